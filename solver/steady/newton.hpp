#pragma once
// Newton's method for the equations of steady_system.hpp at given parameters.
#include "base/failure.hpp"
#include "steady/steady_system.hpp"
#include <optional>
#include <utility>
#include <vector>

namespace capsule {

// A steady state is found when the next correction would move no node further than this.
constexpr double position_tolerance = 1e-9;
constexpr int most_iterations = 25;

// The steady state next to a guess, at the parameters that the system has. Throws NumericsFailure: "unresolved" if
// Newton's method does not converge, or what is wrong with a shape on the way. Of a state nearby the factors of the slopes
// may be given.
Vector solve_steady(SteadySystem &system, Vector guess,
                    std::optional<Eigen::PartialPivLU<Matrix>> factors = std::nullopt);

// For any iteration of Newton's method: whether it can still converge after corrections of these lengths, one after
// the other; and what is thrown if not.
bool contracts(int iteration, double before, double now);
[[noreturn]] void no_convergence();

// Corrections one after another, all by one matrix that Broyden's good update mends: it learns from each correction what that
// did to the residual (C. T. Kelley, Iterative Methods for Linear and Nonlinear Equations, SIAM 1995, section 7.3). Each
// correction that it gives is to be made as a whole. None follows one that is zero.
class BroydenCorrections {
public:
  explicit BroydenCorrections(Eigen::PartialPivLU<Matrix> factors) : factors_(std::move(factors)) {}
  // At the point that the corrections before have led to.
  Vector next(const Vector &residual);
  // With the matrix as it was given.
  Vector solve(const Vector &right) const { return lu_solve(factors_, right); }

private:
  Eigen::PartialPivLU<Matrix> factors_;
  std::vector<Vector> made_;
};

// Halves a step until one can be taken: `take` says whether it was, and throws NumericsFailure where there is no solution.
// Throws where the smallest step fails.
template <class Take>
void take_step(double &step, double smallest, const Take &take) {
  for (;;) {
    try {
      if (take())
        return;
    } catch (const NumericsFailure &) {
      if (step < 2 * smallest)
        throw;
    }
    step /= 2;
    if (step < smallest)
      no_convergence();
  }
}

} // namespace capsule
