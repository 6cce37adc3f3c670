#pragma once
// A linear system that changes with a shape and is solved again and again: the inverse of an earlier matrix
// turns the new system into a few corrections, and the last solutions, continued to the new shape, are the
// first guess. Throws NumericsFailure("unresolved") if the matrix is singular or the corrections do not
// converge with a fresh inverse either.
#include "base/failure.hpp"
#include "base/linear_algebra.hpp"
#include <vector>

namespace capsule {

// What is reused from earlier shapes. Empty at the start; the solution is the same with any, to the tolerance.
struct Recycled {
  Matrix inverse;
  std::vector<Vector> positions, solutions; // the latest first
};

// Of a flow: of its velocity, and of the second route to the pressure drop.
struct RecycledFlow {
  Recycled velocity, traction;
};

// Throws if the matrix is singular.
Matrix inverse_of(const Matrix &system);
// The solution at a position, from the last ones along a smooth path of shapes: one at least.
Vector continued_solution(const Recycled &recycled, const Vector &position);
void remember_solution(const Vector &position, const Vector &solution, Recycled &recycled);
NumericsFailure not_converged();

// Generalised conjugate residuals from a guess, whose residual is given. False if the corrections do not end.
//   tolerance     of the solution, relative to its largest component
//   precondition  nearly the error from a residual
//   apply         the matrix to a vector
template <class Precondition, class Apply>
bool conjugate_residuals(double tolerance, Vector residual, Vector &solution,
                         const Precondition &precondition, const Apply &apply) {
  constexpr int most_corrections = 10; // a fresh inverse costs some tens of them
  std::vector<Vector> directions, images;
  for (int k = 0; k <= most_corrections; ++k) {
    Vector direction = precondition(residual);
    if (direction.cwiseAbs().maxCoeff<Eigen::PropagateNaN>() <= tolerance * solution.cwiseAbs().maxCoeff()) {
      solution += direction;
      return true;
    }
    Vector image = apply(direction);
    for (std::size_t j = 0; j < images.size(); ++j) {
      const double share = images[j].dot(image);
      image -= share * images[j];
      direction -= share * directions[j];
    }
    const double norm = image.norm();
    if (!(norm > 0)) // or not a number: the preconditioner is of no use
      return false;
    images.push_back(image / norm);
    directions.push_back(direction / norm);
    const double share = images.back().dot(residual);
    solution += share * directions.back();
    residual -= share * images.back();
  }
  return false;
}

// The same, preconditioned with the earlier inverse, or else with a fresh one.
//   residual_of   a guess
//   matrix        all of it, for a fresh inverse
template <class Residual, class Apply, class Build>
Vector solve_recycled(const Vector &position, double tolerance, Recycled &recycled,
                      const Residual &residual_of, const Apply &apply, const Build &matrix) {
  if (recycled.inverse.size() == 0)
    recycled.inverse = inverse_of(matrix());
  Vector solution = recycled.positions.empty() ? Vector::Zero(recycled.inverse.rows())
                                               : continued_solution(recycled, position);
  const auto precondition = [&](const Vector &residual) { return Vector(recycled.inverse * residual); };
  for (const bool fresh : {false, true}) {
    if (fresh)
      recycled.inverse = inverse_of(matrix());
    if (conjugate_residuals(tolerance, residual_of(solution), solution, precondition, apply)) {
      remember_solution(position, solution, recycled);
      return solution;
    }
  }
  throw not_converged();
}

} // namespace capsule
