#include "steady/branch.hpp"
#include "base/failure.hpp"
#include "base/text.hpp"
#include "case/key_path.hpp"
#include "case/keys.hpp"
#include "case/physical.hpp"
#include "case/symbols.hpp"
#include "observe/gauge.hpp"
#include "scene/scene.hpp"
#include "steady/continuation.hpp"
#include "steady/fold_curve.hpp"
#include "steady/fold_error.hpp"
#include "steady/homotopy.hpp"
#include "steady/refinement.hpp"
#include "steady/steady_state.hpp"
#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace capsule {
namespace {

constexpr Branch::Steps steps_of_a_branch{
    .first = 0.02, .largest = 0.1, .tolerance = 1e-9, .largest_miss = 0.2};
constexpr double accuracy_of_folds = 1e-6;
constexpr int most_nodes_of_a_branch = 300;
constexpr int most_points_of_a_branch = 500;
constexpr double farthest_stretch = 10; // to which a branch without folds is followed

// What is recorded of a branch's points as they are found.
class Record {
public:
  Record(const KeyPath &path, const Control &control) : path_(path), control_(control) {}

  // The state's system has the parameters of this part of the path.
  BranchRow add(const SteadyState &state, const SteadySystem::Linearisation &linear, double part,
                bool profile) {
    throw_if_interrupted(control_);
    SteadyRecord record = record_steady(state, linear, gauge_of_state(state));
    record.row.time = path_.value(part); // a branch has no time: the key's value takes its place
    record.profile.time = record.row.time;
    BranchRow point{path_.value(part), record.row, record.further.at("growth_rate")};
    latest_ = std::move(record);
    if (profile)
      keep_latest();
    ++outcome.last.steps;
    return point;
  }

  // Series and profile of the latest point, unless they are kept already.
  void keep_latest() {
    if (latest_) {
      outcome.last.series.push_back(latest_->row);
      outcome.last.profiles.push_back(std::move(latest_->profile));
    }
    latest_.reset();
  }

  Outcome outcome;

private:
  // The last one, where nothing that it measures with has changed since: a key of the flow changes no membrane, at most the
  // length of the tube.
  const Gauge &gauge_of_state(const SteadyState &state) {
    const double end = state.system->pore() ? state.system->pore()->exit_x : 0;
    if (!gauge_ || state.system != measured_ || end != end_of_pore_ || !path_.key().starts_with("flow.")) {
      gauge_.emplace(gauge_of(*state.system));
      measured_ = state.system;
      end_of_pore_ = end;
    }
    return *gauge_;
  }

  KeyPath path_;
  std::optional<Gauge> gauge_;
  std::shared_ptr<const SteadySystem> measured_; // by gauge_
  double end_of_pore_ = 0;
  const Control &control_;
  std::optional<SteadyRecord> latest_; // not kept yet
};

// Follows one branch from the case's own value of the key.
class BranchFollower {
public:
  BranchFollower(const Case &input, const KeyPath &path, const Control &control)
      : path_(path), record_(path, control), may_refine_(input.mesh.membrane == 0) {}

  void begin(const RefinedState &start) {
    outcome().error_estimate = start.error_estimate;
    state_ = start.state;
    outcome().branch.push_back(record({state_.unknowns, 0}, true));
    place_ = path_.text(0);
    branch_ = std::make_unique<Branch>(*state_.system, path_, BranchPoint{state_.unknowns, 0},
                                       Branch::upwards(*state_.system), steps_of_a_branch);
  }

  // To the next point; true at the end.
  bool advance() {
    branch_->advance();
    if (branch_->turned() && !branch_->tangent_has_turned() &&
        refine_mesh(branch_->point_before(), branch_->tangent_before(), branch_->trend_before()))
      return false;
    if (branch_->turned()) {
      const BranchPoint fold = branch_->fold();
      BranchRow &row = outcome().folds.emplace_back(record(fold, true));
      row.error_estimate = errors_of_fold(state_, path_.key(), row.row);
      last_fold_ = {{state_.system, fold.unknowns}, fold.parameter, branch_->tangent_before()};
    }
    branch_->require_stiffness(1);
    const double part = branch_->point().parameter;
    place_ = path_.text(part);
    if (part >= 1 || part <= 0) {
      outcome().branch.push_back(record_point(true));
      if (part <= 0)
        throw NumericsFailure(
            failure_kind::fold,
            fmt::format("the branch turns back to where it began and does not reach {}", path_.text(1)),
            "a thin shell may buckle: try another value to begin with, or a larger membrane.bending_ratio");
      outcome().status = Status::reached;
      return true;
    }
    // A stretch alone is no proof: steady states near a fold may reach it. Behind the fold it grows without end.
    const double enough = outcome().folds.empty() ? farthest_stretch : runaway_stretch;
    const bool runs_away = state_.system->largest_stretch(branch_->point().unknowns) > enough;
    outcome().branch.push_back(record_point(runs_away));
    if (runs_away) {
      outcome().status = Status::unbounded;
      outcome().message =
          fmt::format("stretched beyond {} at {}{}; the branch is not followed further", enough, place_,
                      outcome().folds.empty() ? "" : ", behind the fold at " + fold_text());
      return true;
    }
    if (std::ssize(outcome().branch) > most_points_of_a_branch)
      throw NumericsFailure(failure_kind::step,
                            fmt::format("{} points have led to {} only", most_points_of_a_branch, place_),
                            "a nearer --to");
    if (branch_->wants_a_finer_mesh())
      refine_mesh(branch_->point(), branch_->tangent(), branch_->trend());
    return false;
  }

