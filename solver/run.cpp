#include "run.hpp"
#include "progress.hpp"
#include <algorithm>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <ctime>
#include <exception>
#include <fcntl.h>
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <thread>
#include <unistd.h>

namespace capsule {
namespace {

namespace fs = std::filesystem;

// Held by one process for one run's directory; goes with the process, whatever its end.
class DirectoryLock {
public:
  explicit DirectoryLock(const fs::path &directory)
      : descriptor(open(directory.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {}
  ~DirectoryLock() {
    if (descriptor >= 0)
      close(descriptor);
  }
  DirectoryLock(const DirectoryLock &) = delete;
  DirectoryLock &operator=(const DirectoryLock &) = delete;

  // Some network file systems have no locks: there nobody is kept out.
  bool acquire() const { return flock(descriptor, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK; }

private:
  int descriptor;
};

double thread_seconds() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

double wall_seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

// Adds what this thread spends to what was spent before.
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
  return options.pool.empty() ? directory_of(run, options) : options.pool / run_identity(run.physics);
}

std::string report(const RunResult &result, const std::string &case_name, bool reused) {
  const Summary &summary = *result.summary;
  std::string text =
      fmt::format("{}: {}", result.input.name.empty() ? case_name : result.input.name, summary.status);
  if (!summary.failure.empty())
    text += fmt::format(" ({})", summary.failure);
  const auto add = [&](const char *label, const char *quantity) {
    if (const auto found = summary.quantities.find(quantity); found != summary.quantities.end())
      text += fmt::format("  {} {:.6g}", label, found->second);
  };
  add("t", "time");
  add("x_g", "x_g");
  add("v_g", "v_g");
  add("pressure drop", "pressure_drop");
  add("seconds", "wall_seconds");
  return text + fmt::format("{}  -> {}", reused ? " (computed before)" : "", result.directory.string());
}

// One case's runs under way.
struct Campaign {
  const CaseInput &input;
  const RunOptions &options;
  const March &march;
  ProgressLine line;
  std::atomic<bool> abandoned = false; // a run could not write its files: the others save what they have

  bool stops() const { return abandoned || options.stop(); }

  bool wait_for(const DirectoryLock &lock, const RunInput &run) {
    for (bool told = false; !lock.acquire(); told = true) {
      if (!told)
        line.print(fmt::format("{}: another process computes this run; waiting for it",
                               run.name.empty() ? input.name : run.name));
      if (stops())
        return false;
      std::this_thread::sleep_for(std::chrono::milliseconds(100));
    }
    return true;
  }

  // To the end and true, or to a checkpoint and false.
  bool march_in(const fs::path &home, const RunInput &run) {
    const std::string identity = run_identity(run.physics);
    const auto saved = options.fresh ? std::nullopt : read_checkpoint(home, identity);
    SavedRun latest = saved.value_or(SavedRun{});
    if (!saved)
      latest.effort.started = fmt::format("{:%FT%TZ}", fmt::gmtime(std::chrono::system_clock::now()));
    remove_results(home);

    const Stopwatch stopwatch{latest.effort};
    double written = wall_seconds();
    Control control;
    control.progress = [&](const SeriesRow &row, long steps) {
      line.update(run.name, run.physics, row, steps);
    };
    control.interrupted = [&] { return stops(); };
    control.save = [&](const Checkpoint &checkpoint) {
      latest.checkpoint = checkpoint;
      if (wall_seconds() - written < options.seconds_between_checkpoints)
        return;
      write_checkpoint(home, identity, {checkpoint, stopwatch.effort()});
      written = wall_seconds();
    };
    const Checkpoint from = latest.checkpoint;
    const Outcome outcome = march(run.physics, from, control);
    line.finish(run.name);
    if (outcome.status == Status::interrupted) {
      write_checkpoint(home, identity, {latest.checkpoint, stopwatch.effort()});
      return false;
    }
    write_results(home, run.physics, outcome, stopwatch.effort());
    return true;
  }

  RunResult compute_run(const RunInput &run) {
    RunResult result{run, directory_of(run, options), std::nullopt};
    const fs::path home = home_of(run, options);
    make_directories(home);
    const DirectoryLock lock(home);
    if (!wait_for(lock, run))
      return result;
    const bool reused = !options.fresh && is_finished(home, run_identity(run.physics));
    if (!reused && !march_in(home, run))
      return result;
    if (home != result.directory)
      share_results(home, result.directory);
    result.summary = read_summary(result.directory);
    line.print(report(result, input.name, reused));
    return result;
  }
};

} // namespace

std::vector<RunResult> compute(const CaseInput &input, const RunOptions &options, const March &march) {
  const std::size_t count = input.runs.size();
  std::vector<RunResult> results(count);
  for (std::size_t i = 0; i < count; ++i)
    results[i] = {input.runs[i], directory_of(input.runs[i], options), std::nullopt};
  std::vector<std::exception_ptr> failures(count);
  Campaign campaign{input, options, march, ProgressLine(options.on_a_terminal)};
  std::atomic<std::size_t> next = 0;
  const auto work = [&] {
    for (std::size_t i = next++; i < count && !campaign.stops(); i = next++)
      try {
        results[i] = campaign.compute_run(input.runs[i]);
      } catch (...) {
        failures[i] = std::current_exception();
        campaign.abandoned = true;
      }
  };
  {
    std::vector<std::jthread> workers(std::min<std::size_t>(std::max(1u, options.jobs), count));
    std::ranges::generate(workers, [&] { return std::jthread(work); });
  }
  for (const std::exception_ptr &failure : failures)
    if (failure)
      std::rethrow_exception(failure);
  return results;
}

RunState state_of(const RunInput &run, const RunOptions &options) {
  const fs::path home = home_of(run, options);
  const std::string identity = run_identity(run.physics);
  if (is_finished(home, identity))
    return {true, 1, read_summary(home).quantities.at("wall_seconds")};
  const auto saved = read_checkpoint(home, identity);
  if (!saved)
    return {};
  const std::vector<SeriesRow> &series = saved->checkpoint.series;
  return {false, series.empty() ? 0 : fraction_done(run.physics, series.back()), saved->effort.wall_seconds};
}

} // namespace capsule
