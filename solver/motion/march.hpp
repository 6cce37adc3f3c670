#pragma once
// One march of a case, from a start or a checkpoint until the case's end or a reason to stop (stops.hpp). It can be saved
// after each step, and goes on from there bit by bit as if it had never been interrupted (step_memory.hpp). Failures of the
// numerics are in the outcome; throws InputError if the case's pore or start cannot be built.
#include "motion/stops.hpp"
#include "observe/outcome.hpp"

namespace capsule {

struct Case;

// The march that is asked for; the coarser one that it is compared with, which may wrinkle where the other does not.
enum class Role { main, companion };

// The main march ends as wrinkled where dents are rougher than the limit.
Outcome march_once(const Case &input, const Checkpoint &from, const Control &control, Role role,
                   double roughness_limit = wrinkle_roughness);

} // namespace capsule
