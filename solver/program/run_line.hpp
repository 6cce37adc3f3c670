#pragma once
// What is told of a run that has ended, on standard output: how, its numbers, where its files are; and the same numbers in the
// case's own units on a line below, where it has any. Throws nothing.
#include "output/run_result.hpp"
#include <string>

namespace capsule {

// `name`: what the run is called by. Of a run with a summary.
std::string run_line(const RunResult &result, const std::string &name, bool computed_before);

} // namespace capsule
