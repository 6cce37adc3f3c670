#pragma once
// The commands of the program. Each does what it was asked for and returns the exit code. They throw InputError,
// FileError and NumericsFailure.
#include "program/case_runs.hpp"
#include "program/exit_code.hpp"
#include <string>
#include <vector>

namespace capsule {

// What they are given; each looks at its own part.
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
  std::vector<std::string> profiles; // contours to fit: files, or directories of them
  bool together = false;             // all of one capsule
};

// Compute the runs of a case that are not finished yet: in time, their steady states, branches of steady states.
ExitCode run_case(const Arguments &arguments);
ExitCode find_steady_states(const Arguments &arguments);
ExitCode follow_branches(const Arguments &arguments);
// Fits the unknowns of a case to measured contours.
ExitCode fit_case(const Arguments &arguments);
// Computes what is missing and compares with expected values.
ExitCode check_case(const Arguments &arguments);
// The same for all cases that the table of published values speaks of; writes the ledger.
ExitCode write_ledger(const Arguments &arguments);
// Prints the resolved input of every run, and what there is of it.
ExitCode show_case(const Arguments &arguments);
// Makes cases/<id> from another case.
ExitCode create_case(const std::string &id, const std::string &like);

// One line about marches that ended in the pore before they were steady: their membranes still move faster, relative to
// their centre, than the accuracy that was asked for. Empty if there are none.
std::string unsteady_remark(const std::vector<RunResult> &results);

} // namespace capsule
