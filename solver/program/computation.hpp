#pragma once
// What the commands that compute have in common: a case as the command line names it, where its results go, and its runs
// with what is to be said of them. All throw InputError and FileError.
#include "motion/motion.hpp"
#include "program/case_runs.hpp"
#include <string>
#include <vector>

namespace capsule {

// What the command line gives; each command looks at its own part.
struct Arguments {
  std::string path;
  std::vector<std::string> overrides; // key=value
  std::string out;                    // directory of results; empty: results/<case>
  unsigned jobs = 1;
  bool fresh = false;
  double time_limit = 0;             // seconds; 0: none
  std::string table;                 // files of the comparison, without their endings
  bool list = false;                 // the runs, instead of computing them
  std::size_t only = 0;              // one run of a sweep, counted from 1; 0: all
  std::string from;                  // directory of a run whose last profile is near to the steady state
  std::string along;                 // the key that varies on a branch
  std::string to;                    // and where it goes
  std::string fold_along, fold_to;   // the same of the key along which its last fold is followed; or empty
  std::vector<std::string> profiles; // contours to fit: files, or directories of them
  bool together = false;             // all of one capsule
};

// What is computed of a case, and by what.
struct Computation {
  Task task = {};
  Method method = march;
};

// The first signal to end is noted, a second one ends the program at once.
void listen_to_signals();
// If there is no such case, the error suggests the project's case of this, or a similar, name.
CaseInput read_case_of(const Arguments &arguments, const Task &task = {});
RunOptions run_options(const Arguments &arguments, const CaseInput &input, const Task &task = {});

// On the run in the strongest flow, if no membrane resists that: most likely a unit is wrong. Empty if none is so strong.
std::string strong_flow_remark(const CaseInput &input);

// Computes what is not finished; says why runs failed, what else is to be known of them, and how many were interrupted.
std::vector<RunResult> compute_case(const CaseInput &input, const Arguments &arguments,
                                    const Computation &computation = {});
bool is_interrupted(const RunResult &result);
bool has_failed(const RunResult &result);

} // namespace capsule
