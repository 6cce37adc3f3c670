#pragma once
// The motion of the capsule: state -> velocity -> state, from a start or a checkpoint until the case's end.
// What is computed depends on the case and the start alone: an interrupted march that goes on from its last
// checkpoint gives the same numbers as one that was never interrupted.
#include "case/case.hpp"
#include "observe/outcome.hpp"

namespace capsule {

Outcome march(const Case &physics, const Checkpoint &from, const Control &control);

} // namespace capsule
