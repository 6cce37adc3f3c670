// The fit of the empty pore's pressure drop against the boundary integrals, other programs and exact flows.
#include "case/empty_pore.hpp"
#include "flow/wall.hpp"
#include "geometry/pore.hpp"
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <numbers>

using namespace capsule;

BOOST_AUTO_TEST_SUITE(empty_pore)

// Angles between those of the fit. The reservoir's end at 300 radii costs up to 1e-6 where the mouth is narrow, and a sharp
// lip takes shorter panels.
BOOST_AUTO_TEST_CASE(as_the_walls_say) {
  for (const double degrees : {25.0, 60.0, 84.0, 90.0})
    for (const PoreShape shape : {PoreShape::hyperbolic, PoreShape::two_mouths}) {
      const PoreSpec spec{
          .shape = shape, .opening_angle_deg = degrees, .exit_x = 4, .entrance_distance = 300};
      const Wall wall(make_pore(spec).value(), {.lip_panel = degrees == 90 ? 2e-3 : 0.08});
      BOOST_TEST(std::abs(empty_pressure_drop(spec, spec.exit_x) / wall.base_pressure_drop() - 1) < 2e-6,
                 degrees);
    }
}

// Mouths begin to feel each other below two radii.
BOOST_AUTO_TEST_CASE(down_to_two_radii) {
  const PoreSpec spec{.shape = PoreShape::two_mouths, .exit_x = 2, .entrance_distance = 60};
  const Wall wall(make_pore(spec).value(), {});
  BOOST_TEST(std::abs(empty_pressure_drop(spec, 2) / wall.base_pressure_drop() - 1) < 1e-6);
}

// scenes.md: by another program, to 1e-5; Dagan, Weinbaum and Pfeffer (1982): 3 pi + 8 L within 1 %. Narrow mouths are
// cones of the same flow on either side of the throat.
BOOST_AUTO_TEST_CASE(what_others_found) {
  BOOST_TEST(std::abs(mouth_loss(78.5) - 4.924572) < 1e-5);
  const PoreSpec square{.shape = PoreShape::two_mouths, .opening_angle_deg = 90};
  BOOST_TEST(std::abs(empty_pressure_drop(square, 2) / (3 * std::numbers::pi + 8 * 2) - 1) < 0.01);
  BOOST_TEST(half_hyperboloid_loss(90) == 1.5 * std::numbers::pi, boost::test_tools::tolerance(1e-12));
  BOOST_TEST(std::abs(mouth_loss(5) / half_hyperboloid_loss(5) - 1) < 1e-6);
  BOOST_TEST(mouth_loss(1e-4) == 2 * 180 / 1e-4, boost::test_tools::tolerance(1e-6)); // 2 pi/alpha
}

BOOST_AUTO_TEST_SUITE_END()
