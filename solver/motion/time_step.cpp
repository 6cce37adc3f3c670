#include "motion/time_step.hpp"
#include <utility>

namespace capsule {

ExplicitIntegrator::ExplicitIntegrator(Scheme scheme, Rate rate, StepMemory::Point from, double step)
    : scheme_(scheme), rate_(std::move(rate)), time_(from.time), previous_(from.time), step_(step),
      state_(std::move(from.state)), before_(state_), rate_at_state_(std::move(from.rate)) {
  if (scheme_ == Scheme::rk4 && rate_at_state_.size() == 0)
    rate_at_state_ = rate_(state_);
}

StepMemory ExplicitIntegrator::memory() const {
  StepMemory memory;
  memory.past = {{time_, state_, {}, rate_at_state_}};
  return memory;
}

void ExplicitIntegrator::step() {
  before_ = state_;
  previous_ = time_;
  if (scheme_ == Scheme::euler) {
    state_ += step_ * rate_(state_);
  } else {
    const double h = step_;
    rate_before_ = rate_at_state_;
    const Vector &k1 = rate_before_;
    const Vector k2 = rate_(before_ + h / 2 * k1);
    const Vector k3 = rate_(before_ + h / 2 * k2);
    const Vector k4 = rate_(before_ + h * k3);
    state_ += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
    rate_at_state_ = rate_(state_); // k1 of the next step
  }
  time_ += step_;
}

Vector ExplicitIntegrator::state_at(double time) const {
  const double s = (time - previous_) / step_;
  if (scheme_ == Scheme::euler)
    return before_ + s * (state_ - before_);
  const Vector change = state_ - before_;
  return before_ +
         s * (step_ * rate_before_ + s * (3 * change - step_ * (2 * rate_before_ + rate_at_state_) +
                                          s * (step_ * (rate_before_ + rate_at_state_) - 2 * change)));
}

double stability_limit(Scheme scheme) {
  // Runge and Kutta's: the real root of 1 - z/2 + z^2/6 - z^3/24, where |R(-z)| reaches 1 again.
  return scheme == Scheme::euler ? 2 : 2.7852935634052816;
}

} // namespace capsule
