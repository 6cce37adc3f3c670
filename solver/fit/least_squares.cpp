#include "fit/least_squares.hpp"
#include "base/failure.hpp"
#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

namespace capsule {
namespace {

using Flags = Eigen::Array<bool, Eigen::Dynamic, 1>;

constexpr int most_failures = 6; // of steps, in all
constexpr double first_damping = 1e-3, least_damping = 1e-9, most_damping = 1e7;

// Parameters that may not move: fixed, or at a bound towards which they are drawn.
Flags blocked(const LeastSquares &problem, const Vector &parameters, const Vector &gradient) {
  return problem.low.array() == problem.high.array() ||
         (parameters.array() <= problem.low.array() && gradient.array() > 0) ||
         (parameters.array() >= problem.high.array() && gradient.array() < 0);
}

// The step with a damped matrix that lowers the model of the sum most, within the bounds: where it would leave them, it
// goes to the bound, and the other parameters go to their best places for that.
Vector step_of(const LeastSquares &problem, const Vector &parameters, const Matrix &matrix,
               const Vector &gradient, Flags still, double damping) {
  Matrix damped = matrix;
  damped.diagonal().array() += damping * matrix.diagonal().array().max(1e-300);
  Vector step = Vector::Zero(gradient.size());
  for (;;) {
    Matrix free = damped;
    Vector right = -gradient - damped * step; // `step` of those that are settled
    for (Eigen::Index j = 0; j < step.size(); ++j)
      if (still[j]) {
        free.row(j).setZero();
        free.col(j).setZero();
        free(j, j) = 1;
        right[j] = 0;
      }
    Vector whole = step + free.ldlt().solve(right);
    const Vector inside = (parameters + whole).cwiseMax(problem.low).cwiseMin(problem.high) - parameters;
    const Flags outside = !still && inside.array() != (parameters + whole).array() - parameters.array();
    if (!outside.any())
      return whole;
    for (Eigen::Index j = 0; j < step.size(); ++j)
      if (outside[j]) {
        step[j] = inside[j];
        still[j] = true;
      }
  }
}

double shortened(const Vector &step, const Vector &longest) {
  return 1 / std::max(1.0, (step.array() / longest.array()).abs().maxCoeff());
}

} // namespace

Minimum minimise(const LeastSquares &problem, const Vector &start) {
  Minimum best{start, problem.evaluate(start)};
  double damping = first_damping;
  int failures = 0;
  for (int k = 0; k < problem.most_steps && failures < most_failures && damping < most_damping; ++k) {
    const Matrix matrix = best.at.slopes.transpose() * best.at.slopes;
    const Vector gradient = best.at.slopes.transpose() * best.at.values;
    const Flags still = blocked(problem, best.parameters, gradient);
    Vector step = step_of(problem, best.parameters, matrix, gradient, still, damping);
    step *= shortened(step, problem.longest);
    const Vector next = (best.parameters + step).cwiseMax(problem.low).cwiseMin(problem.high);
    step = next - best.parameters;
    const double expected = -2 * gradient.dot(step) - step.dot(matrix * step);
    if (expected < problem.tolerance) {
      best.converged = best.failure.empty();
      return best;
    }
    std::optional<Residuals> there;
    try {
      there = problem.evaluate(next);
    } catch (const NumericsFailure &failure) {
      best.failure = failure.what();
      ++failures;
      damping = std::max(10 * damping, 1e-2);
      continue;
    }
    const double gained = (best.sum() - there->values.squaredNorm()) / expected;
    if (gained > 1e-3) {
      best = {next, std::move(*there)};
      damping = std::max(gained > 0.5 ? damping / 10 : damping, least_damping);
    } else if (std::abs(gained * expected) < 1e-12 * best.sum()) { // nothing but rounding
      best.converged = true;
      return best;
    } else
      damping = std::max(10 * damping, 1e-3);
  }
  return best;
}

Flags held(const LeastSquares &problem, const Minimum &minimum) {
  const Vector gradient = minimum.at.slopes.transpose() * minimum.at.values;
  return blocked(problem, minimum.parameters, gradient) && problem.low.array() != problem.high.array();
}

Matrix covariance(const LeastSquares &problem, const Residuals &at) {
  std::vector<Eigen::Index> free;
  for (Eigen::Index j = 0; j < problem.low.size(); ++j)
    if (problem.low[j] != problem.high[j])
      free.push_back(j);
  const Matrix slopes = at.slopes(Eigen::all, free);
  const Vector lengths = slopes.colwise().norm();
  const Matrix scaled = slopes * lengths.cwiseInverse().asDiagonal();
  const Matrix inverse = lu_inverse(Matrix(scaled.transpose() * scaled));
  Matrix result = Matrix::Zero(problem.low.size(), problem.low.size());
  result(free, free) = lengths.cwiseInverse().asDiagonal() * inverse * lengths.cwiseInverse().asDiagonal();
  return result;
}

} // namespace capsule
