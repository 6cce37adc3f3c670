#include "motion/split_bdf.hpp"
#include "base/failure.hpp"
#include <algorithm>
#include <cmath>
#include <utility>

namespace capsule {
namespace {

constexpr int most_attempts = 15; // at a step
constexpr int most_corrections = 6;
// Of the implicit load, as a share of the step's tolerance. What is left lies in the shortest waves, where the load is
// stiffest: it makes steps short and starts buckles.
constexpr double correction_share = 0.03;
constexpr double safety = 0.9;    // of a step's length
constexpr double most_growth = 2; // from step to step
// A matrix is found again after so many steps, or when it shows its age.
constexpr int mobility_lasts = 50, load_jacobian_lasts = 20;
constexpr int mobility_lasts_at_least = 8;
constexpr int many_corrections = 3;
constexpr double old_factors = 0.3; // relative change of the share
// What the rate may correct, in tolerances, before the mobility is found again; and the part of it that is left.
constexpr double old_mobility = 1;
constexpr double left_of_correction = 0.1;

double root_mean_square(const Vector &values) {
  return std::sqrt(values.squaredNorm() / static_cast<double>(values.size()));
}

// Of the polynomial through values at `nodes`: weights of its value at a place.
std::vector<double> value_weights(const std::vector<double> &nodes, double place) {
  std::vector<double> weights(nodes.size(), 1);
  for (std::size_t i = 0; i < nodes.size(); ++i)
    for (std::size_t j = 0; j < nodes.size(); ++j)
      if (j != i)
        weights[i] *= (place - nodes[j]) / (nodes[i] - nodes[j]);
  return weights;
}

// And of its slope at the first one.
std::vector<double> slope_weights(const std::vector<double> &nodes) {
  std::vector<double> weights(nodes.size(), 0);
  for (std::size_t i = 1; i < nodes.size(); ++i) {
    weights[0] += 1 / (nodes[0] - nodes[i]);
    weights[i] = 1 / (nodes[i] - nodes[0]);
    for (std::size_t j = 1; j < nodes.size(); ++j)
      if (j != i)
        weights[i] *= (nodes[0] - nodes[j]) / (nodes[i] - nodes[j]);
  }
  return weights;
}

std::vector<double> times_of(const std::vector<StepMemory::Point> &past, std::size_t count) {
  std::vector<double> times;
  for (std::size_t k = 0; k < count; ++k)
    times.push_back(past[k].time);
  return times;
}

} // namespace

SplitBdf::SplitBdf(SplitEquations equations, double time, const Vector &state, double tolerance,
                   std::size_t highest_order)
    : equations_(std::move(equations)), tolerance_(tolerance), highest_order_(highest_order) {
  memory_.past.push_back({time, state, equations_.load(state), equations_.rate(state, StepEnd::on_the_way)});
  memory_.step = std::sqrt(tolerance); // of order one, where rates change in a time of one
  memory_.mobility.at = memory_.load_jacobian.at = state;
  find_matrices();
  find_approach();
}

SplitBdf::SplitBdf(SplitEquations equations, StepMemory memory, double tolerance, std::size_t highest_order)
    : equations_(std::move(equations)), tolerance_(tolerance), highest_order_(highest_order),
      memory_(std::move(memory)) {
  find_matrices();
  if (memory_.factored != 0)
    factor(memory_.factored);
  find_approach();
}

void SplitBdf::find_approach() {
  const StepMemory::Point &now = memory_.past[0];
  place_ = equations_.place(now.state);
  approach_ = available() == 1
                  ? (equations_.place(now.state + memory_.step * now.rate) - place_) / memory_.step
                  : (place_ - equations_.place(memory_.past[1].state)) / (now.time - memory_.past[1].time);
}

void SplitBdf::find_matrices() {
  mobility_ = equations_.mobility(memory_.mobility.at);
  load_jacobian_ = equations_.load_jacobian(memory_.load_jacobian.at);
  multiply();
}

// All that follows from both matrices.
void SplitBdf::multiply() {
  jacobian_ = mobility_ * load_jacobian_;
  remainders_.clear();
  for (const StepMemory::Point &point : memory_.past)
    remainders_.emplace_back(point.rate - mobility_ * point.load);
}

void SplitBdf::freeze_mobility() {
  memory_.mobility = {memory_.past[0].state, 0};
  mobility_ = equations_.mobility(memory_.mobility.at);
  multiply();
  memory_.factored = 0;
}

void SplitBdf::freeze_load_jacobian() {
  memory_.load_jacobian = {memory_.past[0].state, 0};
  load_jacobian_ = equations_.load_jacobian(memory_.load_jacobian.at);
  multiply();
  memory_.factored = 0;
}

void SplitBdf::factor(double share) {
  Matrix matrix = -share * jacobian_;
  matrix.diagonal().array() += 1;
  factors_.compute(matrix);
  memory_.factored = share;
}

// By factors of another share: right for neither the stiffest nor the slowest parts, but half way between.
Vector SplitBdf::correction(const Vector &residual, double share) const {
  return factors_.solve(residual) * (2 / (1 + share / memory_.factored));
}

Vector SplitBdf::extrapolated(std::size_t points, double time) const {
  const std::vector<double> weights = value_weights(times_of(memory_.past, points), time);
  Vector state = weights[0] * memory_.past[0].state;
  for (std::size_t k = 1; k < points; ++k)
    state += weights[k] * memory_.past[k].state;
  return state;
}

Vector SplitBdf::state_at(double time) const {
  return extrapolated(std::min(available(), last_order_ + 1), time);
}

// Sets the time of the step's end. The steps up to a target are equal.
StepEnd SplitBdf::choose_end(const Target &target, Trial &trial) const {
  const StepMemory::Point &now = memory_.past[0];
  double distance = target.time - now.time;
  StepEnd end = StepEnd::at_time;
  const double to_place = target.place - place_;
  if (to_place > 0 && approach_ > 0 && to_place < distance * approach_) {
    distance = to_place / approach_;
    end = StepEnd::at_place;
  }
  constexpr double as_long = 1.001;
  if (distance > as_long * memory_.step) {
    trial.time = now.time + distance / std::ceil(distance / (as_long * memory_.step));
    if (!(distance < 1e6 * memory_.step)) // nowhere near
      trial.time = now.time + memory_.step;
    return StepEnd::on_the_way;
  }
  trial.time = end == StepEnd::at_time ? target.time : now.time + distance;
  if (end == StepEnd::at_place && available() > trial.order)
    trial.time += (target.place - equations_.place(extrapolated(trial.order + 1, trial.time))) / approach_;
  return end;
}

// All that follows from the time of the step's end.
void SplitBdf::set_up(Trial &trial) const {
  const std::vector<StepMemory::Point> &past = memory_.past;
  std::vector<double> nodes = times_of(past, trial.order);
  const std::vector<double> values = value_weights(nodes, trial.time);
  nodes.insert(nodes.begin(), trial.time);
  const std::vector<double> slopes = slope_weights(nodes);
  trial.share = 1 / slopes[0];
  trial.known = -trial.share * slopes[1] * past[0].state;
  trial.remainder = values[0] * remainders_[0];
  for (std::size_t k = 1; k < trial.order; ++k) {
    trial.known -= trial.share * slopes[k + 1] * past[k].state;
    trial.remainder += values[k] * remainders_[k];
  }
  trial.predicted = available() > trial.order
                        ? extrapolated(trial.order + 1, trial.time)
                        : Vector(past[0].state + (trial.time - past[0].time) * past[0].rate);
}

// The implicit load with the extrapolated remainder; a step that ends at a place ends there to second order in what the
// last correction moved it. False if the corrections do not end.
bool SplitBdf::solve(const Target &target, StepEnd end, Trial &trial) {
  constexpr double out_of_reach = 1e-2; // of a correction
  trial.state = trial.predicted;
  const StepMemory::Point &now = memory_.past[0];
  for (int count = 1; count <= most_corrections; ++count) {
    const Vector made = mobility_ * equations_.load(trial.state) + trial.remainder;
    const Vector change = correction(trial.known + trial.share * made - trial.state, trial.share);
    trial.state += change;
    const double size = root_mean_square(change);
    if (!(size < out_of_reach)) // or not a number
      return false;
    bool settled = size < correction_share * tolerance_;
    if (end == StepEnd::at_place) {
      const auto move = [&] { // to the target, along the slope; how far, in steps
        const double step = trial.time - now.time;
        const double place = equations_.place(trial.state);
        const double moved = (target.place - place) / (place - place_);
        trial.state += moved * step / trial.share * (trial.state - trial.known);
        trial.time += moved * step;
        set_up(trial);
        return std::abs(moved);
      };
      const double moved = move();
      if (!(moved < 0.5))
        return false;
      settled = settled && moved < 1e-6;
      if (settled)
        move();
    }
    if (settled) {
      if (count > many_corrections)
        memory_.load_jacobian.age = load_jacobian_lasts;
      return true;
    }
  }
  return false;
}

// Of a step of an order that ends in a state, in tolerances.
double SplitBdf::error(const Trial &trial, std::size_t order, const Vector &state) const {
  if (available() <= order) // the first step, of order one: half of what the slope changes
    return root_mean_square(state - trial.predicted) / (2 * tolerance_);
  double inverse_share = 0;
  for (std::size_t k = 0; k < order; ++k)
    inverse_share += 1 / (trial.time - memory_.past[k].time);
  return root_mean_square(state - extrapolated(order + 1, trial.time)) /
         (inverse_share * (trial.time - memory_.past[order].time) * tolerance_);
}

// Order and length of the next step: the order that allows the longest one.
void SplitBdf::choose_next(const Trial &trial, const Vector &state, double error_here) {
  const auto growth = [](double error, std::size_t order) {
    return safety * std::pow(std::max(error, 1e-12), -1 / (static_cast<double>(order) + 1));
  };
  std::size_t order = trial.order;
  double best = growth(error_here, order);
  ++memory_.steps_at_order;
  if (trial.order > 1) {
    const double lower = growth(error(trial, trial.order - 1, state), trial.order - 1);
    if (lower > best) {
      best = lower;
      order = trial.order - 1;
    }
  }
  if (trial.order < highest_order_ && available() == trial.order + 1) {
    order = trial.order + 1; // still beginning
  } else if (trial.order < highest_order_ && available() > trial.order + 1 &&
             memory_.steps_at_order > trial.order) {
    const double higher = growth(error(trial, trial.order + 1, state), trial.order + 1);
    if (higher > 1.05 * best) {
      best = higher;
      order = trial.order + 1;
    }
  }
  if (order != trial.order)
    memory_.steps_at_order = 0;
  memory_.order = order;
  const double step = trial.time - memory_.past[0].time;
  constexpr double as_long = 1.1; // is not worth other factors
  memory_.step = best > 1 && best < as_long ? step : step * std::min(best, most_growth);
}

std::optional<StepEnd> SplitBdf::try_step(const Target &target) {
  if (memory_.mobility.age >= mobility_lasts ||
      (memory_.left_over > old_mobility && memory_.mobility.age >= mobility_lasts_at_least))
    freeze_mobility();
  if (memory_.load_jacobian.age >= load_jacobian_lasts)
    freeze_load_jacobian();
  Trial trial;
  trial.order = std::min(memory_.order, available());
  const StepEnd end = choose_end(target, trial);
  set_up(trial);
  if (memory_.factored == 0 || std::abs(trial.share / memory_.factored - 1) > old_factors)
    factor(trial.share);
  if (!solve(target, end, trial)) {
    if (memory_.load_jacobian.age > 0)
      freeze_load_jacobian();
    else
      memory_.step /= 4;
    return std::nullopt;
  }
  const auto shorten = [&](double error) {
    constexpr double least = 0.2;
    memory_.step = (trial.time - memory_.past[0].time) *
                   std::max(least, safety * std::pow(error, -1 / (static_cast<double>(trial.order) + 1)));
  };
  if (const double first = error(trial, trial.order, trial.state); first > 1) {
    shorten(first);
    return std::nullopt;
  }
  const Vector load = equations_.load(trial.state);
  const Vector rate = equations_.rate(trial.state, end);
  const Vector last = correction(trial.known + trial.share * rate - trial.state, trial.share);
  const Vector state = trial.state + last;
  memory_.left_over = root_mean_square(last) / tolerance_;
  const double left = left_of_correction * memory_.left_over;
  if (!(left < 1)) {
    if (memory_.mobility.age > 0)
      freeze_mobility();
    else
      shorten(left);
    return std::nullopt;
  }
  choose_next(trial, state, std::max(error(trial, trial.order, state), left));
  last_order_ = trial.order;
  memory_.past.insert(memory_.past.begin(), {trial.time, state, load, rate});
  remainders_.insert(remainders_.begin(), rate - mobility_ * load);
  if (available() > highest_order_ + 2) {
    memory_.past.pop_back();
    remainders_.pop_back();
  }
  const double before = std::exchange(place_, equations_.place(state));
  approach_ = (place_ - before) / (trial.time - memory_.past[1].time);
  ++memory_.mobility.age;
  ++memory_.load_jacobian.age;
  return end;
}

StepEnd SplitBdf::step(const Target &target) {
  std::optional<NumericsFailure> cause;
  for (int k = 0; k < most_attempts; ++k)
    try {
      if (const auto end = try_step(target))
        return *end;
    } catch (const NumericsFailure &failure) {
      cause.emplace(failure);
      memory_.step /= 4;
    }
  if (cause)
    throw NumericsFailure(*cause);
  throw NumericsFailure(failure_kind::step, "no step of the time integrator is short enough",
                        "try a larger time.tolerance or a finer mesh.membrane");
}

} // namespace capsule
