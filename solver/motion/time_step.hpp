#pragma once
// Explicit schemes with a given step for dy/dt = f(y): Euler's, which is the paper's, and the classical one of order 4 of Runge
// and Kutta. Both are stable while step * rate stays below stability_limit for every rate of decay. (With error control:
// split_bdf.hpp.)
#include "base/linear_algebra.hpp"
#include "case/parameters.hpp"
#include "observe/step_memory.hpp"
#include <functional>

namespace capsule {

// Between two steps: the straight line for Euler's scheme, Hermite's cubic for Runge and Kutta's. Throws what
// `rate` throws.
class ExplicitIntegrator {
public:
  using Rate = std::function<Vector(const Vector &state)>;
  // From a time and a state, or with the rate that Runge and Kutta's scheme remembers there, too.
  ExplicitIntegrator(Scheme scheme, Rate rate, StepMemory::Point from, double step);

  void step();
  double time() const { return time_; }
  double previous_time() const { return previous_; }
  Vector state_at(double time) const;
  StepMemory memory() const;

private:
  Scheme scheme_;
  Rate rate_;
  double time_, previous_, step_;
  Vector state_, before_;
  Vector rate_at_state_, rate_before_; // of Runge and Kutta's scheme
};

// Length of an explicit scheme's interval of stability on the negative real axis.
double stability_limit(Scheme scheme);

} // namespace capsule
