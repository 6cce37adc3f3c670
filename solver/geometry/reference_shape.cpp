#include "geometry/reference_shape.hpp"

namespace capsule {

Vector initial_position(const CapsuleSpec &capsule, const Vector &angle) {
  const auto [half_length, half_width] = extent(capsule);
  Vector position(2 * angle.size());
  position << -half_length * angle.array().cos(), half_width * angle.array().sin();
  if (capsule.shape == CapsuleShape::biconcave) {
    const auto [c0, c1, c2] = biconcave_thickness;
    const Eigen::ArrayXd u = angle.array().sin().square();
    position.head(angle.size()) = -half_width / 2 * angle.array().cos() * (c0 + u * (c1 + u * c2));
  }
  return position;
}

Vector reference_position(const CapsuleSpec &capsule, const Vector &angle) {
  return initial_position(capsule, angle) / (1 + capsule.inflation);
}

// From the equator to half way to the upstream pole nodes are denser (at A/B = 0.28 up to 1.8 times), and at the front
// less dense (1.7 times). A sphere's nodes stay where they are, because the front of a neo-Hookean one may stretch
// without bound.
Vector clustered_angles(const Vector &zeta, double clustering) {
  return zeta.array() + clustering * (0.28 * (2 * zeta.array()).sin() - 0.42 * zeta.array().sin());
}

} // namespace capsule
