#pragma once
// The motion of the capsule: state -> velocity -> state, from a start or a checkpoint until the case's end, with
// estimates of its errors from a second, coarser march. What is computed depends on the case and the start alone: an
// interrupted march that goes on from its last checkpoint gives the same numbers as one that was never interrupted.
#include "observe/outcome.hpp"

namespace capsule {

struct Case;

// Failures of the numerics are in the outcome. Throws InputError if the case's pore or start cannot be built.
Outcome march(const Case &input, const Checkpoint &from, const Control &control);

} // namespace capsule
