// Marches against small-deformation theory, symmetry of interruption, and failures that must be told apart.
#include "base/failure.hpp"
#include "law/neo_hookean.hpp"
#include "law/skalak.hpp"
#include "motion/march.hpp"
#include "motion/motion.hpp"
#include "scene/resolution.hpp"
#include "steady/steady_state.hpp"
#include <array>
#include <bit>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <cstdint>

using namespace capsule;

namespace {

Case in_extension(const MembraneLaw &law, double capillary_number, double viscosity_ratio) {
  Case physics;
  physics.pore.shape = PoreShape::none;
  physics.flow.type = FlowType::extension;
  physics.flow.capillary_number = capillary_number;
  physics.flow.viscosity_ratio = viscosity_ratio;
  physics.capsule.radius = 1;
  physics.capsule.start_x = 0;
  physics.membrane.law = law;
  physics.membrane.bending_ratio = 0;
  physics.mesh.membrane = 16;
  physics.time.tolerance = 1e-10;
  physics.until.time = 40 * capillary_number * (1 + viscosity_ratio);
  return physics;
}

// Without the companion that only estimates errors.
Outcome march_alone(const Case &input) {
  return march_once(input, {}, {}, Role::main);
}

double steady_deformation(const Case &physics) {
  const Outcome outcome = march_alone(physics);
  BOOST_REQUIRE(outcome.status == Status::reached);
  BOOST_TEST(outcome.last.series.back().max_radial_velocity < 1e-6);
  return outcome.last.series.back().deformation;
}

// Into a short pore, whose wall is soon inverted.
Case short_entrance() {
  Case physics;
  physics.pore.exit_x = 4;
  physics.pore.entrance_distance = 10;
  physics.capsule.radius = 0.8;
  physics.flow.capillary_number = 0.09;
  physics.mesh.membrane = 24;
  physics.time.tolerance = 1e-11; // many steps: the march passes a checkpoint
  physics.until.x_g = 0.5;
  return physics;
}

} // namespace

BOOST_AUTO_TEST_SUITE(motion)

// D = (15/8)(2 + nu)/(1 + nu) Ca, nu = 1/2 (NH, SK C = 1) and 0 (SK C = 0), whatever the viscosity ratio; two
// capillary numbers take out the term of the next order.
BOOST_AUTO_TEST_CASE(small_deformation_in_extension) {
  struct Row {
    MembraneLaw law;
    double viscosity_ratio, slope;
  };
  for (const Row &row :
       {Row{neo_hookean, 1, 3.125}, Row{{skalak, {1}}, 1, 3.125}, Row{{skalak, {0}}, 1, 3.75},
        Row{{skalak, {0}}, 0.2, 3.75}, Row{neo_hookean, 5, 3.125}}) {
    const double fine = 0.001;
    const double slope_fine = steady_deformation(in_extension(row.law, fine, row.viscosity_ratio)) / fine;
    const double slope_coarse =
        steady_deformation(in_extension(row.law, 2 * fine, row.viscosity_ratio)) / (2 * fine);
    BOOST_TEST(std::abs(2 * slope_fine - slope_coarse - row.slope) < 2e-3 * row.slope);
  }
}

// Stopped at a checkpoint and started from it, a march gives the same bits; with lambda != 1 it
// carries an inverse from shape to shape.
BOOST_AUTO_TEST_CASE(a_resumed_march_is_the_same) {
  for (const double viscosity_ratio : {1.0, 5.0}) {
    Case physics = short_entrance();
    physics.capsule.start_x = -2;
    physics.until.x_g = -1.5;
    physics.flow.viscosity_ratio = viscosity_ratio;
    const Outcome whole = march(physics, {}, {});
    BOOST_REQUIRE((whole.status == Status::reached));

    Checkpoint saved;
    long steps = 0;
    Control control;
    control.save = [&](const Checkpoint &checkpoint) { saved = checkpoint; };
    control.interrupted = [&] { return ++steps > 100; };
    BOOST_REQUIRE((march(physics, {}, control).status == Status::interrupted));
    const Outcome resumed = march(physics, saved, {});
    BOOST_REQUIRE((resumed.status == Status::reached));
    BOOST_TEST(resumed.last.steps == whole.last.steps);
    BOOST_REQUIRE(resumed.last.series.size() == whole.last.series.size());
    for (std::size_t k = 0; k < whole.last.series.size(); ++k) {
      BOOST_TEST(resumed.last.series[k].time == whole.last.series[k].time);
      BOOST_TEST(resumed.last.series[k].pressure_drop == whole.last.series[k].pressure_drop);
      BOOST_TEST(resumed.last.series[k].max_radial_velocity == whole.last.series[k].max_radial_velocity);
    }
    BOOST_TEST((resumed.last.position - whole.last.position).cwiseAbs().maxCoeff() == 0);
  }
}

