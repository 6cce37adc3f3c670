// Estimates from made-up series whose differences, peaks and deformations are known.
#include "case/case.hpp"
#include "motion/error_estimate.hpp"
#include <boost/test/unit_test.hpp>
#include <cmath>

using namespace capsule;
using boost::test_tools::tolerance;

namespace {

using Series = std::vector<SeriesRow>;

// A pulse with its top between two rows: pressure drop 3 - 2 (x_g - 1.01)^2.
constexpr double top = 1.01;
Series pulse() {
  Series series;
  for (int k = 0; k <= 40; ++k) {
    SeriesRow row;
    row.x_g = row_spacing * k;
    row.time = row.x_g / 1.25;
    row.v_g = 1.25;
    row.pressure_drop = 3 - 2 * (row.x_g - top) * (row.x_g - top);
    series.push_back(row);
  }
  return series;
}

Series resistance_pulse() {
  Series series = pulse();
  for (SeriesRow &row : series)
    row.resistance = row.pressure_drop;
  return series;
}

Case transit_with_resistance() {
  Case physics;
  physics.pore.shape = PoreShape::two_mouths;
  physics.output.resistance = true;
  return physics;
}

// No row at the place of one of the other march.
Series at_other_places(Series series) {
  for (SeriesRow &row : series)
    row.x_g += 1e-5;
  return series;
}

} // namespace

BOOST_AUTO_TEST_SUITE(error_estimate)

// Rows at times of one march only have nothing to say, and the last part is a tenth of the time.
BOOST_AUTO_TEST_CASE(rows_at_the_same_time_are_compared) {
  Series fine, coarse;
  for (int k = 0; k <= 20; ++k) {
    SeriesRow row;
    row.time = 0.5 * k;
    row.v_g = std::sin(row.time);
    row.max_stretch = 1 + row.time;
    if (k % 5 != 3)
      fine.push_back(row);
    row.time += k % 2 == 0 ? 1e-10 : -1e-10;
    row.v_g += k % 5 == 3 ? 100 : 1e-3 * row.time;
    row.max_stretch += row.time < 8 ? 1e-2 : 1e-4;
    coarse.push_back(row);
    row.time += 0.1;
    row.v_g = 100;
    coarse.push_back(row);
  }
  coarse.resize(coarse.size() - 2); // it ends before
  const auto error = estimate_errors(fine, coarse, false, Scheme::bdf);
  BOOST_TEST(error.at("v_g@time") == 3 * 9.5e-3, tolerance(1e-6));
  BOOST_TEST(error.at("v_g") == 6 * 9.5e-3, tolerance(1e-6));
  BOOST_TEST(error.at("max_stretch@time") == 3e-2, tolerance(1e-6));
  BOOST_TEST(error.at("max_stretch") == 6e-4, tolerance(1e-6));
  BOOST_TEST(!error.contains("v_g@x_g"));
  BOOST_TEST(estimate_errors(fine, coarse, false, Scheme::euler).at("v_g") == 9 * error.at("v_g"),
             tolerance(1e-12));
}

// Who comes late is as far behind as it moves in that time.
BOOST_AUTO_TEST_CASE(rows_at_the_same_place_are_compared) {
  const Series fine = pulse();
  Series coarse = fine;
  for (SeriesRow &row : coarse)
    row.time += 1e-3 * row.x_g;
  const auto error = estimate_errors(fine, coarse, true, Scheme::bdf);
  BOOST_TEST(error.at("time") == 6 * 2e-3, tolerance(1e-9));
  BOOST_TEST(error.at("x_g@time") == 3 * 2e-3 * 1.25, tolerance(1e-9));
  BOOST_TEST(error.at("pressure_drop@x_g") == 0);
}

// A tilt s moves the top by s/4. The drop is compared half a radius to both sides of it.
BOOST_AUTO_TEST_CASE(a_tilt_moves_the_peak) {
  const Series fine = pulse();
  const double tilt = 1e-3;
  Series coarse = fine;
  for (SeriesRow &row : coarse)
    row.pressure_drop += tilt * (row.x_g - top);
  const auto error = estimate_errors(fine, coarse, true, Scheme::bdf);
  BOOST_TEST(error.at("x_g_at_peak") == 6 * tilt / 4, tolerance(1e-9));
  BOOST_TEST(error.at("peak_pressure_drop") > 6 * tilt * 0.4);
  BOOST_TEST(error.at("peak_pressure_drop") < 6 * tilt * 0.5);
}

// The peaks agree, by accident, in the three rows around them, and the slope beside them does not: it differs by s.
BOOST_AUTO_TEST_CASE(peaks_that_agree_by_accident_may_be_shifted) {
  const Series fine = pulse();
  const double slope = 1e-3;
  const auto shift = [&](std::size_t row) {
    Series coarse = fine;
    coarse.at(row).pressure_drop += slope * row_spacing;
    return estimate_errors(fine, coarse, true, Scheme::bdf).at("x_g_at_peak");
  };
  BOOST_TEST(shift(22) == 6 * slope / 4, tolerance(1e-9)); // at x_g = 1.1
  BOOST_TEST(shift(25) == 0);                              // too far away to say something about the peak
}

