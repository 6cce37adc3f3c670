// Do steady shapes without marching agree with marches through a long tube? Capsules of both laws, spheres and
// ellipsoids, soft and stiff shells.
#include "study.hpp"
#include "law/neo_hookean.hpp"
#include "law/skalak.hpp"
#include "motion/motion.hpp"
#include "steady/steady_state.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

using namespace capsule;

namespace {

constexpr double allowed = 2e-5;        // relative, of speed and pressure drop
constexpr double allowed_meshes = 1e-7; // the same between two meshes of the steady state

struct Capsule {
  const char *name;
  MembraneLaw law;
  int march_nodes; // 0: as the accuracy asks for
  double radius, aspect_ratio, capillary_number, bending_ratio;
};
const Capsule capsules[] = {{"NH 0.8", neo_hookean, 0, 0.8, 1, 0.09, 1e-5},
                            {"NH 0.9", neo_hookean, 0, 0.9, 1, 0.05, 1e-4},
                            {"NH 0.6", neo_hookean, 0, 0.6, 1, 0.1, 1e-3},
                            {"SK0 0.9", {skalak, {0}}, 0, 0.9, 1, 0.04, 1e-5},
                            {"SK1 0.8", {skalak, {1}}, 0, 0.8, 1, 0.09, 1e-4},
                            {"SK10 1.0", {skalak, {10}}, 0, 1, 1, 0.05, 1e-3},
                            {"SK0 0.9 flat", {skalak, {0}}, 0, 0.9, 0.28, 0.04, 1e-3},
                            {"SK1 0.7 flat", {skalak, {1}}, 0, 0.7, 0.5, 0.1, 1e-4},
                            {"NH 0.8 flat", neo_hookean, 0, 0.8, 0.5, 0.05, 1e-3},
                            {"SK1 0.9 Fig. 16", {skalak, {1}}, 360, 0.9, 0.28, 0.09, 1e-5},
                            {"SK0 0.8 flat", {skalak, {0}}, 0, 0.8, 0.28, 0.01, 1e-4},
                            {"SK1 0.7 long", {skalak, {1}}, 0, 0.711, 1.149, 0.0379, 9.1e-5}};

// From the mouth to where nothing is left of the entrance, with the exit out of reach.
RunInput long_march(const Capsule &capsule, std::size_t number) {
  RunInput run;
  run.name = fmt::format("{}", number);
  Case &c = run.physics;
  c.accuracy = 1e-5;
  c.membrane.law = capsule.law;
  c.membrane.bending_ratio = capsule.bending_ratio;
  c.capsule.radius = capsule.radius;
  c.capsule.aspect_ratio = capsule.aspect_ratio;
  c.flow.capillary_number = capsule.capillary_number;
  c.mesh.membrane = capsule.march_nodes;
  c.until.x_g = 30;
  c.pore.exit_x = 38;
  return run;
}

bool study(const std::string &directory, unsigned jobs) {
  std::vector<RunInput> inputs;
  for (const Capsule &capsule : capsules)
    inputs.push_back(long_march(capsule, inputs.size() + 1));
  const std::vector<StudyRun> marches = run_all(directory, jobs, inputs);

  Table table("capsule,v_g,v_g_apart,pressure_drop,pressure_drop_apart,max_stretch_apart,meshes_apart,nodes,"
              "seconds,march_seconds");
  double worst = 0, worst_meshes = 0;
  for (std::size_t k = 0; k < marches.size(); ++k) {
    Case physics = inputs[k].physics;
    physics.accuracy = allowed_meshes;
    physics.mesh.membrane = 0;
    const double before = cpu_seconds();
    const Outcome found = steady(physics, {}, {});
    const double seconds = cpu_seconds() - before;
    if (found.status != Status::steady)
      throw std::runtime_error(fmt::format("{}: {}", capsules[k].name, found.message));
    const SeriesRow &row = found.last.series.at(0);
    const auto &marched = marches[k].summary.quantities;
    const auto apart = [&](const char *quantity, double value) {
      return std::abs(marched.at(quantity) / value - 1);
    };
    const double speed = apart("v_g", row.v_g);
    const double pressure = apart("pressure_drop", row.pressure_drop);
    const double meshes = std::max(found.error_estimate.at("v_g") / row.v_g,
                                   found.error_estimate.at("pressure_drop") / row.pressure_drop);
    worst = std::max({worst, speed, pressure});
    worst_meshes = std::max(worst_meshes, meshes);
    fmt::print(
        "{:13} v_g {:.7f}, march {:.1e} off; pressure drop {:.6f}, march {:.1e} off; two meshes {:.1e} "
        "apart\n",
        capsules[k].name, row.v_g, speed, row.pressure_drop, pressure, meshes);
    table.add(fmt::format("{},{:.10g},{:.3g},{:.10g},{:.3g},{:.3g},{:.3g},{},{:.3g},{:.3g}", capsules[k].name,
                          row.v_g, speed, row.pressure_drop, pressure, apart("max_stretch", row.max_stretch),
                          meshes, found.membrane_nodes, seconds, marched.at("cpu_seconds")));
  }
  table.write(directory + "/comparison.csv");
  const bool agree = worst <= allowed;
  const bool resolved = worst_meshes <= allowed_meshes;
  fmt::print(
      "steady-march: {}: marches and steady states are {:.1e} apart; {}: two meshes are {:.1e} apart\n",
      agree ? "HOLDS" : "FAILS", worst, resolved ? "HOLDS" : "FAILS", worst_meshes);
  return agree && resolved;
}

} // namespace

int main(int argc, char **argv) {
  return study_main(argc, argv, study);
}
