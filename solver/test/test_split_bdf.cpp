// The integrator of marches on a stiff problem with a known solution: its errors follow the tolerance, its steps are those
// of the slow part, it is a polynomial between the ends of a step, goes on from its memory with the same bits, and gives up
// where it must.
#include "base/failure.hpp"
#include "motion/split_bdf.hpp"
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <vector>

using namespace capsule;

namespace {

// A point (c, s) on the unit circle and z = c^2, to which a load pulls through a mobility that changes with c:
//   c' = -s, s' = c, z' = m F + rest,   m = 1 + c/20,   F = 5 - 1000 (z - c^2) - 100 (z - c^2)^3
constexpr double stiffness = 1000;

double mobility_at(const Vector &state) {
  return 1 + state[0] / 20;
}

double load_at(const Vector &state) {
  const double off = state[2] - state[0] * state[0];
  return 5 - stiffness * off - 100 * off * off * off;
}

Vector rate_at(const Vector &state) {
  const double held = 5 * mobility_at(state);
  return Vector{{-state[1], state[0], mobility_at(state) * load_at(state) - held - 2 * state[0] * state[1]}};
}

SplitEquations circle() {
  return {.load = [](const Vector &state) -> Vector {
            return Vector{{0, 0, load_at(state)}};
          },
          .rate = [](const Vector &state) -> SplitEquations::Rate {
            return {rate_at(state), Vector{{state[0], state[0] * state[1]}}};
          },
          .mobility = [](const Vector &state) -> Matrix {
            Matrix mobility = Matrix::Zero(3, 3);
            mobility(2, 2) = mobility_at(state);
            return mobility;
          },
          .load_jacobian = [](const Vector &state) -> Matrix {
            Matrix jacobian = Matrix::Zero(3, 3);
            jacobian(2, 0) = 2 * state[0] * stiffness; // without the cubic part
            jacobian(2, 2) = -stiffness;
            return jacobian;
          }};
}

const Vector beginning{{1, 0, 1}};

double error_at(double time, const Vector &state) {
  const double c = std::cos(time);
  return std::max({std::abs(state[0] - c), std::abs(state[1] - std::sin(time)), std::abs(state[2] - c * c)});
}

struct Way {
  double error = 0;
  int steps = 0;
};
Way way_to(double end, double tolerance) {
  SplitBdf integrator(circle(), 0, beginning, tolerance);
  Way way;
  while (integrator.time() < end) {
    integrator.step();
    ++way.steps;
    way.error = std::max(way.error, error_at(integrator.time(), integrator.state_at(integrator.time())));
  }
  return way;
}

} // namespace

BOOST_AUTO_TEST_SUITE(split_bdf)

// Of order 5 a step of a given error is shorter by the sixth root of the tolerance. An explicit scheme would be stable below
// steps of 2/1000.
BOOST_AUTO_TEST_CASE(errors_follow_the_tolerance_and_steps_the_slow_part) {
  constexpr double end = 10;
  const Way coarse = way_to(end, 1e-6), fine = way_to(end, 1e-9);
  BOOST_TEST(coarse.error < 1e-4);
  BOOST_TEST(fine.error < 1e-7);
  BOOST_TEST(fine.error < coarse.error / 100);
  BOOST_TEST(coarse.steps < end * stiffness / 20);
  BOOST_TEST(fine.steps < 1.3 * std::pow(1000, 1.0 / 6) * coarse.steps);
}

// A state beside the slow manifold comes back to it.
BOOST_AUTO_TEST_CASE(what_is_stiff_decays) {
  SplitBdf integrator(circle(), 0, Vector{{1, 0, 1.1}}, 1e-7);
  while (integrator.time() < 1)
    integrator.step();
  BOOST_TEST(error_at(integrator.time(), integrator.state_at(integrator.time())) < 1e-5);
}

// Within steps the state errs no more than at their ends. The rate errs by what an error of the state, of the size of the
// tolerance, makes of it: 1000 times as much.
BOOST_AUTO_TEST_CASE(between_the_ends_of_a_step_all_is_a_polynomial) {
  constexpr double tolerance = 1e-8;
  SplitBdf integrator(circle(), 0, beginning, tolerance);
  double off_state = 0, off_rate = 0, off_further = 0;
  while (integrator.time() < 5) {
    integrator.step();
    const double before = integrator.previous_time(), now = integrator.time();
    BOOST_TEST(now > before);
    for (const double share : {0.0, 0.3, 0.8, 1.0}) {
      const double time = before + share * (now - before), c = std::cos(time), s = std::sin(time);
      off_state = std::max(off_state, error_at(time, integrator.state_at(time)));
      off_rate =
          std::max(off_rate, (integrator.rate_at(time) - Vector{{-s, c, -2 * s * c}}).cwiseAbs().maxCoeff());
      off_further =
          std::max(off_further, (integrator.further_at(time) - Vector{{c, s * c}}).cwiseAbs().maxCoeff());
    }
  }
  BOOST_TEST(off_state < 1e-6);
  BOOST_TEST(off_rate < 2 * stiffness * tolerance);
  BOOST_TEST(off_further < 1e-6);
}

