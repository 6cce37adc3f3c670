// Steady trains: rigid spheres known from elsewhere as the limit of weak flows, one capsule alone as the limit of long
// periods, and derivatives against differences.
#include "base/failure.hpp"
#include "case/key_path.hpp"
#include "disturbed_state.hpp"
#include "extrapolation.hpp"
#include "flow/flow.hpp"
#include "law/neo_hookean.hpp"
#include "law/skalak.hpp"
#include "membrane/load.hpp"
#include "steady/growth_rates.hpp"
#include "steady/newton.hpp"
#include "steady/refinement.hpp"
#include "steady/slopes.hpp"
#include "steady/steady_state.hpp"
#include <array>
#include <boost/test/unit_test.hpp>
#include <cmath>

using namespace capsule;

namespace {

Case train_case(const MembraneLaw &law, double radius, double capillary_number, double period) {
  Case physics;
  physics.membrane.law = law;
  physics.membrane.bending_ratio = 1e-2;
  physics.capsule.radius = radius;
  physics.flow.capillary_number = capillary_number;
  physics.flow.period = period;
  physics.mesh.membrane = 48;
  return physics;
}

double largest(const Vector &v) {
  return v.cwiseAbs().maxCoeff();
}

} // namespace

BOOST_AUTO_TEST_SUITE(train)

BOOST_AUTO_TEST_CASE(rigid_limit) {
  struct Row {
    double radius, gap, speed, pressure_drop;
  };
  for (const Row &row : {Row{0.5, 0.25, 1.6626103, 0.450172}, Row{0.8, 0.2, 1.2715607, 6.918261},
                         Row{0.8, 1, 1.2753364, 7.696080}}) {
    Case physics = train_case(skalak, row.radius, 0.004, 2 * row.radius + row.gap);
    SteadyState state{system_on_mesh(physics, spectral_basis(48).nodes), {}};
    state.unknowns = state.system->initial();
    std::array<double, 3> speeds{}, drops{}, pairing{}; // by reversibility rigid spheres do not pair
    for (std::size_t k = 0; k < 3; ++k) {
      state.system->set_parameters(physics);
      state.unknowns = solve_steady(*state.system, state.unknowns);
      const FlowState flow = state.system->flow(state.unknowns.head(2 * state.system->nodes()));
      BOOST_TEST(std::abs(flow.pressure_drop - flow.pressure_drop_reciprocal) < 1e-6 * row.pressure_drop);
      speeds[k] = state.unknowns[2 * state.system->nodes()];
      drops[k] = flow.pressure_drop;
      pairing[k] = slowest_rate(*state.system, state.system->linearise(state.unknowns, Neighbours::opposed),
                                Neighbours::opposed)
                       .real();
      physics.flow.capillary_number /= 2;
    }
    BOOST_TEST(std::abs(extrapolated(speeds) - row.speed) < 1e-5);
    BOOST_TEST(std::abs(extrapolated(drops) - row.pressure_drop) < 1e-5 * row.pressure_drop);
    BOOST_TEST(std::abs(extrapolated(pairing)) < 1e-5);
    BOOST_TEST_MESSAGE(row.radius << ' ' << row.gap << ": " << extrapolated(speeds) - row.speed << ' '
                                  << extrapolated(drops) - row.pressure_drop << ' ' << pairing[0] << ' '
                                  << pairing[1] << ' ' << pairing[2]);
  }
}

