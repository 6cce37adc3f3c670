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
  const Transit ends_early = transit_of(physics, bell(-2, 3.3)).value();
  BOOST_TEST(std::isnan(ends_early.time.length()));
  BOOST_TEST(std::isnan(ends_early.pulse_fall.length()));
  BOOST_TEST(!std::isnan(ends_early.pulse_rise.length()));
  physics.output.resistance = false;
  BOOST_TEST(std::isnan(transit_of(physics, bell(-2, 9))->pulse_height));
  physics.pore.shape = PoreShape::hyperbolic;
  BOOST_TEST(!transit_of(physics, bell(-2, 9)).has_value());
}

BOOST_AUTO_TEST_SUITE_END()
