// The wall against eq. 1 itself, closed forms and finite differences.
#include "base/failure.hpp"
#include "geometry/pore.hpp"
#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <numbers>

using namespace capsule;

namespace {

Pore pore_of_angle(double degrees) {
  return make_pore({.opening_angle_deg = degrees}).value();
}

} // namespace

BOOST_AUTO_TEST_CASE(wall_satisfies_equation_1) {
  for (double degrees : {10.0, 45.0, 78.5, 89.0, 89.99}) {
    const Pore pore = pore_of_angle(degrees);
    const double tangent = std::tan(degrees * std::numbers::pi / 180);
    for (int i = 0; i <= 200; ++i) {
      const WallPoint p = wall_point(pore, pore.entrance_arc * i / 200);
      if (p.x <= 0)
        BOOST_CHECK_SMALL((p.r * p.r - p.x * p.x * tangent * tangent - 1) / (p.r * p.r), 1e-12);
      else
        BOOST_CHECK_EQUAL(p.r, 1);
      BOOST_CHECK_CLOSE(wall_radius(pore, p.x), p.r, 1e-10);
    }
    const WallPoint end = wall_point(pore, pore.entrance_arc);
    BOOST_CHECK_CLOSE(std::hypot(end.x, end.r), 30, 1e-11);
  }
}

BOOST_AUTO_TEST_CASE(parameter_is_arc_length_and_normals_are_normal) {
  for (double degrees : {30.0, 78.5, 89.0}) {
    const Pore pore = pore_of_angle(degrees);
    for (double arc : {1.0, 14.0, 15.002, 15.02, 15.1, 15.7, 17.0, 25.0, 40.0}) {
      const double step = 1e-4;
      const WallPoint a = wall_point(pore, arc - step), b = wall_point(pore, arc + step),
                      p = wall_point(pore, arc);
      const double dx = (b.x - a.x) / (2 * step), dr = (b.r - a.r) / (2 * step);
      const double tolerance = arc > 15.5 || arc < 15 ? 1e-8 : 1e-2; // the lip of 89 degrees has radius 3e-4
      BOOST_CHECK_SMALL(std::hypot(dx, dr) - 1, tolerance);
      BOOST_CHECK_SMALL(dx * p.normal_x + dr * p.normal_r, tolerance);
      BOOST_CHECK_SMALL(std::hypot(p.normal_x, p.normal_r) - 1, 1e-14);
      BOOST_CHECK(p.normal_r > 0);
      BOOST_CHECK(p.normal_x >= 0);
      if (p.x < 0)
        BOOST_CHECK_CLOSE(wall_slope(pore, p.x), -p.normal_x / p.normal_r, 1e-8);
    }
  }
}

// alpha = 45: arc length of the rectangular hyperbola r^2 - x^2 = 1 from the lip to x = -1, integral of
// sqrt((1 + 2 x^2)/(1 + x^2)) over [0, 1]: midpoint sums extrapolated.
BOOST_AUTO_TEST_CASE(arc_of_rectangular_hyperbola) {
  const auto midpoint = [](int n) {
    double sum = 0;
    for (int i = 0; i < n; ++i) {
      const double x = (i + 0.5) / n;
      sum += std::sqrt((1 + 2 * x * x) / (1 + x * x)) / n;
    }
    return sum;
  };
  const double arc = (4 * midpoint(4000) - midpoint(2000)) / 3;
  BOOST_CHECK_CLOSE(wall_point(pore_of_angle(45), 15 + arc).x, -1, 1e-10);
}

BOOST_AUTO_TEST_CASE(curvature_of_the_lip) {
  const Pore pore = pore_of_angle(78.5);
  const double tangent = std::tan(78.5 * std::numbers::pi / 180), step = 1e-6;
  const double turn = std::asin(wall_point(pore, 15 + step).normal_x);
  BOOST_CHECK_CLOSE(turn / step, tangent * tangent, 1e-2);
  BOOST_CHECK_EQUAL(wall_point(pore, 15).normal_x, 0);
}