// Stopped after every so many steps of its own or of the companion's, a march goes on from where it was and ends with the same bits.
BOOST_AUTO_TEST_CASE(a_march_that_is_interrupted_anywhere_is_the_same) {
  for (const Scheme scheme : {Scheme::bdf, Scheme::rk4})
    for (const double viscosity_ratio : {1.0, 5.0}) {
      Case physics = short_entrance();
      physics.flow.viscosity_ratio = viscosity_ratio;
      physics.accuracy = 1e-2;
      physics.mesh.membrane = 16;
      physics.capsule.start_x = -2;
      physics.until.x_g = -1.82;
      physics.output.profiles_at_x_g = {-1.95, -1.88};
      physics.time.scheme = scheme;
      physics.time.step = 4e-3;
      const Outcome whole = march(physics, {}, {});
      BOOST_REQUIRE_MESSAGE((whole.status == Status::reached), whole.message);
      const int patience = scheme == Scheme::bdf ? 15 : 30;
      Checkpoint saved;
      Outcome last;
      int calls = 0;
      do {
        int steps = 0;
        Control control;
        control.interrupted = [&] { return ++steps > patience; };
        control.save = [&](const Checkpoint &checkpoint) { saved = checkpoint; };
        last = march(physics, saved, control);
        BOOST_REQUIRE(++calls < 100);
      } while (last.status == Status::interrupted);
      BOOST_TEST(calls > 3);
      BOOST_TEST((last.status == whole.status));
      BOOST_TEST(last.last.steps == whole.last.steps);
      BOOST_TEST((last.error_estimate == whole.error_estimate));
      BOOST_REQUIRE(last.last.series.size() == whole.last.series.size());
      using Bits = std::array<std::uint64_t, sizeof(SeriesRow) / sizeof(double)>;
      for (std::size_t k = 0; k < whole.last.series.size(); ++k)
        BOOST_TEST((std::bit_cast<Bits>(last.last.series[k]) == std::bit_cast<Bits>(whole.last.series[k])));
      BOOST_REQUIRE(last.last.profiles.size() == whole.last.profiles.size());
      BOOST_TEST((last.last.position - whole.last.position).cwiseAbs().maxCoeff() == 0);
    }
}

// Rows that are recorded for their profiles leave the march and its other rows as they are, bit by bit.
BOOST_AUTO_TEST_CASE(further_rows_change_nothing) {
  Case physics = short_entrance();
  physics.flow.viscosity_ratio = 5;
  physics.time.tolerance = 1e-7;
  Case with_profiles = physics;
  with_profiles.output.profiles_at_x_g = {-3.99, -3.33, -3.31, -2, -1.01};
  with_profiles.output.profiles_at_time = {0.5, 1, 1.0001};
  const Checkpoint plain = march_alone(physics).last;
  const Checkpoint further = march_alone(with_profiles).last;
  BOOST_TEST(further.profiles.size() == plain.profiles.size() + 8);
  BOOST_TEST(further.series.size() == plain.series.size() + 7); // -2 has a row of its own
  BOOST_TEST(further.steps == plain.steps);
  BOOST_TEST((further.position - plain.position).cwiseAbs().maxCoeff() == 0);
  using Bits = std::array<std::uint64_t, sizeof(SeriesRow) / sizeof(double)>;
  std::size_t k = 0;
  for (const SeriesRow &row : further.series)
    if (k < plain.series.size() && std::bit_cast<Bits>(row) == std::bit_cast<Bits>(plain.series[k]))
      ++k;
  BOOST_TEST(k == plain.series.size());
}

