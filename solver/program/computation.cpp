#include "program/computation.hpp"
#include "base/failure.hpp"
#include "base/text.hpp"
#include "case/keys.hpp"
#include "case/physical.hpp"
#include "case/project.hpp"
#include <algorithm>
#include <atomic>
#include <chrono>
#include <csignal>
#include <fmt/format.h>
#include <unistd.h>

namespace capsule {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

// The only thing that a signal's handler may touch.
std::atomic<bool> signal_came = false;

// results/<case> for marches, results/<case>/steady and results/<case>/branch for steady states. `taken`: the pool's place.
fs::path usual_place(const fs::path &results, const fs::path &taken, const CaseInput &input,
                     const Task &task) {
  if (results / input.name == taken)
    throw InputError(
        fmt::format("error: '{}' holds the runs of all cases: call the case '{}' otherwise, or give --out\n",
                    taken.string(), input.name));
  return task.motion ? results / input.name : results / input.name / task.name.substr(0, task.name.find(' '));
}

// The run whose liquid has the largest Reynolds number, if that is not small.
void warn_of_inertia(const CaseInput &input) {
  const RunInput *fastest = nullptr;
  for (const RunInput &run : input.runs)
    if (has_physical(run.physics) && !is_inertia_small(run.physics) &&
        (fastest == nullptr || reynolds_number(run.physics) > reynolds_number(fastest->physics)))
      fastest = &run;
  if (fastest != nullptr)
    fmt::print(stderr, "warning: {}: {}\n", name_of(*fastest, input), reynolds_text(fastest->physics));
}

} // namespace

std::string strong_flow_remark(const CaseInput &input) {
  constexpr double strong = 1e3;
  double strongest = 0;
  for (const RunInput &run : input.runs)
    for (const Case *capsule : capsules_of(run.physics))
      strongest = std::max(strongest, capsule->flow.capillary_number);
  return strongest <= strong ? ""
                             : fmt::format("{} = {:.3g}: the flow is that much stronger than the membrane; "
                                           "is a unit wrong?",
                                           flow_key, strongest);
}

void listen_to_signals() {
  struct sigaction action {};
  action.sa_handler = [](int) { signal_came = true; };
  action.sa_flags = static_cast<int>(SA_RESETHAND);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

CaseInput read_case_of(const Arguments &arguments, const Task &task) {
  try {
    return read_case(arguments.path, arguments.overrides, task);
  } catch (const InputError &error) {
    std::error_code ignored;
    if (fs::exists(arguments.path, ignored))
      throw;
    const fs::path path = fs::path(arguments.path);
    const fs::path name = path.has_filename() ? path.filename() : path.parent_path().filename();
    const fs::path near = nearest_project_case("", name.string());
    throw InputError(near.empty() ? error.what()
                                  : fmt::format("{}did you mean '{}'?\n", error.what(), near.string()));
  }
}

RunOptions run_options(const Arguments &arguments, const CaseInput &input, const Task &task) {
  const fs::path results = "results", pool = results / "runs";
  RunOptions options;
  options.directory =
      arguments.out.empty() ? usual_place(results, pool, input, task) : fs::path(arguments.out);
  options.pool = arguments.out.empty() ? pool : fs::path();
  options.task = task;
  options.jobs = arguments.jobs;
  options.fresh = arguments.fresh;
  options.on_a_terminal = isatty(STDERR_FILENO) == 1;
  const Clock::time_point began = Clock::now();
  options.stop = [began, limit = arguments.time_limit] {
    return signal_came || (limit > 0 && std::chrono::duration<double>(Clock::now() - began).count() > limit);
  };
  return options;
}

bool is_interrupted(const RunResult &result) {
  return !result.summary;
}

bool has_failed(const RunResult &result) {
  return result.summary && result.summary->status == word_of(Status::failed);
}

std::vector<RunResult> compute_case(const CaseInput &input, const Arguments &arguments,
                                    const Computation &computation) {
  listen_to_signals();
  warn_of_inertia(input);
  if (const std::string strong = strong_flow_remark(input); !strong.empty())
    fmt::print(stderr, "warning: {}: {}\n", input.name, strong);
  const RunOptions options = run_options(arguments, input, computation.task);
  std::vector<RunResult> results = compute(input, options, computation.method);
  for (const RunResult &result : results)
    if (result.summary && !result.summary->message.empty())
      fmt::print(stderr, "{}: {}{}\n", result.directory.string(),
                 has_failed(result) ? result.summary->failure + ": " : "", result.summary->message);
  if (const auto unfinished = std::ranges::count_if(results, is_interrupted); unfinished > 0)
    fmt::print(stderr, "interrupted: {} of {} to finish; the same command {}\n", unfinished,
               counted(results.size(), "run"),
               options.task.motion ? "goes on from the last checkpoint" : "begins with them again");
  return results;
}

} // namespace capsule
