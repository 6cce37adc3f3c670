// Quadrature rules and interpolation against exact integrals.
#include "geometry/quadrature.hpp"
#include <boost/test/unit_test.hpp>
#include <cmath>

using namespace capsule;

BOOST_AUTO_TEST_SUITE(quadrature)

BOOST_AUTO_TEST_CASE(gauss_rule_is_exact_to_degree_2n_minus_1) {
  const GaussRule rule = gauss_legendre(7);
  for (int k = 0; k < 14; ++k)
    BOOST_TEST(std::abs(rule.weights.dot(rule.nodes.array().pow(k).matrix()) -
                        (k % 2 == 0 ? 2.0 / (k + 1) : 0)) < 1e-14);
}

// int_-1^1 ln((t - t0)^2) t^k dt by parts: the boundary terms and a geometric sum.
double logarithm_moment(double t0, int k) {
  const double high = std::log((1 - t0) * (1 - t0));
  const double low = std::log((1 + t0) * (1 + t0));
  double inner = 0; // int_-1^1 (t^(k+1) - t0^(k+1))/(t - t0) dt
  for (int j = 0; j <= k; ++j)
    inner += std::pow(t0, k - j) * (j % 2 == 0 ? 2.0 / (j + 1) : 0);
  const double end = (k + 1) % 2 == 0 ? low : -low;
  return (high - end - 2 * inner - std::pow(t0, k + 1) * (high - low)) / (k + 1);
}

BOOST_AUTO_TEST_CASE(logarithm_weights_are_exact_for_polynomials) {
  const GaussRule rule = gauss_legendre(12);
  for (const double t0 : {0.3, -0.999, 0.9999999, 1.0000001, -1.05, 1.7}) {
    const Vector weights = logarithm_weights(rule, t0);
    for (int k = 0; k < 12; ++k)
      BOOST_TEST(std::abs(weights.dot(rule.nodes.array().pow(k).matrix()) - logarithm_moment(t0, k)) < 2e-13);
  }
}

BOOST_AUTO_TEST_CASE(panels_cover_the_interval) {
  const Vector edges = graded_edges(2, 5, 0.01, 0.5, Graded::both);
  BOOST_TEST(edges[0] == 2);
  BOOST_TEST(edges[edges.size() - 1] == 5);
  const Vector lengths = edges.tail(edges.size() - 1) - edges.head(edges.size() - 1);
  BOOST_TEST(lengths.minCoeff() > 0.005);
  BOOST_TEST(lengths.maxCoeff() < 0.5 + 1e-12);
  for (Eigen::Index k = 0; k + 1 < lengths.size(); ++k)
    BOOST_TEST(std::max(lengths[k] / lengths[k + 1], lengths[k + 1] / lengths[k]) < 2.5);
  const Panels panels = make_panels(edges, 8);
  BOOST_TEST(std::abs(panels.weights.dot(panels.points.array().exp().matrix()) -
                      (std::exp(5.0) - std::exp(2.0))) < 1e-11);
}

BOOST_AUTO_TEST_CASE(interpolation_reproduces_polynomials) {
  const GaussRule rule = gauss_legendre(9);
  const Vector points = Vector::LinSpaced(11, -1, 1);
  const Matrix matrix = lagrange_matrix(rule.nodes, points);
  BOOST_TEST(
      (matrix * rule.nodes.array().pow(8).matrix() - points.array().pow(8).matrix()).cwiseAbs().maxCoeff() <
      1e-13);
}

BOOST_AUTO_TEST_CASE(derivative_of_polynomials) {
  const Vector nodes = gauss_legendre(9).nodes;
  const Vector slopes = derivative_matrix(nodes) * nodes.array().pow(8).matrix();
  BOOST_TEST((slopes - 8 * nodes.array().pow(7).matrix()).cwiseAbs().maxCoeff() < 1e-12);
}

BOOST_AUTO_TEST_SUITE_END()
