#pragma once
// The commands of the program. Each does what it was asked for and returns the exit code. They throw InputError,
// FileError and NumericsFailure.
#include "program/computation.hpp"
#include "program/exit_code.hpp"
#include <string>
#include <vector>

namespace capsule {

// Compute the runs of a case that are not finished yet: in time, their steady states, branches of steady states.
ExitCode run_case(const Arguments &arguments);
ExitCode find_steady_states(const Arguments &arguments);
ExitCode follow_branches(const Arguments &arguments);
// Fits the unknowns of a case to measured contours.
ExitCode fit_case(const Arguments &arguments);
// Prints the resolved input of every run, and what there is of it.
ExitCode show_case(const Arguments &arguments);
// Makes cases/<id> from another case.
ExitCode create_case(const std::string &id, const std::string &like);

} // namespace capsule
