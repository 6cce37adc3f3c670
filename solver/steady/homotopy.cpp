#include "steady/homotopy.hpp"
#include "base/failure.hpp"
#include "steady/fold_error.hpp"
#include <fmt/format.h>
#include <memory>

namespace capsule {
namespace {

// On so many the place where a law softens is right to a few per cent.
constexpr int nodes_that_show_softening = 100;

// On the finest mesh a stretch above this that has grown since the fold counts as running away, too.
constexpr double large_stretch = 2;
constexpr double growth_behind_fold = 1.03;

} // namespace

void Homotopy::vary(const std::string &key, double to, const Control &control) {
  const KeyPath path(key, now_, to);
  const SteadyState begin = state_;
  begin_path();
  bool arrived = !path.needed();
  while (!arrived) {
    try {
      arrived = follow(path, control);
    } catch (const NumericsFailure &failure) {
      const bool softens =
          failure.kind == failure_kind::softening && state_.system->nodes() >= nodes_that_show_softening;
      if (failure.kind == failure_kind::fold || softens || !can_refine())
        throw;
    }
    if (place_.part < 0) { // the fold that led here was the coarse mesh's own
      state_ = moved_to_mesh(path.at(0), next_mesh(), begin);
      begin_path();
    } else if (!arrived)
      refine_at(path.at(place_.part));
  }
  now_ = path.at(1);
}

void Homotopy::begin_path() {
  place_ = Place{};
  place_.direction = Branch::upwards(*state_.system);
}

// A guess on a finer mesh, from which the branch goes on in the same direction.
void Homotopy::refine_at(const Case &input) {
  const SteadyState coarse = state_;
  state_ = moved_to_mesh(input, next_mesh(), coarse);
  place_.direction = moved_to(*state_.system, *coarse.system, place_.direction);
}

// Follows the branch, if need be through folds, to its end (true) or to where it needs a finer mesh. When it fails,
// state_ and place_ hold what was reached.
bool Homotopy::follow(const KeyPath &path, const Control &control) {
  const Branch::Steps steps{.first = place_.first_step,
                            .largest = 0.7,
                            .tolerance = 1e-7,
                            .largest_unresolved_part =
                                10 * fine_tail}; // a way need not be as exact as its end
  constexpr int most_steps = 200;
  constexpr double first_part = -1; // as far as a branch that has turned is followed
  Branch branch(*state_.system, path, {state_.unknowns, place_.part}, place_.direction, steps, place_.trend,
                control);
  for (int step = 0; step < most_steps; ++step) {
    state_.unknowns = branch.point().unknowns;
    place_.part = branch.point().parameter;
    place_.direction = branch.tangent();
    place_.trend = branch.trend();
    place_.first_step = branch.plain_step();
    try {
      branch.advance({});
    } catch (const NumericsFailure &failure) {
      if (!place_.turned_at.empty() && !can_refine())
        break; // behind the fold, as far as this mesh goes
      throw NumericsFailure(failure.kind, fmt::format("{} beyond {}", failure.what(), path.text(place_.part)),
                            failure.advice);
    }
    if (branch.wants_a_finer_mesh() && can_refine())
      return false;
    const BranchPoint &now = branch.point();
    if (branch.turned() && now.parameter < branch.point_before().parameter) {
      const BranchPoint fold = branch.fold();
      if (fold.parameter >= 1) { // the step has gone past the end of the path, and back
        state_.unknowns = branch.before_fold(fold, 1).unknowns;
        return true;
      }
      if (place_.turned_at.empty() || fold.parameter > place_.farthest) {
        place_.farthest = fold.parameter;
        place_.fold = {{std::make_shared<SteadySystem>(*state_.system), fold.unknowns},
                       fold.parameter,
                       branch.tangent_before()};
      }
      place_.turned_at = path.text(place_.farthest);
      place_.stretch_at_fold = state_.system->largest_stretch(fold.unknowns);
    }
    if (place_.turned_at.empty())
      branch.require_stiffness(1);
    else if (softens(state_.system->softest(now.unknowns)))
      break;                             // behind the fold, as far as the law goes
    if (now.parameter > place_.farthest) // it has come back
      place_.turned_at.clear();
    if (now.parameter < first_part ||
        (!place_.turned_at.empty() && state_.system->largest_stretch(now.unknowns) > runaway_stretch))
      break;
    if (now.parameter >= 1) {
      state_.unknowns = branch.at_parameter(1).unknowns;
      return true;
    }
  }
  if (place_.turned_at.empty())
    throw NumericsFailure(failure_kind::unresolved,
                          fmt::format("the branch does not end beyond {}", path.text(place_.part)),
                          "try a finer mesh.membrane or a larger membrane.bending_ratio");
  const double stretch = state_.system->largest_stretch(branch.point().unknowns);
  if (stretch < large_stretch || stretch < growth_behind_fold * place_.stretch_at_fold)
    throw NumericsFailure(
        failure_kind::unresolved,
        fmt::format("the branch turns at {} and is not seen to come back", place_.turned_at),
        "begin with a profile of a march (--from)");
  const SteadyState &fold = place_.fold.state;
  fold.system->set_parameters(path.at(place_.farthest));
  throw NumericsFailure(
      failure_kind::fold,
      fmt::format("fold at {}", path.fold_text(place_.farthest, error_of_fold(fold, path.key()))),
      "stay on the near side of it");
}

} // namespace capsule
