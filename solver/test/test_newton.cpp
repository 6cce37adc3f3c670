// Broyden's update on equations with a known solution, from the matrix of a place nearby.
#include "steady/newton.hpp"
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <vector>

using namespace capsule;

namespace {

// Zero at (1, 2, 3).
Vector equations(const Vector &y) {
  return Vector{{y[0] * y[1] - 2, std::exp(y[0] - 1) + y[2] - 4, y[1] * y[1] + y[2] * y[0] - 7}};
}

Matrix slopes_at(const Vector &y) {
  Matrix slopes(3, 3);
  slopes << y[1], y[0], 0, std::exp(y[0] - 1), 0, 1, y[2], 2 * y[1], y[0];
  return slopes;
}

double error_of(const Vector &y) {
  return std::hypot(y[0] - 1, y[1] - 2, y[2] - 3);
}

} // namespace

BOOST_AUTO_TEST_SUITE(newton)

// With a matrix that is wrong by a tenth or more, plain corrections shrink by a constant ratio. With the update the ratio itself
// shrinks, and in 2 n corrections a linear problem would be solved (Gay 1979).
BOOST_AUTO_TEST_CASE(broydens_corrections_shrink_faster_and_faster) {
  const Matrix nearby = slopes_at(Vector{{1.15, 1.9, 2.8}});
  Vector plain{{1.02, 1.97, 3.01}}, mended = plain;
  BroydenCorrections corrections(nearby.partialPivLu());
  std::vector<double> errors_plain, errors_mended;
  for (int k = 0; k < 9; ++k) {
    plain -= nearby.partialPivLu().solve(equations(plain));
    mended += corrections.next(equations(mended));
    errors_plain.push_back(error_of(plain));
    errors_mended.push_back(error_of(mended));
  }
  BOOST_TEST(errors_mended[8] < 1e-12);
  BOOST_TEST(errors_mended[8] < 1e-3 * errors_plain[8]);
}

BOOST_AUTO_TEST_CASE(the_matrix_itself_stays) {
  const Matrix nearby = slopes_at(Vector{{1, 2, 3}});
  BroydenCorrections corrections(nearby.partialPivLu());
  const Vector right{{1, 2, -1}};
  corrections.next(equations(right));
  const Vector made = nearby * corrections.solve(right);
  for (Eigen::Index k = 0; k < 3; ++k)
    BOOST_TEST(std::abs(made[k] - right[k]) < 1e-12);
}

BOOST_AUTO_TEST_SUITE_END()
