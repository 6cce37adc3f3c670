#pragma once
// From a shape that is too far off for Newton's method, the way that it takes itself in the tube with equal viscosities:
// implicit steps in time, which get longer as the motion dies away, until they are Newton's.
#include "observe/outcome.hpp"
#include "steady/steady_system.hpp"

namespace capsule {

// Unknowns near to a steady state of the system, to which the shape relaxes. Throws NumericsFailure("unresolved") where
// the shape does not come to rest, Interrupted.
Vector relaxed(SteadySystem &system, Vector shape, const Control &control);

} // namespace capsule
