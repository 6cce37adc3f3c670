#pragma once
// Boundary elements of section 3: cubic B-splines on elements of unit length in the parameter, and the
// quadrature rules of an element.
//   A spline on N elements has N + 3 coefficients; element e = 0 ... N-1 carries the B-splines e ... e+3 (eq.
//   19). Node j has parameter j. Derivatives are with respect to this parameter.
// Throws nothing.
#include "base/linear_algebra.hpp"

namespace capsule {

// On [0, 1].
struct UnitRule {
  Vector nodes;
  Vector weights;
};
// Integral of f(t), exact below degree 2 points.
UnitRule unit_gauss_rule(int points);
// Integral of ln(1/t) f(t), exact below degree 2 points.
UnitRule logarithmic_rule(int points);

// The four B-splines of an element at the nodes of a rule.
struct ShapeTable {
  using Values = Eigen::Matrix<double, 4, Eigen::Dynamic>;
  Values value, slope, second;
  Eigen::Index points() const { return value.cols(); }
};
ShapeTable tabulate_shapes(const Vector &nodes);

// Coefficients from N + 1 nodal values followed by the derivatives of order 1 or 2 at the first and the last
// node: (N+3) x (N+3).
Matrix spline_coefficients(int elements, int end_derivative);

// Spline or derivative at the tabulated points of all elements, element after element.
Vector evaluate_spline(const Vector &coefficients, const ShapeTable::Values &shapes);

} // namespace capsule