  // To the end of another key's path.
  void follow_last_fold(const KeyPath &second, const Control &control) {
    outcome().fold_along = second.key();
    if (outcome().folds.empty())
      throw NumericsFailure(failure_kind::unresolved, "no fold on the way that could be followed",
                            "a farther --to");
    auto &[fold, part, tangent] = last_fold_;
    follow_fold(fold, {fold.unknowns, part, 0}, tangent.head(fold.unknowns.size()), path_, second,
                may_refine_ ? most_nodes_of_a_branch : nodes(), control,
                [&](const SteadyState &state, const FoldPoint &point) {
                  throw_if_interrupted(control);
                  place_ = second.text(point.second_part);
                  const SteadyRecord record = record_steady(state);
                  outcome().fold_curve.push_back(
                      {second.value(point.second_part),
                       {path_.value(point.part), record.row, record.further.at("growth_rate")}});
                });
    BranchRow &end = outcome().fold_curve.back().fold;
    end.error_estimate = errors_of_fold(fold, path_.key(), end.row);
  }

  void keep_latest() { record_.keep_latest(); }
  Outcome &outcome() { return record_.outcome; }
  int nodes() const { return static_cast<int>(state_.system->nodes()); }
  const std::string &place() const { return place_; }

private:
  // Of the last one.
  std::string fold_text() {
    return path_.fold_text(last_fold_.part,
                           error_of_place(outcome().folds.back().error_estimate, path_.key()));
  }
  BranchRow record(const BranchPoint &point, bool profile) {
    go_to(point);
    return record_.add(state_, state_.system->linearise(point.unknowns), point.parameter, profile);
  }
  // That of the branch, whose linearisation is known.
  BranchRow record_point(bool profile) {
    go_to(branch_->point());
    return record_.add(state_, branch_->linearisation(), branch_->point().parameter, profile);
  }
  void go_to(const BranchPoint &point) {
    state_.unknowns = point.unknowns;
    state_.system->set_parameters(path_.at(point.parameter));
  }
  // Goes on from a point on a finer mesh; false if there is none, or the branch is not found on it.
  bool refine_mesh(const BranchPoint &point, const Vector &tangent, Branch::Trend trend) {
    const int more = finer_mesh(nodes());
    if (!may_refine_ || more > most_nodes_of_a_branch)
      return false;
    const SteadyState guess = moved_to_mesh(path_.at(point.parameter), more, {state_.system, point.unknowns});
    try {
      branch_ = std::make_unique<Branch>(*guess.system, path_, BranchPoint{guess.unknowns, point.parameter},
                                         moved_to(*guess.system, *state_.system, tangent), steps_of_a_branch,
                                         trend);
      state_ = {guess.system, branch_->point().unknowns};
    } catch (const NumericsFailure &) {
      may_refine_ = false;
    }
    return may_refine_;
  }

