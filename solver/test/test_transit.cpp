// The numbers of a passage against those of a pulse that is known.
#include "observe/transit.hpp"
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <numbers>

using namespace capsule;

namespace {

Case between_mouths() {
  Case physics;
  physics.pore.shape = PoreShape::two_mouths;
  physics.pore.exit_x = 6;
  physics.output.resistance = true;
  return physics;
}

// x_g = sinh(t - 2) + 3, and a bell-shaped pulse.
std::vector<SeriesRow> bell(double from, double to) {
  std::vector<SeriesRow> series;
  const auto rows = std::lround((to - from) / row_spacing) + 1;
  for (long k = 0; k < rows; ++k) {
    const double x = from + static_cast<double>(k) * row_spacing;
    SeriesRow row;
    row.x_g = x;
    row.time = 2 + std::asinh(x - 3);
    row.v_g = std::cosh(row.time - 2);
    row.resistance = 1.5 * std::exp(-std::pow((row.time - 2) / 0.8, 2));
    series.push_back(row);
  }
  return series;
}

} // namespace

BOOST_AUTO_TEST_SUITE(transit)

BOOST_AUTO_TEST_CASE(bell_shaped_pulse) {
  Case physics = between_mouths();
  physics.output.transit_from = -0.52;
  const Transit found = transit_of(physics, bell(-2, 9)).value();
  BOOST_TEST(std::abs(found.time.length() - std::asinh(4) - std::asinh(3.52)) < 1e-8);
  BOOST_TEST(std::abs(found.pulse_height - 1.5) < 1e-6);
  BOOST_TEST(std::abs(found.pulse_width.length() - 2 * 0.8 * std::sqrt(std::numbers::ln2)) < 1e-5);
  const double edge = 0.8 * (std::sqrt(std::log(10)) - std::sqrt(-std::log(0.9)));
  BOOST_TEST(std::abs(found.pulse_rise.length() - edge) < 1e-5);
  BOOST_TEST(std::abs(found.pulse_fall.length() - edge) < 1e-5);
}

BOOST_AUTO_TEST_CASE(what_is_not_on_the_way_is_no_number) {
  Case physics = between_mouths();
  physics.output.resistance = false;
  BOOST_TEST(std::isnan(transit_of(physics, bell(-2, 9))->pulse_height));
  BOOST_TEST(remark_on_transit(physics, bell(-2, 9)) == "");
  const std::string no_time = remark_on_transit(physics, bell(-2, 6.5));
  BOOST_TEST(no_time == "no transit time: the way from x_g = -2 to 6.5 does not include that from -1 to 7");
  BOOST_TEST(std::isnan(transit_of(physics, bell(-0.5, 9))->time.length()));
  physics.pore.shape = PoreShape::hyperbolic;
  BOOST_TEST(!transit_of(physics, bell(-2, 9)).has_value());
  BOOST_TEST(remark_on_transit(physics, bell(-2, 3)) == "");
}

// The resistance of the bell is 1.5 at x_g = 3, half of it .67 of time and .72 of length away, a tenth 1.21 and 1.53.
BOOST_AUTO_TEST_CASE(a_pulse_that_the_march_cuts_is_no_pulse) {
  Case physics = between_mouths();
  physics.output.transit_from = 2.9;
  physics.output.transit_to = 3;
  const auto numbers = [&](double from, double to) {
    const Transit transit = transit_of(physics, bell(from, to)).value();
    std::string known;
    for (const TransitQuantity &quantity : transit_quantities())
      known += std::isfinite(quantity.of(transit)) ? '1' : '0';
    return known;
  };
  const auto remark = [&](double from, double to) { return remark_on_transit(physics, bell(from, to)); };
  // time, height, width, rise, fall
  BOOST_TEST(numbers(-2, 9) == "11111");
  BOOST_TEST(remark(-2, 9) == "");
  for (const double end : {3.0, 3.3, 3.7}) // while it rises, and when the largest was no end of the way
    BOOST_TEST(numbers(-2, end) == "10000");
  BOOST_TEST(
      remark(-2, 3.7).starts_with("no pulse_height, pulse_width, pulse_rise, pulse_fall: the march ends "
                                  "at x_g = 3.7 with 51 % of its largest resistance"));
  BOOST_TEST(numbers(-2, 4) == "11110");
  BOOST_TEST(remark(-2, 4) == "no pulse_fall: the march ends at x_g = 4 with 30 % of its largest resistance");
  BOOST_TEST(numbers(2.5, 9) == "10000");
  BOOST_TEST(numbers(2, 9) == "11101");
  BOOST_TEST(remark(2, 9) ==
             "no pulse_rise: the march begins at x_g = 2 with 30 % of its largest resistance");
  BOOST_TEST(remark(2.5, 3.7).find("begins at x_g = 2.5 with 70 % and ends at x_g = 3.7 with 5") !=
             std::string::npos);
}

BOOST_AUTO_TEST_SUITE_END()
