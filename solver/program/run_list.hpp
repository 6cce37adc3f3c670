#pragma once
// directory/runs.txt: the directories of all runs of a case, in the case's order and relative to that one; "." is a run
// without a name.
#include <filesystem>

namespace capsule {

struct CaseInput;

// Throws FileError, also where there is a runs.txt that is no list of runs.
void write_run_list(const CaseInput &input, const std::filesystem::path &directory);

} // namespace capsule