  KeyPath path_;
  Record record_;
  bool may_refine_;
  SteadyState state_;
  std::unique_ptr<Branch> branch_;
  std::string place_; // of the last point
  Homotopy::Fold last_fold_;
};

// In words: the keys that can be typed.
std::string where_branches_go(const Case &input) {
  std::vector<std::string> names = parameters_of_steady_states();
  if (has_physical(input)) {
    const std::vector<std::string> physical = physical_keys();
    names.insert(names.begin(), physical.begin(), physical.end());
  }
  return fmt::format("branches go along {}", fmt::join(names, ", "));
}

// Throws InputError where no branch goes along this key.
void require_key(const Case &input, const std::string &key) {
  const std::vector<std::string> names = parameters_of_steady_states();
  if (std::ranges::find(names, key) != names.end())
    return;
  const std::string near = find_key(key) == nullptr ? nearest_key(key) : "";
  throw InputError(
      fmt::format("error: no branch along '{}'\n{}\n", key,
                  near.empty() ? where_branches_go(input) : fmt::format("did you mean '{}'?", near)));
}

void require_end(const Case &input, const BranchEnd &end, const std::string &option = to_option) {
  const auto &[name, to] = end;
  require_key(input, name);
  const Key &key = *find_key(name);
  if (!means_something(key, input))
    throw InputError(fmt::format("error: no branch along '{}': {}\n", name, why_meaningless(key, input)));
  Case there = input;
  if (const auto complaint = set_value(key, to, there))
    throw InputError(fmt::format("error: {} {}: {}\n{}\n", option, number_text(to), complaint->message,
                                 "allowed: " + allowed_text(key)));
  if (name == "capsule.radius" && input.flow.type == FlowType::extension)
    throw InputError("error: no branch along 'capsule.radius': it is the unit of length in an extension\n");
  if (name == "flow.period" && input.flow.period == 0)
    throw InputError("error: no branch along 'flow.period': the case has no train\n"
                     "give flow.period, where the branch begins\n");
  if (!KeyPath(name, input, to).needed())
    throw InputError(fmt::format("error: {}: {} = {} is the case's own value, where the {} begins\n", option,
                                 name, number_text(to), option == to_option ? "branch" : "curve of folds"));
}

// The end along a physical key.
BranchEnd physical_end(const Case &input, const Key &key, const std::string &to, const std::string &option) {
  if (!has_physical(input))
    throw InputError(fmt::format("error: no branch along '{}': the case has no physical units\n", key.name));
  if (is_of_fits(key))
    throw InputError(fmt::format("error: no branch along '{}': it is a key of `capsule fit`\n{}\n", key.name,
                                 where_branches_go(input)));
  Case there = input;
  const std::vector<std::string> of_flow = physical_keys_of(flow_key);
  if (std::ranges::find(of_flow, key.name) != of_flow.end()) // each in place of the others
    for (const std::string &name : of_flow)
      reset_value(*find_key(name), there);
  if (const auto complaint = set_value(key, to, there))
    throw InputError(fmt::format("error: {}: {}\n{}\n", option, complaint->message, complaint->hint));
  for (const PhysicalComplaint &complaint : physical_complaints(there))
    if (std::ranges::find(complaint.keys, key.name) != complaint.keys.end())
      throw InputError(fmt::format("error: no branch along '{}': {}\n", key.name, complaint.message));
  const std::vector<std::string> parameters = parameters_of_steady_states();
  std::vector<std::string> changed;
  for (const Derived &derived : derived_values(there)) {
    if (std::ranges::find(parameters, derived.key) == parameters.end())
      continue;
    if (derived.from == key.name)
      return {derived.key, derived.value};
    if (derived.value != number(derived.key, input))
      changed.push_back(derived.key);
  }
  throw InputError(fmt::format(
      "error: no branch along '{}': {}\n{}\n", key.name,
      changed.empty() ? "steady states do not depend on it"
                      : fmt::format("it changes {} and the scales of the results", fmt::join(changed, ", ")),
      where_branches_go(input)));
}

} // namespace

void require_branch(const Case &input, const BranchEnd &end, const std::optional<BranchEnd> &second) {
  require_end(input, end);
  if (!second)
    return;
  if (second->key == end.key)
    throw InputError(fmt::format("error: --fold-along {}: the branch goes along it\n", end.key));
  require_end(input, *second, fold_to_option);
}

BranchEnd end_of_branch(const Case &input, const std::string &along, const std::string &to,
                        const std::string &option) {
  if (const Key *key = find_key(along); key != nullptr && std::holds_alternative<Measured>(key->field))
    return physical_end(input, *key, to, option);
  if (const auto value = to_number(to))
    return {along, *value};
  require_key(input, along);
  throw InputError(fmt::format("error: {}: {}\n", option, not_a_number(to)));
}

Outcome follow_branch(const Case &asked, const BranchEnd &end, const Control &control,
                      const MarchToRest &march, const std::optional<BranchEnd> &second) {
  Case input = asked;
  input.accuracy = std::min(asked.accuracy, accuracy_of_folds);
  BranchFollower follower(input, KeyPath(end.key, input, end.value), control);
  Outcome &outcome = follower.outcome();
  outcome.along = end.key;
  if (const auto empty = empty_resistance(input))
    outcome.further["empty_resistance"] = *empty;
  try {
    follower.begin(refine(input, find_steady(input, {}, control, march), control));
    while (!follower.advance()) {
    }
    if (second)
      follower.follow_last_fold({second->key, input, second->value}, control);
    outcome.membrane_nodes = follower.nodes();
  } catch (const NumericsFailure &failure) {
    follower.keep_latest();
    outcome.status = Status::failed;
    outcome.failure = failure.kind;
    outcome.message = fmt::format("{}{}; {}", failure.what(),
                                  outcome.branch.empty() ? "" : fmt::format(" (after {})", follower.place()),
                                  with_physical_keys(failure.advice, input));
  } catch (const Interrupted &) {
    outcome.status = Status::interrupted;
  }
  return outcome;
}

} // namespace capsule