// Neighbours further off than the disturbance reaches are not felt, nearer ones are; the one in front saves pressure.
BOOST_AUTO_TEST_CASE(a_long_period_is_one_capsule_alone) {
  Case physics = train_case(neo_hookean, 0.8, 0.05, 6.2);
  physics.accuracy = 1e-5;
  SteadyState state = find_steady(physics, {}, {});
  state.unknowns = solve_steady(*state.system, state.unknowns); // as exactly as the one alone
  const SteadyRecord far_apart = record_steady(state);
  const double beside_drift = all_growth_rates(*state.system, state.unknowns, Neighbours::opposed)[1].real();
  const auto with_period = [&](double period) {
    state.system->set_parameters(with_number(physics, "flow.period", period));
    return record_steady({state.system, solve_steady(*state.system, state.unknowns)});
  };
  const SteadyRecord alone = with_period(0), close = with_period(2);
  BOOST_TEST(std::abs(far_apart.row.v_g - alone.row.v_g) < 1e-7);
  BOOST_TEST(std::abs(far_apart.row.pressure_drop - alone.row.pressure_drop) < 1e-6);
  BOOST_TEST(std::abs(far_apart.further.at("growth_rate") - alone.further.at("growth_rate")) < 1e-6);
  // Opposed neighbours drift freely against each other; the next motion is the capsule's own.
  BOOST_TEST_MESSAGE(beside_drift - alone.further.at("growth_rate")
                     << ' ' << far_apart.further.at("pairing_growth_rate") << ' '
                     << close.further.at("pairing_growth_rate"));
  BOOST_TEST(std::abs(far_apart.further.at("pairing_growth_rate")) < 1e-6);
  BOOST_TEST(std::abs(beside_drift - alone.further.at("growth_rate")) < 1e-6);
  BOOST_TEST(close.further.at("pairing_growth_rate") < -1e-3);
  BOOST_TEST(close.row.pressure_drop < alone.row.pressure_drop - 0.05);
  BOOST_TEST(close.further.at("apparent_viscosity") == 1 + close.row.pressure_drop / 16);
  BOOST_TEST(std::abs(close.row.min_gap - (2 - close.row.length)) < 0.1);
  BOOST_TEST(alone.further.count("apparent_viscosity") == 0);
}

BOOST_AUTO_TEST_CASE(two_meshes_agree) {
  Case physics = train_case(skalak, 0.8, 0.05, 1.9);
  const SteadyState found = find_steady(physics, {}, {});
  physics.accuracy = 1e-6;
  const SteadyState coarse = on_mesh(physics, 64, found), fine = on_mesh(physics, 84, coarse);
  const SteadyRecord a = record_steady(coarse), b = record_steady(fine);
  BOOST_TEST(std::abs(a.row.v_g - b.row.v_g) < 1e-6);
  BOOST_TEST(std::abs(a.row.pressure_drop / b.row.pressure_drop - 1) < 1e-6);
  BOOST_TEST(std::abs(a.row.min_gap - b.row.min_gap) < 1e-5);
  BOOST_TEST(std::abs(a.further.at("growth_rate") / b.further.at("growth_rate") - 1) < 1e-5);
}

// Errors that two meshes of the membrane share, because they have one wall, are in the estimates, too.
BOOST_AUTO_TEST_CASE(estimates_bound_the_errors) {
  Case physics = train_case(neo_hookean, 0.8, 0.05, 1.65);
  physics.mesh.membrane = 0;
  const Outcome usual = steady(physics, {}, {});
  physics.accuracy = 1e-6;
  const SteadyRecord exact =
      record_steady(on_mesh(physics, 80, find_steady(physics, usual.last.profiles.at(0), {})));
  const auto bounded = [&](const char *quantity, double value, double true_value) {
    const double error = std::abs(value - true_value), estimate = usual.error_estimate.at(quantity);
    BOOST_TEST(error < estimate, quantity << ": " << error << ' ' << estimate);
    BOOST_TEST(estimate < 1e-4, quantity << ": " << estimate);
  };
  const SeriesRow &row = usual.last.series.at(0), &true_row = exact.row;
  bounded("pressure_drop", row.pressure_drop, true_row.pressure_drop);
  bounded("v_g", row.v_g, true_row.v_g);
  bounded("min_gap", row.min_gap, true_row.min_gap);
  for (const char *rate : {"growth_rate", "growth_per_length", "pairing_growth_rate", "apparent_viscosity"})
    bounded(rate, usual.further.at(rate), exact.further.at(rate));
}