// The estimate bounds the distance to a much finer march, for the error-controlled scheme and for Euler's. It speaks of
// rows near the end: a single one may be right by accident.
BOOST_AUTO_TEST_CASE(error_estimates_bound_the_error) {
  Case physics = short_entrance();
  physics.capsule.start_x = -3;
  physics.until.x_g = -0.8;
  physics.mesh.membrane = 40;
  physics.time.tolerance = 1e-9;
  const std::vector<SeriesRow> exact = march_alone(physics).last.series;
  for (const Scheme scheme : {Scheme::bdf, Scheme::euler}) {
    Case coarse = physics;
    coarse.mesh.membrane = 20;
    coarse.time.scheme = scheme;
    coarse.time.step = 0.004;
    coarse.time.tolerance = 1e-5;
    const Outcome outcome = march(coarse, {}, {});
    BOOST_REQUIRE((outcome.status == Status::reached));
    const std::vector<SeriesRow> &rows = outcome.last.series;
    BOOST_REQUIRE(rows.size() == exact.size());
    double error = 0;
    for (std::size_t k = 0; k < rows.size(); ++k)
      if (rows[k].x_g > rows.back().x_g - 2)
        error = std::max(error, std::abs(rows[k].pressure_drop - exact[k].pressure_drop));
    BOOST_TEST(error < outcome.error_estimate.at("pressure_drop"));
    BOOST_TEST(error > 0.01 * outcome.error_estimate.at("pressure_drop"));
  }
}

// In an extension the centre stays: rows of the march and of its companion meet in time. Off by one row, they would
// tell a transient's speed, not its error.
BOOST_AUTO_TEST_CASE(error_estimates_in_time_bound_the_error) {
  Case physics = in_extension(neo_hookean, 0.2, 1);
  physics.until.time = 0.5;
  physics.mesh.membrane = 64; // its errors are then those of the time
  const std::vector<SeriesRow> exact = march_alone(physics).last.series;
  physics.time.tolerance = 1e-6;
  const Outcome outcome = march(physics, {}, {});
  const std::vector<SeriesRow> &rows = outcome.last.series;
  BOOST_REQUIRE(rows.size() == exact.size());
  double error = 0;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    BOOST_TEST(std::abs(rows[k].time - exact[k].time) < 1e-12);
    error = std::max(error, std::abs(rows[k].deformation - exact[k].deformation));
  }
  const double estimate = outcome.error_estimate.at("deformation@time");
  BOOST_TEST(error < estimate);
  BOOST_TEST(error > 0.01 * estimate);
  BOOST_TEST(estimate < 0.1 * (rows[2].deformation - rows[1].deformation));
  BOOST_TEST(!outcome.error_estimate.contains("deformation@x_g"));
}

// Before tensions build up the sphere deforms like a viscous inclusion: the strain inside is 5/(2 lambda + 3)
// of the flow's, so that D = (15/4) t/(2 lambda + 3).
BOOST_AUTO_TEST_CASE(first_deformation_is_that_of_a_viscous_inclusion) {
  for (const double viscosity_ratio : {0.2, 1.0, 10.0}) {
    Case physics = in_extension(neo_hookean, 100, viscosity_ratio);
    physics.until.time = 1e-3;
    const double deformation = march_alone(physics).last.series.back().deformation;
    const double inclusion = 3.75e-3 / (2 * viscosity_ratio + 3);
    BOOST_TEST(std::abs(deformation - inclusion) < 2e-3 * inclusion);
  }
}

