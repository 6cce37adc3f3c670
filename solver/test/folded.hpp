#pragma once
// A shape with a fold, for tests of nodes and panels.
#include "base/linear_algebra.hpp"
#include <cmath>

namespace capsule {

// A sphere whose rear is pushed in: at the ring where it turns back, the tangent turns within a tenth of a radian.
inline Vector folded(const Vector &angle) {
  const auto a = angle.array();
  const Eigen::ArrayXd inward = 0.5 * (1 - ((a - 0.8) / 0.08).tanh() * ((a + 0.8) / 0.08).tanh());
  Vector position(2 * angle.size());
  position << -a.cos() + inward * 2 * (a.cos() - std::cos(0.8)), a.sin();
  return position;
}

} // namespace capsule
