#pragma once
// The command `capsule fit`: contours of one capsule or of many, to fits of the case's unknowns. Of many, each begins with
// the fit of its neighbour in the list; they are computed in several processes, and what is finished is used again.
#include "program/case_runs.hpp"
#include "program/exit_code.hpp"

namespace capsule {

// `profiles` are files, or directories of them; `together`: they are one capsule, and one fit. Throws InputError and
// FileError.
ExitCode fit_profiles(const std::vector<std::string> &profiles, bool together, const CaseInput &input,
                      const RunOptions &options);

} // namespace capsule
