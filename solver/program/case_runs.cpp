#include "program/case_runs.hpp"
#include "base/atomic_file.hpp"
#include "base/directory_lock.hpp"
#include "base/failure.hpp"
#include "base/text.hpp"
#include "case/identity.hpp"
#include "case/physical.hpp"
#include "observe/quantities.hpp"
#include "output/checkpoint.hpp"
#include "output/results.hpp"
#include "program/progress.hpp"
#include "program/workers.hpp"
#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <exception>
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <fstream>
#include <new>
#include <sstream>
#include <thread>

namespace capsule {
namespace {

namespace fs = std::filesystem;

double thread_seconds() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

double wall_seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

// What was spent before, and what this thread has spent since.
struct Stopwatch {
  Effort before;
  double cpu_at_start = thread_seconds();
  double wall_at_start = wall_seconds();

  Effort effort() const {
    return {before.started, before.cpu_seconds + thread_seconds() - cpu_at_start,
            before.wall_seconds + wall_seconds() - wall_at_start};
  }
};

fs::path directory_of(const RunInput &run, const RunOptions &options) {
  return run.name.empty() ? options.directory : options.directory / run.name;
}

// Where a run is computed and looked for.
fs::path home_of(const RunInput &run, const RunOptions &options) {
  return options.pool.empty() ? directory_of(run, options)
                              : options.pool / run_identity(run.physics, options.task);
}

// Runs in the pool are matched by program and input, those in the user's directory by input alone.
bool is_there(const RunInput &run, const RunOptions &options) {
  const fs::path home = home_of(run, options);
  return options.pool.empty() ? is_finished_input(home, run.physics, options.task)
                              : is_finished(home, run_identity(run.physics, options.task));
}

// How a run ended.
enum RunEnd { interrupted, computed, found };

// What is told of a run's end: labels and quantities.
std::vector<std::pair<std::string, std::string>> told_quantities(const Summary &summary) {
  std::vector<std::pair<std::string, std::string>> told;
  if (!summary.along.empty())
    told.emplace_back(summary.along, "time"); // on a branch the key takes the place of the time
  else if (summary.status != "steady")
    told = {{"t", "time"}, {"x_g", "x_g"}};
  told.insert(told.end(), {{"v_g", "v_g"}, {"pressure drop", "pressure_drop"}});
  return told;
}

// The same in SI units, on a line of its own, where the case has them.
std::string report_in_si(const RunResult &result) {
  const Summary &summary = *result.summary;
  if (!has_physical(result.input.physics) || !summary.along.empty())
    return "";
  const Scales scales = physical_scales(result.input.physics);
  std::string text = "\n  in SI units:";
  for (const auto &[label, name] : told_quantities(summary)) {
    const auto value = summary.quantities.find(name);
    const auto quantity = std::ranges::find(reported_quantities(), name, &ReportedQuantity::name);
    if (value != summary.quantities.end() && quantity != reported_quantities().end() && quantity->unit)
      text += fmt::format("  {} {:.4g} {}", label, value->second * scales.*quantity->unit->scale,
                          unit_text(quantity->unit->dimension));
  }
  return text;
}

std::string report(const RunResult &result, const std::string &name, RunEnd end) {
  const Summary &summary = *result.summary;
  std::string text = fmt::format("{}: {}", name, summary.status);
  if (!summary.failure.empty())
    text += fmt::format(" ({})", summary.failure);
  const auto add = [&](const std::string &label, const std::string &quantity, int digits = 6) {
    if (const auto value = summary.quantities.find(quantity); value != summary.quantities.end())
      text += fmt::format("  {} {:.{}g}", label, value->second, digits);
  };
  for (const auto &[label, quantity] : told_quantities(summary))
    add(label, quantity);
  add("CPU seconds", "cpu_seconds", 3);
  return text +
         fmt::format("{}  -> {}", end == found ? " (computed before)" : "", result.directory.string()) +
         report_in_si(result);
}

// The runs of one case while they are computed.
struct CaseRuns {
  const CaseInput &input;
  const RunOptions &options;
  const Method &method;
  ProgressLine line;
  SharedState shared;
  std::vector<RunResult> results;

  CaseRuns(const CaseInput &input_, const RunOptions &options_, const Method &method_)
      : input(input_), options(options_), method(method_), line(options_.on_a_terminal),
        shared(input_.runs.size()) {
    for (const RunInput &run : input.runs)
      results.push_back({run, directory_of(run, options), std::nullopt});
  }

  bool stops() const { return shared.stops() || options.stop(); }

  bool wait_for(const DirectoryLock &lock, const RunInput &run) {
    for (bool told = false; !lock.acquire(); told = true) {
      if (!told)
        line.print(fmt::format("{}: another process computes this run or one in its place; waiting for it",
                               name_of(run, input)));
      if (stops())
        return false;
      std::this_thread::sleep_for(std::chrono::milliseconds(100));
    }
    return true;
  }

  // Says so if the results of another input or method are going to be replaced.
  void announce_replacement(const RunInput &run, const fs::path &place) {
    if (const std::string other = other_results(place, run.physics, options.task); !other.empty())
      line.print(fmt::format("{}: replaces {}", place.string(), other));
  }

