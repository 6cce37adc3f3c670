// Nodes for a shape: the same points of the membrane wherever the nodes lie, and fewer nodes for a fold.
#include "geometry/node_density.hpp"
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <numbers>

using namespace capsule;

namespace {

constexpr double pi = std::numbers::pi;

Membrane oblate_membrane(int nodes) {
  Case physics;
  physics.capsule.radius = 1;
  physics.capsule.aspect_ratio = 0.4;
  const MeridianBasis rule = spectral_basis(nodes + 8);
  return make_membrane(physics, spectral_basis(nodes), rule.nodes, rule.weights);
}

Membrane with_angles(Membrane membrane, const Vector &angles) {
  Case physics;
  physics.capsule.radius = 1;
  physics.capsule.aspect_ratio = 0.4;
  membrane.node_angle = angles;
  take_physics(physics, membrane);
  return membrane;
}

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
  const Membrane fine = oblate_membrane(300);
  const Vector position = folded(fine.basis.nodes);
  const Vector angles = suitable_angles(fine, position, spectral_basis(100));
  BOOST_TEST(angles[0] > 0);
  BOOST_TEST(angles[99] < pi);
  BOOST_TEST((angles.tail(99) - angles.head(99)).minCoeff() > 0);
  const MeridianBasis basis = spectral_basis(100);
  const double even = unresolved_part(basis, folded(basis.nodes));
  const double suited = unresolved_part(basis, folded(angles));
  BOOST_TEST(suited < 0.01 * even);
}

// Where nothing turns sharply nothing is won by uneven nodes: an ellipse in its own angle is one wave.
BOOST_AUTO_TEST_CASE(an_ellipse_keeps_its_nodes) {
  const Membrane membrane = oblate_membrane(40);
  const Vector angles = suitable_angles(membrane, membrane.reference, spectral_basis(50));
  BOOST_TEST((angles - spectral_basis(50).nodes).cwiseAbs().maxCoeff() < 1e-12);
}

// To other nodes and back, and directly to the points of the shape itself.
BOOST_AUTO_TEST_CASE(shapes_move_with_the_membrane) {
  const Membrane even = oblate_membrane(240);
  const Vector position = folded(even.basis.nodes);
  const Membrane uneven =
      with_angles(oblate_membrane(220), suitable_angles(even, position, spectral_basis(220)));
  const Vector there = at_angles(uneven.node_angle, even, position);
  const Vector back = at_angles(even.node_angle, uneven, there);
  BOOST_TEST((back - position).cwiseAbs().maxCoeff() < 1e-6);
  const Vector undeformed = at_angles(even.node_angle, uneven, uneven.reference);
  BOOST_TEST((undeformed - even.reference).cwiseAbs().maxCoeff() < 1e-10);
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
