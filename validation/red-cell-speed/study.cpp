// What a red cell costs: time against error of its way through a short pore, with and without a viscous membrane; and steps
// and time of cells whose area is the harder to change the larger Skalak's C is, to where it hardly changes at all.
#include "study.hpp"
#include "law/skalak.hpp"
#include "motion/dynamics.hpp"
#include "motion/split_bdf.hpp"
#include "observe/gauge.hpp"
#include "scene/resolution.hpp"
#include "steady/steady_state.hpp"
#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <limits>

using namespace capsule;

namespace {

constexpr double viscous = 200; // mu_s of a red cell's membrane

// A red cell in an analyzer: lambda = 5, C = 100.
struct Mesh {
  int nodes, wall;
  double accuracy;
};
Case red_cell(double shear_viscosity, const Mesh &mesh) {
  Case physics = physics_of("red-cell-transit");
  physics.flow.capillary_number = 2;
  physics.membrane.bending_ratio = 1e-2;
  physics.membrane.viscosity.shear = shear_viscosity;
  physics.mesh.membrane = mesh.nodes;
  physics.mesh.wall = mesh.wall;
  physics.accuracy = mesh.accuracy;
  return physics;
}

// ---- Time against error ----

// With a viscous membrane the rear keeps a crease, which rides close to the wall: both need short panels.
constexpr std::array meshes{Mesh{64, 440, 1e-2}, Mesh{88, 700, 1e-2}, Mesh{112, 1000, 1e-3}};
constexpr Mesh reference{128, 1300, 5e-4};
constexpr std::array quantities{"time", "v_g", "pressure_drop", "flow_rate"};
constexpr double asked = 0.01; // of each quantity's largest value
constexpr int asked_on = 112;  // nodes

RunInput transit(double shear_viscosity, const Mesh &mesh) {
  return {fmt::format("mu_s={}-{}", shear_viscosity, mesh.nodes), red_cell(shear_viscosity, mesh)};
}

double largest(const StudyRun &run, const std::string &quantity) {
  const std::vector<double> &values = run.history.at(quantity);
  return std::abs(*std::ranges::max_element(values, {}, [](double value) { return std::abs(value); }));
}

// Largest estimated error along the way, relative to the largest value.
double estimate(const StudyRun &run, const std::string &quantity) {
  return run.summary.error_estimate.at(quantity + "@x_g") / largest(run, quantity);
}

bool time_against_error(const std::string &directory, unsigned jobs) {
  std::vector<RunInput> inputs;
  for (const double viscosity : {0.0, viscous}) {
    inputs.push_back(transit(viscosity, reference));
    for (const Mesh &mesh : meshes)
      inputs.push_back(transit(viscosity, mesh));
  }
  const std::vector<StudyRun> runs = run_all(directory, jobs, inputs);
  std::string header = "shear_viscosity,nodes,accuracy,steps,seconds,transit_time";
  for (const std::string quantity : quantities)
    header += fmt::format(",{0}_error,{0}_estimate", quantity);
  Table table(header);
  bool reached = true, bounded = true;
  double worst = 0;
  const StudyRun *exact = nullptr;
  for (std::size_t k = 0; k < runs.size(); ++k) {
    const Case &physics = inputs[k].physics;
    const StudyRun &run = runs[k];
    reached = reached && run.summary.status == "reached";
    if (physics.mesh.membrane == reference.nodes)
      exact = &run;
    std::string row =
        fmt::format("{},{},{},{},{:.4g},{:.6g}", physics.membrane.viscosity.shear, physics.mesh.membrane,
                    physics.accuracy, run.summary.quantities.at("steps"),
                    run.summary.quantities.at("cpu_seconds"), run.summary.quantities.at("transit_time"));
    for (const std::string quantity : quantities) {
      const double error = history_error(run.history, exact->history, quantity, physics.capsule.start_x,
                                         physics.until.x_g.value());
      const double estimated = estimate(run, quantity);
      row += fmt::format(",{:.3e},{:.3e}", error, estimated);
      bounded = bounded && error < estimated + estimate(*exact, quantity);
      if (physics.membrane.viscosity.shear > 0 && physics.mesh.membrane == asked_on)
        worst = std::max(worst, estimated);
    }
    table.add(row);
  }
  table.write(directory + "/transits.csv");
  bool holds = check(reached, "every red cell passes the pore");
  holds = check(bounded, "no error is above its estimate and that of the reference together") && holds;
  holds =
      check(worst < asked, fmt::format("with mu_s = {} on {} nodes the estimated errors are below {:.2f} %",
                                       viscous, asked_on, 100 * worst)) &&
      holds;
  return holds;
}

// ---- Cost against C ----

struct Cell {
  std::string name;
  Case physics;
  bool settles; // in a tube
};

std::vector<Cell> cells() {
  Case oblate;
  oblate.accuracy = 1e-3;
  oblate.capsule.radius = 0.8;
  oblate.capsule.aspect_ratio = 0.6;
  oblate.membrane.law = skalak;
  oblate.membrane.bending_ratio = 1e-2;
  oblate.flow.capillary_number = 0.09;
  oblate.until.x_g = 8;
  Case biconcave = oblate;
  biconcave.capsule.aspect_ratio = 1;
  biconcave.capsule.shape = CapsuleShape::biconcave;
  Case plain = red_cell(0, {160, 0, 1e-2}), with_viscosity = red_cell(viscous, {80, 0, 1e-2});
  plain.until.x_g = with_viscosity.until.x_g = 3;
  return {{"oblate", oblate, true},
          {"biconcave", biconcave, true},
          {"transit", plain, false},
          {"viscous-transit", with_viscosity, false}};
}

// A march without rows, in one go, with all that it asks for counted.
std::string cost_of(const Cell &cell, double dilatation) {
  Case physics = cell.physics;
  physics.membrane.law = {skalak, {dilatation}};
  const Dynamics dynamics = make_dynamics(physics);
  const Membrane &membrane = dynamics.scene->membrane;
  const Gauge gauge(dynamics.scene->pore, membrane);
  long velocities = 0, mobilities = 0, steps = 0;
  const SplitEquations equations{.load = dynamics.load,
                                 .rate = [&](const Vector &position) -> SplitEquations::Rate {
                                   ++velocities;
                                   return {dynamics.flow(position).velocity};
                                 },
                                 .mobility =
                                     [&](const Vector &position) {
                                       ++mobilities;
                                       return dynamics.mobility(position);
                                     },
                                 .load_jacobian = dynamics.load_jacobian};
  const double began = cpu_seconds();
  SplitBdf integrator(equations, 0, dynamics.scene->start, choose_resolution(physics).time_tolerance);
  Vector position;
  double area_change = 0;
  do {
    integrator.step();
    ++steps;
    position = integrator.state_at(integrator.time());
    const MembraneState state = membrane_state(membrane, membrane.at_nodes, position);
    area_change =
        std::max(area_change,
                 (state.stretch_meridional.array() * state.stretch_azimuthal.array() - 1).abs().maxCoeff());
  } while (gauge.centre(position) < physics.until.x_g.value());
  const double seconds = cpu_seconds() - began;
  const FlowState flow = dynamics.flow(position);
  double settled = std::numeric_limits<double>::quiet_NaN();
  if (cell.settles) {
    const Outcome found = steady(physics, gauge.profile(integrator.time(), position, flow.velocity), {});
    if (found.status == Status::steady)
      settled = found.last.series.front().pressure_drop;
  }
  return fmt::format("{},{},{},{},{},{},{:.4g},{:.4e},{:.8g},{:.8g}", cell.name, dilatation,
                     membrane.basis.size(), steps, velocities, mobilities, seconds, area_change,
                     flow.pressure_drop, settled);
}

struct Cost {
  double steps, area_change, pressure_drop, settled;
};

constexpr const char *cost_header = "cell,dilatation,nodes,steps,velocities,mobilities,seconds,area_change,"
                                    "pressure_drop,steady_pressure_drop";

Cost read_cost(const std::string &text) {
  const Rows row(cost_header, text);
  return {row.value(0, "steps"), row.value(0, "area_change"), row.value(0, "pressure_drop"),
          row.value(0, "steady_pressure_drop")};
}

bool cost_against_dilatation(const std::string &directory, unsigned jobs) {
  const std::array dilatations{10.0, 100.0, 1e3, 1e4};
  std::vector<TextTask> tasks;
  const std::vector<Cell> all = cells();
  for (const Cell &cell : all)
    for (const double dilatation : dilatations)
      tasks.push_back({fmt::format("{}-{}", cell.name, dilatation),
                       [cell, dilatation] { return cost_of(cell, dilatation); }});
  const std::vector<std::string> rows = make_all(directory, jobs, tasks);
  Table table(cost_header);
  for (const std::string &row : rows)
    table.add(row);
  table.write(directory + "/costs.csv");

  double more_steps = 0, off_the_steady = 0, area_change = 0;
  double least_order = std::numeric_limits<double>::infinity(), largest_order = -least_order;
  for (std::size_t k = 0; k < all.size(); ++k) {
    const auto at = [&](std::size_t i) { return read_cost(rows[k * dilatations.size() + i]); };
    more_steps = std::max(more_steps, at(3).steps / at(1).steps);
    if (!all[k].settles)
      continue;
    for (std::size_t i = 0; i < dilatations.size(); ++i)
      off_the_steady = std::max(off_the_steady, std::abs(at(i).pressure_drop / at(i).settled - 1));
    area_change = std::max(area_change, at(3).area_change);
    for (const double order :
         {std::log10(at(1).area_change / at(3).area_change) / 2,
          std::log10((at(2).settled - at(1).settled) / (at(3).settled - at(2).settled))}) {
      least_order = std::min(least_order, order);
      largest_order = std::max(largest_order, order);
    }
  }
  bool holds = check(more_steps < 1.5,
                     fmt::format("C = 1e4 takes at most {:.2f} times the steps of C = 100", more_steps));
  holds = check(area_change < 1e-3,
                fmt::format("the area of cells in a tube then changes nowhere by more than {:.1e}",
                            area_change)) &&
          holds;
  holds = check(least_order > 0.9 && largest_order < 1.1,
                fmt::format("they come to cells of constant area with the orders {:.3f} to {:.3f} in 1/C",
                            least_order, largest_order)) &&
          holds;
  holds = check(off_the_steady < 1e-3,
                fmt::format("and end within {:.1e} of the steady pressure drop", off_the_steady)) &&
          holds;
  return holds;
}

bool study(const std::string &directory, unsigned jobs) {
  make_directories(directory);
  const bool cheap = cost_against_dilatation(directory, jobs);
  return time_against_error(directory, jobs) && cheap;
}

} // namespace

int main(int argc, char **argv) {
  return study_main(argc, argv, study);
}
