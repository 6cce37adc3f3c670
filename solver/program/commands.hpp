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

// One line about marches that ended in the pore before they were steady: their membranes still move faster, relative to
// their centre, than the accuracy that was asked for. Empty if there are none.
std::string unsteady_remark(const std::vector<RunResult> &results);

// One line about marches whose two routes to the pressure drop differ at the end by more than a hundredth, as where the end of
// the tube is near: the outlet is taken for a Poiseuille flow, and both marches of an estimate err alike. Empty if none does.
std::string outlet_remark(const std::vector<RunResult> &results);

// One line about marches in which the membrane wrinkled, with at least three dents at once, from where to where, and that
// their error estimates are no bounds there. Empty if none did. Throws as read_columns (base/csv.hpp).
std::string wrinkle_remark(const std::vector<RunResult> &results);

} // namespace capsule
