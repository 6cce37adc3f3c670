#include "steady/newton.hpp"
#include "base/failure.hpp"
#include <cmath>

namespace capsule {

Vector solve_steady(SteadySystem &system, Vector guess) {
  constexpr double farthest = 3; // that a guess can be from a solution
  const Eigen::Index n2 = 2 * system.nodes();
  double before = 0;
  for (int iteration = 0; iteration < most_iterations; ++iteration) {
    system.fit_tube(guess);
    const SteadySystem::Linearisation linear = system.linearise(guess);
    const Vector change = linear.jacobian.partialPivLu().solve(-linear.residual);
    const double step = system.admissible_step(guess, change);
    const double length = change.head(n2).cwiseAbs().maxCoeff();
    if (!(length < farthest) || (iteration > 10 && !contracts(iteration, before, length)))
      no_convergence();
    guess += step * change;
    if (step == 1 && length < position_tolerance)
      return guess;
    before = length;
  }
  no_convergence();
}

bool contracts(int iteration, double before, double now) {
  return std::isfinite(now) && (iteration < 2 || now < 0.7 * before);
}

void no_convergence() {
  throw NumericsFailure("unresolved", "Newton's method does not converge",
                        "try a finer mesh.membrane or a larger membrane.bending_ratio");
}

} // namespace capsule
