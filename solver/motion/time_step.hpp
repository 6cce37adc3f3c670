#pragma once
// Time integration of dy/dt = f(y):
// - with error control: variable-order BDF of SUNDIALS' CVODE with a Newton iteration on a Jacobian that the
//   caller supplies (an approximate one costs iterations, not accuracy);
// - with a given step: explicit Euler, the scheme of the paper, and the classical Runge-Kutta scheme of order
//   4. Both are stable while step * rate stays below stability_limit for every rate of decay.
// All offer step(), time(), previous_time() and state_at(time within the last step).
#include "base/linear_algebra.hpp"
#include "case/parameters.hpp"
#include <functional>
#include <memory>

namespace capsule {

struct Equations {
  // dy/dt; false where the state is out of the domain and a shorter step may stay inside
  std::function<bool(const Vector &state, Vector &rate)> rate;
  std::function<bool(const Vector &state, Matrix &jacobian)> jacobian;
  // a correction of Newton's iteration; solving for it may be left out where it is known
  std::function<Vector(const std::function<Vector()> &solve)> correction =
      [](const std::function<Vector()> &solve) { return solve(); };
};

class BdfIntegrator {
public:
  // tolerance: error of a step, root mean square over the components, absolute.
  BdfIntegrator(Equations equations, double time, const Vector &state, double tolerance);
  ~BdfIntegrator();
  BdfIntegrator(const BdfIntegrator &) = delete;
  BdfIntegrator &operator=(const BdfIntegrator &) = delete;
  BdfIntegrator(BdfIntegrator &&) = delete;
  BdfIntegrator &operator=(BdfIntegrator &&) = delete;

  // One step of the integrator's choice. Throws NumericsFailure("step") when no step size is short enough.
  void step();
  double time() const;
  double previous_time() const;
  // State at a time of the last step, by the integrator's own interpolant.
  Vector state_at(double time) const;

private:
  struct Memory;
  std::unique_ptr<Memory> memory_;
};

// Between two steps: the straight line for Euler's scheme, Hermite's cubic for Runge and Kutta's. Throws what
// `rate` throws.
class ExplicitIntegrator {
public:
  using Rate = std::function<Vector(const Vector &state)>;
  ExplicitIntegrator(Scheme scheme, Rate rate, double time, const Vector &state, double step);

  void step();
  double time() const { return time_; }
  double previous_time() const { return previous_; }
  Vector state_at(double time) const;

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
