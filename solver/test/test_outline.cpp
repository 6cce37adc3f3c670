// Distances to the outline of a shape with a closed form, and of a silhouette.
#include "fit/outline.hpp"
#include "spheroid.hpp"
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <numbers>

using namespace capsule;
using std::numbers::pi;

BOOST_AUTO_TEST_SUITE(outline)

BOOST_AUTO_TEST_CASE(distances_to_a_sphere) {
  const MeridianBasis basis = spectral_basis(24);
  const Outline outline(dense_meridian(basis), sphere(basis, 0.3, 0.8), OutlineSeen::meridian);
  for (const double angle : {0.0, 0.001, 0.4, 1.1, 2.0, pi})
    for (const double away : {-0.2, -1e-3, 0.0, 1e-3, 0.3}) {
      const double x = 0.3 - (0.8 + away) * std::cos(angle), r = (0.8 + away) * std::sin(angle);
      const Foot foot = outline.foot(x, r);
      BOOST_TEST(std::abs(foot.distance - away) < 1e-8);
      BOOST_TEST(std::abs(foot.normal_x + std::cos(angle)) < 1e-5);
      BOOST_TEST(std::abs(foot.normal_r - std::sin(angle)) < 1e-5);
    }
  BOOST_TEST(std::abs(outline.front_x() - 1.1) < 1e-12);
  BOOST_TEST(std::abs(outline.rear_pole_x() + 0.5) < 1e-12);
}

// The distance's derivative along a motion of the shape is -n.dX: against differences.
BOOST_AUTO_TEST_CASE(slopes_are_limits_of_differences) {
  const MeridianBasis basis = spectral_basis(24);
  const DenseMeridian dense = dense_meridian(basis);
  const Vector position = spheroid(basis, 0, 0.9, 0.6);
  Vector change(48);
  change << (2 * basis.nodes.array()).cos(), 0.4 * basis.nodes.array().sin();
  const auto distance = [&](double step) {
    return Outline(dense, position + step * change, OutlineSeen::meridian).foot(0.5, 0.7).distance;
  };
  const double h = 1e-4, difference = (distance(h) - distance(-h)) / (2 * h);
  const Foot foot = Outline(dense, position, OutlineSeen::meridian).foot(0.5, 0.7);
  const auto moved = moved_at(dense.even[0] * change.head(24), dense.odd[0] * change.tail(24), foot.at);
  BOOST_TEST(std::abs(-foot.normal_x * moved(0, 0) - foot.normal_r * moved(1, 0) - difference) < 1e-4);
}

// x = -cos z + 0.9 (1 + cos z)^2/4 has its rear pole inside: the rim hides it, and its plane is the outline.
BOOST_AUTO_TEST_CASE(a_rim_hides_the_rear) {
  const MeridianBasis basis = spectral_basis(24);
  const DenseMeridian dense = dense_meridian(basis);
  Vector position(48);
  const auto cosine = basis.nodes.array().cos();
  position << -cosine + 0.9 * (1 + cosine).square() / 4, 0.8 * basis.nodes.array().sin();
  // dx/dcos = -1 + 0.45 (1 + cos) = 0 at cos = 11/9 > 1: no rim yet; twice the dent has one at cos = 1/9.
  position.head(24) = -cosine + 1.8 * (1 + cosine).square() / 4;
  const double rim = -1.0 / 9 + 0.45 * std::pow(10.0 / 9, 2), rim_r = 0.8 * std::sqrt(1 - 1.0 / 81);
  const Outline seen(dense, position, OutlineSeen::silhouette), whole(dense, position, OutlineSeen::meridian);
  const Foot hidden = seen.foot(rim - 0.02, 0.3);
  BOOST_TEST(std::abs(hidden.distance - 0.02) < 1e-7);
  BOOST_TEST(hidden.normal_x == -1);
  BOOST_TEST(std::abs(seen.foot(rim, 0.99 * rim_r).distance) < 1e-7);
  BOOST_TEST(std::abs(seen.rear_pole_x() - 0.8) < 1e-12);
  BOOST_TEST(std::abs(whole.foot(0.8, 0.0).distance) < 1e-10);
  const double angle = 2.5; // in front of the rim both are the same
  const double x = -std::cos(angle) + 1.8 * std::pow(1 + std::cos(angle), 2) / 4, r = 0.8 * std::sin(angle);
  BOOST_TEST(std::abs(seen.foot(x, r).distance) < 1e-8);
}

BOOST_AUTO_TEST_SUITE_END()
