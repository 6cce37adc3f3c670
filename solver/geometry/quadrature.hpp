#pragma once
// Quadrature on panels: composite Gauss-Legendre rules, product weights for a logarithm inside or beside a
// panel, and interpolation from a panel's nodes. Throws nothing.
#include "base/linear_algebra.hpp"

namespace capsule {

struct GaussRule {
  Vector nodes; // on [-1, 1], ascending
  Vector weights;
  Eigen::Index size() const { return nodes.size(); }
};
GaussRule gauss_legendre(int points);

// A composite rule: panel k is [edges_k, edges_k+1] and holds the points k p ... (k+1) p - 1.
struct Panels {
  GaussRule rule; // p points
  Vector edges;   // ascending
  Vector points;
  Vector weights;
  Eigen::Index count() const { return edges.size() - 1; }
};
Panels make_panels(const Vector &edges, int points_per_panel);

// Edges from a to b whose panels double in length away from a graded end until they reach `largest`; the
// panel at a graded end has about the length `smallest`.
enum class Graded { first, last, both };
Vector graded_edges(double a, double b, double smallest, double largest, Graded ends);

// Weights w with sum_k w_k f(t_k) = integral over [-1, 1] of ln((t - t0)^2) f(t) dt, exact for polynomials of
// degree below the rule's number of points. t0 is any real number; beyond |t0| of about 3 the rule's own weights
// with ln((t - t0)^2) f as integrand are as good.
Vector logarithm_weights(const GaussRule &rule, double t0);

// values at `points` from values at `nodes` by the interpolating polynomial (barycentric); points x nodes.
Matrix lagrange_matrix(const Vector &nodes, const Vector &points);
// Derivatives at the nodes themselves.
Matrix derivative_matrix(const Vector &nodes);

} // namespace capsule
