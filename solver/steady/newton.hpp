#pragma once
// Newton's method for the equations of steady_system.hpp at given parameters.
#include "steady/steady_system.hpp"

namespace capsule {

// A steady state is found when the next correction would move no node further than this.
constexpr double position_tolerance = 1e-9;
constexpr int most_iterations = 25;

// The steady state next to a guess, at the parameters that the system has. Throws NumericsFailure: "unresolved" if
// Newton's method does not converge, or what is wrong with a shape on the way.
Vector solve_steady(SteadySystem &system, Vector guess);

// For any iteration of Newton's method: whether it can still converge after corrections of these lengths, one after
// the other; and what is thrown if not.
bool contracts(int iteration, double before, double now);
[[noreturn]] void no_convergence();

} // namespace capsule
