#pragma once
// Time integration of dy/dt = f(t, y) with error control: variable-order BDF of SUNDIALS' CVODE with a Newton
// iteration on a Jacobian that the caller supplies (an approximate one costs iterations, not accuracy).
#include "linear_algebra.hpp"
#include <functional>
#include <memory>

namespace capsule {

struct Equations {
  // dy/dt; false where the state is out of the domain and a shorter step may stay inside
  std::function<bool(const Vector &state, Vector &rate)> rate;
  std::function<bool(const Vector &state, Matrix &jacobian)> jacobian;
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

} // namespace capsule
