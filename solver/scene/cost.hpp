#pragma once
// What a whole run costs, in seconds on one core, from runs that were measured on one server: good to a factor of three.
#include "case/case.hpp"

namespace capsule {

double estimated_seconds(const Case &physics);

} // namespace capsule
