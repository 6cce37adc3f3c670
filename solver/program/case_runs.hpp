#pragma once
// The runs of a case, from their input to their files: what is finished is used again, what was interrupted
// goes on, the rest is computed, several at a time. A run's files are the same whatever happened on the way,
// except for run.json and the seconds in summary.json.
#include "case/case_file.hpp"
#include "observe/outcome.hpp"
#include "output/run_result.hpp"
#include <functional>
#include <vector>

namespace capsule {

// What computes a run: `march`, or what finds steady states.
using March = std::function<Outcome(const Case &, const Checkpoint &, const Control &)>;

struct RunOptions {
  // Results go to directory/summary.json, or to directory/<name of the run>/summary.json with a sweep.
  // Without a pool, finished runs there are used again if their input is the same, whatever version
  // of the program made them.
  std::filesystem::path directory;
  // Runs that several cases share are computed in pool/<identity> and appear in `directory` too; empty:
  // computed there.
  std::filesystem::path pool = {};
  Task task = {};
  unsigned jobs = 1;  // more than one: each run in a process of its own
  bool fresh = false; // neither use finished runs nor checkpoints
  bool on_a_terminal = false;
  double seconds_between_checkpoints = 0.5;
  std::function<bool()> stop = [] { return false; }; // asked after each step
};

// directory/runs.txt: the directories of all runs, in the case's order and relative to that one; "." is a run
// without a name. Throws FileError.
void write_run_list(const CaseInput &input, const RunOptions &options);

// In the order of the case's runs. Waits for runs that another process computes at the moment. Throws
// FileError, and an InputError of one run after the others have been computed.
std::vector<RunResult> compute(const CaseInput &input, const RunOptions &options, const March &march);

// What there is of a run before it is computed.
struct RunState {
  bool finished = false;
  std::string ending;  // "reached", "failed: wrinkled"; empty unless finished
  double fraction = 0; // of an interrupted one
  double cpu_seconds = 0;
};
RunState state_of(const RunInput &run, const RunOptions &options);

// One line about marches whose membranes move faster relative to their centre, when they end, than the accuracy that was
// asked for, in the pore: what they end with is not the steady state to it. Empty if there are none.
std::string unsteady_remark(const std::vector<RunResult> &results);

} // namespace capsule
