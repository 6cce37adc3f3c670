// Nodes for a shape: the same points of the membrane wherever the nodes lie, and fewer nodes for a fold.
#include "folded.hpp"
#include "geometry/node_density.hpp"
#include "geometry/reference_shape.hpp"
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <numbers>

using namespace capsule;

namespace {

constexpr double pi = std::numbers::pi;

} // namespace

BOOST_AUTO_TEST_SUITE(node_density)

// Ascending angles in (0, pi) for which the fold is resolved by several digits more than on even nodes.
BOOST_AUTO_TEST_CASE(a_fold_gets_the_nodes) {
  const MeridianBasis even = spectral_basis(300), coarse = spectral_basis(100);
  const Vector angles = suitable_angles(coarse, even, even.nodes, folded(even.nodes));
  BOOST_TEST(angles[0] > 0);
  BOOST_TEST(angles[99] < pi);
  BOOST_TEST((angles.tail(99) - angles.head(99)).minCoeff() > 0);
  const double on_even = unresolved_part(coarse, folded(coarse.nodes));
  const double suited = unresolved_part(coarse, folded(angles));
  BOOST_TEST(suited < 0.01 * on_even);
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

BOOST_AUTO_TEST_SUITE_END()
