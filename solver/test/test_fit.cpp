// Fits of outlines whose capsule is known, and the slopes that they use.
#include "base/failure.hpp"
#include "case/case.hpp"
#include "case/key_path.hpp"
#include "fit/fit.hpp"
#include "law/neo_hookean.hpp"
#include "law/skalak.hpp"
#include "motion/march.hpp"
#include "steady/steady_state.hpp"
#include <array>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <numbers>

using namespace capsule;

namespace {

constexpr const char *flow_key = "flow.capillary_number";

Case inflated_case() {
  Case input;
  input.membrane.law = neo_hookean;
  input.membrane.bending_ratio = 1e-3;
  input.capsule.radius = 0.85;
  input.capsule.inflation = 0.02;
  input.flow.capillary_number = 0.06;
  input.accuracy = 1e-3;
  return input;
}

const SteadyState &inflated_state() {
  static const SteadyState state = find_steady(inflated_case(), {}, {});
  return state;
}

// Without noise, at another place on the axis.
Contour outline_of(const SteadyState &state) {
  const Eigen::Index n = state.system->nodes();
  const MeridianBasis &basis = state.system->membrane().basis;
  const Vector zeta = Vector::LinSpaced(301, 0, std::numbers::pi);
  Contour contour;
  contour.x = basis.even(zeta, 0, state.unknowns.head(n)).array() + 4.2;
  contour.r = basis.odd(zeta, 0, state.unknowns.segment(n, n)).cwiseAbs();
  return contour;
}

double value_of(const FitResult &fit, const std::string &name) {
  const auto found = std::ranges::find(fit.values, name, &FittedValue::name);
  BOOST_REQUIRE(found != fit.values.end());
  return found->value;
}

} // namespace

BOOST_AUTO_TEST_SUITE(fits)

// All rows, of two contours at different flow rates with velocities, against differences.
BOOST_AUTO_TEST_CASE(slopes_of_residuals) {
  const Case input = inflated_case();
  const SteadyState &state = inflated_state();
  std::array contours{outline_of(state), outline_of(state)};
  contours[0].x.array() += 0.01; // off the outline
  contours[1].r *= 0.97;
  contours[0].rear_pole_x = 3.6;
  contours[0].flow_rate = 1;
  contours[1].flow_rate = 1.2;
  contours[0].velocity = contours[1].velocity = 1.2;
  FittedStates states(input, {"capsule.radius", flow_key, "capsule.inflation"}, contours);
  const Vector start = states.begin_with(state);
  BOOST_TEST_REQUIRE(start.size() == 5);
  const Residuals here = states.evaluate(start);
  BOOST_TEST(here.values.size() == 605);
  for (Eigen::Index j = 0; j < start.size(); ++j) {
    const auto at = [&](double step) -> Vector {
      return states.evaluate(start + step * Vector::Unit(start.size(), j)).values;
    };
    constexpr double h = 1e-3;
    const Vector difference = (8 * (at(h) - at(-h)) - (at(2 * h) - at(-2 * h))) / (12 * h);
    BOOST_TEST((difference - here.slopes.col(j)).cwiseAbs().maxCoeff() <
                   2e-4 * difference.cwiseAbs().maxCoeff(),
               states.names()[static_cast<std::size_t>(j)]);
  }
}

// A march is another way to the same shape: what has come to rest in the tube is recovered to 1e-5 and better.
BOOST_AUTO_TEST_CASE(the_capsule_of_a_march_is_found) {
  Case input = inflated_case();
  input.accuracy = 1e-5;
  input.capsule.start_x = 0;
  input.pore.shape = PoreShape::tube;
  input.pore.exit_x = 15;
  input.pore.entrance_distance = 6;
  input.until.x_g = 10;
  const Outcome marched = march_once(input, {}, {}, Role::main);
  BOOST_REQUIRE_MESSAGE(marched.status == Status::reached, marched.message);
  const Profile &last = marched.last.profiles.back();
  Contour contour;
  contour.x = last.x;
  contour.r = last.r.cwiseAbs();
  Case unknown = inflated_case();
  unknown.capsule.radius = unknown.flow.capillary_number = unknown.capsule.inflation = 0;
  unknown.fit.unknowns = {"capsule.radius", flow_key, "capsule.inflation"};
  FitStarts starts;
  const FitResult fit = fit_contours(unknown, std::span(&contour, 1), starts, {});
  BOOST_TEST(std::abs(value_of(fit, "capsule.radius") - 0.85) < 1e-5);
  BOOST_TEST(std::abs(value_of(fit, flow_key) - 0.06) < 1e-5 * 0.06 * 10);
  BOOST_TEST(std::abs(value_of(fit, "capsule.inflation") - 0.02) < 1e-5);
  // The state that is written is that of these values, whatever was tried for the intervals.
  for (const char *key : {"capsule.radius", flow_key, "capsule.inflation"})
    BOOST_TEST(std::abs(number(key, fit.contours[0].state.system->input()) - value_of(fit, key)) < 1e-10);
}

