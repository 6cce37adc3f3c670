#pragma once
// What the values of one run must be to each other: the step of a scheme, what each preset and each flow can
// compute, and a capsule that fits into the pore from its start to its end. A value alone is checked by its key,
// whether a key means something by case_file. Throws nothing: errors become complaints.
#include "case/chosen.hpp"
#include "case/task.hpp"

namespace capsule {

// Complains at the places of the values.
void check_together(const Chosen &chosen, const Case &physics, const Task &task);
// What several capsules must be to each other and to the case.
void check_capsules(const Chosen &chosen, const Case &physics, const Task &task);

} // namespace capsule
