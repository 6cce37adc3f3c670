#include "geometry/sampling.hpp"

namespace capsule {

Sampling sample(const MeridianBasis &basis, const Vector &zeta, const Vector &weights) {
  Sampling at{.zeta = zeta, .weights = weights, .even = {}, .odd = {}};
  for (int derivative = 0; derivative <= 2; ++derivative) {
    at.even[derivative] = basis.even(zeta, derivative);
    at.odd[derivative] = basis.odd(zeta, derivative);
  }
  return at;
}

Trace trace(const Sampling &at, const Vector &position) {
  const Eigen::Index n = position.size() / 2;
  Trace curve;
  curve.x = at.even[0] * position.head(n);
  curve.r = at.odd[0] * position.tail(n);
  curve.x_zeta = at.even[1] * position.head(n);
  curve.r_zeta = at.odd[1] * position.tail(n);
  curve.arc = (curve.x_zeta.array().square() + curve.r_zeta.array().square()).sqrt();
  return curve;
}

Matrix area_change(const Sampling &at, const Trace &curve) {
  const Eigen::Index n = at.even[0].cols();
  const Vector tangent_x = curve.x_zeta.cwiseQuotient(curve.arc);
  const Vector tangent_r = curve.r_zeta.cwiseQuotient(curve.arc);
  Matrix change(curve.r.size(), 2 * n);
  change << tangent_x.cwiseQuotient(curve.arc).asDiagonal() * at.even[1],
      tangent_r.cwiseQuotient(curve.arc).asDiagonal() * at.odd[1];
  change.rightCols(n) += curve.r.cwiseInverse().asDiagonal() * at.odd[0];
  return change;
}

} // namespace capsule
