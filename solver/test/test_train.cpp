// Steady trains: rigid spheres known from elsewhere as the limit of weak flows, one capsule alone as the limit of long
// periods, and derivatives against differences.
#include "base/failure.hpp"
#include "case/key_path.hpp"
#include "disturbed_state.hpp"
#include "extrapolation.hpp"
#include "law/neo_hookean.hpp"
#include "law/skalak.hpp"
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
  physics.accuracy = 1e-5;
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
    SteadyState state = find_steady(physics, {}, {});
    std::array<double, 3> speeds{}, drops{};
    for (std::size_t k = 0; k < 3; ++k) {
      state.system->set_parameters(physics);
      state.unknowns = solve_steady(*state.system, state.unknowns);
      const FlowState flow = state.system->flow(state.unknowns.head(2 * state.system->nodes()));
      BOOST_TEST(std::abs(flow.pressure_drop - flow.pressure_drop_reciprocal) < 1e-6 * row.pressure_drop);
      speeds[k] = state.unknowns[2 * state.system->nodes()];
      drops[k] = flow.pressure_drop;
      physics.flow.capillary_number /= 2;
    }
    BOOST_TEST(std::abs(extrapolated(speeds) - row.speed) < 1e-5);
    BOOST_TEST(std::abs(extrapolated(drops) - row.pressure_drop) < 1e-5 * row.pressure_drop);
    BOOST_TEST_MESSAGE(row.radius << ' ' << row.gap << ": " << extrapolated(speeds) - row.speed << ' '
                                  << extrapolated(drops) - row.pressure_drop);
  }
}

// Neighbours further off than the disturbance reaches are not felt, nearer ones are; the one in front saves pressure.
BOOST_AUTO_TEST_CASE(a_long_period_is_one_capsule_alone) {
  const SteadyState state = find_steady(train_case(neo_hookean, 0.8, 0.05, 6.2), {}, {});
  const SteadyRecord far_apart = record_steady(state, 1);
  state.system->set_parameters(train_case(neo_hookean, 0.8, 0.05, 0));
  const SteadyRecord alone = record_steady({state.system, solve_steady(*state.system, state.unknowns)}, 1);
  const SteadyRecord close = record_steady(find_steady(train_case(neo_hookean, 0.8, 0.05, 2), {}, {}), 1);
  BOOST_TEST(std::abs(far_apart.row.v_g - alone.row.v_g) < 1e-7);
  BOOST_TEST(std::abs(far_apart.row.pressure_drop - alone.row.pressure_drop) < 1e-6);
  BOOST_TEST(std::abs(far_apart.further.at("growth_rate") - alone.further.at("growth_rate")) < 1e-6);
  BOOST_TEST(close.row.pressure_drop < alone.row.pressure_drop - 0.05);
  BOOST_TEST(close.further.at("apparent_viscosity") == 1 + close.row.pressure_drop / 16);
  BOOST_TEST(std::abs(close.further.at("min_gap") - (2 - close.row.length)) < 0.1);
  BOOST_TEST(alone.further.count("apparent_viscosity") == 0);
}

BOOST_AUTO_TEST_CASE(two_meshes_agree) {
  Case physics = train_case(skalak, 0.8, 0.05, 1.9);
  physics.accuracy = 1e-6;
  const SteadyState coarse = on_mesh(physics, 72, find_steady(physics, {}, {}));
  const SteadyState fine = on_mesh(physics, 96, coarse);
  const SteadyRecord a = record_steady(coarse, 1), b = record_steady(fine, 1);
  BOOST_TEST(std::abs(a.row.v_g - b.row.v_g) < 1e-6);
  BOOST_TEST(std::abs(a.row.pressure_drop / b.row.pressure_drop - 1) < 1e-6);
  BOOST_TEST(std::abs(a.further.at("min_gap") - b.further.at("min_gap")) < 1e-5);
  BOOST_TEST(std::abs(a.further.at("growth_rate") / b.further.at("growth_rate") - 1) < 1e-5);
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

BOOST_AUTO_TEST_SUITE_END()
