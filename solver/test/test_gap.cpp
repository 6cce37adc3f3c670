// Distances between spheres, and between a sphere and the hollow rear that it stands in.
#include "geometry/gap.hpp"
#include <boost/test/unit_test.hpp>
#include <cmath>

using namespace capsule;

namespace {

const MeridianBasis basis = spectral_basis(32);
constexpr int chords = 16; // per node

Vector sphere_nodes(double centre, double radius) {
  Vector position(64);
  position << centre - radius * basis.nodes.array().cos(), radius * basis.nodes.array().sin();
  return position;
}
Chain sphere(double centre, double radius) {
  return chain_of(basis, sphere_nodes(centre, radius), chords);
}

// A bowl that opens upstream: its rim lies at x = -0.81, the bottom of its hollow at 0.5.
Vector bowl_nodes() {
  Vector position(64);
  const auto zeta = basis.nodes.array();
  position << 0.8 * (2 * zeta).cos() - 0.3 * zeta.cos(), zeta.sin();
  return position;
}
Chain bowl() {
  return chain_of(basis, bowl_nodes(), chords);
}

} // namespace

BOOST_AUTO_TEST_SUITE(gap)

BOOST_AUTO_TEST_CASE(spheres_in_a_row) {
  const Chain leading = sphere(2, 0.8);
  for (const double width : {1e-3, 0.2, 3.0}) {
    const Chain following = sphere(2 - 0.8 - width - 0.5, 0.5);
    BOOST_TEST(!overlap(leading, following));
    const Gap found = gap_between(leading, following);
    BOOST_TEST(std::abs(found.width - width) < 1e-13);
    BOOST_TEST(std::abs(found.x - 1.2) < 1e-13);
    BOOST_TEST(std::abs(found.r) < 1e-13);
    BOOST_TEST(std::abs(gap_between(following, leading).width - width) < 1e-13);
  }
  BOOST_TEST(overlap(leading, sphere(0.8, 0.5)));
  BOOST_TEST(overlap(leading, sphere(2, 0.1)));
  BOOST_TEST(overlap(sphere(2, 0.1), leading));
}

// Their axial extents overlap, they do not.
BOOST_AUTO_TEST_CASE(one_stands_in_the_hollow_of_the_other) {
  const Chain outer = bowl();
  const double rear = outer.x[0], rim = outer.x.minCoeff();
  BOOST_TEST(rim < rear - 0.3);
  const Chain inner = sphere(rear - 0.35, 0.3);
  BOOST_TEST(inner.x.maxCoeff() > rim + 0.3);
  BOOST_TEST(!overlap(outer, inner));
  const Gap found = gap_between(outer, inner);
  BOOST_TEST(found.width <= 0.05 + 1e-12);
  BOOST_TEST(std::abs(std::hypot(found.x - (rear - 0.35), found.r) - 0.3 - found.width) < 1e-3 * found.width);
  BOOST_TEST(overlap(outer, sphere(rear - 0.25, 0.3)));
}

// Chains of the parts that may be nearest have the gap of the whole ones.
BOOST_AUTO_TEST_CASE(membranes_have_the_gap_of_their_chains) {
  const auto compare = [](const Vector &a, const Vector &b) {
    const Gap found = gap_between(basis, a, basis, b, chords);
    const Gap whole = gap_between(chain_of(basis, a, chords), chain_of(basis, b, chords));
    BOOST_TEST(std::abs(found.width - whole.width) < 1e-14);
    BOOST_TEST(std::hypot(found.x - whole.x, found.r - whole.r) < 1e-7);
  };
  const double rear = bowl().x[0];
  for (const double width : {1e-3, 0.03, 0.4, 3.0}) {
    compare(sphere_nodes(2, 0.8), sphere_nodes(1.2 - width - 0.5, 0.5));
    compare(bowl_nodes(), sphere_nodes(rear - width - 0.3, 0.3)); // nearest to the bottom, or to the rim
    compare(bowl_nodes(), sphere_nodes(-0.9 - width - 0.9, 0.9));
  }
}

BOOST_AUTO_TEST_SUITE_END()
