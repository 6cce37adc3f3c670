// Numbers behind keys, and their way from one value to another.
#include "case/key_path.hpp"
#include "case/keys.hpp"
#include "law/skalak.hpp"
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <numbers>

using namespace capsule;

namespace {

Case some_case() {
  Case input;
  input.capsule.radius = 0.8;
  input.membrane.bending_ratio = 1e-2;
  input.membrane.law = {skalak, {-0.25}};
  input.mesh.membrane = 48;
  return input;
}

} // namespace

BOOST_AUTO_TEST_SUITE(key_path)

BOOST_AUTO_TEST_CASE(numbers_and_what_is_none) {
  Case input = some_case();
  BOOST_TEST(number(*find_key("capsule.radius"), input).value() == 0.8);
  BOOST_TEST(number(*find_key("mesh.membrane"), input).value() == 48);
  BOOST_TEST(!number(*find_key("membrane.law"), input).has_value());
  BOOST_TEST(!number(*find_key("physical.viscosity"), input).has_value());
  BOOST_TEST(!number(*find_key("output.profiles_at_time"), input).has_value());
  BOOST_TEST(!number(*find_key("until.time"), input).has_value());
  input.until.time = 3;
  BOOST_TEST(number(*find_key("until.time"), input).value() == 3);
}

// Both ends are exact, and nothing but the key changes.
BOOST_AUTO_TEST_CASE(from_one_value_to_another) {
  const Case input = some_case();
  for (const double to : {1e-2, 3e-7, 0.0, 5.0}) {
    const KeyPath path("membrane.bending_ratio", input, to);
    BOOST_TEST(path.needed() == (to != 1e-2));
    BOOST_TEST(path.at(0).membrane.bending_ratio == 1e-2);
    BOOST_TEST(path.at(1).membrane.bending_ratio == to);
    double before = path.value(0);
    for (const double part : {0.2, 0.4, 0.6, 0.8, 1.0}) {
      BOOST_TEST((path.value(part) - before) * (to - 1e-2) >= 0);
      if (path.needed())
        BOOST_TEST(std::abs(path.part(path.value(part)) - part) < 1e-14);
      before = path.value(part);
    }
    Case there = path.at(0.3);
    BOOST_TEST(there.capsule.radius == 0.8);
    BOOST_TEST(there.membrane.law.values()[0] == -0.25);
  }
  BOOST_TEST(KeyPath("capsule.radius", input, 0.5).text(1) == "capsule.radius = 0.5");
  Case physical = input;
  physical.flow.capillary_number = 0.05;
  physical.physical.flow_rate = {1e-11, "10 nl/s"};
  physical.physical.tube_radius = {1e-5};
  physical.physical.viscosity = {1e-3};
  physical.physical.shear_modulus = {1e-11 * 1e-3 / (0.05 * std::numbers::pi * 1e-10)};
  BOOST_TEST(KeyPath(flow_key, physical, 0.1).text(1) == "flow.capillary_number = 0.1 (20 nl/s)");
  BOOST_TEST(KeyPath(flow_key, physical, 0.1).fold_text(1) ==
             "flow.capillary_number = 0.1 (20 nl/s), the critical flow rate");
  BOOST_TEST(KeyPath(flow_key, some_case(), 0.1).fold_text(1) ==
             "flow.capillary_number = 0.1, the critical capillary number");
  Case faster = some_case();
  faster.flow.capillary_number = 0.2;
  BOOST_TEST(KeyPath(flow_key, faster, 0.1).fold_text(1) ==
             "flow.capillary_number = 0.1"); // in a weaker flow
  BOOST_TEST(KeyPath("capsule.radius", some_case(), 0.7).fold_text(1) == "capsule.radius = 0.7");
  // With its error, and as many digits as that leaves.
  BOOST_TEST(KeyPath(flow_key, physical, 0.123456789).fold_text(1, 2e-8) ==
             "flow.capillary_number = 0.12345679 +- 2e-08 (24.69 nl/s), the critical flow rate");
  BOOST_TEST(KeyPath("capsule.radius", some_case(), 0.7).fold_text(1, 0) == "capsule.radius = 0.7 +- 0");
}

// Between positive values the eighth root is a straight line; with a negative end the value is one.
BOOST_AUTO_TEST_CASE(steps_suit_any_magnitude) {
  const Case input = some_case();
  const KeyPath small("membrane.bending_ratio", input, 1e-10);
  const double middle = (std::pow(1e-2, 0.125) + std::pow(1e-10, 0.125)) / 2;
  BOOST_TEST(std::abs(small.value(0.5) / std::pow(middle, 8) - 1) < 1e-12);
  const KeyPath through_zero("membrane.dilatation", input, 1);
  BOOST_TEST(std::abs(through_zero.value(0.2)) < 1e-15);
  BOOST_TEST(std::abs(through_zero.value(2) - 2.25) < 1e-15);
}

BOOST_AUTO_TEST_CASE(slope_is_the_derivative_of_the_value) {
  const Case input = some_case();
  constexpr double h = 1e-4;
  for (const KeyPath &path : {KeyPath("membrane.bending_ratio", input, 1e-5),
                              KeyPath("membrane.dilatation", input, 1), KeyPath("capsule.radius", input, 1)})
    for (const double part : {0.0, 0.4, 1.0}) {
      const double difference = (path.value(part + h) - path.value(part - h)) / (2 * h);
      BOOST_TEST(std::abs(path.slope(part) - difference) < 1e-5 * std::abs(difference));
    }
}

BOOST_AUTO_TEST_SUITE_END()
