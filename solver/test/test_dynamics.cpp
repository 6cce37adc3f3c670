// The equations of motion: both presets move the same capsule alike, and what is no capsule in the pore is said to be none.
#include "base/failure.hpp"
#include "motion/dynamics.hpp"
#include "observe/gauge.hpp"
#include <boost/test/unit_test.hpp>
#include <cmath>

using namespace capsule;

namespace {

Case mouth_case() {
  Case physics;
  physics.capsule.radius = 0.8;
  physics.capsule.start_x = 0.3;
  physics.membrane.bending_ratio = 1e-2;
  physics.flow.capillary_number = 0.1;
  physics.accuracy = 1e-3;
  return physics;
}

std::string failure_of(const Dynamics &dynamics, const std::function<void(Vector &)> &change) {
  Vector position = dynamics.scene->start;
  change(position);
  try {
    dynamics.flow(position);
  } catch (const NumericsFailure &failure) {
    return failure.kind;
  }
  return "";
}

} // namespace

BOOST_AUTO_TEST_SUITE(dynamics)

// A sphere without load is a drop without surface tension: of the outer liquid it is not felt at all; of a stiffer one,
// both presets on their own meshes say the same of it.
BOOST_AUTO_TEST_CASE(presets_agree) {
  for (const double viscosity_ratio : {1.0, 5.0}) {
    Case physics = mouth_case();
    physics.flow.viscosity_ratio = viscosity_ratio;
    const auto first_row = [&] {
      const Dynamics dynamics = make_dynamics(physics);
      const FlowState state = dynamics.report(dynamics.scene->start, true);
      SeriesRow row =
          Gauge(dynamics.scene->pore, dynamics.scene->membrane).row(0, dynamics.scene->start, state.velocity);
      row.pressure_drop = state.pressure_drop;
      return row;
    };
    const SeriesRow standard = first_row();
    physics.numerics = Numerics::paper;
    physics.mesh = {60, 120, 30};
    const SeriesRow paper = first_row();
    if (viscosity_ratio == 1) {
      BOOST_TEST(std::abs(standard.pressure_drop) < 1e-9);
      BOOST_TEST(std::abs(paper.pressure_drop) < 1e-9);
    } else {
      BOOST_TEST(standard.pressure_drop > 1);
      BOOST_TEST(standard.pressure_drop == paper.pressure_drop, boost::test_tools::tolerance(3e-3));
    }
    BOOST_TEST(standard.v_g == paper.v_g, boost::test_tools::tolerance(3e-3));
    BOOST_TEST(standard.max_radial_velocity == paper.max_radial_velocity, boost::test_tools::tolerance(3e-3));
  }
}

BOOST_AUTO_TEST_CASE(what_is_no_capsule_in_the_pore) {
  const auto to_the_end = [](Vector &position) { position.head(position.size() / 2).array() += 14; };
  const auto across_the_axis = [](Vector &position) { position[position.size() - 2] = -0.1; };
  const auto into_the_wall = [](Vector &position) { position.tail(position.size() / 2) *= 1.3; };
  const auto out_of_numbers = [](Vector &position) { position[0] = NAN; };
  Case paper = mouth_case();
  paper.numerics = Numerics::paper;
  paper.mesh = {60, 120, 30};
  for (const Case &physics : {mouth_case(), paper}) {
    const Dynamics dynamics = make_dynamics(physics);
    BOOST_TEST(failure_of(dynamics, [](Vector &) {}) == "");
    BOOST_TEST(failure_of(dynamics, to_the_end) == "exit");
    BOOST_TEST(failure_of(dynamics, across_the_axis) == "folded");
    BOOST_TEST(failure_of(dynamics, into_the_wall) == "touching");
    BOOST_TEST(failure_of(dynamics, out_of_numbers) == "not-a-number");
  }
  Case tube = mouth_case();
  tube.pore.shape = PoreShape::tube;
  BOOST_TEST(failure_of(make_dynamics(tube), [&](Vector &position) {
               position.head(position.size() / 2).array() -= tube.pore.entrance_distance;
             }) == "exit");
}

// Everything is linear in flow rate and load: what the capsule does at constant pressure at one instant, it does Q times
// faster than at the constant flow rate Q, with the capillary number of that. So it takes the same shapes in the same order
// when that flow rate is given as a function of time. The empty pore's drop is known to 1e-5.
BOOST_AUTO_TEST_CASE(constant_pressure_is_a_given_flow_rate_at_each_instant) {
  const double empty = 8 * 15 + 4.92457;
  for (const double viscosity_ratio : {0.2, 1.0}) {
    Case physics = mouth_case();
    physics.flow.viscosity_ratio = viscosity_ratio;
    physics.pore.entrance_distance = 100;
    physics.flow.drive = DriveBy::pressure;
    const Dynamics driven = make_dynamics(physics);
    Vector position = driven.scene->start;
    const Eigen::Index n = position.size() / 2;
    position.head(n) *= 1.2;
    position.tail(n) /= std::sqrt(1.2);
    const FlowState state = driven.report(position, true);
    BOOST_TEST(std::abs(state.flow_rate - 1) > 1e-3);
    BOOST_TEST(std::abs(state.flow_rate - (1 - state.pressure_drop / empty)) < 1e-6);
    physics.flow.drive = DriveBy::flow_rate;
    physics.flow.capillary_number *= state.flow_rate;
    const FlowState given = make_dynamics(physics).report(position, true);
    const double q = state.flow_rate;
    BOOST_TEST((state.velocity - q * given.velocity).cwiseAbs().maxCoeff() < 1e-7);
    BOOST_TEST(std::abs(state.pressure_drop - q * given.pressure_drop) < 1e-6);
    BOOST_TEST(std::abs(state.pressure_drop_reciprocal - q * given.pressure_drop_reciprocal) < 1e-5);
  }
}

BOOST_AUTO_TEST_SUITE_END()
