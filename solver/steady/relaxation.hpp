#pragma once
// Where a shape is too far off for Newton's method: its motion in the tube with equal viscosities, in implicit steps of
// time. They get longer as the motion dies away; the last ones are Newton's.
#include "observe/outcome.hpp"
#include "steady/mesh_change.hpp"

namespace capsule {

// Unknowns near to a steady state of the system, to which the shape relaxes. Throws NumericsFailure: "unresolved" where
// the shape does not come to rest, "unbounded" where it stretches without end, "softening" where its law does on the way; Interrupted.
Vector relaxed(SteadySystem &system, Vector shape, const Control &control);

// The case with a membrane that is stiff enough to relax. Softer shells buckle on the way to a shape that does not.
Case with_stiff_membrane(Case input);

// The capsule let loose in the tube: undeformed, or squeezed if it is wider than this. Throws as `relaxed` does.
inline constexpr double widest_unsqueezed = 0.85;
SteadyState let_loose(const Case &input, const Control &control);

} // namespace capsule
