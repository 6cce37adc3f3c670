#include "geometry/quadrature.hpp"
#include <algorithm>
#include <cmath>
#include <gsl/gsl_integration.h>
#include <memory>
#include <vector>

namespace capsule {

GaussRule gauss_legendre(int points) {
  const std::unique_ptr<gsl_integration_glfixed_table, decltype(&gsl_integration_glfixed_table_free)> table(
      gsl_integration_glfixed_table_alloc(static_cast<std::size_t>(points)),
      gsl_integration_glfixed_table_free);
  GaussRule rule{Vector(points), Vector(points)};
  for (int k = 0; k < points; ++k)
    gsl_integration_glfixed_point(-1, 1, static_cast<std::size_t>(k), &rule.nodes[k], &rule.weights[k],
                                  table.get());
  return rule;
}

Panels make_panels(const Vector &edges, int points_per_panel) {
  Panels panels{gauss_legendre(points_per_panel), edges, {}, {}};
  const Eigen::Index p = points_per_panel;
  panels.points.resize(panels.count() * p);
  panels.weights.resize(panels.count() * p);
  for (Eigen::Index k = 0; k < panels.count(); ++k) {
    const double half = (edges[k + 1] - edges[k]) / 2;
    const double middle = (edges[k + 1] + edges[k]) / 2;
    panels.points.segment(k * p, p) = middle + half * panels.rule.nodes.array();
    panels.weights.segment(k * p, p) = half * panels.rule.weights;
  }
  return panels;
}

Vector graded_edges(double a, double b, double smallest, double largest, Graded ends) {
  if (ends == Graded::last)
    return (a + b) - graded_edges(a, b, smallest, largest, Graded::first).reverse().array();
  const double length = ends == Graded::both ? (b - a) / 2 : b - a;
  std::vector<double> from_end{0};
  for (double panel = smallest; panel < largest && from_end.back() + 2 * panel < length; panel *= 2)
    from_end.push_back(from_end.back() + panel);
  const double rest = length - from_end.back();
  const int equal = std::max(1, static_cast<int>(std::ceil(rest / largest - 1e-9)));
  const double base = from_end.back();
  for (int k = 1; k <= equal; ++k)
    from_end.push_back(base + rest * k / equal);
  const Vector half = Eigen::Map<Vector>(from_end.data(), static_cast<Eigen::Index>(from_end.size()));
  if (ends == Graded::first)
    return a + half.array();
  const Eigen::Index n = half.size();
  Vector edges(2 * n - 1);
  edges.head(n) = a + half.array();
  edges.tail(n) = b - half.reverse().array();
  return edges;
}

namespace {

// Legendre polynomials P_0 ... P_(n-1) at t.
Vector legendre_values(Eigen::Index n, double t) {
  Vector values(n);
  values[0] = 1;
  if (n > 1)
    values[1] = t;
  for (Eigen::Index k = 2; k < n; ++k) {
    const auto j = static_cast<double>(k);
    values[k] = ((2 * j - 1) * t * values[k - 1] - (j - 1) * values[k - 2]) / j;
  }
  return values;
}

// Adds the integral over [a, b] of ln((t - t0)^2) P_n(t): panels halve towards the end nearest to t0, which
// lies outside (a, b), until the panel is no longer than its distance to t0 or below the rounding error.
void add_logarithm_moments(const GaussRule &rule, double a, double b, double t0, Vector &moments) {
  const double distance = t0 <= a ? a - t0 : t0 - b;
  const double length = b - a;
  if (length > distance && length > 1e-15) {
    const double cut = t0 <= a ? a + length / 2 : b - length / 2;
    add_logarithm_moments(rule, a, cut, t0, moments);
    add_logarithm_moments(rule, cut, b, t0, moments);
    return;
  }
  for (Eigen::Index k = 0; k < rule.size(); ++k) {
    const double t = (a + b) / 2 + length / 2 * rule.nodes[k];
    const double gap = t - t0;
    if (gap != 0)
      moments += (length / 2 * rule.weights[k] * std::log(gap * gap)) * legendre_values(moments.size(), t);
  }
}

// The integrals over [-1, 1] of ln((t - t0)^2) P_n(t), t0 inside. Neumann's formula 2 Q_n(t0) = int P_n(t)/(t0 - t) dt is
// their derivative up to a factor, and (2n + 1) Q_n = Q'_(n+1) - Q'_(n-1) integrates it.
Vector logarithm_moments(Eigen::Index n, double t0) {
  Vector q(n + 1); // Legendre functions of the second kind on the cut
  q[0] = std::atanh(t0);
  q[1] = t0 * q[0] - 1;
  for (Eigen::Index k = 2; k <= n; ++k) {
    const auto j = static_cast<double>(k);
    q[k] = ((2 * j - 1) * t0 * q[k - 1] - (j - 1) * q[k - 2]) / j;
  }
  Vector moments(n);
  moments[0] = 2 * ((1 - t0) * std::log1p(-t0) + (1 + t0) * std::log1p(t0) - 2);
  for (Eigen::Index k = 1; k < n; ++k)
    moments[k] = 4 * (q[k + 1] - q[k - 1]) / (2 * static_cast<double>(k) + 1);
  return moments;
}

} // namespace

Vector logarithm_weights(const GaussRule &rule, double t0) {
  const Eigen::Index n = rule.size();
  Vector moments = Vector::Zero(n);
  if (t0 > -1 && t0 < 1)
    moments = logarithm_moments(n, t0);
  else
    add_logarithm_moments(gauss_legendre(16), -1, 1, t0, moments);
  Vector weights(n);
  for (Eigen::Index k = 0; k < n; ++k) {
    const Vector p = legendre_values(n, rule.nodes[k]);
    double sum = 0;
    for (Eigen::Index j = 0; j < n; ++j)
      sum += (static_cast<double>(j) + 0.5) * p[j] * moments[j];
    weights[k] = rule.weights[k] * sum;
  }
  return weights;
}

namespace {

Vector barycentric_weights(const Vector &nodes) {
  const Eigen::Index n = nodes.size();
  Vector barycentric(n);
  for (Eigen::Index j = 0; j < n; ++j) {
    double product = 1;
    for (Eigen::Index k = 0; k < n; ++k)
      if (k != j)
        product *= 2 * (nodes[j] - nodes[k]); // factor 2: no under- or overflow on [-1, 1]
    barycentric[j] = 1 / product;
  }
  return barycentric;
}

} // namespace

Matrix lagrange_matrix(const Vector &nodes, const Vector &points) {
  const Eigen::Index n = nodes.size();
  const Vector barycentric = barycentric_weights(nodes);
  Matrix values(points.size(), n);
  for (Eigen::Index i = 0; i < points.size(); ++i) {
    const Vector gap = points[i] - nodes.array();
    Eigen::Index hit = 0;
    if (gap.cwiseAbs().minCoeff(&hit) == 0) {
      values.row(i).setZero();
      values(i, hit) = 1;
      continue;
    }
    const Vector terms = barycentric.array() / gap.array();
    values.row(i) = terms.transpose() / terms.sum();
  }
  return values;
}

Matrix derivative_matrix(const Vector &nodes) {
  const Eigen::Index n = nodes.size();
  const Vector barycentric = barycentric_weights(nodes);
  Matrix slopes = Matrix::Zero(n, n);
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = 0; j < n; ++j)
      if (i != j) {
        slopes(i, j) = barycentric[j] / barycentric[i] / (nodes[i] - nodes[j]);
        slopes(i, i) -= slopes(i, j); // that of a constant vanishes
      }
  return slopes;
}

} // namespace capsule
