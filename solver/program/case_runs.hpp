#pragma once
// The runs of a case, from their input to their files. Finished runs are used again, interrupted ones go on, the others
// are computed, several at a time. A run's files are the same whatever interrupted it, except for run.json and the
// seconds in summary.json.
#include "case/case_file.hpp"
#include "observe/outcome.hpp"
#include "output/run_result.hpp"
#include <functional>
#include <vector>

namespace capsule {

// What computes a run: the march in time (motion.hpp), or a search for steady states.
using Method = std::function<Outcome(const Case &, const Checkpoint &, const Control &)>;

struct RunOptions {
  // Results go to directory/summary.json, of a sweep to directory/<name of the run>/summary.json.
  std::filesystem::path directory;
  // Runs are computed in pool/<identity>, where other cases find them, and appear in `directory`, too; empty: they are
  // computed in `directory`. Runs in the pool are used again if program and input are the same, those in `directory` if
  // the input is the same, whatever version of the program made them.
  std::filesystem::path pool = {};
  Task task = {};
  unsigned jobs = 1;  // more than one: each run in a process of its own
  bool fresh = false; // use neither finished runs nor checkpoints
  bool on_a_terminal = false;
  double seconds_between_checkpoints = 0.5;          // at least
  std::function<bool()> stop = [] { return false; }; // asked after each step
};

// All runs, in the case's order. Waits for runs that another process is computing. A run that cannot be computed stops no
// other: once they have ended it is thrown, FileError before std::runtime_error (memory) before InputError, unless some
// were interrupted.
std::vector<RunResult> compute(const CaseInput &input, const RunOptions &options, const Method &method);

// What messages call a run: its name, or the case's where it has none.
std::string name_of(const RunInput &run, const CaseInput &input);

// What there is of a run.
struct RunState {
  bool finished = false;
  std::string ending;  // "reached", "failed: wrinkled"; empty unless finished
  double fraction = 0; // of an interrupted one
  double cpu_seconds = 0;
};
RunState state_of(const RunInput &run, const RunOptions &options);

} // namespace capsule