// As the peak's; a value that is still growing has its largest at the end of both marches.
BOOST_AUTO_TEST_CASE(largest_values_err_as_their_rows_do) {
  Series fine = pulse();
  for (SeriesRow &row : fine) {
    row.max_tension = row.pressure_drop;
    row.max_area_stretch = 1 + row.x_g;
  }
  const double tilt = 1e-3;
  Series coarse = fine;
  for (SeriesRow &row : coarse) {
    row.max_tension += tilt * (row.x_g - top);
    row.max_area_stretch += tilt * row.x_g;
  }
  const auto error = estimate_errors(fine, coarse, true, Scheme::bdf);
  BOOST_TEST(error.at("x_g_at_largest_tension") == 6 * tilt / 4, tolerance(1e-9));
  BOOST_TEST(error.at("largest_tension") > 6 * tilt * 0.4);
  BOOST_TEST(error.at("largest_tension") < 6 * tilt * 0.5);
  BOOST_TEST(error.at("largest_area_stretch") == 6 * tilt * 2, tolerance(1e-9));
  BOOST_TEST(error.at("x_g_at_largest_area_stretch") == 0);
}

// The tops of both pulses agree, rows beside them do not.
BOOST_AUTO_TEST_CASE(pulses_whose_tops_agree_by_accident) {
  Case physics = transit_with_resistance();
  physics.until.x_g = 2;
  const Series fine = resistance_pulse();
  Series coarse = fine;
  for (SeriesRow &row : coarse)
    if (std::abs(row.x_g - top) > 0.2)
      row.resistance += 1e-3 * std::abs(row.x_g - top);
  std::map<std::string, double> error;
  add_errors_of_transit(physics, fine, coarse, error);
  BOOST_TEST(error.at("transit_pulse_height") > 6 * 1e-3 * 0.4);
  BOOST_TEST(error.at("transit_pulse_height") < 6 * 1e-3 * 0.5);
}

// One march is as late at the end of its transit as at the beginning: the errors of both count.
BOOST_AUTO_TEST_CASE(delays_do_not_cancel_in_the_time_of_a_transit) {
  Case physics;
  physics.pore.shape = PoreShape::two_mouths;
  physics.output.transit_from = 0.5;
  physics.output.transit_to = 1.5;
  const Series fine = pulse();
  Series coarse = fine;
  for (SeriesRow &row : coarse)
    row.time += 1e-3;
  std::map<std::string, double> error;
  add_errors_of_transit(physics, fine, coarse, error);
  BOOST_TEST(error.at("transit_time") == 6 * 2e-3, tolerance(1e-9));
}

// Two marches that burst before they come to a common place.
BOOST_AUTO_TEST_CASE(without_rows_at_the_same_place_there_are_no_estimates) {
  const Series fine = pulse();
  BOOST_TEST(estimate_errors(fine, at_other_places(fine), true, Scheme::bdf).empty());
}

// Tops without rows around them say nothing; the times of a transit are the marches' own.
BOOST_AUTO_TEST_CASE(a_pulse_without_rows_at_the_same_place_has_no_estimate) {
  Case physics = transit_with_resistance();
  physics.output.transit_from = 0.5;
  physics.output.transit_to = 1.5;
  const Series fine = resistance_pulse();
  std::map<std::string, double> error;
  add_errors_of_transit(physics, fine, at_other_places(fine), error);
  BOOST_TEST(!error.contains("transit_pulse_height"));
  BOOST_TEST(error.contains("transit_time"));
}

// Length and diameter err by the same share: the deformation agrees, but their errors are what it is made of.
BOOST_AUTO_TEST_CASE(errors_of_length_and_diameter_do_not_cancel_in_the_deformation) {
  const auto deformation = [](double length, double diameter) {
    return (length - diameter) / (length + diameter);
  };
  const double length = 1.8, diameter = 1.2, share = 1e-6;
  Series fine = pulse(), coarse = fine;
  for (std::size_t k = 0; k < fine.size(); ++k) {
    fine[k].length = length;
    coarse[k].length = length * (1 + share);
    fine[k].deformation = coarse[k].deformation = deformation(length, diameter);
  }
  const double apart = std::abs(deformation(length * (1 + share), diameter) - deformation(length, diameter)) +
                       std::abs(deformation(length, diameter * (1 + share)) - deformation(length, diameter));
  const auto error = estimate_errors(fine, coarse, true, Scheme::bdf);
  BOOST_TEST(error.at("deformation@x_g") == 3 * apart, tolerance(1e-5));
  BOOST_TEST(error.at("deformation") == 6 * apart, tolerance(1e-5));
}

BOOST_AUTO_TEST_SUITE_END()
