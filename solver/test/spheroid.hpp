#pragma once
// Shapes on the axis with a closed form, for tests.
#include "geometry/meridian.hpp"

namespace capsule {

// Points of a spheroid at the angles of the basis' nodes, 2N.
inline Vector spheroid(const MeridianBasis &basis, double centre, double half_length, double half_width) {
  Vector position(2 * basis.size());
  position << centre - half_length * basis.nodes.array().cos(), half_width * basis.nodes.array().sin();
  return position;
}

inline Vector sphere(const MeridianBasis &basis, double centre, double radius) {
  return spheroid(basis, centre, radius, radius);
}

} // namespace capsule
