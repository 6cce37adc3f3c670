#include "steady_folds.hpp"
#include "base/failure.hpp"
#include "case/key_path.hpp"
#include "steady/continuation.hpp"
#include "steady/refinement.hpp"
#include <cmath>
#include <fmt/format.h>

namespace capsule {
namespace {

constexpr double most_stretch = 8; // folds lie below
constexpr int most_steps = 60;

SteadyPoint point_at(const SteadyState &state, const Case &physics, double value) {
  state.system->set_parameters(physics);
  const SteadyRecord record = record_steady(state);
  return {value, record.row, record.further.at("growth_rate"),
          std::abs(state.unknowns[state.unknowns.size() - 1])};
}

} // namespace

FoldSearch find_fold(const Case &physics, const SteadyState &start, const std::string &key, double to,
                     double largest_step, const Look &look) {
  const KeyPath path(key, physics, to);
  FoldSearch search;
  search.state = start;
  BranchPoint good{start.unknowns, 0};
  Branch branch(*start.system, path, good, Branch::upwards(*start.system),
                {.first = largest_step, .largest = largest_step, .tolerance = 1e-6});
  for (int step = 0; search.end.empty(); ++step) {
    if (step == most_steps) { // short steps: Newton's method has a hard time
      search.end = "mesh";
      break;
    }
    try {
      branch.advance();
    } catch (const NumericsFailure &) {
      search.end = "mesh";
      break;
    }
    BranchPoint now = branch.point();
    if (branch.turned()) {
      try {
        now = branch.fold();
      } catch (const NumericsFailure &) {
        search.end = "mesh";
        break;
      }
      search.end = "fold";
      search.fold = Fold{{}, path.value(good.parameter), {start.system, good.unknowns}};
    } else if (branch.wants_a_finer_mesh()) {
      search.end = "mesh";
      break;
    } else if (now.parameter >= 1)
      search.end = "end of the path";
    good = now;
    search.state.unknowns = now.unknowns;
    if (search.end.empty() && search.state.system->largest_stretch(search.state.unknowns) > most_stretch)
      search.end = "stretch";
    if (look)
      look(search.state, path.at(now.parameter));
  }
  search.last = point_at(search.state, path.at(good.parameter), path.value(good.parameter));
  if (search.fold)
    search.fold->point = search.last;
  return search;
}

Fold fold_on_mesh(const Case &physics, const std::string &key, double to, const Fold &fold, int nodes) {
  const Case before = with_number(physics, key, fold.value_before);
  const SteadyState state = on_mesh(before, nodes, fold.before);
  constexpr double short_step = 0.03;
  const FoldSearch search = find_fold(before, state, key, to, short_step);
  if (!search.fold)
    throw NumericsFailure(
        "unresolved",
        fmt::format("the fold at {} = {} is not there on {} nodes", key, fold.point.value, nodes),
        "another mesh");
  return *search.fold;
}

} // namespace capsule
