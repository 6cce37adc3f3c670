#include "flow/recycled_solver.hpp"
#include "base/decompositions.hpp"

namespace capsule {
namespace {

NumericsFailure unresolved(const char *what) {
  return {failure_kind::unresolved, what, "try a finer mesh.membrane"};
}

} // namespace

NumericsFailure not_converged() {
  return unresolved("the membrane's system does not converge");
}

Matrix inverse_of(const Matrix &system) {
  Matrix inverse = lu_inverse(system);
  if (!inverse.allFinite())
    throw unresolved("the membrane's system is singular");
  return inverse;
}

// The new shape as a combination of the last ones, by least squares; their solutions in the same combination.
// Far from them, the last solution is as good.
Vector continued_solution(const Recycled &recycled, const Vector &position) {
  constexpr double negligible = 1e-6; // of a step beside another one
  constexpr double far = 20;          // times the steps between the last shapes
  const auto count = static_cast<Eigen::Index>(recycled.positions.size()) - 1;
  if (count == 0)
    return recycled.solutions[0];
  Matrix steps(position.size(), count), changes(recycled.solutions[0].size(), count);
  for (Eigen::Index k = 0; k < count; ++k) {
    const auto earlier = static_cast<std::size_t>(k + 1);
    steps.col(k) = recycled.positions[earlier] - recycled.positions[0];
    changes.col(k) = recycled.solutions[earlier] - recycled.solutions[0];
  }
  const Vector shares = least_squares(steps, position - recycled.positions[0], negligible);
  if (!(shares.cwiseAbs().maxCoeff() < far)) // or not a number
    return recycled.solutions[0];
  return recycled.solutions[0] + changes * shares;
}

void remember_solution(const Vector &position, const Vector &solution, Recycled &recycled) {
  constexpr std::size_t kept = 4;
  recycled.positions.insert(recycled.positions.begin(), position);
  recycled.solutions.insert(recycled.solutions.begin(), solution);
  if (recycled.positions.size() > kept) {
    recycled.positions.pop_back();
    recycled.solutions.pop_back();
  }
}

} // namespace capsule
