#pragma once
// Limits of sequences by Richardson's extrapolation.
#include <array>

namespace capsule {

// The limit of values at h, h/2 and h/4 that have errors of order h and h^2.
inline double extrapolated(const std::array<double, 3> &values) {
  const double first = 2 * values[1] - values[0], second = 2 * values[2] - values[1];
  return (4 * second - first) / 3;
}

} // namespace capsule
