#include "geometry/sampling.hpp"
#include <numbers>

namespace capsule {
namespace {

bool is_symmetric(const Vector &zeta) {
  constexpr double rounding = 1e-14;
  return (zeta + zeta.reverse()).isConstant(std::numbers::pi, rounding);
}

} // namespace

MirroredMatrix::MirroredMatrix(const Matrix &matrix, double sign) : sign_(sign), rows_(matrix.rows()) {
  const Eigen::Index half_rows = (rows_ + 1) / 2, pairs = matrix.cols() / 2;
  const auto left = matrix.topLeftCorner(half_rows, pairs);
  const auto right = matrix.topRightCorner(half_rows, pairs).rowwise().reverse();
  symmetric_.resize(half_rows, matrix.cols() - pairs); // with the node on the equator, if there is one
  symmetric_.leftCols(pairs) = left + right;
  if (symmetric_.cols() > pairs)
    symmetric_.col(pairs) = matrix.col(pairs).head(half_rows);
  antisymmetric_ = left - right;
}

Vector MirroredMatrix::operator*(const Eigen::Ref<const Vector> &nodal) const {
  const Eigen::Index pairs = antisymmetric_.cols();
  Vector symmetric = nodal.head(symmetric_.cols()), antisymmetric = nodal.head(pairs);
  symmetric.head(pairs) = 0.5 * (nodal.head(pairs) + nodal.tail(pairs).reverse());
  antisymmetric -= symmetric.head(pairs);
  const Vector of_symmetric = symmetric_ * symmetric, of_antisymmetric = antisymmetric_ * antisymmetric;
  Vector values(rows_);
  values.tail(of_symmetric.size()).reverse() = sign_ * (of_symmetric - of_antisymmetric);
  values.head(of_symmetric.size()) = of_symmetric + of_antisymmetric;
  return values;
}

Vector MirroredMatrix::transposed_times(const Eigen::Ref<const Vector> &values) const {
  const Eigen::Index pairs = rows_ / 2;
  Vector same = values.head(symmetric_.rows()), opposite = same; // a point on the equator once
  const Vector mirrored = sign_ * values.tail(pairs).reverse();
  same.head(pairs) += mirrored;
  opposite.head(pairs) -= mirrored;
  const Vector symmetric = symmetric_.transpose() * same;
  const Vector antisymmetric = antisymmetric_.transpose() * opposite;
  Vector nodal(symmetric.size() + antisymmetric.size());
  nodal.head(symmetric.size()) = symmetric; // a node on the equator is its own mirror image
  nodal.head(antisymmetric.size()) = 0.5 * (symmetric.head(antisymmetric.size()) + antisymmetric);
  nodal.tail(antisymmetric.size()).reverse() = 0.5 * (symmetric.head(antisymmetric.size()) - antisymmetric);
  return nodal;
}

Vector Sampling::even_field(int derivative, const Eigen::Ref<const Vector> &nodal) const {
  if (is_mirrored)
    return mirrored_even[derivative] * nodal;
  return even[derivative] * nodal;
}

Vector Sampling::odd_field(int derivative, const Eigen::Ref<const Vector> &nodal) const {
  if (is_mirrored)
    return mirrored_odd[derivative] * nodal;
  return odd[derivative] * nodal;
}

Vector Sampling::on_even_nodes(int derivative, const Eigen::Ref<const Vector> &values) const {
  if (is_mirrored)
    return mirrored_even[derivative].transposed_times(values);
  return even[derivative].transpose() * values;
}

Vector Sampling::on_odd_nodes(int derivative, const Eigen::Ref<const Vector> &values) const {
  if (is_mirrored)
    return mirrored_odd[derivative].transposed_times(values);
  return odd[derivative].transpose() * values;
}

Sampling sample(const MeridianBasis &basis, const Vector &zeta, const Vector &weights) {
  Sampling at;
  at.zeta = zeta;
  at.weights = weights;
  at.is_mirrored = is_symmetric(zeta) && is_symmetric(basis.nodes);
  for (int derivative = 0; derivative <= 2; ++derivative) {
    at.even[derivative] = basis.even(zeta, derivative);
    at.odd[derivative] = basis.odd(zeta, derivative);
    if (at.is_mirrored) { // a derivative of a mirrored field has the other sign
      const double sign = derivative == 1 ? -1 : 1;
      at.mirrored_even[derivative] = MirroredMatrix(at.even[derivative], sign);
      at.mirrored_odd[derivative] = MirroredMatrix(at.odd[derivative], sign);
    }
  }
  return at;
}

Trace trace(const Sampling &at, const Vector &position) {
  const Eigen::Index n = position.size() / 2;
  Trace curve;
  curve.x = at.even_field(0, position.head(n));
  curve.r = at.odd_field(0, position.tail(n));
  curve.x_zeta = at.even_field(1, position.head(n));
  curve.r_zeta = at.odd_field(1, position.tail(n));
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
