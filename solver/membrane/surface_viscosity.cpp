#include "membrane/surface_viscosity.hpp"
#include <numbers>

namespace capsule {

Matrix surface_dissipation(const Sampling &at, const Vector &position, const SurfaceViscosity &viscosity) {
  const Trace curve = trace(at, position);
  const Eigen::Index n = position.size() / 2;
  const Matrix sum = area_change(at, curve); // e_s + e_phi
  Matrix difference = sum;                   // e_s - e_phi
  difference.rightCols(n) -= (2 * curve.r.cwiseInverse()).asDiagonal() * at.odd[0];
  const Vector area = 2 * std::numbers::pi * at.weights.array() * curve.r.array() * curve.arc.array();
  return sum.transpose() * (viscosity.dilatational * area).asDiagonal() * sum +
         difference.transpose() * (viscosity.shear * area).asDiagonal() * difference;
}

Matrix surface_friction(const Sampling &at, const Vector &nodal_area, const Vector &position,
                        const SurfaceViscosity &viscosity) {
  return nodal_area.cwiseInverse().replicate(2, 1).asDiagonal() *
         surface_dissipation(at, position, viscosity);
}

} // namespace capsule
