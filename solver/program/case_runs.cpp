#include "program/case_runs.hpp"
#include "base/atomic_file.hpp"
#include "base/directory_lock.hpp"
#include "base/failure.hpp"
#include "base/text.hpp"
#include "case/identity.hpp"
#include "case/keys.hpp"
#include "output/checkpoint.hpp"
#include "output/results.hpp"
#include "program/exit_code.hpp"
#include "program/progress.hpp"
#include "program/run_line.hpp"
#include "program/workers.hpp"
#include "steady/search.hpp"
#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <exception>
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <new>
#include <system_error>
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

// The runs of one case while they are computed.
struct CaseRuns {
  const CaseInput &input;
  const RunOptions &options;
  const Method &method;
  ProgressLine line;
  SharedState shared;
  std::vector<RunResult> results;
  std::vector<std::exception_ptr> lost; // what runs threw that have no result

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

  // Tells of files that were altered since a run has written them; they keep another name. Whether there are any.
  bool set_aside(const fs::path &directory) {
    const std::vector<fs::path> altered = set_aside_altered(directory);
    for (const fs::path &file : altered)
      line.warn(fmt::format("{}: altered since it was computed, and kept under this name\n", file.string()));
    return !altered.empty();
  }

  RunEnd compute_in(const fs::path &home, std::size_t index) {
    const RunInput &run = input.runs[index];
    const std::string identity = run_identity(run.physics, options.task);
    if (options.fresh)
      remove_checkpoint(home);
    const FoundCheckpoint found_there = read_checkpoint(home, identity);
    if (!found_there.damage.empty())
      line.warn(fmt::format("{}: the checkpoint in '{}' is damaged ({}): the run begins again\n",
                            name_of(run, input), home.string(), found_there.damage));
    SavedRun latest = found_there.run.value_or(SavedRun{});
    if (!found_there.run)
      latest.effort.started = fmt::format("{:%FT%TZ}", fmt::gmtime(std::chrono::system_clock::now()));
    remove_results(home);

    const Stopwatch stopwatch{latest.effort};
    constexpr double soon_written = 0.01; // seconds; where it takes longer, checkpoints are as much rarer
    double written = wall_seconds(), pause = options.seconds_between_checkpoints;
    Control control;
    control.progress = [&](const SeriesRow &row, long steps) {
      Progress &progress = shared.progress(index);
      progress.time = row.time;
      progress.x_g = row.x_g;
      progress.steps = steps;
    };
    control.spend = [&](double work) { shared.progress(index).work += work; };
    control.interrupted = [&] {
      show_progress();
      return stops();
    };
    control.wants_checkpoint = [&] { return wall_seconds() - written >= pause; };
    control.save = [&](const Checkpoint &checkpoint) {
      latest.checkpoint = checkpoint;
      if (!control.wants_checkpoint())
        return;
      const double begun = wall_seconds();
      write_checkpoint(home, identity, {checkpoint, stopwatch.effort()});
      written = wall_seconds();
      pause = options.seconds_between_checkpoints * std::max(1.0, (written - begun) / soon_written);
    };
    const Checkpoint from = latest.checkpoint;
    const Outcome outcome = [&] {
      try {
        return method(run.physics, from, control);
      } catch (const std::bad_alloc &) {
        throw std::runtime_error(
            "not enough memory; try fewer elements (mesh.membrane, mesh.wall) or a looser "
            "accuracy");
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
    const fs::path &place = results[index].directory;
    require_free(home);
    require_free(place);
    const bool altered = set_aside(home);
    const bool whole = !altered && (options.pool.empty() || is_complete(home));
    const bool there = !options.fresh && whole && is_there(run, options);
    if (!there && home == place)
      announce_replacement(run, home);
    const RunEnd end = there ? found : compute_in(home, index);
    if (there)
      remove_checkpoint(home); // of a process that was killed when it was nearly done
    if (end == interrupted || home == place)
      return end;
    make_directories(place);
    const DirectoryLock place_lock(place);
    if (!wait_for(place_lock, run))
      return interrupted;
    set_aside(place);
    announce_replacement(run, place);
    share_results(home, place);
    return end;
  }

  void show_progress() {
    for (std::size_t i = 0; i < results.size(); ++i) {
      const Progress &progress = shared.progress(i);
      const RunInput &run = input.runs[i];
      if (progress.steps > 0)
        line.update(run.name, run.physics, progress.time, progress.x_g, progress.steps);
      else if (progress.work > 0 && options.task.branch)
        line.update_branch(run.name, progress.work / most_work_of_search);
      else if (progress.work > 0)
        line.update_search(run.name, progress.work / most_work_of_search);
    }
  }

  void finish(std::size_t index, RunEnd end) {
    shared.progress(index).steps = 0;
    line.finish(input.runs[index].name);
    if (end == interrupted)
      return;
    Summary summary = read_summary(home_of(input.runs[index], options));
    if (!is_there(input.runs[index], options)) // then the summary may be another run's, too
      throw FileError(fmt::format("another process has overwritten '{}'; give each its own --out",
                                  results[index].directory.string()));
    results[index].summary = std::move(summary);
    line.print(run_line(results[index], name_of(input.runs[index], input), end == found));
  }

  // A run that fails, but for its numerics, is told of by its name and stops no other.
  void lose(std::size_t index, const std::exception_ptr &failure) {
    line.finish(input.runs[index].name);
    lost.push_back(failure);
    if (input.runs.size() == 1)
      return; // nothing more is to be said than will be thrown
    try {
      std::rethrow_exception(failure);
    } catch (const InputError &error) { // its text is complete
      line.warn(fmt::format("{}:\n{}", input.runs[index].name, error.what()));
    } catch (const std::exception &error) {
      line.warn(fmt::format("error: {}: {}\n", input.runs[index].name, error.what()));
    }
  }

  // The gravest failure, by its exit code: what the machine refused before the numerics before input.
  void throw_if_lost() const {
    const auto thrown = [](const std::exception_ptr &failure) {
      try {
        std::rethrow_exception(failure);
      } catch (const InputError &) {
        return ExitCode::bad_input;
      } catch (const FileError &) {
        return ExitCode::files_failed;
      } catch (const std::system_error &) {
        return ExitCode::files_failed;
      } catch (...) {
        return ExitCode::numerics_failed;
      }
    };
    const auto gravest = std::ranges::max_element(lost, {}, thrown);
    if (gravest == lost.end())
      return;
    if (input.runs.size() == 1)
      std::rethrow_exception(*gravest);
    const std::string text =
        fmt::format("{} of {} could not be computed", lost.size(), counted(input.runs.size(), "run"));
    switch (thrown(*gravest)) {
    case ExitCode::bad_input:
      throw InputError(fmt::format("error: {}\n", text));
    case ExitCode::files_failed:
      throw FileError(text + "; the same command computes what is missing");
    default:
      throw std::runtime_error(text);
    }
  }

  void one_after_the_other() {
    for (std::size_t i = 0; i < results.size() && !stops(); ++i)
      try {
        finish(i, compute_run(i));
      } catch (const std::exception &) {
        lose(i, std::current_exception());
      }
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
    const auto failed = [&](std::size_t index, const std::exception_ptr &failure) { lose(index, failure); };
    const auto finished = [&](std::size_t index, int end) {
      try {
        finish(index, static_cast<RunEnd>(end));
      } catch (const std::exception &) {
        lose(index, std::current_exception());
      }
    };
    run_in_processes({results.size(), options.jobs, task, watch, finished, failed}, shared);
  }

  void compute_all() {
    if (options.jobs > 1 && input.runs.size() > 1)
      side_by_side();
    else
      one_after_the_other();
    const auto unfinished = std::ranges::count_if(results, [](const RunResult &r) { return !r.summary; });
    if (unfinished ==
        std::ssize(lost)) // otherwise some are interrupted, and the same command is to be given anyway
      throw_if_lost();
  }
};

} // namespace

std::vector<RunResult> compute(const CaseInput &input, const RunOptions &options, const Method &method) {
  CaseRuns runs(input, options, method);
  runs.compute_all();
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
    const std::string reason = summary.reason();
    const std::string ending = summary.status + (reason.empty() ? "" : ": " + reason);
    return {true, ending, 1, summary.quantities.at("cpu_seconds")};
  }
  const auto saved = read_checkpoint(home, identity).run;
  if (!saved)
    return {};
  const std::vector<SeriesRow> &series = saved->checkpoint.series;
  return {false, "", series.empty() ? 0 : fraction_done(run.physics, series.back().time, series.back().x_g),
          saved->effort.cpu_seconds};
}

} // namespace capsule
