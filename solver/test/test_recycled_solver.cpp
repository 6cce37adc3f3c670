// The solver that reuses earlier systems, on matrices whose solution is known beforehand.
#include "flow/recycled_solver.hpp"
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <limits>

using namespace capsule;

namespace {

constexpr Eigen::Index size = 20;

// A family of well-conditioned matrices, and the solution that the right side is made from.
struct System {
  Matrix matrix;
  Vector solution;
};

System system_at(double t) {
  System system{Matrix::Identity(size, size), Vector(size)};
  for (Eigen::Index i = 0; i < size; ++i) {
    system.solution[i] = std::cos(0.3 * static_cast<double>(i) + t);
    for (Eigen::Index j = 0; j < size; ++j)
      system.matrix(i, j) += 0.4 * std::sin(static_cast<double>(i * j) + t) / static_cast<double>(i + j + 1);
  }
  return system;
}

struct Count {
  int builds = 0, applications = 0;
};

Vector solved(double t, double tolerance, Recycled &recycled, Count &count) {
  const System system = system_at(t);
  const Vector right = system.matrix * system.solution;
  return solve_recycled(
      Vector::Constant(2, t), tolerance, recycled,
      [&](const Vector &guess) { return Vector(right - system.matrix * guess); },
      [&](const Vector &direction) {
        ++count.applications;
        return Vector(system.matrix * direction);
      },
      [&] {
        ++count.builds;
        return system.matrix;
      });
}

} // namespace

BOOST_AUTO_TEST_SUITE(recycled_solver)

// Along a smooth path one inverse serves all systems, and the continued solutions leave less to correct.
BOOST_AUTO_TEST_CASE(one_inverse_serves_a_path) {
  Recycled recycled;
  Count count;
  for (int k = 0; k < 12; ++k)
    BOOST_TEST((solved(0.01 * k, 1e-12, recycled, count) - system_at(0.01 * k).solution).norm() < 1e-10);
  BOOST_TEST(count.builds == 1);
  Count unaided;
  for (int k = 0; k < 12; ++k) {
    Recycled old{recycled.inverse, {}, {}};
    solved(0.01 * k, 1e-12, old, unaided);
  }
  BOOST_TEST(count.applications < unaided.applications);
  Count again;
  solved(0.11, 1e-6, recycled, again); // the same system: nothing to correct
  BOOST_TEST(again.applications == 0);
}

// A path that the solutions follow linearly is continued exactly.
BOOST_AUTO_TEST_CASE(continuation_is_linear) {
  Recycled recycled;
  const auto position = [](double t) { return Vector{{t, 1 - 2 * t, t + 0.5}}; };
  const auto solution = [](double t) { return Vector{{3 * t, 2 - t}}; };
  for (const double t : {0.0, 0.1, 0.25})
    remember_solution(position(t), solution(t), recycled);
  BOOST_TEST((continued_solution(recycled, position(0.4)) - solution(0.4)).norm() < 1e-12);
  // Too far to go on like that: the last one.
  BOOST_TEST((continued_solution(recycled, position(100)) - solution(0.25)).norm() == 0);
}

BOOST_AUTO_TEST_CASE(far_away_a_fresh_inverse_is_made) {
  Recycled recycled;
  Count count;
  solved(0, 1e-12, recycled, count);
  BOOST_TEST((solved(2, 1e-12, recycled, count) - system_at(2).solution).norm() < 1e-10);
  BOOST_TEST(count.builds == 2);
}

BOOST_AUTO_TEST_CASE(what_has_no_solution_is_a_failure) {
  const auto unresolved = [](const NumericsFailure &failure) { return failure.kind == "unresolved"; };
  BOOST_CHECK_EXCEPTION(inverse_of(Matrix::Zero(3, 3)), NumericsFailure, unresolved);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  Recycled recycled;
  BOOST_CHECK_EXCEPTION(solve_recycled(
                            Vector::Zero(2), 1e-10, recycled,
                            [&](const Vector & /*guess*/) {
                              return Vector(Vector{{nan, 1}});
                            },
                            [](const Vector &direction) { return direction; },
                            [] { return Matrix(Matrix::Identity(2, 2)); }),
                        NumericsFailure, unresolved);
}

BOOST_AUTO_TEST_SUITE_END()
