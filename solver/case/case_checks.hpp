#pragma once
// What the values of one run must be to each other: the scheme's step and tolerance, what each preset and each flow can
// compute, and a capsule that fits into the pore from its start to its end. A value alone is checked by its key.
#include "case/case_reader.hpp"
#include "case/task.hpp"

namespace capsule {

// Complains at the places of the values, and clears those that mean nothing to this run of a sweep.
void check_together(const Chosen &chosen, Case &physics, const Task &task);

} // namespace capsule
