#pragma once
// The command `capsule keys`: every key of a case file, with its meaning, its default and what is allowed. Throws nothing.
#include "program/exit_code.hpp"

namespace capsule {

ExitCode list_keys();

} // namespace capsule