  RunEnd compute_in(const fs::path &home, std::size_t index) {
    const RunInput &run = input.runs[index];
    const std::string identity = run_identity(run.physics, options.task);
    if (options.fresh)
      remove_checkpoint(home);
    const auto saved = read_checkpoint(home, identity);
    SavedRun latest = saved.value_or(SavedRun{});
    if (!saved)
      latest.effort.started = fmt::format("{:%FT%TZ}", fmt::gmtime(std::chrono::system_clock::now()));
    remove_results(home);

    const Stopwatch stopwatch{latest.effort};
    double written = wall_seconds();
    Control control;
    control.progress = [&](const SeriesRow &row, long steps) {
      Progress &progress = shared.progress(index);
      progress.time = row.time;
      progress.x_g = row.x_g;
      progress.steps = steps;
    };
    control.interrupted = [&] {
      show_progress();
      return stops();
    };
    control.save = [&](const Checkpoint &checkpoint) {
      latest.checkpoint = checkpoint;
      if (wall_seconds() - written < options.seconds_between_checkpoints)
        return;
      write_checkpoint(home, identity, {checkpoint, stopwatch.effort()});
      written = wall_seconds();
    };
    const Checkpoint from = latest.checkpoint;
    const Outcome outcome = [&] {
      try {
        return method(run.physics, from, control);
      } catch (const std::bad_alloc &) {
        throw std::runtime_error(
            fmt::format("{}: not enough memory; try fewer elements (mesh.membrane, mesh.wall) or "
                        "a looser accuracy",
                        name_of(run, input)));
      }
    }();
    if (outcome.status == Status::interrupted) {
      write_checkpoint(home, identity, {latest.checkpoint, stopwatch.effort()});
      return interrupted;
    }
    write_results(home, run.physics, outcome, stopwatch.effort(), options.task);
    return computed;
  }

  RunEnd compute_run(std::size_t index) {
    const RunInput &run = input.runs[index];
    const fs::path home = home_of(run, options);
    make_directories(home);
    const DirectoryLock lock(home);
    if (!wait_for(lock, run))
      return interrupted;
    const bool there = !options.fresh && is_there(run, options);
    if (!there && home == results[index].directory)
      announce_replacement(run, home);
    const RunEnd end = there ? found : compute_in(home, index);
    if (there)
      remove_checkpoint(home); // of a process that was killed when it was nearly done
    if (end == interrupted || home == results[index].directory)
      return end;
    make_directories(results[index].directory);
    const DirectoryLock place(results[index].directory);
    if (!wait_for(place, run))
      return interrupted;
    announce_replacement(run, results[index].directory);
    share_results(home, results[index].directory);
    return end;
  }

  void show_progress() {
    for (std::size_t i = 0; i < results.size(); ++i)
      if (const Progress &progress = shared.progress(i); progress.steps > 0)
        line.update(input.runs[i].name, input.runs[i].physics, progress.time, progress.x_g, progress.steps);
  }

  void finish(std::size_t index, RunEnd end) {
    shared.progress(index).steps = 0;
    line.finish(input.runs[index].name);
    if (end == interrupted)
      return;
    results[index].summary = read_summary(home_of(input.runs[index], options));
    if (!is_there(input.runs[index], options)) // then the summary may be another run's, too
      throw FileError(fmt::format("another process has overwritten '{}'; give each its own --out",
                                  results[index].directory.string()));
    line.print(report(results[index], name_of(input.runs[index], input), end));
  }

  void one_after_the_other() {
    std::exception_ptr bad_input;
    for (std::size_t i = 0; i < results.size() && !stops(); ++i)
      try {
        finish(i, compute_run(i));
      } catch (const InputError &) { // of this run alone
        if (!bad_input)
          bad_input = std::current_exception();
      }
    if (bad_input)
      std::rethrow_exception(bad_input);
  }

  void side_by_side() {
    const auto task = [&](std::size_t index) {
      line = ProgressLine(false); // the first process shows it
      return compute_run(index);
    };
    const auto watch = [&] {
      if (options.stop())
        shared.stop();
      show_progress();
    };
    const auto finished = [&](std::size_t index, int end) { finish(index, static_cast<RunEnd>(end)); };
    run_in_processes({results.size(), options.jobs, task, watch, finished}, shared);
  }
};

} // namespace

void write_run_list(const CaseInput &input, const RunOptions &options) {
  std::string text;
  for (const RunInput &run : input.runs)
    text += (run.name.empty() ? "." : run.name) + "\n";
  const fs::path file = options.directory / "runs.txt";
  std::ostringstream present;
  present << std::ifstream(file).rdbuf();
  if (present.str() == text) // then it need not be a place where files can be written
    return;
  make_directories(options.directory);
  write_atomically(file, text);
}

std::vector<RunResult> compute(const CaseInput &input, const RunOptions &options, const Method &method) {
  CaseRuns runs(input, options, method);
  if (options.jobs > 1 && input.runs.size() > 1)
    runs.side_by_side();
  else
    runs.one_after_the_other();
  return runs.results;
}

std::string name_of(const RunInput &run, const CaseInput &input) {
  return run.name.empty() ? input.name : run.name;
}

RunState state_of(const RunInput &run, const RunOptions &options) {
  const fs::path home = home_of(run, options);
  const std::string identity = run_identity(run.physics, options.task);
  if (is_there(run, options)) {
    const Summary summary = read_summary(home);
    const std::string ending = summary.status + (summary.failure.empty() ? "" : ": " + summary.failure);
    return {true, ending, 1, summary.quantities.at("cpu_seconds")};
  }
  const auto saved = read_checkpoint(home, identity);
  if (!saved)
    return {};
  const std::vector<SeriesRow> &series = saved->checkpoint.series;
  return {false, "", series.empty() ? 0 : fraction_done(run.physics, series.back().time, series.back().x_g),
          saved->effort.cpu_seconds};
}

} // namespace capsule
