// Least squares with bounds, and where there is no value: against problems with known minima.
#include "base/failure.hpp"
#include "fit/profile_likelihood.hpp"
#include <boost/test/unit_test.hpp>
#include <cmath>

using namespace capsule;

namespace {

// Rosenbrock's valley: (10 (y - x^2), 1 - x), minimum at (1, 1).
Residuals rosenbrock(const Vector &p) {
  Residuals at{Vector(2), Matrix(2, 2)};
  at.values << 10 * (p[1] - p[0] * p[0]), 1 - p[0];
  at.slopes << -20 * p[0], 10, -1, 0;
  return at;
}

LeastSquares problem_of(const std::function<Residuals(const Vector &)> &evaluate) {
  return {evaluate, Vector::Constant(2, -5), Vector::Constant(2, 5), Vector::Constant(2, 1), 1e-20, 200};
}

} // namespace

BOOST_AUTO_TEST_SUITE(least_squares)

BOOST_AUTO_TEST_CASE(a_bent_valley) {
  const Minimum found = minimise(problem_of(rosenbrock), Vector{{-1.2, 1}});
  BOOST_TEST(found.converged);
  BOOST_TEST((found.parameters - Vector::Ones(2)).norm() < 1e-9);
}

// With x <= 1/2 the minimum lies at the bound, in the valley.
BOOST_AUTO_TEST_CASE(a_bound_holds) {
  LeastSquares problem = problem_of(rosenbrock);
  problem.high[0] = 0.5;
  const Minimum found = minimise(problem, Vector{{-1.2, 1}});
  BOOST_TEST(found.converged);
  BOOST_TEST((found.parameters - Vector{{0.5, 0.25}}).norm() < 1e-9);
  BOOST_TEST(held(problem, found)[0]);
  BOOST_TEST(!held(problem, found)[1]);
  problem.low[0] = problem.high[0] = -0.7;
  BOOST_TEST((minimise(problem, Vector{{-0.7, 1}}).parameters - Vector{{-0.7, 0.49}}).norm() < 1e-9);
}

// Steps to where there is no value are shortened; a minimum behind such a place is not reached, and that is said.
BOOST_AUTO_TEST_CASE(places_without_a_value) {
  const auto up_to = [](double end) {
    return [end](const Vector &p) {
      if (p[0] > end)
        throw NumericsFailure("fold", "no value", "");
      return rosenbrock(p);
    };
  };
  const Minimum inside = minimise(problem_of(up_to(1.02)), Vector{{-1.2, 1}});
  BOOST_TEST((inside.parameters - Vector::Ones(2)).norm() < 1e-6);
  const Minimum outside = minimise(problem_of(up_to(0.9)), Vector{{-1.2, 1}});
  BOOST_TEST(!outside.converged);
  BOOST_TEST(outside.failure == "no value");
  BOOST_TEST(outside.parameters[0] <= 0.9);
}

// Linear in both parameters: the sum grows as (way/error)^2, to bounds, where it ends, and with the other one free.
BOOST_AUTO_TEST_CASE(reaches_of_a_linear_problem) {
  Matrix slopes(3, 2);
  slopes << 1, 0.5, 0.3, 2, -1, 1;
  const auto linear = [&](const Vector &p) { return Residuals{slopes * (p - Vector{{0.2, -0.1}}), slopes}; };
  const LeastSquares problem = problem_of(linear);
  const Minimum found = minimise(problem, Vector::Zero(2));
  const Matrix errors = covariance(problem, found.at);
  BOOST_TEST((errors - (slopes.transpose() * slopes).inverse()).norm() < 1e-14);
  const double way = std::sqrt(2.706 * errors(1, 1));
  BOOST_TEST(reach(problem, found, errors, 1, 1, 2.706).value == -0.1 + way,
             boost::test_tools::tolerance(1e-6));
  BOOST_TEST(reach(problem, found, errors, 1, -1, 2.706).value == -0.1 - way,
             boost::test_tools::tolerance(1e-6));
  LeastSquares bounded = problem;
  bounded.high[1] = 0;
  const Reach end = reach(bounded, found, errors, 1, 1, 2.706);
  BOOST_TEST(end.value == 0);
  BOOST_TEST(end.at_bound);
}

// exp(p) = 2 within an error of 0.3: the ends of the interval are ln(2 +- 0.3 sqrt(2.706)).
BOOST_AUTO_TEST_CASE(reaches_of_a_bent_problem) {
  const auto bent = [](const Vector &p) {
    Residuals at{Vector(2), Matrix::Zero(2, 2)};
    at.values << (std::exp(p[0]) - 2) / 0.3, p[1];
    at.slopes(0, 0) = std::exp(p[0]) / 0.3;
    at.slopes(1, 1) = 1;
    return at;
  };
  const LeastSquares problem = problem_of(bent);
  const Minimum found = minimise(problem, Vector::Zero(2));
  const Matrix errors = covariance(problem, found.at);
  for (const int sense : {1, -1}) {
    const double exact = std::log(2 + sense * 0.3 * std::sqrt(2.706)) - std::log(2.0);
    BOOST_TEST(std::abs((reach(problem, found, errors, 0, sense, 2.706).value - std::log(2.0)) / exact - 1) <
               0.011);
  }
}

// The sum a^2 (1 - exp(-p))^2 grows to a^2 and no further, or up to where it ends.
BOOST_AUTO_TEST_CASE(reaches_without_an_end) {
  const auto growing = [](double most, double last) {
    LeastSquares problem = problem_of([=](const Vector &p) {
      if (p[0] > last)
        throw NumericsFailure("fold", "no value", "");
      Residuals at{Vector(2), Matrix::Zero(2, 2)};
      at.values << most * (1 - std::exp(-p[0])), p[1];
      at.slopes(0, 0) = most * std::exp(-p[0]);
      at.slopes(1, 1) = 1;
      return at;
    });
    problem.high[0] = 1e6;
    return problem;
  };
  const auto upwards = [](const LeastSquares &problem) {
    const Minimum found = minimise(problem, Vector::Zero(2));
    return reach(problem, found, covariance(problem, found.at), 0, 1, 2.706);
  };
  const Reach flat = upwards(growing(1.6, 1e9));
  BOOST_TEST((flat.open && !flat.at_bound && !flat.at_end));
  const Reach ended = upwards(growing(2, 1.2));
  BOOST_TEST((ended.open && ended.at_end));
  BOOST_TEST(std::abs(ended.value - 1.2) < 0.012);
  const Reach late = upwards(growing(1.7, 1e9)); // far beyond where the parabola ends, at 0.97
  BOOST_TEST(!late.open);
  BOOST_TEST(std::abs(std::pow(1.7 * (1 - std::exp(-late.value)), 2) / 2.706 - 1) < 0.02);
}

BOOST_AUTO_TEST_SUITE_END()
