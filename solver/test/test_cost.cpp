// What a run is expected to cost: in proportion to its duration, its steps and their stages.
#include "case/case.hpp"
#include "scene/cost.hpp"
#include <boost/test/unit_test.hpp>

using namespace capsule;
namespace tt = boost::test_tools;

BOOST_AUTO_TEST_SUITE(cost)

BOOST_AUTO_TEST_CASE(costs_grow_with_what_there_is_to_do) {
  Case physics;
  physics.capsule.radius = 0.8;
  physics.until.time = 5;
  const double standard = estimated_seconds(physics);
  BOOST_TEST(standard > 0);
  physics.until.time = 10;
  BOOST_TEST(estimated_seconds(physics) == 2 * standard, tt::tolerance(1e-12));
  physics.until = {};
  physics.until.last_x_g = 2;
  physics.followers = {physics};
  physics.followers[0].capsule.start_x = -6;
  const double of_two = estimated_seconds(physics);
  physics.until = {};
  physics.until.x_g = physics.capsule.start_x + 8; // as long a way
  BOOST_TEST(estimated_seconds(physics) == of_two, tt::tolerance(1e-12));
  physics.followers.clear();
  const double of_one = estimated_seconds(physics);
  BOOST_TEST(of_two > 2 * of_one);
  BOOST_TEST(of_two < 2.5 * of_one);
  physics.followers.resize(3); // the study several-capsules: 5.9 times one
  BOOST_TEST(estimated_seconds(physics) == 5.9 * of_one, tt::tolerance(0.05));
  physics.followers.clear();
  physics.until = {};
  physics.until.time = 10;
  physics.accuracy = 1e-5;
  BOOST_TEST(estimated_seconds(physics) > 2 * standard);
  physics.time = {.scheme = Scheme::euler, .step = 1e-3};
  const double euler = estimated_seconds(physics);
  physics.time.step = 5e-4;
  BOOST_TEST(estimated_seconds(physics) == 2 * euler, tt::tolerance(1e-12));
  physics.time.scheme = Scheme::rk4;
  BOOST_TEST(estimated_seconds(physics) == 8 * euler, tt::tolerance(1e-12));
}

BOOST_AUTO_TEST_SUITE_END()
