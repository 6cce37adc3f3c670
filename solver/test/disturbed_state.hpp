#pragma once
// A shape whose nodes move as fast as the flow, far from steady, and the derivative of the equations there along a
// direction, by differences of the residual. Throws what the residual throws.
#include "steady/steady_system.hpp"

namespace capsule {

struct DisturbedState {
  Vector unknowns, direction, differences;
};

// Fits the tube to the shape.
inline DisturbedState disturb(SteadySystem &system) {
  const Eigen::Index n = system.nodes();
  const auto zeta = system.membrane().basis.nodes.array();
  DisturbedState state{system.initial(), Vector::Zero(2 * n + 2), {}};
  state.unknowns.head(n).array() += 0.02 * (3 * zeta).cos() + 0.03 * (2 * zeta).cos();
  state.unknowns.segment(n, n).array() += 0.02 * zeta.sin() - 0.01 * (4 * zeta).sin();
  system.fit_tube(state.unknowns);
  state.direction.head(n) = (2 * zeta).cos() + 0.3 * (3 * zeta).cos();
  state.direction.segment(n, n) = zeta.sin() - 0.4 * (4 * zeta).sin();
  constexpr double h = 1e-4;
  const auto at = [&](double step) { return system.residual(state.unknowns + step * h * state.direction); };
  state.differences = (8 * (at(1) - at(-1)) - (at(2) - at(-2))) / (12 * h);
  return state;
}

} // namespace capsule
