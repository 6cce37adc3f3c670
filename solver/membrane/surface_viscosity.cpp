#include "membrane/surface_viscosity.hpp"
#include <numbers>

namespace capsule {

SurfaceFriction::SurfaceFriction(const Sampling &at, const Vector &nodal_area, const Vector &position,
                                 const SurfaceViscosity &viscosity)
    : nodal_area_(nodal_area.replicate(2, 1)) {
  const Trace curve = trace(at, position);
  sum_ = area_change(at, curve);
  difference_ = sum_;
  difference_.rightCols(nodal_area.size()) -= (2 * curve.r.cwiseInverse()).asDiagonal() * at.odd[0].whole();
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

// With s the length of the tangent t and D the change by a displacement of the nodes, the power against w is the integral of
// T_s e_s(w) + T_phi e_phi(w) over the area, where e_s(w) = t.w'/s^2, e_phi(w) = w_r/r:
//   D area = (e_s + e_phi) area
//   D e_s(w) = D t.w'/s^2 - 2 e_s(w) e_s,   D e_phi(w) = -e_phi(w) e_phi,   with e_s, e_phi of the displacement
Matrix friction_jacobian(const Sampling &at, const Vector &nodal_area, const Vector &position,
                         const SurfaceViscosity &viscosity, const Vector &velocity) {
  const Trace curve = trace(at, position);
  const Eigen::Index n = nodal_area.size();
  Matrix azimuthal = Matrix::Zero(curve.r.size(), 2 * n); // e_phi of nodal displacements
  azimuthal.rightCols(n) = curve.r.cwiseInverse().asDiagonal() * at.odd[0].whole();
  const Matrix meridional = area_change(at, curve) - azimuthal; // e_s
  const Vector square = curve.arc.array().square();
  const Vector e_s = meridional * velocity, e_phi = azimuthal * velocity;

  Matrix d_meridional(curve.r.size(), 2 * n); // D e_s, D e_phi of the velocity
  d_meridional << (at.even[1] * velocity.head(n)).cwiseQuotient(square).asDiagonal() * at.even[1].whole(),
      (at.odd[1] * velocity.tail(n)).cwiseQuotient(square).asDiagonal() * at.odd[1].whole();
  d_meridional -= 2 * e_s.asDiagonal() * meridional;
  const Matrix d_azimuthal = -(e_phi.asDiagonal() * azimuthal);

  const double with = viscosity.dilatational + viscosity.shear,
               across = viscosity.dilatational - viscosity.shear;
  const Vector t_s = with * e_s + across * e_phi, t_phi = across * e_s + with * e_phi;
  const Vector area = 2 * std::numbers::pi * at.weights.array() * curve.r.array() * curve.arc.array();
  const Matrix against_meridional =
      with * d_meridional + across * d_azimuthal + t_s.asDiagonal() * (azimuthal - meridional);
  const Matrix against_azimuthal =
      across * d_meridional + with * d_azimuthal + t_phi.asDiagonal() * meridional;
  Matrix change = meridional.transpose() * area.asDiagonal() * against_meridional +
                  azimuthal.transpose() * area.asDiagonal() * against_azimuthal;
  const Vector tension = area.cwiseProduct(t_s).cwiseQuotient(square);
  change.topLeftCorner(n, n) += at.even[1].whole().transpose() * tension.asDiagonal() * at.even[1].whole();
  change.bottomRightCorner(n, n) += at.odd[1].whole().transpose() * tension.asDiagonal() * at.odd[1].whole();
  return nodal_area.replicate(2, 1).cwiseInverse().asDiagonal() * change;
}

} // namespace capsule