// In physical units: with the flow rate the modulus follows from eps, with the velocity from eps V.
BOOST_AUTO_TEST_CASE(the_modulus_follows_from_flow_rate_or_velocity) {
  const Case input = inflated_case();
  const SteadyState &state = inflated_state();
  Contour contour = outline_of(state);
  Case unknown = input;
  unknown.fit.unknowns = {"capsule.radius", flow_key};
  unknown.physical.tube_radius.si = 5e-5;
  unknown.physical.viscosity.si = 1e-3;
  const double speed = 4e-3; // Q/(pi R_t^2)
  const double modulus = 1e-3 * speed / 0.06;
  unknown.physical.flow_rate.si = speed * std::numbers::pi * 25e-10;
  for (const bool by_velocity : {false, true}) {
    if (by_velocity) {
      unknown.physical.flow_rate.si = 0;
      contour.velocity = speed * state.unknowns[2 * state.system->nodes()];
    }
    FitStarts starts;
    const FitResult fit = fit_contours(unknown, std::span(&contour, 1), starts, {});
    BOOST_TEST(std::abs(value_of(fit, "physical.shear_modulus") / modulus - 1) < 1e-5);
    BOOST_TEST(std::abs(value_of(fit, "physical.capsule_radius") / (0.85 * 5e-5) - 1) < 1e-6);
  }
}

// Residual, noise and points are of the same mesh: an outline without noise is followed far below the first mesh's error.
BOOST_AUTO_TEST_CASE(the_residual_is_that_of_the_points) {
  const Contour contour = outline_of(inflated_state());
  Case unknown = inflated_case();
  unknown.fit.unknowns = {"capsule.radius", flow_key};
  FitStarts starts;
  const FitResult fit = fit_contours(unknown, std::span(&contour, 1), starts, {});
  double sum = 0;
  for (const Foot &foot : fit.contours[0].feet)
    sum += foot.distance * foot.distance;
  const auto points = static_cast<double>(fit.contours[0].feet.size());
  const double residual = std::sqrt(sum / points);
  BOOST_TEST(residual < 1e-6);
  BOOST_TEST(std::abs(fit.residual - residual) < 0.01 * residual);
  BOOST_TEST(fit.candidates[0].residual == fit.residual);
  const auto free = static_cast<double>(fit.degrees_of_freedom);
  BOOST_TEST(std::abs(fit.noise - fit.residual * std::sqrt(points / free)) < 0.01 * fit.noise);
  BOOST_TEST(std::abs(fit.chi_squared - free) < 0.01 * free);
}

// Weak flows are not cut off.
BOOST_AUTO_TEST_CASE(a_small_capillary_number_is_found) {
  Case input = inflated_case();
  input.flow.capillary_number = 5e-5;
  const Contour contour = outline_of(find_steady(input, {}, {}));
  input.fit.unknowns = {"capsule.radius", flow_key};
  FitStarts starts;
  const FitResult fit = fit_contours(input, std::span(&contour, 1), starts, {});
  BOOST_TEST(std::abs(value_of(fit, flow_key) / 5e-5 - 1) < 1e-3);
  BOOST_TEST(fit.warnings.empty());
}

// Two laws: the right one has the evidence, and starts that were left shorten the way to the same place.
BOOST_AUTO_TEST_CASE(laws_are_ranked) {
  const Contour contour = outline_of(inflated_state());
  Case unknown = inflated_case();
  unknown.membrane.law = {skalak, {1}};
  unknown.fit.unknowns = {"capsule.radius", flow_key, "membrane.dilatation"};
  unknown.fit.laws = {"skalak", "neo-hookean"};
  unknown.fit.noise = 1e-3;
  FitStarts starts;
  const FitResult fit = fit_contours(unknown, std::span(&contour, 1), starts, {});
  BOOST_TEST(fit.law == "neo-hookean");
  BOOST_TEST_REQUIRE(fit.candidates.size() == 2);
  BOOST_TEST(fit.candidates[1].evidence_ratio < 0.1);
  BOOST_TEST(fit.candidates[0].names.size() == 3); // radius, flow, place: no dilatation
  const FitResult again = fit_contours(unknown, std::span(&contour, 1), starts, {});
  BOOST_TEST(std::abs(value_of(again, flow_key) / value_of(fit, flow_key) - 1) < 1e-5);
}

BOOST_AUTO_TEST_SUITE_END()
