#include "membrane/surface_viscosity.hpp"
#include <numbers>

namespace capsule {

SurfaceFriction::SurfaceFriction(const Sampling &at, const Vector &nodal_area, const Vector &position,
                                 const SurfaceViscosity &viscosity)
    : nodal_area_(nodal_area.replicate(2, 1)) {
  const Trace curve = trace(at, position);
  sum_ = area_change(at, curve);
  difference_ = sum_;
  difference_.rightCols(nodal_area.size()) -= (2 * curve.r.cwiseInverse()).asDiagonal() * at.odd[0];
  const Vector area = 2 * std::numbers::pi * at.weights.array() * curve.r.array() * curve.arc.array();
  of_sum_ = viscosity.dilatational * area;
  of_difference_ = viscosity.shear * area;
}

Matrix SurfaceFriction::dissipation() const {
  return sum_.transpose() * of_sum_.asDiagonal() * sum_ +
         difference_.transpose() * of_difference_.asDiagonal() * difference_;
}

Matrix SurfaceFriction::matrix() const {
  return nodal_area_.cwiseInverse().asDiagonal() * dissipation();
}

Vector SurfaceFriction::load(const Vector &velocity) const {
  const Vector sum = sum_ * velocity, difference = difference_ * velocity;
  const Vector power = sum_.transpose() * of_sum_.cwiseProduct(sum) +
                       difference_.transpose() * of_difference_.cwiseProduct(difference);
  return power.cwiseQuotient(nodal_area_);
}

} // namespace capsule
