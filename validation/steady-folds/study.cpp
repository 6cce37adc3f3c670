// Up to which capillary number does a steady state exist? Folds of neo-Hookean capsules against size, shape and bending
// stiffness on two meshes; the same search for Skalak's law.
#include "base/failure.hpp"
#include "law/neo_hookean.hpp"
#include "law/skalak.hpp"
#include "steady/fold_error.hpp"
#include "steady/mesh_change.hpp"
#include "steady/steady_state.hpp"
#include "steady_folds.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>
#include <string>
#include <vector>

using namespace capsule;

namespace {

constexpr const char *flow_key = "flow.capillary_number";
constexpr double first_flow = 0.05; // weaker flows may buckle the soft shells
constexpr double highest_flow = 0.5;
constexpr int coarse = 96, fine = 128; // nodes
constexpr double allowed = 1e-6;       // between the meshes, in the capillary number

struct Curve {
  const char *name;
  double aspect_ratio, bending_ratio;
  std::vector<double> radii;
};
std::vector<Curve> curves() {
  return {{"sphere", 1, 1e-3, {0.7, 0.75, 0.8, 0.85, 0.9, 0.95, 1, 1.05, 1.1}},
          {"stiff sphere", 1, 1e-2, {0.7, 0.8, 0.9, 1}},
          {"flat", 0.5, 1e-3, {0.7, 0.8, 0.9, 1}}};
}

Case case_of(const MembraneLaw &law, double radius, double aspect_ratio, double bending_ratio) {
  Case physics;
  physics.accuracy = 1e-6;
  physics.membrane.law = law;
  physics.membrane.bending_ratio = bending_ratio;
  physics.capsule.radius = radius;
  physics.capsule.aspect_ratio = aspect_ratio;
  physics.flow.capillary_number = first_flow;
  return physics;
}

// A row: where the fold is on both meshes, what the capsule looks like there, and the estimated errors of the coarse one.
std::string neo_hookean_fold(const Curve &curve, double radius) {
  const Case physics = case_of(neo_hookean, radius, curve.aspect_ratio, curve.bending_ratio);
  const FoldSearch search = find_fold(physics, on_mesh(physics, coarse, find_steady(physics, {}, {})),
                                      flow_key, highest_flow, 0.15);
  if (!search.fold)
    throw std::runtime_error(
        fmt::format("{}, R = {}: no fold, {} at {}", curve.name, radius, search.end, search.last.value));
  const SteadyPoint first = search.fold->point;
  const std::map<std::string, double> errors = errors_of_fold(search.state, flow_key, first.row);
  const SteadyPoint second = fold_on_mesh(physics, flow_key, highest_flow, *search.fold, fine).point;
  return fmt::format("{},{},{},{},{:.12f},{:.12f},{:.2e},{:.2e},{:.6f},{:.6f},{:.11f},{:.2e},{:.11f},{:.2e}",
                     curve.name, curve.aspect_ratio, curve.bending_ratio, radius, second.value, first.value,
                     second.growth_rate, first.growth_rate, second.row.max_stretch, second.row.min_film,
                     second.row.pressure_drop, errors.at(flow_key), first.row.pressure_drop,
                     errors.at("pressure_drop"));
}

// A row: how far the branch goes until it ends or turns, on finer meshes where they are called for.
std::string skalak_branch(double dilatation, double radius) {
  constexpr double bending_ratio = 1e-2;
  constexpr int first = 64, finest = 240;
  Case physics = case_of({skalak, {dilatation}}, radius, 1, bending_ratio);
  SteadyState state = on_mesh(physics, first, find_steady(physics, {}, {}));
  for (;;) {
    const FoldSearch search = find_fold(physics, state, flow_key, highest_flow, 0.25);
    const auto nodes = static_cast<int>(state.system->nodes());
    const SteadyPoint &last = search.last;
    std::string row =
        fmt::format("{},{},{},{},{:.6f},{},{:.4f},{:.4f},{:.6f}", dilatation, radius, bending_ratio,
                    search.end, last.value, nodes, last.growth_rate, last.row.max_stretch, last.row.min_film);
    if (search.end != "mesh" || finer_mesh(nodes) > finest)
      return row;
    physics.flow.capillary_number = search.last.value;
    try {
      state = on_mesh(physics, finer_mesh(nodes), search.state);
    } catch (const NumericsFailure &) {
      return row;
    }
  }
}

bool study(const std::string &directory, unsigned jobs) {
  std::vector<TextTask> tasks;
  for (const Curve &curve : curves())
    for (const double radius : curve.radii)
      tasks.push_back({fmt::format("neo-hookean {} {}", curve.name, radius),
                       [=] { return neo_hookean_fold(curve, radius); }});
  const std::size_t folds_to_find = tasks.size();
  for (const double dilatation : {0.0, 1.0, 10.0})
    for (const double radius : {0.7, 0.9, 1.1})
      tasks.push_back({fmt::format("skalak {} {}", dilatation, radius),
                       [=] { return skalak_branch(dilatation, radius); }});
  const std::vector<std::string> rows = make_all(directory, jobs, tasks);

  const std::string fold_header =
      "capsule,aspect_ratio,bending_ratio,radius,capillary_number,coarse,growth_rate,coarse_growth_rate,"
      "max_stretch,min_film,pressure_drop,estimate,coarse_pressure_drop,pressure_drop_estimate";
  Table folds(fold_header);
  double apart = 0, growth = 0;
  std::vector<double> looseness; // estimates over distances of both meshes
  for (std::size_t k = 0; k < folds_to_find; ++k) {
    folds.add(rows[k]);
    const Rows fold(fold_header, rows[k]);
    apart = std::max(apart, std::abs(fold.value(0, "capillary_number") - fold.value(0, "coarse")));
    const auto compare = [&](const char *value, const char *coarse_value, const char *estimate) {
      looseness.push_back(fold.value(0, estimate) /
                          std::abs(fold.value(0, value) - fold.value(0, coarse_value)));
    };
    compare("capillary_number", "coarse", "estimate");
    compare("pressure_drop", "coarse_pressure_drop", "pressure_drop_estimate");
    growth = std::max(
        {growth, std::abs(fold.value(0, "growth_rate")), std::abs(fold.value(0, "coarse_growth_rate"))});
    fmt::print("NH {:12} R = {:4}: no steady state beyond eps = {}, stretch {} there\n",
               fold.text(0, "capsule"), fold.text(0, "radius"), fold.text(0, "capillary_number"),
               fold.text(0, "max_stretch"));
  }
  folds.write(directory + "/folds.csv");
  const std::string end_header =
      "dilatation,radius,bending_ratio,end,capillary_number,nodes,growth_rate,max_stretch,min_film";
  Table ends(end_header);
  bool none = true, bounded = true;
  for (std::size_t k = folds_to_find; k < rows.size(); ++k) {
    ends.add(rows[k]);
    const Rows branch(end_header, rows[k]);
    const std::string &end = branch.text(0, "end");
    if (branch.value(0, "dilatation") == 10)
      none = none && end == "end of the path" && branch.value(0, "growth_rate") < 0;
    bounded = bounded && branch.value(0, "max_stretch") < 2;
    fmt::print("SK C = {:2} R = {:4}: {} at eps = {}, stretch {}, growth rate {}\n",
               branch.text(0, "dilatation"), branch.text(0, "radius"),
               end == "mesh" ? "no fold; a finer mesh is needed" : end, branch.text(0, "capillary_number"),
               branch.text(0, "max_stretch"), branch.text(0, "growth_rate"));
  }
  ends.write(directory + "/skalak.csv");
  const bool agree = apart <= allowed;
  const bool neutral = growth <= allowed;
  std::ranges::sort(looseness);
  const bool estimated = looseness.front() >= 1;
  const auto verdict = [](bool holds) { return holds ? "HOLDS" : "FAILS"; };
  fmt::print("steady-folds: {}: folds on two meshes are {:.1e} apart; {}: largest growth rate there {:.1e}\n",
             verdict(agree), apart, verdict(neutral), growth);
  fmt::print("steady-folds: {}: estimated errors of places and pressure drops are at least {:.1f} times what "
             "both meshes "
             "differ by, in the median {:.0f} times\n",
             verdict(estimated), looseness.front(), looseness[looseness.size() / 2]);
  fmt::print("steady-folds: {}: no fold of Skalak's law with C = 10 up to eps = {}, all stable; {}: branches "
             "with C = 0 "
             "and 1 end at stretches below 2\n",
             verdict(none), highest_flow, verdict(bounded));
  return agree && neutral && estimated && none && bounded;
}

} // namespace

int main(int argc, char **argv) {
  return study_main(argc, argv, study);
}
