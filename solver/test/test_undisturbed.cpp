// The flows in closed form obey Stokes' equations and carry the unit flow rate.
#include "flow/undisturbed.hpp"
#include <boost/test/unit_test.hpp>
#include <numbers>

using namespace capsule;

BOOST_AUTO_TEST_SUITE(undisturbed)

BOOST_AUTO_TEST_CASE(poiseuille_s_flow) {
  const GaussRule rule = gauss_legendre(8);
  const Vector r = 0.5 * (1 + rule.nodes.array());
  const Vector velocity = poiseuille_flow({Vector::Constant(8, 3), r});
  // The flow rate is pi, and no liquid moves at the wall or sideways.
  BOOST_TEST(std::abs(std::numbers::pi * rule.weights.dot(velocity.head(8).cwiseProduct(r)) -
                      std::numbers::pi) < 1e-12);
  BOOST_TEST(poiseuille_velocity(1) == 0);
  BOOST_TEST(velocity.tail(8).norm() == 0);
  // Shear is the velocity's slope, and the pressure on a section holds against the shear on its edge.
  const double h = 1e-4;
  BOOST_TEST(std::abs((poiseuille_velocity(0.6 + h) - poiseuille_velocity(0.6 - h)) / (2 * h) -
                      poiseuille_shear(0.6)) < 1e-9);
  BOOST_TEST(std::abs(poiseuille_pressure_drop(3) * 0.6 * 0.6 + 2 * 0.6 * 3 * poiseuille_shear(0.6)) < 1e-12);
}

// Nothing flows out of a closed surface: out of a cylinder's side what comes in through its ends.
BOOST_AUTO_TEST_CASE(extension_conserves_volume) {
  const Vector velocity = extensional_flow({Vector{{-0.7, 0.7, 0.1}}, Vector{{0.2, 0.1, 0.5}}});
  const double ends = (velocity[1] - velocity[0]) * 0.5 * 0.5; // over pi
  const double side = velocity[5] * 2 * 0.5 * 1.4;
  BOOST_TEST(std::abs(ends + side) < 1e-15);
  BOOST_TEST(ends > 0.1);
  BOOST_TEST(liquid_at_rest({Vector::Ones(2), Vector::Ones(2)}).norm() == 0);
}

BOOST_AUTO_TEST_SUITE_END()