BOOST_AUTO_TEST_CASE(it_goes_on_from_its_memory_with_the_same_bits) {
  SplitBdf whole(circle(), 0, beginning, 1e-7);
  std::vector<StepMemory> memories{whole.memory()};
  std::vector<Vector> states{beginning};
  for (int k = 0; k < 120; ++k) {
    whole.step();
    memories.push_back(whole.memory());
    states.push_back(whole.state_at(whole.time()));
  }
  for (std::size_t from = 0; from < memories.size(); from += 7) {
    SplitBdf resumed(circle(), memories[from], 1e-7);
    for (std::size_t k = from + 1; k < memories.size(); ++k) {
      resumed.step();
      BOOST_REQUIRE(resumed.time() == memories[k].past[0].time);
      BOOST_REQUIRE((resumed.state_at(resumed.time()) - states[k]).cwiseAbs().maxCoeff() == 0);
    }
  }
}

// Where there is no rate beyond a place, steps become shorter, and then the failure is the rate's own.
BOOST_AUTO_TEST_CASE(failures_of_the_rate_end_the_march_where_they_are) {
  SplitEquations equations = circle();
  equations.rate = [](const Vector &state) -> SplitEquations::Rate {
    if (state[1] > 0.5)
      throw NumericsFailure("wall", "here is the wall", "go back");
    return {rate_at(state)};
  };
  SplitBdf integrator(equations, 0, beginning, 1e-7);
  const auto go = [&] {
    for (int k = 0; k < 10000; ++k)
      integrator.step();
  };
  BOOST_CHECK_EXCEPTION(go(), NumericsFailure,
                        [](const NumericsFailure &failure) { return failure.kind == "wall"; });
  BOOST_TEST(std::abs(integrator.state_at(integrator.time())[1] - 0.5) < 1e-4);
}

// The rate refuses the first attempt alone; in all shorter ones it is far from what was extrapolated.
BOOST_AUTO_TEST_CASE(failures_of_longer_steps_are_no_cause) {
  SplitEquations equations = circle();
  int rates = 0;
  equations.rate = [&](const Vector &state) -> SplitEquations::Rate {
    ++rates;
    if (rates == 2) // the first one is of the beginning
      throw NumericsFailure("wall", "here is the wall", "go back");
    return {rates == 1 ? rate_at(state) : Vector::Constant(3, 1e15)};
  };
  SplitBdf integrator(equations, 0, beginning, 1e-7);
  BOOST_CHECK_EXCEPTION(integrator.step(), NumericsFailure,
                        [](const NumericsFailure &failure) { return failure.kind == failure_kind::step; });
  BOOST_TEST(rates > 3);
}

// Two circles as one system, with components in alternating order, whose loads do not depend on each other: the root mean
// square of the error is that of one circle, and so are steps and states.
BOOST_AUTO_TEST_CASE(parts_go_as_one_alone) {
  const SplitEquations one = circle();
  const std::vector<std::vector<Eigen::Index>> parts{{0, 2, 4}, {1, 3, 5}};
  const auto both = [parts](const auto &of_one, const Vector &state) {
    Vector values(6);
    for (const auto &part : parts)
      values(part) = of_one(state(part));
    return values;
  };
  const auto blocks = [parts](const auto &of_one, const Vector &state) {
    Matrix values = Matrix::Zero(6, 6);
    for (const auto &part : parts)
      values(part, part) = of_one(state(part));
    return values;
  };
  const SplitEquations two{
      .load = [&](const Vector &state) -> Vector { return both(one.load, state); },
      .rate = [&](const Vector &state) -> SplitEquations::Rate {
        return {both([&](const Vector &part) { return one.rate(part).rate; }, state)};
      },
      .mobility = [&](const Vector &state) -> Matrix { return blocks(one.mobility, state); },
      .load_jacobian = [&](const Vector &state) -> Matrix { return blocks(one.load_jacobian, state); },
      .parts = parts};
  SplitBdf alone(one, 0, beginning, 1e-7), together(two, 0, Vector{{1, 1, 0, 0, 1, 1}}, 1e-7);
  for (int k = 0; k < 100; ++k) {
    alone.step();
    together.step();
  }
  BOOST_TEST(std::abs(together.time() - alone.time()) < 1e-9);
  const Vector end = together.state_at(together.time());
  for (const auto &part : parts)
    BOOST_TEST((end(part) - alone.state_at(alone.time())).cwiseAbs().maxCoeff() < 1e-9);
}

BOOST_AUTO_TEST_SUITE_END()
