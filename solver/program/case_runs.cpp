#include "program/case_runs.hpp"
#include "base/atomic_file.hpp"
#include "base/failure.hpp"
#include "base/text.hpp"
#include "case/identity.hpp"
#include "output/results.hpp"
#include "program/progress.hpp"
#include "program/workers.hpp"
#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <ctime>
#include <exception>
#include <fcntl.h>
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <fstream>
#include <new>
#include <sstream>
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
  return options.pool.empty() ? directory_of(run, options)
                              : options.pool / run_identity(run.physics, options.task);
}

// What lies in the pool is of this program; a directory that the user named holds what its input says.
bool is_there(const RunInput &run, const RunOptions &options) {
  const fs::path home = home_of(run, options);
  return options.pool.empty() ? is_finished_input(home, run.physics, options.task)
                              : is_finished(home, run_identity(run.physics, options.task));
}

// What came of a run.
enum Course { interrupted, computed, found };

std::string report(const RunResult &result, const std::string &case_name, Course course) {
  const Summary &summary = *result.summary;
  std::string text =
      fmt::format("{}: {}", result.input.name.empty() ? case_name : result.input.name, summary.status);
  if (!summary.failure.empty())
    text += fmt::format(" ({})", summary.failure);
  const auto add = [&](const std::string &label, const char *quantity, int digits = 6) {
    if (const auto value = summary.quantities.find(quantity); value != summary.quantities.end())
      text += fmt::format("  {} {:.{}g}", label, value->second, digits);
  };
  if (!summary.along.empty())
    add(summary.along, "time"); // which the key has taken the place of
  else if (summary.status != "steady") {
    add("t", "time");
    add("x_g", "x_g");
  }
  add("v_g", "v_g");
  add("pressure drop", "pressure_drop");
  add("CPU seconds", "cpu_seconds", 3);
  return text +
         fmt::format("{}  -> {}", course == found ? " (computed before)" : "", result.directory.string());
}

// One case's runs under way.
struct Campaign {
  const CaseInput &input;
  const RunOptions &options;
  const March &march;
  ProgressLine line;
  Crew crew;
  std::vector<RunResult> results;

  Campaign(const CaseInput &input_, const RunOptions &options_, const March &march_)
      : input(input_), options(options_), march(march_), line(options_.on_a_terminal),
        crew(input_.runs.size()) {
    for (const RunInput &run : input.runs)
      results.push_back({run, directory_of(run, options), std::nullopt});
  }

  bool stops() const { return crew.stops() || options.stop(); }

  bool wait_for(const DirectoryLock &lock, const RunInput &run) {
    for (bool told = false; !lock.acquire(); told = true) {
      if (!told)
        line.print(fmt::format("{}: another process computes this run or one in its place; waiting for it",
                               run.name.empty() ? input.name : run.name));
      if (stops())
        return false;
      std::this_thread::sleep_for(std::chrono::milliseconds(100));
    }
    return true;
  }

  // Two inputs, or methods, in one place: the first goes, and that is said.
  void announce_replacement(const RunInput &run, const fs::path &place) {
    if (const std::string other = other_results(place, run.physics, options.task); !other.empty())
      line.print(fmt::format("{}: replaces {}", place.string(), other));
  }

  Course march_in(const fs::path &home, std::size_t index) {
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
      Crew::News &news = crew.news(index);
      news.time = row.time;
      news.x_g = row.x_g;
      news.steps = steps;
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
        return march(run.physics, from, control);
      } catch (const std::bad_alloc &) {
        throw std::runtime_error(
            fmt::format("{}: not enough memory; try fewer elements (mesh.membrane, mesh.wall) or "
                        "a looser accuracy",
                        run.name.empty() ? input.name : run.name));
      }
    }();
    if (outcome.status == Status::interrupted) {
      write_checkpoint(home, identity, {latest.checkpoint, stopwatch.effort()});
      return interrupted;
    }
    write_results(home, run.physics, outcome, stopwatch.effort(), options.task);
    return computed;
  }

  Course compute_run(std::size_t index) {
    const RunInput &run = input.runs[index];
    const fs::path home = home_of(run, options);
    make_directories(home);
    const DirectoryLock lock(home);
    if (!wait_for(lock, run))
      return interrupted;
    const bool there = !options.fresh && is_there(run, options);
    if (!there && home == results[index].directory)
      announce_replacement(run, home);
    const Course course = there ? found : march_in(home, index);
    if (there)
      remove_checkpoint(home); // of a process that was killed when it was nearly done
    if (course == interrupted || home == results[index].directory)
      return course;
    make_directories(results[index].directory);
    const DirectoryLock place(results[index].directory);
    if (!wait_for(place, run))
      return interrupted;
    announce_replacement(run, results[index].directory);
    share_results(home, results[index].directory);
    return course;
  }

  void show_progress() {
    for (std::size_t i = 0; i < results.size(); ++i)
      if (const Crew::News &news = crew.news(i); news.steps > 0)
        line.update(input.runs[i].name, input.runs[i].physics, news.time, news.x_g, news.steps);
  }

  void finish(std::size_t index, Course course) {
    crew.news(index).steps = 0;
    line.finish(input.runs[index].name);
    if (course == interrupted)
      return;
    results[index].summary = read_summary(home_of(input.runs[index], options));
    if (!is_there(input.runs[index], options)) // neither may the summary be
      throw FileError(fmt::format("another process has overwritten '{}'; give each its own --out",
                                  results[index].directory.string()));
    line.print(report(results[index], input.name, course));
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
        crew.stop();
      show_progress();
    };
    const auto finished = [&](std::size_t index, int course) { finish(index, static_cast<Course>(course)); };
    run_in_processes({results.size(), options.jobs, task, watch, finished}, crew);
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
  if (present.str() == text) // perhaps where nothing can be written
    return;
  make_directories(options.directory);
  write_atomically(file, text);
}

std::vector<RunResult> compute(const CaseInput &input, const RunOptions &options, const March &march) {
  Campaign campaign(input, options, march);
  if (options.jobs > 1 && input.runs.size() > 1)
    campaign.side_by_side();
  else
    campaign.one_after_the_other();
  return campaign.results;
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

std::string unsteady_remark(const std::vector<RunResult> &results) {
  std::size_t unsteady = 0;
  double fastest = 0;
  bool by_x_g = false;
  for (const auto &[input, directory, summary] : results) {
    if (!summary || summary->status != "reached")
      continue;
    const auto at_the_end = [&quantities = summary->quantities](const char *name) {
      const auto found = quantities.find(name);
      return found == quantities.end() ? 0 : found->second;
    };
    const double moving = std::max(at_the_end("max_axial_residual"), at_the_end("max_radial_velocity"));
    const bool in_the_mouth = input.physics.pore.shape == PoreShape::hyperbolic && at_the_end("x_g") < 0;
    if (moving <= input.physics.accuracy || in_the_mouth)
      continue;
    ++unsteady;
    fastest = std::max(fastest, moving);
    by_x_g = by_x_g || input.physics.until.x_g;
  }
  if (unsteady == 0)
    return "";
  return fmt::format(
      "not steady yet{}: the membrane still moves with {}{:.2g} relative to its centre; {} leads nearer, "
      "`capsule steady` finds the steady state",
      results.size() == 1 ? "" : fmt::format(", {} of {}", unsteady, counted(results.size(), "run")),
      unsteady == 1 ? "" : "up to ", fastest,
      by_x_g ? "a larger until.x_g (with pore.exit_x)" : "a larger until.time");
}

} // namespace capsule