BOOST_AUTO_TEST_CASE(a_membrane_at_the_exit_stops_the_march) {
  Case physics = short_entrance();
  physics.pore.shape = PoreShape::tube;
  physics.pore.entrance_distance = 3;
  physics.pore.exit_x = 4;
  physics.capsule.start_x = 1;
  physics.until.x_g = 3.5;
  physics.time.tolerance = 1e-6;
  const Outcome outcome = march(physics, {}, {});
  BOOST_TEST((outcome.status == Status::failed));
  BOOST_TEST(outcome.failure == "exit");
}

BOOST_AUTO_TEST_CASE(wrinkles_stop_a_membrane_without_bending_stiffness) {
  Case physics;
  physics.capsule.radius = 0.8;
  physics.flow.capillary_number = 0.12;
  physics.membrane.bending_ratio = 0;
  physics.pore.exit_x = 7;
  physics.capsule.start_x = -2.5;
  physics.mesh.membrane = 64;
  physics.time.tolerance = 1e-6;
  physics.until.x_g = 4;
  const Outcome outcome = march(physics, {}, {});
  BOOST_TEST((outcome.status == Status::failed));
  BOOST_TEST(outcome.failure == "wrinkled");
  BOOST_TEST(outcome.last.series.back().x_g > 1); // where the paper sees it: for x_g > 1, at the rear
  BOOST_TEST(outcome.message.find("bending_ratio") != std::string::npos);
}

// Nodes that were chosen from the accuracy are half as many again after wrinkles, once, with a thirtieth of the time
// tolerance; an interrupted march goes on with those it had. Given nodes stay.
BOOST_AUTO_TEST_CASE(wrinkles_on_chosen_nodes_begin_again_on_more) {
  Case physics;
  physics.accuracy = 1e-2;
  physics.pore.exit_x = 6;
  physics.capsule.radius = 0.8;
  physics.capsule.start_x = -1.5;
  physics.flow.capillary_number = 0.12;
  physics.membrane.bending_ratio = 1e-6; // wrinkles on any mesh
  physics.until.x_g = 4;
  const int chosen = choose_resolution(physics).membrane_nodes;
  const int more = 3 * chosen / 2;
  Case on_more = physics, as_given = physics;
  on_more.mesh.membrane = more;
  on_more.time.tolerance = choose_resolution(physics).time_tolerance / 30;
  as_given.mesh.membrane = chosen;
  const Outcome given = march(as_given, {}, {}), finer = march(on_more, {}, {});
  BOOST_TEST(given.failure == "wrinkled");
  BOOST_TEST(given.last.position.size() == 2 * chosen);

  Checkpoint saved;
  bool begun_again = false;
  Control control;
  long before = 0;
  control.progress = [&](const SeriesRow &, long steps) {
    begun_again = begun_again || steps < before;
    before = steps;
  };
  const Outcome automatic = march(physics, {}, control);
  BOOST_TEST(begun_again);
  BOOST_TEST(automatic.failure == "wrinkled");
  BOOST_TEST(automatic.membrane_nodes == more);
  const auto same = [&](const Outcome &one, const Outcome &other) {
    BOOST_TEST(one.last.steps == other.last.steps);
    BOOST_REQUIRE(one.last.series.size() == other.last.series.size());
    for (std::size_t k = 0; k < one.last.series.size(); ++k) {
      BOOST_TEST(one.last.series[k].time == other.last.series[k].time);
      BOOST_TEST(one.last.series[k].pressure_drop == other.last.series[k].pressure_drop);
    }
  };
  same(automatic, finer);

  Control stopping; // in the second march
  int steps_on_more = 0;
  stopping.save = [&](const Checkpoint &checkpoint) {
    saved = checkpoint;
    steps_on_more += checkpoint.position.size() == 2L * more ? 1 : 0;
  };
  stopping.wants_checkpoint = [] { return true; };
  stopping.interrupted = [&] { return steps_on_more > 50; };
  BOOST_REQUIRE((march(physics, {}, stopping).status == Status::interrupted));
  const Outcome resumed = march(physics, saved, {});
  BOOST_TEST(resumed.membrane_nodes == more);
  same(resumed, finer);
}

