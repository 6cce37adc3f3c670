#pragma once
// What is to be said of runs that were computed, one line for all runs of a case. Empty where there is nothing to say.
#include "output/run_result.hpp"
#include <string>
#include <vector>

namespace capsule {

// Marches that ended in the pore before they were steady: their membranes still move faster, relative to their centre, than
// the accuracy that was asked for.
std::string unsteady_remark(const std::vector<RunResult> &results);

// Marches whose two routes to the pressure drop differ at the end by more than a hundredth, as where the end of the tube is
// near: the outlet is taken for a Poiseuille flow, and both marches of an estimate err alike.
std::string outlet_remark(const std::vector<RunResult> &results);

// Marches in which the membrane wrinkled, with at least three dents at once, from where to where, and that their error
// estimates are no bounds there. Throws as read_columns (base/csv.hpp).
std::string wrinkle_remark(const std::vector<RunResult> &results);

// Steady states, also those of a branch, of a membrane that is strained beyond what it bears: only a
// march ends there. Throws as read_columns.
std::string bearing_remark(const std::vector<RunResult> &results);

} // namespace capsule
