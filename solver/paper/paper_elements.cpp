#include "paper/paper_elements.hpp"
#include "geometry/quadrature.hpp"
#include <Eigen/Eigenvalues>
#include <cmath>

namespace capsule {
namespace {

// Gauss's rule from the recurrence p_k+1 = (t - a_k) p_k - b_k p_k-1 of the monic orthogonal polynomials; b_0
// is the integral of the weight function.
UnitRule rule_from_recurrence(const Vector &a, const Vector &b) {
  Eigen::SelfAdjointEigenSolver<Matrix> eigen;
  eigen.computeFromTridiagonal(a, b.tail(b.size() - 1).cwiseSqrt());
  return {eigen.eigenvalues(), b(0) * eigen.eigenvectors().row(0).transpose().cwiseAbs2()};
}

// Recurrence of the monic Legendre polynomials of [0, 1].
Vector legendre_b(Eigen::Index count) {
  Vector b = Vector::Ones(count);
  for (Eigen::Index k = 1; k < count; ++k) {
    b(k) = 0.25 / (4 - 1.0 / static_cast<double>(k * k));
  }
  return b;
}

} // namespace

UnitRule unit_gauss_rule(int points) {
  const GaussRule rule = gauss_legendre(points);
  return {(1 + rule.nodes.array()) / 2, rule.weights / 2};
}

// The modified Chebyshev algorithm: the recurrence for ln(1/t) from its moments against the Legendre
// polynomials, which is well conditioned, unlike that from the moments of powers. With P_k(1) = 1 the moments
// are 1 and (-1)^k/(k (k+1)).
UnitRule logarithmic_rule(int points) {
  const Eigen::Index n = points;
  const Vector legendre = legendre_b(2 * n);
  Vector above = Vector::Zero(2 * n); // sigma_(k-1), then sigma_k of the algorithm
  Vector current(2 * n);
  double leading = 1; // 1/leading coefficient of P_k
  for (Eigen::Index l = 0; l < 2 * n; ++l) {
    const auto order = static_cast<double>(l);
    leading *= l == 0 ? 1 : order / (2 * (2 * order - 1));
    current(l) = leading * (l == 0 ? 1 : (l % 2 == 0 ? 1 : -1) / (order * (order + 1)));
  }
  Vector a(n), b(n);
  a(0) = 0.5 + current(1) / current(0);
  b(0) = current(0);
  for (Eigen::Index k = 1; k < n; ++k) {
    Vector next = Vector::Zero(2 * n);
    for (Eigen::Index l = k; l < 2 * n - k; ++l) {
      next(l) =
          current(l + 1) - (a(k - 1) - 0.5) * current(l) - b(k - 1) * above(l) + legendre(l) * current(l - 1);
    }
    a(k) = 0.5 + next(k + 1) / next(k) - current(k) / current(k - 1);
    b(k) = next(k) / current(k - 1);
    above = current;
    current = next;
  }
  return rule_from_recurrence(a, b);
}

ShapeTable tabulate_shapes(const Vector &nodes) {
  ShapeTable table;
  const Eigen::Index n = nodes.size();
  table.value.resize(4, n);
  table.slope.resize(4, n);
  table.second.resize(4, n);
  for (Eigen::Index k = 0; k < n; ++k) {
    const double t = nodes(k), s = 1 - t;
    table.value.col(k) << s * s * s, 4 - 3 * t * t * (1 + s), 4 - 3 * s * s * (1 + t), t * t * t;
    table.slope.col(k) << -s * s, t * (3 * t - 4), s * (4 - 3 * s), t * t;
    table.second.col(k) << s, 3 * t - 2, 3 * s - 2, t;
  }
  table.value /= 6;
  table.slope /= 2;
  return table;
}

Matrix spline_coefficients(int elements, int end_derivative) {
  const Eigen::Index n = elements;
  const ShapeTable ends = tabulate_shapes(Eigen::Vector2d(0, 1));
  const ShapeTable::Values &derivative = end_derivative == 1 ? ends.slope : ends.second;
  Matrix conditions = Matrix::Zero(n + 3, n + 3);
  for (Eigen::Index e = 0; e <= n; ++e) {
    conditions.row(e).segment(e, 3) = ends.value.col(0).head(3).transpose();
  }
  conditions.row(n + 1).head(4) = derivative.col(0).transpose();
  conditions.row(n + 2).tail(4) = derivative.col(1).transpose();
  return lu_inverse(conditions);
}

Vector evaluate_spline(const Vector &coefficients, const ShapeTable::Values &shapes) {
  const Eigen::Index elements = coefficients.size() - 3, points = shapes.cols();
  Vector values(elements * points);
  for (Eigen::Index e = 0; e < elements; ++e) {
    values.segment(e * points, points).noalias() = shapes.transpose() * coefficients.segment<4>(e);
  }
  return values;
}

} // namespace capsule
