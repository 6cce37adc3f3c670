#pragma once
// What a flow solver returns for one shape of the membrane, in the scales of undisturbed.hpp.
#include "base/linear_algebra.hpp"
#include <limits>

namespace capsule {

struct FlowState {
  Vector velocity;          // of the nodes, 2N: axial, then radial
  double pressure_drop = 0; // Delta P of eq. 15 as a positive extra drop
  double flow_rate = 1;     // less than 1 where the pressure is given instead
  // Delta P by the reciprocal theorem, where it was asked for, and each membrane's share of it.
  double pressure_drop_reciprocal = std::numeric_limits<double>::quiet_NaN();
  Vector pressure_shares = {};
};

} // namespace capsule
