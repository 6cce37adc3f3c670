#pragma once
// The command `capsule keys`: keys of a case file, with their meaning, their default and what is allowed.
#include "program/exit_code.hpp"
#include <string>

namespace capsule {

// Those that have the word in their name or their meaning, or are called so by a symbol; all, if it is empty. Throws InputError
// if there is none.
ExitCode list_keys(const std::string &word);

} // namespace capsule