BOOST_AUTO_TEST_CASE(right_angled_mouth) {
  const Pore pore = pore_of_angle(90), near = pore_of_angle(89.9999);
  BOOST_CHECK_EQUAL(pore.entrance_arc, 15 + 29);
  for (double arc : {3.0, 16.0, 20.0, 43.0}) {
    const WallPoint p = wall_point(pore, arc), q = wall_point(near, arc);
    BOOST_CHECK_SMALL(std::hypot(p.x - q.x, p.r - q.r), 1e-4);
    BOOST_CHECK_SMALL(std::hypot(p.normal_x - q.normal_x, p.normal_r - q.normal_r), 1e-4);
  }
  BOOST_CHECK(std::isinf(wall_radius(pore, -0.1)));
  BOOST_CHECK_EQUAL(wall_radius(pore, 0.1), 1);
  BOOST_CHECK_CLOSE(wall_distance(pore, -3, 0.5), std::hypot(3, 0.5), 1e-12);
  BOOST_CHECK_EQUAL(wall_distance(pore, -3, 2), 3);
}

// Against the smallest distance to many points of the wall.
BOOST_AUTO_TEST_CASE(distance_to_the_wall) {
  for (double degrees : {30.0, 78.5, 89.0}) {
    const Pore pore = pore_of_angle(degrees);
    for (double x : {-5.0, -0.2, -0.01, 0.3, 7.0})
      for (double share : {0.0, 0.5, 0.9, 0.999}) {
        const double r = share * std::min(wall_radius(pore, x), 8.0);
        const auto squared = [&](double arc) {
          const WallPoint p = wall_point(pore, arc);
          return (p.x - x) * (p.x - x) + (p.r - r) * (p.r - r);
        };
        double best = 15, least = squared(best),
               width = 12; // coarse scan, then ever finer ones around the best arc
        for (int pass = 0; pass < 10; ++pass, width *= 0.15) {
          const double centre = best;
          for (int i = -12; i <= 12; ++i) {
            const double arc = std::clamp(centre + width * i / 12, 0.0, pore.entrance_arc);
            if (const double here = squared(arc); here < least) {
              best = arc;
              least = here;
            }
          }
        }
        BOOST_CHECK_SMALL(wall_distance(pore, x, r) - std::sqrt(least), 1e-8);
      }
    BOOST_CHECK(wall_distance(pore, -0.5, 1.1 * wall_radius(pore, -0.5)) < 0);
    BOOST_CHECK_CLOSE(wall_distance(pore, 2, 1.25), -0.25, 1e-12);
  }
}

BOOST_AUTO_TEST_CASE(second_mouth_is_the_first_s_mirror_image) {
  const Pore pore = make_pore({.shape = PoreShape::two_mouths, .exit_x = 6}).value();
  BOOST_TEST(std::abs(pore.exit_arc + pore.entrance_arc - 6) < 1e-12);
  for (const double arc : {pore.exit_arc, -3.0, -0.1, 2.0, 3.0}) {
    const WallPoint point = wall_point(pore, arc), image = wall_point(pore, 6 - arc);
    BOOST_TEST(std::abs(point.x + image.x - 6) < 1e-12);
    BOOST_TEST(std::abs(point.r - image.r) < 1e-12);
    BOOST_TEST(std::abs(point.normal_x + image.normal_x) < 1e-12);
    BOOST_TEST(std::abs(point.normal_r - image.normal_r) < 1e-12);
    BOOST_TEST(std::abs(wall_radius(pore, point.x) - point.r) < 1e-10 * point.r);
  }
  for (const double x : {-2.0, -0.2, 1.0}) {
    BOOST_TEST(std::abs(wall_distance(pore, 6 - x, 0.7) - wall_distance(pore, x, 0.7)) < 1e-14);
    BOOST_TEST(std::abs(wall_slope(pore, 6 - x) + wall_slope(pore, x)) < 1e-13);
  }
}

BOOST_AUTO_TEST_CASE(straight_tube_and_bad_input) {
  PoreSpec spec;
  spec.shape = PoreShape::tube;
  const Pore tube = make_pore(spec).value();
  BOOST_CHECK_EQUAL(wall_point(tube, tube.entrance_arc).x, -30);
  BOOST_CHECK_EQUAL(wall_radius(tube, -10), 1);
  BOOST_CHECK_EQUAL(wall_distance(tube, -10, 0.75), 0.25);
  spec.shape = PoreShape::none;
  BOOST_CHECK(!make_pore(spec));
  spec.shape = PoreShape::hyperbolic;
  spec.opening_angle_deg = 91;
  BOOST_CHECK_THROW(make_pore(spec), InputError);
  spec.opening_angle_deg = 78.5;
  spec.entrance_distance = 0.5;
  BOOST_CHECK_THROW(make_pore(spec), InputError);
}