// Two capsules in a period twice as long, displaced against each other: the differences of their velocities are the
// derivative with opposed neighbours, for any viscosity ratio.
BOOST_AUTO_TEST_CASE(opposed_neighbours_are_two_in_one_period) {
  const double period = 1.9;
  const SteadyState state = find_steady(train_case(neo_hookean, 0.8, 0.05, period), {}, {});
  const SteadySystem &system = *state.system;
  const Eigen::Index n = system.nodes();
  const auto zeta = system.membrane().basis.nodes.array();
  Vector direction(2 * n), ahead = Vector::Zero(4 * n);
  direction << 0.3 + (2 * zeta).cos() + 0.5 * zeta.cos(), zeta.sin() - 0.4 * (2 * zeta).sin();
  ahead.segment(n, n).setConstant(period);
  const FlowResolution &resolution = system.resolution().flow;
  const std::vector<MembraneMesh> meshes(2, make_membrane_mesh(system.membrane().basis, resolution));
  const Wall wall(system.pore().value(), resolution);
  for (const double lambda : {1.0, 5.0}) {
    state.system->set_parameters(with_number(system.input(), "flow.viscosity_ratio", lambda));
    Flow flow(wall, join(meshes), {.viscosity_ratios = {lambda, lambda}}, resolution.solver_tolerance);
    flow.place_images({{-2 * period}, {2 * period}}); // others would stand before coarse parts of the wall
    const auto first = flow.mesh().rows(0), second = flow.mesh().rows(1);
    const auto velocity_at = [&](double step) {
      Vector position = ahead, load(4 * n);
      for (const auto &[rows, side] : {std::pair(first, 1), std::pair(second, -1)}) {
        const Vector here = state.unknowns.head(2 * n) + side * step * direction;
        position(rows) += here;
        load(rows) = membrane_load(system.membrane(), here) / system.input().flow.capillary_number;
      }
      Recycled unused;
      return flow.solve(flow.interact(position), load, unused).velocity;
    };
    constexpr double h = 1e-3;
    const Vector differences =
        (8 * (velocity_at(h) - velocity_at(-h)) - velocity_at(2 * h) + velocity_at(-2 * h)) / (12 * h);
    const Vector exact = small_motion(system, state.unknowns, Neighbours::opposed) * direction;
    const double tolerance = 1e-6 * largest(exact);
    BOOST_TEST_MESSAGE(lambda << ": " << largest(differences(first) - exact) / largest(exact));
    BOOST_TEST(largest(differences(first) - exact) < tolerance);
    BOOST_TEST(largest(differences(second) + exact) < tolerance);
    BOOST_TEST(largest(small_motion(system, state.unknowns) * direction - exact) > 100 * tolerance);
  }
}

// About a shape that is not steady, with images so close that their kernels need near rules.
BOOST_AUTO_TEST_CASE(derivatives_against_differences) {
  const Case physics = train_case(neo_hookean, 0.7, 0.05, 1.6);
  const auto system = system_on_mesh(physics, spectral_basis(56).nodes);
  const DisturbedState disturbed = disturb(*system);
  const SteadySystem::Linearisation linear = system->linearise(disturbed.unknowns);
  BOOST_TEST(largest(linear.residual) > 0.3);
  BOOST_TEST(largest(linear.jacobian * disturbed.direction - disturbed.differences) <
             1e-5 * largest(disturbed.differences));

  constexpr double wider = 4e-3;
  const auto with_period = [&](double step) {
    system->set_parameters(with_number(physics, "flow.period", 1.6 + step * wider));
    return system->residual(disturbed.unknowns);
  };
  const Vector by_period = (45 * (with_period(1) - with_period(-1)) - 9 * (with_period(2) - with_period(-2)) +
                            with_period(3) - with_period(-3)) /
                           (60 * wider);
  system->set_parameters(physics);
  const std::string key = "flow.period";
  BOOST_TEST(largest(slopes(*system, disturbed.unknowns, linear, std::span(&key, 1)).col(0) - by_period) <
             1e-5 * largest(by_period));
}

// Capsules that would have to stand in each other are told from those that only come close.
BOOST_AUTO_TEST_CASE(touching_neighbours) {
  const Case physics = train_case(skalak, 0.7, 0.05, 1.3);
  const auto system = system_on_mesh(physics, spectral_basis(40).nodes);
  BOOST_CHECK_THROW(system->residual(system->initial()), NumericsFailure);
  system->set_parameters(with_number(physics, "flow.period", 1.41));
  BOOST_TEST(std::abs(system->gap_to_next(system->initial().head(2 * system->nodes())) - 0.01) < 1e-12);
  BOOST_TEST(largest(system->residual(system->initial())) < 100);
}

// A file of capsules that are longer than the period is told to touch, and where it does.
BOOST_AUTO_TEST_CASE(a_period_below_the_length) {
  Case physics = train_case(neo_hookean, 0.8, 0.05, 1.5);
  physics.mesh.membrane = 32;
  physics.accuracy = 1e-2;
  const Outcome outcome = steady(physics, {}, {});
  BOOST_TEST(outcome.failure == failure_kind::touching);
  BOOST_TEST(outcome.message.find("near flow.period = 1.604") != std::string::npos, outcome.message);
  physics.flow.period = 1.7;
  BOOST_TEST(std::abs(record_steady(find_steady(physics, {}, {})).row.length - 1.604) < 2e-3);
}

BOOST_AUTO_TEST_SUITE_END()
