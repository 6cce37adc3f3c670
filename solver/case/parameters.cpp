#include "case/parameters.hpp"

namespace capsule {
namespace {

// With the volume 2 pi R_0^3 (c_0/3 + 2 c_1/15 + 8 c_2/105). The thickness is largest where
// 5 c_2 u^2 + (3 c_1 - 4 c_2) u + c_0 - 2 c_1 = 0, u = p^2.
Extent biconcave_extent(double radius) {
  const auto [c0, c1, c2] = biconcave_thickness;
  const double half_width = radius * std::cbrt(2.0 / 3 / (c0 / 3 + 2 * c1 / 15 + 8 * c2 / 105));
  const double a = 5 * c2, b = 3 * c1 - 4 * c2, c = c0 - 2 * c1;
  const double u = (-b + std::sqrt(b * b - 4 * a * c)) / (2 * a);
  return {half_width / 2 * std::sqrt(1 - u) * (c0 + u * (c1 + u * c2)), half_width};
}

} // namespace

Extent extent(const CapsuleSpec &capsule) {
  if (capsule.shape == CapsuleShape::biconcave)
    return biconcave_extent(capsule.radius);
  const double half_width = capsule.radius / std::cbrt(capsule.aspect_ratio);
  return {half_width * capsule.aspect_ratio, half_width};
}

double aspect_ratio(const CapsuleSpec &capsule) {
  if (capsule.shape == CapsuleShape::spheroid)
    return capsule.aspect_ratio;
  const auto [half_length, half_width] = extent(capsule);
  return half_length / half_width;
}

} // namespace capsule
