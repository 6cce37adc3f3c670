// Distances between spheres, and between a sphere and the hollow rear that it stands in.
#include "geometry/gap.hpp"
#include <boost/test/unit_test.hpp>
#include <cmath>

using namespace capsule;

namespace {

const MeridianBasis basis = spectral_basis(32);

Chain sphere(double centre, double radius) {
  Vector position(64);
  position << centre - radius * basis.nodes.array().cos(), radius * basis.nodes.array().sin();
  return chain_of(basis, position, 16);
}

// A bowl that opens upstream: its rim lies at x = -0.81, the bottom of its hollow at 0.5.
Chain bowl() {
  Vector position(64);
  const auto zeta = basis.nodes.array();
  position << 0.8 * (2 * zeta).cos() - 0.3 * zeta.cos(), zeta.sin();
  return chain_of(basis, position, 16);
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

BOOST_AUTO_TEST_SUITE_END()