// What is not resolved on chosen nodes begins again on half as many more and then on three times as many; what wrinkles
// begins again once. A finer mesh is believed where it arrives, and the last one where it fails.
BOOST_AUTO_TEST_CASE(what_is_not_resolved_begins_again_twice) {
  Case physics = in_extension(neo_hookean, 0.1, 1);
  physics.accuracy = 1e-2;
  physics.mesh.membrane = 0;
  physics.time.tolerance = 0;
  physics.until.time = 0.003;
  const int chosen = choose_resolution(physics).membrane_nodes;
  const auto after_failures = [&](int failures, const char *kind) {
    Control control;
    control.interrupted = [&] {
      if (failures > 0) {
        --failures;
        throw NumericsFailure(kind, "stub", "none");
      }
      return false;
    };
    return march(physics, {}, control);
  };
  BOOST_TEST(after_failures(0, failure_kind::unresolved).membrane_nodes == 0);
  BOOST_TEST(after_failures(1, failure_kind::unresolved).membrane_nodes == 3 * chosen / 2);
  const Outcome third = after_failures(2, failure_kind::unresolved);
  BOOST_TEST((third.status == Status::reached));
  BOOST_TEST(third.membrane_nodes == 3 * chosen);
  BOOST_TEST(third.last.position.size() == 2L * 3 * chosen);
  BOOST_TEST(third.error_estimate.at("deformation@time") < 1e-4);
  BOOST_TEST(after_failures(3, failure_kind::unresolved).failure == failure_kind::unresolved);
  BOOST_TEST(after_failures(2, failure_kind::wrinkled).failure == failure_kind::wrinkled);
}

// A march that hardly gains any time in a thousand steps is given up: one that goes on as if it had made all but one of them.
BOOST_AUTO_TEST_CASE(a_thousand_steps_without_gain_are_enough) {
  Case physics = in_extension(neo_hookean, 0.1, 1);
  physics.until.time = 0.1;
  Checkpoint saved;
  Control control;
  control.save = [&](const Checkpoint &checkpoint) { saved = checkpoint; };
  control.interrupted = [steps = 0]() mutable { return ++steps > 5; };
  BOOST_REQUIRE((march(physics, {}, control).status == Status::interrupted));
  saved.steps = 999;
  saved.checked = saved.time - 0.01;
  BOOST_TEST((march(physics, saved, {}).status == Status::reached));
  saved.checked = saved.time;
  const Outcome outcome = march(physics, saved, {});
  BOOST_TEST(outcome.failure == failure_kind::unresolved);
  BOOST_TEST(outcome.message.find("the last 1000 steps add") == 0U, outcome.message);
}

// A neo-Hookean capsule has no steady state in a strong extension.
BOOST_AUTO_TEST_CASE(runaway_is_reported_as_unbounded) {
  Case physics = in_extension(neo_hookean, 1, 1);
  physics.mesh.membrane = 64;
  physics.time.tolerance = 1e-7;
  physics.until.time = 40;
  const Outcome outcome = march(physics, {}, {});
  BOOST_TEST((outcome.status == Status::unbounded));
  BOOST_TEST(std::abs(outcome.last.series.back().volume_change) < 1e-4);
}

// A spheroid whose widest ring lies between two nodes, beyond the wall.
BOOST_AUTO_TEST_CASE(contact_between_the_nodes_is_seen) {
  Case physics;
  physics.pore.shape = PoreShape::tube;
  physics.pore.exit_x = physics.pore.entrance_distance = 4;
  physics.capsule.start_x = 0;
  physics.capsule.aspect_ratio = 0.6;
  physics.capsule.radius = 1.001 * std::cbrt(0.6);
  physics.flow.capillary_number = 0.05;
  physics.mesh.membrane = 24;
  physics.until.x_g = 1;
  const Outcome outcome = march(physics, {}, {});
  BOOST_TEST((outcome.status == Status::failed));
  BOOST_TEST(outcome.failure == "touching");
}

