#include "steady/newton.hpp"
#include "base/failure.hpp"
#include <algorithm>
#include <cmath>

namespace capsule {

// A matrix is kept while corrections shrink fast with it: a residual costs a small part of a linearisation. What is left
// after a correction is about the next one, which the last ratio tells.
Vector solve_steady(SteadySystem &system, Vector guess, std::optional<Eigen::PartialPivLU<Matrix>> factors) {
  constexpr double farthest = 3; // that a guess can be from a solution
  constexpr double near = 1e-2;  // after a correction as small the matrix may do for the next one
  constexpr double fast = 0.1;   // ratio of corrections with the same matrix
  const Eigen::Index n2 = 2 * system.nodes();
  double before = 1;
  for (int iteration = 0; iteration < most_iterations; ++iteration) {
    system.fit_tube(guess);
    Vector residual;
    if (factors) {
      residual = system.residual(guess);
    } else {
      const SteadySystem::Linearisation linear = system.linearise(guess);
      residual = linear.residual;
      factors.emplace(linear.jacobian);
    }
    const Vector change = lu_solve(*factors, Vector(-residual));
    const double step = system.admissible_step(guess, change);
    const double length = change.head(n2).cwiseAbs().maxCoeff();
    if (!(length < farthest) || (iteration > 10 && !contracts(iteration, before, length)))
      no_convergence();
    const double ratio = length / before;
    guess += step * change;
    if (step == 1 && length * std::min(ratio, 1.0) < position_tolerance)
      return guess;
    if (length > near || ratio > fast)
      factors.reset();
    before = length;
  }
  no_convergence();
}

Vector BroydenCorrections::next(const Vector &residual) {
  Vector correction = lu_solve(factors_, Vector(-residual));
  for (std::size_t k = 0; k + 1 < made_.size(); ++k)
    correction += made_[k].dot(correction) / made_[k].squaredNorm() * made_[k + 1];
  if (!made_.empty())
    correction /= 1 - made_.back().dot(correction) / made_.back().squaredNorm();
  made_.push_back(correction);
  return correction;
}

bool contracts(int iteration, double before, double now) {
  return std::isfinite(now) && (iteration < 2 || now < 0.7 * before);
}

void no_convergence() {
  throw NumericsFailure(failure_kind::unresolved, "Newton's method does not converge",
                        "try a finer mesh.membrane or a larger membrane.bending_ratio");
}

} // namespace capsule
