#include "motion/split_bdf.hpp"
#include "base/failure.hpp"
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace capsule {
namespace {

constexpr std::size_t highest_order = 5;
constexpr int most_attempts = 15; // at a step
constexpr int most_corrections = 6;
// Of the implicit load, as a share of the step's tolerance. What is left lies in the shortest waves, where the load is
// stiffest: it makes steps short and starts buckles.
constexpr double correction_share = 0.03;
constexpr double safety = 0.9;    // of a step's length
constexpr double most_growth = 2; // from step to step
// A matrix is found again after so many steps, or when it shows its age.
constexpr int mobility_lasts = 50, load_jacobian_lasts = 20;
constexpr int mobility_lasts_at_least = 20;
constexpr int many_corrections = 4;
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

Vector weighted(const std::vector<StepMemory::Point> &past, const std::vector<double> &weights,
                Vector StepMemory::Point::*values) {
  Vector sum = weights[0] * past[0].*values;
  for (std::size_t k = 1; k < weights.size(); ++k)
    sum += weights[k] * past[k].*values;
  return sum;
}

} // namespace

SplitBdf::SplitBdf(SplitEquations equations, double time, const Vector &state, double tolerance)
    : equations_(std::move(equations)), tolerance_(tolerance) {
  const SplitEquations::Rate here = equations_.rate(state);
  memory_.past.push_back({time, state, equations_.load(state), here.rate, here.rate, here.further});
  memory_.step = std::sqrt(tolerance); // of order one, where rates change in a time of one
  memory_.mobility.at = memory_.load_jacobian.at = state;
  find_matrices();
}

SplitBdf::SplitBdf(SplitEquations equations, StepMemory memory, double tolerance)
    : equations_(std::move(equations)), tolerance_(tolerance), memory_(std::move(memory)) {
  find_matrices();
  if (memory_.factored != 0)
    factor(memory_.factored);
}

void SplitBdf::find_matrices() {
  mobility_ = equations_.mobility(memory_.mobility.at);
  load_jacobian_ = equations_.load_jacobian(memory_.load_jacobian.at);
  multiply();
}

// All that follows from both matrices.
void SplitBdf::multiply() {
  if (equations_.parts.empty())
    jacobian_ = mobility_ * load_jacobian_;
  else
    jacobian_ = times_blocks(mobility_, load_jacobian_, equations_.parts);
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
  return lu_solve(factors_, residual) * (2 / (1 + share / memory_.factored));
}

Vector SplitBdf::extrapolated(std::size_t points, double time) const {
  return weighted(memory_.past, value_weights(times_of(memory_.past, points), time),
                  &StepMemory::Point::state);
}

Vector SplitBdf::interpolated(Vector StepMemory::Point::*values, double time) const {
  const std::size_t points = std::min(available(), last_order_ + 1);
  return weighted(memory_.past, value_weights(times_of(memory_.past, points), time), values);
}

Vector SplitBdf::state_at(double time) const {
  return interpolated(&StepMemory::Point::state, time);
}

Vector SplitBdf::rate_at(double time) const {
  return interpolated(&StepMemory::Point::rate_at_state, time);
}

Vector SplitBdf::further_at(double time) const {
  return interpolated(&StepMemory::Point::further, time);
}

SplitBdf::Trial SplitBdf::set_up() const {
  const std::vector<StepMemory::Point> &past = memory_.past;
  Trial trial;
  trial.order = std::min(memory_.order, available());
  trial.time = past[0].time + memory_.step;
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
  return trial;
}

// The implicit load with the extrapolated remainder. False if the corrections do not end.
bool SplitBdf::solve(Trial &trial) {
  constexpr double out_of_reach = 1e-2; // of a correction
  trial.state = trial.predicted;
  for (int count = 1; count <= most_corrections; ++count) {
    const Vector made = mobility_ * equations_.load(trial.state) + trial.remainder;
    const Vector change = correction(trial.known + trial.share * made - trial.state, trial.share);
    trial.state += change;
    const double size = root_mean_square(change);
    if (!(size < out_of_reach)) // or not a number
      return false;
    if (size < correction_share * tolerance_) {
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
  if (trial.order < highest_order && available() == trial.order + 1) {
    order = trial.order + 1; // still beginning
  } else if (trial.order < highest_order && available() > trial.order + 1 &&
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

// False where another attempt is to be made, with other matrices or a shorter step. What failed in a longer one is no cause
// any more where the error asks for a shorter one. Corrections that do not end say nothing: before a place without rates
// steps get too short for the digits of the time.
bool SplitBdf::try_step(std::optional<NumericsFailure> &cause) {
  if (memory_.mobility.age >= mobility_lasts ||
      (memory_.left_over > old_mobility && memory_.mobility.age >= mobility_lasts_at_least))
    freeze_mobility();
  if (memory_.load_jacobian.age >= load_jacobian_lasts)
    freeze_load_jacobian();
  Trial trial = set_up();
  if (memory_.factored == 0 || std::abs(trial.share / memory_.factored - 1) > old_factors)
    factor(trial.share);
  if (!solve(trial)) {
    if (memory_.load_jacobian.age > 0)
      freeze_load_jacobian();
    else
      memory_.step /= 4;
    return false;
  }
  const auto shorten = [&](double error) {
    cause.reset();
    constexpr double least = 0.2;
    memory_.step = (trial.time - memory_.past[0].time) *
                   std::max(least, safety * std::pow(error, -1 / (static_cast<double>(trial.order) + 1)));
  };
  if (const double first = error(trial, trial.order, trial.state); first > 1) {
    shorten(first);
    return false;
  }
  const Vector load = equations_.load(trial.state);
  const auto [rate, further] = equations_.rate(trial.state);
  const Vector last = correction(trial.known + trial.share * rate - trial.state, trial.share);
  const Vector state = trial.state + last;
  memory_.left_over = root_mean_square(last) / tolerance_;
  const double left = left_of_correction * memory_.left_over;
  if (!(left < 1)) {
    if (memory_.mobility.age > 0)
      freeze_mobility();
    else
      shorten(left);
    return false;
  }
  choose_next(trial, state, std::max(error(trial, trial.order, state), left));
  last_order_ = trial.order;
  const Vector rate_at_state = rate + jacobian_ * last;
  memory_.past.insert(memory_.past.begin(), {trial.time, state, load, rate, rate_at_state, further});
  remainders_.insert(remainders_.begin(), rate - mobility_ * load);
  if (available() > highest_order + 2) {
    memory_.past.pop_back();
    remainders_.pop_back();
  }
  ++memory_.mobility.age;
  ++memory_.load_jacobian.age;
  return true;
}

void SplitBdf::step(double longest) {
  memory_.step = std::min(memory_.step, longest);
  std::optional<NumericsFailure> cause;
  for (int k = 0; k < most_attempts; ++k)
    try {
      if (try_step(cause))
        return;
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