// A viscous capsule is pressed onto the lip. Its film becomes too thin for the mesh, and the steps so short that it would
// not arrive: that is said, soon.
BOOST_AUTO_TEST_CASE(a_march_that_hardly_goes_on_is_stopped) {
  Case physics;
  physics.accuracy = 1e-3;
  physics.pore.exit_x = 5;
  physics.capsule.radius = 1.1;
  physics.capsule.start_x = -2.5;
  physics.membrane.law = skalak;
  physics.flow.capillary_number = 0.05;
  physics.flow.viscosity_ratio = 100;
  physics.mesh.membrane = 24;
  physics.until.x_g = 3;
  const Outcome outcome = march(physics, {}, {});
  BOOST_TEST((outcome.failure == "unresolved" || outcome.failure == "touching"));
  BOOST_TEST(outcome.last.steps < 2000);
  BOOST_TEST(outcome.last.series.back().min_film < 0.01);
}

// The centre of an extension is an unstable place: whatever is off it drifts away as exp(t). The capsule stays.
BOOST_AUTO_TEST_CASE(a_long_extension_keeps_its_centre) {
  Case physics = in_extension(neo_hookean, 0.1, 1);
  physics.mesh.membrane = 24;
  physics.time.tolerance = 1e-6;
  physics.until.time = 100;
  const Outcome outcome = march(physics, {}, {});
  BOOST_TEST((outcome.status == Status::reached));
  const SeriesRow &last = outcome.last.series.back();
  BOOST_TEST(std::abs(last.x_g) < 1e-6);
  BOOST_TEST(last.max_radial_velocity < 1e-6);
  BOOST_TEST(std::abs(last.deformation - steady(physics, {}, {}).last.series.at(0).deformation) < 1e-6);
}

// A stiff sphere under constant pressure: Q/Q0 = P/(P + Delta P), with the drops of the empty pore, P = 57.849, and of a
// rigid sphere. Its small deformation takes a term of the first order in the capillary number.
BOOST_AUTO_TEST_CASE(stiff_capsule_under_constant_pressure) {
  const auto flow_rate = [](double capillary_number) {
    Case physics;
    physics.capsule.radius = 0.8;
    physics.capsule.start_x = 3;
    physics.pore.exit_x = 6.6155;
    physics.flow.drive = DriveBy::pressure;
    physics.flow.capillary_number = capillary_number;
    physics.membrane.law = neo_hookean;
    physics.accuracy = 1e-5;
    physics.until.time = 100 * capillary_number;
    const Outcome outcome = march_alone(physics);
    BOOST_REQUIRE(outcome.status == Status::reached);
    return outcome.last.series.back().flow_rate;
  };
  const double coarse = flow_rate(1e-3), fine = flow_rate(5e-4);
  BOOST_TEST(std::abs(2 * fine - coarse - 0.88206) < 1e-5);
}

