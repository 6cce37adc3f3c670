#include "geometry/sampling.hpp"
#include <numbers>

namespace capsule {
namespace {

bool is_symmetric(const Vector &zeta) {
  constexpr double rounding = 1e-14;
  return (zeta + zeta.reverse()).isConstant(std::numbers::pi, rounding);
}

} // namespace

BasisMatrix::BasisMatrix(const Matrix &half, Eigen::Index points, double sign)
    : whole_(points, half.cols()), symmetric_(half.leftCols((half.cols() + 1) / 2)), sign_(sign) {
  whole_.bottomRows(half.rows()) = sign * half.reverse();
  whole_.topRows(half.rows()) = half;
  const Eigen::Index pairs = half.cols() / 2; // a node on the equator is no pair
  const auto right = half.rightCols(pairs).rowwise().reverse();
  antisymmetric_ = half.leftCols(pairs) - right;
  symmetric_.leftCols(pairs) += right;
}

Vector BasisMatrix::operator*(const Eigen::Ref<const Vector> &nodal) const {
  if (!is_mirrored())
    return whole_ * nodal;
  const Eigen::Index pairs = antisymmetric_.cols();
  Vector symmetric = nodal.head(symmetric_.cols()), antisymmetric = nodal.head(pairs);
  symmetric.head(pairs) = 0.5 * (nodal.head(pairs) + nodal.tail(pairs).reverse());
  antisymmetric -= symmetric.head(pairs);
  const Vector of_symmetric = symmetric_ * symmetric, of_antisymmetric = antisymmetric_ * antisymmetric;
  Vector values(whole_.rows());
  values.tail(of_symmetric.size()).reverse() = sign_ * (of_symmetric - of_antisymmetric);
  values.head(of_symmetric.size()) = of_symmetric + of_antisymmetric;
  return values;
}

Vector BasisMatrix::transposed_times(const Eigen::Ref<const Vector> &values) const {
  return (values.transpose() * *this).transpose();
}

Matrix operator*(const Eigen::Ref<const RowMatrix> &at_points, const BasisMatrix &matrix) {
  if (!matrix.is_mirrored())
    return at_points * matrix.whole_;
  const Eigen::Index pairs = matrix.whole_.rows() / 2, pairs_of_nodes = matrix.antisymmetric_.cols();
  RowMatrix same = at_points.leftCols(matrix.symmetric_.rows()),
            opposite = same; // a point on the equator once
  const auto mirrored = matrix.sign_ * at_points.rightCols(pairs).rowwise().reverse();
  same.leftCols(pairs) += mirrored;
  opposite.leftCols(pairs) -= mirrored;
  const Matrix symmetric = same * matrix.symmetric_, antisymmetric = opposite * matrix.antisymmetric_;
  Matrix on_nodes(at_points.rows(), matrix.whole_.cols());
  on_nodes.leftCols(symmetric.cols()) = symmetric; // a node on the equator is its own mirror image
  on_nodes.leftCols(pairs_of_nodes) = 0.5 * (symmetric.leftCols(pairs_of_nodes) + antisymmetric);
  on_nodes.rightCols(pairs_of_nodes).rowwise().reverse() =
      0.5 * (symmetric.leftCols(pairs_of_nodes) - antisymmetric);
  return on_nodes;
}

Sampling sample(const MeridianBasis &basis, const Vector &zeta, const Vector &weights) {
  const bool is_mirrored = is_symmetric(zeta) && is_symmetric(basis.nodes);
  const Eigen::Index points = zeta.size();
  const Vector computed = zeta.head(is_mirrored ? (points + 1) / 2 : points);
  const auto matrix = [&](Matrix rows, int derivative) {
    if (!is_mirrored)
      return BasisMatrix(std::move(rows));
    return BasisMatrix(rows, points, derivative == 1 ? -1 : 1); // the sign of a mirrored field's derivative
  };
  Sampling at;
  at.zeta = zeta;
  at.weights = weights;
  for (int derivative = 0; derivative <= 2; ++derivative) {
    at.even[derivative] = matrix(basis.even(computed, derivative), derivative);
    at.odd[derivative] = matrix(basis.odd(computed, derivative), derivative);
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
  const Eigen::Index n = at.even[0].whole().cols();
  const Vector tangent_x = curve.x_zeta.cwiseQuotient(curve.arc);
  const Vector tangent_r = curve.r_zeta.cwiseQuotient(curve.arc);
  Matrix change(curve.r.size(), 2 * n);
  change << tangent_x.cwiseQuotient(curve.arc).asDiagonal() * at.even[1].whole(),
      tangent_r.cwiseQuotient(curve.arc).asDiagonal() * at.odd[1].whole();
  change.rightCols(n) += curve.r.cwiseInverse().asDiagonal() * at.odd[0].whole();
  return change;
}

} // namespace capsule
