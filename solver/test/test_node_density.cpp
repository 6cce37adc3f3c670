// Nodes for a shape: the same points of the membrane wherever the nodes lie, and fewer nodes for a fold.
#include "geometry/node_density.hpp"
#include "geometry/reference_shape.hpp"
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <numbers>

using namespace capsule;

namespace {

constexpr double pi = std::numbers::pi;

// A sphere whose rear is pushed in: at the ring where it turns back, the tangent turns within a tenth of a radian.
Vector folded(const Vector &angle) {
  const auto a = angle.array();
  const Eigen::ArrayXd inward = 0.5 * (1 - ((a - 0.8) / 0.08).tanh() * ((a + 0.8) / 0.08).tanh());
  Vector position(2 * angle.size());
  position << -a.cos() + inward * 2 * (a.cos() - std::cos(0.8)), a.sin();
  return position;
}

} // namespace

BOOST_AUTO_TEST_SUITE(node_density)

// Ascending angles in (0, pi) for which the fold is resolved by several digits more than on even nodes.
BOOST_AUTO_TEST_CASE(a_fold_gets_the_nodes) {
  const MeridianBasis fine = spectral_basis(300), basis = spectral_basis(100);
  const Vector angles = suitable_angles(basis, fine, fine.nodes, folded(fine.nodes));
  BOOST_TEST(angles[0] > 0);
  BOOST_TEST(angles[99] < pi);
  BOOST_TEST((angles.tail(99) - angles.head(99)).minCoeff() > 0);
  const double even = unresolved_part(basis, folded(basis.nodes));
  const double suited = unresolved_part(basis, folded(angles));
  BOOST_TEST(suited < 0.01 * even);
}

// Where nothing turns sharply nothing is won by uneven nodes: an ellipse in its own angle is one wave.
BOOST_AUTO_TEST_CASE(an_ellipse_keeps_its_nodes) {
  const MeridianBasis basis = spectral_basis(40), more = spectral_basis(50);
  const CapsuleSpec oblate{.radius = 1, .aspect_ratio = 0.4};
  const Vector angles = suitable_angles(more, basis, basis.nodes, reference_position(oblate, basis.nodes));
  BOOST_TEST((angles - more.nodes).cwiseAbs().maxCoeff() < 1e-12);
}

// To other nodes and back, and directly to the points of the shape itself.
BOOST_AUTO_TEST_CASE(shapes_move_with_the_membrane) {
  const MeridianBasis basis = spectral_basis(240), other = spectral_basis(220);
  const Vector even = basis.nodes;
  const Vector position = folded(even);
  const Vector uneven = suitable_angles(other, basis, even, position);
  const Vector there = at_angles(uneven, basis, even, position);
  const Vector back = at_angles(even, other, uneven, there);
  BOOST_TEST((back - position).cwiseAbs().maxCoeff() < 1e-6);
  const CapsuleSpec oblate{.radius = 1, .aspect_ratio = 0.4};
  const Vector undeformed = at_angles(even, other, uneven, reference_position(oblate, uneven));
  BOOST_TEST((undeformed - reference_position(oblate, even)).cwiseAbs().maxCoeff() < 1e-10);
}

// On a circle the tangent turns as the parameter: halving pi twice leaves quarters.
BOOST_AUTO_TEST_CASE(panels_turn_little) {
  const MeridianBasis basis = spectral_basis(30);
  Vector circle(60);
  circle << -basis.nodes.array().cos(), basis.nodes.array().sin();
  Vector ends(2);
  ends << 0, pi;
  const Vector quarters = halved_edges(basis, circle, ends, 0.9);
  BOOST_REQUIRE(quarters.size() == 5);
  for (Eigen::Index k = 0; k < 5; ++k)
    BOOST_TEST(std::abs(quarters[k] - static_cast<double>(k) * pi / 4) < 1e-14);
  BOOST_TEST(halved_edges(basis, circle, ends, 4).size() == 2);
}

// Short ones at the fold only, with the edges that were there.
BOOST_AUTO_TEST_CASE(a_fold_gets_short_panels) {
  const MeridianBasis basis = spectral_basis(200);
  const Vector edges = Vector::LinSpaced(9, 0, pi);
  const Vector halved = halved_edges(basis, folded(basis.nodes), edges, 0.5);
  const Vector lengths = halved.tail(halved.size() - 1) - halved.head(halved.size() - 1);
  Eigen::Index shortest = 0;
  BOOST_TEST(lengths.minCoeff(&shortest) < 0.05);
  BOOST_TEST(std::abs(halved[shortest] - 0.8) < 0.2);
  for (const double edge : edges)
    BOOST_TEST((halved.array() - edge).abs().minCoeff() < 1e-14);
}

// A tip where the tangent turns at once ends the halving all the same.
BOOST_AUTO_TEST_CASE(a_cusp_is_cut_off) {
  const MeridianBasis basis = spectral_basis(60);
  const Eigen::ArrayXd c = basis.nodes.array().cos();
  Vector cusp(120);
  cusp << -(c.square() / 2 - std::cos(1) * c),
      basis.nodes.array().sin() * ((c - std::cos(1)).square() + 1e-3);
  Vector ends(2);
  ends << 0, pi;
  const Vector halved = halved_edges(basis, cusp, ends, 0.5);
  BOOST_TEST(halved.size() > 2);
  BOOST_TEST(halved.size() < 100);
}

BOOST_AUTO_TEST_SUITE_END()
