// One capsule, two stable steady states: where the rear of a capsule snaps from round to dented and back, along the flow,
// the size and the stiffness; and whether marches do so.
#include "study.hpp"
#include "base/atomic_file.hpp"
#include "base/failure.hpp"
#include "case/keys.hpp"
#include "law/neo_hookean.hpp"
#include "law/skalak.hpp"
#include "motion/march.hpp"
#include "steady/branch.hpp"
#include "steady/fold_curve.hpp"
#include "steady/refinement.hpp"
#include "steady/steady_state.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <optional>
#include <utility>

using namespace capsule;

namespace {

constexpr const char *size_key = "capsule.radius", *shape_key = "capsule.aspect_ratio";
constexpr double weak = 2e-3, strong = 0.1; // flows before and behind both folds
constexpr int finest = 320;                 // nodes
constexpr double allowed_march = 1e-3;      // between marches and steady states, in the pressure drop
constexpr double allowed_folds = 1e-5;      // between the folds of a branch and those that are followed

struct Family {
  const char *name;
  MembraneLaw law;
};
const std::vector<Family> families = {{"neo-Hookean", neo_hookean},
                                      {"Skalak C = 0", {skalak, {0}}},
                                      {"Skalak C = 1", {skalak, {1}}},
                                      {"Skalak C = 10", {skalak, {10}}}};
constexpr std::size_t marched_family = 2;

Case case_of(const Family &family) {
  Case physics;
  physics.capsule.radius = 0.9;
  physics.membrane.law = family.law;
  physics.membrane.bending_ratio = 1e-3;
  physics.flow.capillary_number = weak;
  physics.accuracy = 1e-6;
  return physics;
}

// Which fold is followed, along which key, and towards which value.
struct Direction {
  int fold;
  const char *key;
  double to;
};
// The second fold where the first one does not come back to it by way of a cusp. Two ends for the size: the first steps of
// some lines succeed with one of them only.
constexpr Direction directions[] = {{1, size_key, 1.2},     {1, size_key, 0.6},     {1, size_key, 0.5},
                                    {1, bending_key, 2e-3}, {1, bending_key, 2e-4}, {2, bending_key, 2e-4},
                                    {1, shape_key, 0.6},    {1, shape_key, 1.5},    {2, shape_key, 1.5}};

struct FoldOfBranch {
  SteadyState state;
  FoldPoint point;
  Vector null_vector;
};

// A fold of the branch of growing flow, the first or the second one. Throws NumericsFailure if there is none.
FoldOfBranch fold_of_branch(const Case &physics, const KeyPath &flow, int number) {
  constexpr int most_points = 200;
  const SteadyState state = refine(physics, find_steady(physics, {}, {}), {}).state;
  Branch branch(*state.system, flow, {state.unknowns, 0}, Branch::upwards(*state.system),
                {.first = 0.02, .largest = 0.05, .tolerance = 1e-9});
  int folds = 0;
  for (int k = 0; k < most_points && branch.point().parameter < 1; ++k) {
    branch.advance();
    if (branch.turned() && ++folds == number) {
      const BranchPoint fold = branch.fold();
      return {{state.system, fold.unknowns},
              {fold.unknowns, fold.parameter, 0},
              branch.tangent_before().head(fold.unknowns.size())};
    }
  }
  throw NumericsFailure("no fold", "the branch has no fold", "");
}

// A row per point of the fold that is followed along a second key, through the cusp and back if there is one.
std::string fold_rows(const Family &family, const Direction &direction) {
  const int number = direction.fold;
  const char *key = direction.key;
  const double to = direction.to;
  const Case physics = case_of(family);
  const KeyPath flow(flow_key, physics, strong), second(key, physics, to);
  std::string rows;
  const auto add = [&](const SteadyState &state, const FoldPoint &point) {
    const SteadyRecord record = record_steady(state);
    rows += fmt::format("{},{},{},{},{:.10g},{:.10g},{:.8g},{}\n", family.name, number, key, to,
                        second.value(point.second_part), flow.value(point.part), record.row.pressure_drop,
                        record.row.dents);
  };
  try {
    FoldOfBranch fold = fold_of_branch(physics, flow, number);
    follow_fold(fold.state, fold.point, fold.null_vector, flow, second, finest, {}, add);
  } catch (const NumericsFailure &failure) {
    rows += fmt::format("{},{},{},{},,,,{}\n", family.name, number, key, to, failure.kind);
  }
  return rows;
}

// The branch of one size and stiffness, and its folds.
std::string branch_rows(const Family &family) {
  const Outcome outcome = follow_branch(case_of(family), {flow_key, strong}, {});
  std::string rows;
  const auto add = [&](const BranchRow &point, const char *kind) {
    rows += fmt::format("{},{},{:.10g},{:.8g},{:.8g},{},{:.4g}\n", family.name, kind, point.parameter,
                        point.row.v_g, point.row.pressure_drop, point.row.dents, point.growth_rate);
  };
  for (const BranchRow &point : outcome.branch)
    add(point, "point");
  for (const BranchRow &fold : outcome.folds)
    add(fold, "fold");
  return rows;
}

// The end of a march, and the steady state next to it.
std::string march_row(const char *flow, const Case &physics, const Outcome &marched) {
  if (marched.status != Status::reached)
    throw std::runtime_error(marched.message);
  const SeriesRow &end = marched.last.series.back();
  const Outcome state = steady(physics, marched.last.profiles.back(), {});
  if (state.status != Status::steady)
    throw std::runtime_error(state.message);
  const SeriesRow &row = state.last.series.at(0);
  return fmt::format("{},{},{:.8g},{:.8g},{},{},{:.3g},{:.4g}\n", flow, physics.flow.capillary_number,
                     end.pressure_drop, row.pressure_drop, end.dents, row.dents, end.max_axial_residual,
                     state.further.at("growth_rate"));
}

// Marches in the tube, each from the shape at the end of the one before, in a flow that rises and then falls again; at
// last one that comes through the mouth.
std::string march_rows() {
  constexpr double duration = 15;
  const std::vector<double> rising = {0.008, 0.0095, 0.0102, 0.011, 0.0116, 0.0125, 0.014};
  std::vector<double> flows = rising;
  flows.insert(flows.end(), rising.rbegin() + 1, rising.rend());
  Case in_tube = case_of(families[marched_family]);
  in_tube.pore.shape = PoreShape::tube;
  in_tube.pore.exit_x = 25;
  in_tube.capsule.start_x = 0;
  in_tube.until.time = duration;
  std::string rows;
  Vector shape; // empty: undeformed
  for (std::size_t k = 0; k < flows.size(); ++k) {
    in_tube.flow.capillary_number = flows[k];
    Checkpoint from;
    from.position = shape;
    const Outcome marched = march_once(in_tube, from, {}, Role::main);
    rows += march_row(k < rising.size() ? "rising" : "falling", in_tube, marched);
    shape = marched.last.position;
    shape.head(shape.size() / 2).array() -= marched.last.series.back().x_g;
  }
  Case entering = case_of(families[marched_family]);
  entering.flow.capillary_number = 0.011;
  entering.until.x_g = 20;
  entering.pore.exit_x = 28;
  return rows + march_row("entering", entering, march_once(entering, {}, {}, Role::main));
}

const std::string branch_header = "law,kind,capillary_number,v_g,pressure_drop,dents,growth_rate";
const std::string fold_header = "law,fold,key,towards,value,capillary_number,pressure_drop,dents";
const std::string march_header =
    "flow,capillary_number,pressure_drop,steady_pressure_drop,dents,steady_dents,axial_residual,growth_rate";

// Where a line of folds turns back in the second key: the vertex of the parabola through its last three points there, over
// the pressure drop, which grows evenly along the line.
struct Cusp {
  double value, capillary_number;
};
std::optional<Cusp> cusp_of(const Rows &line) {
  std::size_t last = 0;
  const auto way = [&](std::size_t k) { return std::abs(line.value(k, "value") - line.value(0, "value")); };
  for (std::size_t k = 1; k < line.size() && !line.text(k, "value").empty(); ++k)
    if (way(k) > way(last))
      last = k;
  if (last == 0 || last + 1 >= line.size() || line.text(last + 1, "value").empty())
    return {};
  // Newton's form: q(x) = q0 + d1 (x - x0) + d2 (x - x0)(x - x1)
  const auto x = [&](std::size_t k) { return line.value(last - 1 + k, "pressure_drop"); };
  const auto differences = [&](const char *name) {
    const auto q = [&](std::size_t k) { return line.value(last - 1 + k, name); };
    const double d1 = (q(1) - q(0)) / (x(1) - x(0));
    return std::pair{d1, ((q(2) - q(1)) / (x(2) - x(1)) - d1) / (x(2) - x(0))};
  };
  const auto [d1, d2] = differences("value");
  const double vertex = (x(0) + x(1)) / 2 - d1 / (2 * d2);
  const auto at_vertex = [&](const char *name) {
    const auto [first, second] = differences(name);
    return line.value(last - 1, name) + first * (vertex - x(0)) + second * (vertex - x(0)) * (vertex - x(1));
  };
  return Cusp{at_vertex("value"), at_vertex("capillary_number")};
}

// Whether a line of folds that has passed by a cusp ends at the branch's other fold.
bool ends_at_other_fold(const Rows &line, const Rows &branch, double &worst) {
  double other = 0;
  for (std::size_t k = 0; k < branch.size(); ++k)
    if (branch.text(k, "kind") == "fold")
      other = branch.value(k, "capillary_number");
  worst = std::max(worst, std::abs(line.value(line.size() - 1, "capillary_number") / other - 1));
  return worst < allowed_folds;
}

bool study(const std::string &directory, unsigned jobs) {
  std::vector<TextTask> tasks = {{"marches", march_rows}};
  for (const Family &family : families) {
    tasks.push_back({fmt::format("{}-branch", family.name), [&] { return branch_rows(family); }});
    for (const Direction &direction : directions)
      tasks.push_back({fmt::format("{}-{}-{}-{}", family.name, direction.fold, direction.key, direction.to),
                       [&] { return fold_rows(family, direction); }});
  }
  const std::vector<std::string> texts = make_all(directory, jobs, tasks);
  const auto write = [&](const char *file, const std::string &header, const std::string &rows) {
    write_atomically(directory + "/" + file, header + "\n" + rows);
  };

  std::string branches, folds, cusps;
  bool same_folds = true;
  double worst_folds = 0;
  for (std::size_t f = 0; f < families.size(); ++f) {
    const std::string *of_family = &texts[1 + f * (1 + std::size(directions))];
    const Rows branch(branch_header, of_family[0]);
    branches += of_family[0];
    for (std::size_t d = 0; d < std::size(directions); ++d) {
      const Rows line(fold_header, of_family[1 + d]);
      folds += of_family[1 + d] + "\n\n"; // blocks of lines that belong together
      if (const auto cusp = line.size() > 2 ? cusp_of(line) : std::nullopt) {
        cusps += fmt::format("{},{},{:.6g},{:.6g}\n", families[f].name, directions[d].key, cusp->value,
                             cusp->capillary_number);
        if (directions[d].fold == 1 && !line.text(line.size() - 1, "value").empty())
          same_folds &= ends_at_other_fold(line, branch, worst_folds);
      }
    }
  }
  write("branches.csv", branch_header, branches);
  write("folds.csv", fold_header, folds);
  write("cusps.csv", "law,key,value,capillary_number", cusps);
  write("marches.csv", march_header, texts[0]);
  fmt::print("cusps:\n{}", cusps);

  const Rows marches(march_header, texts[0]),
      branch(branch_header, texts[1 + marched_family * (1 + std::size(directions))]);
  std::vector<double> of_folds;
  for (std::size_t k = 0; k < branch.size(); ++k)
    if (branch.text(k, "kind") == "fold")
      of_folds.push_back(branch.value(k, "capillary_number"));
  double worst = 0, least_apart = std::numeric_limits<double>::infinity();
  if (!check(of_folds.size() == 2, fmt::format("the branch of the marches has {} folds", of_folds.size())))
    return false;
  bool keeps_its_shape = true;
  for (std::size_t k = 0; k < marches.size(); ++k) {
    worst = std::max(
        worst, std::abs(marches.value(k, "pressure_drop") / marches.value(k, "steady_pressure_drop") - 1));
    const double flow = marches.value(k, "capillary_number");
    const bool falls = marches.text(k, "flow") == "falling";
    const bool is_dented = flow > of_folds.at(0) || (falls && flow > of_folds.at(1));
    keeps_its_shape = keeps_its_shape && (marches.value(k, "dents") > 0) == is_dented;
    for (std::size_t other = 0; other < k && is_dented; ++other)
      if (marches.value(other, "capillary_number") == flow && marches.value(other, "dents") == 0)
        least_apart = std::min(least_apart,
                               marches.value(k, "pressure_drop") / marches.value(other, "pressure_drop") - 1);
  }
  bool holds =
      check(same_folds && worst_folds > 0,
            fmt::format("lines of folds that pass by a cusp end at the branch's other fold, {:.1e} apart",
                        worst_folds));
  holds &= check(worst < allowed_march,
                 fmt::format("the ends of the marches are steady states, {:.1e} apart", worst));
  holds &= check(keeps_its_shape,
                 "marches stay round in a rising flow up to one fold, and dented in a falling one "
                 "down to the other; one that comes through the mouth is round");
  holds &= check(least_apart > 0 && std::isfinite(least_apart),
                 fmt::format("in the same flow the dented state costs {:.1f} % more pressure at least",
                             100 * least_apart));
  return holds;
}

} // namespace

int main(int argc, char **argv) {
  return study_main(argc, argv, study);
}