// The steady state at constant pressure is that of the flow rate that it comes to, with the resistance that the march ends
// with, in the same pore.
BOOST_AUTO_TEST_CASE(steady_state_under_constant_pressure) {
  Case physics;
  physics.pore.shape = PoreShape::tube;
  physics.pore.exit_x = physics.pore.entrance_distance = 6;
  physics.capsule.radius = 0.8;
  physics.capsule.start_x = -1;
  physics.flow.drive = DriveBy::pressure;
  physics.flow.capillary_number = 0.01;
  physics.membrane.law = neo_hookean;
  physics.membrane.bending_ratio = 1e-3;
  physics.until.time = 2;
  physics.output.resistance = true;
  const Outcome outcome = march(physics, {}, {});
  BOOST_REQUIRE(outcome.status == Status::reached);
  const SeriesRow end = outcome.last.series.back();
  BOOST_TEST(end.max_radial_velocity < 1e-5);
  const Outcome at_rest = steady(physics, {}, {});
  const SeriesRow steady_end = at_rest.last.series.back();
  BOOST_TEST(steady_end.resistance == end.resistance, boost::test_tools::tolerance(1e-5));
  BOOST_TEST(steady_end.resistance_long_conductor == end.resistance_long_conductor,
             boost::test_tools::tolerance(1e-5));
  BOOST_TEST(at_rest.further.at("empty_resistance") == outcome.further.at("empty_resistance"));
  BOOST_TEST(steady_end.flow_rate == end.flow_rate, boost::test_tools::tolerance(1e-6));
  BOOST_TEST(steady_end.v_g == end.v_g, boost::test_tools::tolerance(1e-5));
  BOOST_TEST(steady_end.length == end.length, boost::test_tools::tolerance(1e-5));
  physics.flow.drive = DriveBy::flow_rate;
  physics.flow.capillary_number *= end.flow_rate;
  const SeriesRow given = steady(physics, {}, {}).last.series.back();
  BOOST_TEST(given.flow_rate == 1);
  BOOST_TEST(end.flow_rate == 1 - end.pressure_drop / 96, boost::test_tools::tolerance(1e-12));
  BOOST_TEST(end.v_g == end.flow_rate * given.v_g, boost::test_tools::tolerance(1e-5));
  BOOST_TEST(end.pressure_drop == end.flow_rate * given.pressure_drop, boost::test_tools::tolerance(1e-4));
  BOOST_TEST(end.length == given.length, boost::test_tools::tolerance(1e-5));
  BOOST_TEST(outcome.error_estimate.at("flow_rate") < 1e-4);
}

// A membrane bursts where it comes to what it bears, to the last digits, with the row and the profile of that instant; the
// march up to there is the one without a limit, and its error estimate knows how far off the place is.
BOOST_AUTO_TEST_CASE(a_membrane_bursts_where_it_comes_to_what_it_bears) {
  Case physics = short_entrance();
  physics.time.tolerance = 1e-8;
  const Outcome whole = march_alone(physics);
  BOOST_REQUIRE(whole.status == Status::reached);
  const std::vector<SeriesRow> &rows = whole.last.series;
  for (const auto &[limit, value] : {std::pair(&UntilSpec::area_stretch, &SeriesRow::max_area_stretch),
                                     std::pair(&UntilSpec::tension, &SeriesRow::max_tension)}) {
    const std::size_t middle = rows.size() / 2;
    const double bears = (rows[middle].*value + rows[middle + 1].*value) / 2;
    BOOST_REQUIRE(rows[middle].*value < bears);
    Case weak = physics;
    weak.until.*limit = bears;
    const Outcome outcome = march(weak, {}, {});
    BOOST_TEST((outcome.status == Status::burst));
    BOOST_TEST(outcome.message.find("bursts") != std::string::npos);
    const std::vector<SeriesRow> &series = outcome.last.series;
    BOOST_REQUIRE(series.size() == middle + 2);
    BOOST_TEST(series[middle].v_g == rows[middle].v_g);
    BOOST_TEST((series.back().*value) == bears, boost::test_tools::tolerance(1e-11));
    BOOST_TEST(series.back().time > rows[middle].time);
    BOOST_TEST(series.back().time < rows[middle + 1].time);
    BOOST_TEST(outcome.last.profiles.back().time == series.back().time);
    // The same place by a cubic through the four rows about it.
    double x_g = 0;
    for (std::size_t i = middle - 1; i < middle + 3; ++i) {
      double weight = rows[i].x_g;
      for (std::size_t k = middle - 1; k < middle + 3; ++k)
        if (k != i)
          weight *= (bears - rows[k].*value) / (rows[i].*value - rows[k].*value);
      x_g += weight;
    }
    BOOST_TEST(std::abs(series.back().x_g - x_g) < 1e-4);
    BOOST_TEST(outcome.error_estimate.at("x_g") > 0);
    BOOST_TEST(outcome.error_estimate.at("x_g") < 1e-2);
    BOOST_TEST(outcome.error_estimate.at("largest_tension") > 0);
    BOOST_TEST(outcome.error_estimate.at("largest_tension") < 1e-2);
  }
}

BOOST_AUTO_TEST_SUITE_END()
