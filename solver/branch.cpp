#include "branch.hpp"
#include "case_keys.hpp"
#include "failure.hpp"
#include "steady_state.hpp"
#include "text.hpp"
#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace capsule {
namespace {

constexpr double first_step = 0.02;
constexpr double largest_step = 0.04;
constexpr double accuracy_of_folds = 1e-6;
constexpr int most_nodes_of_a_branch = 200;
constexpr int most_points = 500;
constexpr double runaway_stretch = 4; // as in a march

constexpr std::array numbers_of_a_steady_state{"flow.capillary_number", "capsule.radius",
                                               "capsule.aspect_ratio", "membrane.bending_ratio",
                                               "membrane.dilatation"};

void require_way(const Case &physics, const std::string &key, double to) {
  if (std::ranges::find(numbers_of_a_steady_state, key) == numbers_of_a_steady_state.end())
    throw InputError(fmt::format("error: no branch along '{}'; it goes along one of {}\n", key,
                                 fmt::join(numbers_of_a_steady_state, ", ")));
  Case there = physics;
  if (const auto complaint = set_value(*find_key(key), to, there))
    throw InputError(
        fmt::format("error: --to {}: {}; {}\n", number_text(to), complaint->message, complaint->hint));
  if (key == "capsule.radius" && physics.flow.type == FlowType::extension)
    throw InputError("error: no branch along 'capsule.radius': it is the unit of length in an extension\n");
  if (!KeyPath(key, physics, to).needed())
    throw InputError(fmt::format("error: {} = {} is where the branch begins\n", key, number_text(to)));
}

// The points of one branch as they are found.
class Record {
public:
  Record(const KeyPath &path, double viscosity_ratio, const Control &control)
      : path_(path), viscosity_ratio_(viscosity_ratio), control_(control) {}

  BranchRow look_at(const SteadyState &state, double part, bool profile) {
    if (control_.interrupted && control_.interrupted())
      throw Interrupted{};
    state.system->take(path_.at(part));
    SteadyRecord record = record_steady(state, viscosity_ratio_);
    record.row.time = path_.value(part); // a branch has no time: what varies takes its place
    record.profile.time = record.row.time;
    if (profile) {
      outcome.last.series.push_back(record.row);
      outcome.last.profiles.push_back(std::move(record.profile));
    }
    ++outcome.last.steps;
    return {path_.value(part), record.row, record.rates.at("growth_rate")};
  }

  Outcome outcome;

private:
  const KeyPath &path_;
  double viscosity_ratio_;
  const Control &control_;
};

} // namespace

Outcome follow_branch(const Case &asked, const std::string &key, double to, const Control &control) {
  require_way(asked, key, to);
  Case physics = asked;
  physics.accuracy = std::min(asked.accuracy, accuracy_of_folds);
  const KeyPath path(key, physics, to);
  Record record(path, physics.flow.viscosity_ratio, control);
  Outcome &outcome = record.outcome;
  outcome.along = key;
  double part = 0;
  try {
    RefinedState start = refine(physics, find_steady(physics, {}, control), control);
    outcome.error_estimate = start.error_estimate;
    SteadyState state = start.state;
    outcome.branch.push_back(record.look_at(state, part, true));
    const Path cases = [&](double at) { return path.at(at); };
    auto branch = std::make_unique<Branch>(*state.system, cases, BranchPoint{state.unknowns, 0},
                                           Branch::upwards(*state.system), first_step, largest_step);
    const auto note = [&](const BranchPoint &point, bool profile) {
      state.unknowns = point.unknowns;
      return record.look_at(state, point.parameter, profile);
    };
    for (;;) {
      branch->advance();
      if (branch->turned())
        outcome.folds.push_back(note(branch->fold(), true));
      const BranchPoint point = branch->point();
      part = point.parameter;
      const bool there = part >= 1;
      const bool back = part <= 0;
      if (there || back) {
        outcome.branch.push_back(note(branch->at_parameter(there ? 1 : 0), true));
        outcome.status = Status::reached;
        if (back)
          outcome.message = fmt::format("the branch turns back and does not reach {}", path.text(1));
        break;
      }
      outcome.branch.push_back(note(point, false));
      if (outcome.branch.back().row.max_stretch > runaway_stretch) {
        outcome.status = Status::unbounded;
        outcome.message = fmt::format("stretched beyond {} at {}; the branch is not followed further",
                                      runaway_stretch, path.text(part));
        break;
      }
      const int nodes = finer_mesh(static_cast<int>(state.system->nodes()));
      if (branch->wants_a_finer_mesh() && physics.mesh.membrane == 0 && nodes <= most_nodes_of_a_branch) {
        const SteadyState finer = on_mesh(path.at(part), nodes, state);
        const Vector &tangent = branch->tangent();
        Vector direction(2 * nodes + 3);
        direction << moved_to(finer.system->membrane().basis, state.system->membrane().basis,
                              tangent.head(tangent.size() - 1)),
            tangent[tangent.size() - 1];
        state = finer;
        branch = std::make_unique<Branch>(*state.system, cases, BranchPoint{state.unknowns, part}, direction,
                                          first_step, largest_step);
      }
      if (std::ssize(outcome.branch) > most_points)
        throw NumericsFailure("step",
                              fmt::format("{} points have led to {} only", most_points, path.text(part)),
                              "a nearer --to");
    }
    outcome.membrane_nodes = static_cast<int>(state.system->nodes());
  } catch (const NumericsFailure &failure) {
    outcome.status = Status::failed;
    outcome.failure = failure.kind;
    outcome.message = fmt::format("{} (after {}); {}", failure.what(), path.text(part), failure.advice);
  } catch (const Interrupted &) {
    outcome.status = Status::interrupted;
  }
  return outcome;
}

} // namespace capsule
