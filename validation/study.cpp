#include "study.hpp"
#include "base/csv.hpp"
#include "base/failure.hpp"
#include "motion/motion.hpp"
#include "program/workers.hpp"
#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <fmt/format.h>
#include <fstream>
#include <limits>
#include <sstream>

namespace capsule {
namespace {

// Grid position of a row: its x_g in units of 0.05, and whether it lies on the grid.
struct GridPlace {
  long index;
  bool on_grid;
};
GridPlace grid_place(double x_g) {
  const double place = x_g / 0.05;
  return {std::lround(place), std::abs(place - std::round(place)) < 1e-6};
}

// Rows on the grid with x_g in [from, to].
std::vector<std::size_t> rows_between(const History &history, double from, double to) {
  constexpr double rounding = 1e-9;
  const std::vector<double> &x_g = history.at("x_g");
  std::vector<std::size_t> rows;
  for (std::size_t k = 0; k < x_g.size(); ++k)
    if (grid_place(x_g[k]).on_grid && x_g[k] > from - rounding && x_g[k] < to + rounding)
      rows.push_back(k);
  return rows;
}

std::size_t digest_of_this_program() {
  std::ifstream file("/proc/self/exe", std::ios::binary);
  return std::hash<std::string>{}(std::string(std::istreambuf_iterator<char>(file), {}));
}

} // namespace

int study_main(int argc, char **argv,
               const std::function<bool(const std::string &directory, unsigned jobs)> &study) {
  const int jobs = argc == 3 ? std::atoi(argv[2]) : 0;
  if (jobs < 1) {
    fmt::print(stderr, "usage: {} DIRECTORY JOBS\n", argv[0]);
    return 2;
  }
  std::setvbuf(stdout, nullptr, _IOLBF, 0); // what is found shows at once
  try {
    return study(argv[1], static_cast<unsigned>(jobs)) ? 0 : 1;
  } catch (const std::exception &error) {
    fmt::print(stderr, "error: {}\n", error.what());
    return 3;
  }
}

Case physics_of(const std::string &case_name) {
  return read_case("cases/" + case_name).runs.front().physics;
}

Case short_entrance(int nodes, double end) {
  Case physics = physics_of("table1-mesh");
  physics.accuracy = 1e-3;
  physics.mesh.membrane = nodes;
  physics.capsule.start_x = -2.5;
  physics.pore.exit_x = 8;
  physics.until.x_g = end;
  return physics;
}

std::vector<StudyRun> run_all(const std::string &directory, unsigned jobs, const std::vector<RunInput> &runs,
                              Found found) {
  CaseInput input;
  input.name = std::filesystem::path(directory).filename().string();
  input.runs = runs;
  RunOptions options;
  options.directory = directory;
  if (found == Found::of_this_program)
    options.pool = std::filesystem::path(directory).parent_path() / "runs";
  options.jobs = jobs;
  std::vector<StudyRun> computed;
  for (const RunResult &result : compute(input, options, march)) {
    if (!result.summary)
      throw FileError(result.directory.string() + ": the run was interrupted");
    computed.push_back(read_run(result.directory));
  }
  return computed;
}

std::vector<std::string> make_all(const std::string &directory, unsigned jobs,
                                  const std::vector<TextTask> &tasks) {
  const std::filesystem::path parts =
      std::filesystem::path(directory) / "parts" / fmt::format("{:x}", digest_of_this_program());
  std::filesystem::create_directories(parts);
  Work work;
  work.tasks = tasks.size();
  work.jobs = jobs;
  work.task = [&](std::size_t k) {
    if (!std::filesystem::exists(parts / tasks[k].name))
      write_atomically(parts / tasks[k].name, tasks[k].make());
    return 0;
  };
  work.watch = [] {};
  work.finished = [](std::size_t, int) {};
  std::exception_ptr failure;
  work.failed = [&](std::size_t, const std::exception_ptr &what) { failure = what; };
  SharedState shared(tasks.size());
  run_in_processes(work, shared);
  if (failure)
    std::rethrow_exception(failure);
  std::vector<std::string> texts;
  for (const TextTask &task : tasks) {
    std::ifstream file(parts / task.name);
    texts.emplace_back(std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>{});
  }
  return texts;
}

History history_of(const std::vector<SeriesRow> &series) {
  History history;
  for (const SeriesRow &row : series) {
    history["time"].push_back(row.time);
    history["x_g"].push_back(row.x_g);
    history["v_g"].push_back(row.v_g);
    history["pressure_drop"].push_back(row.pressure_drop);
    history["volume_change"].push_back(row.volume_change);
  }
  return history;
}

Rows::Rows(const std::string &header, const std::string &text) {
  for (const std::string &name : split_csv(header))
    columns_.emplace(name, columns_.size());
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);)
    rows_.push_back(split_csv(line));
}

const std::string &Rows::text(std::size_t row, const std::string &column) const {
  return rows_.at(row).at(columns_.at(column));
}

StudyRun read_run(const std::filesystem::path &directory) {
  const std::filesystem::path series = directory / "series.csv";
  StudyRun run{read_summary(directory), read_columns(series)};
  if (run.history.at("x_g").empty())
    throw FileError(series.string() + ": no rows");
  return run;
}

double history_difference(const History &history, const History &reference, const std::string &quantity,
                          double from, double to) {
  std::map<long, double> computed;
  const std::vector<double> &x_g = history.at("x_g");
  for (std::size_t k = 0; k < x_g.size(); ++k)
    if (const GridPlace place = grid_place(x_g[k]); place.on_grid)
      computed[place.index] = history.at(quantity)[k];
  double largest = 0;
  for (const std::size_t k : rows_between(reference, from, to)) {
    const auto found = computed.find(grid_place(reference.at("x_g")[k]).index);
    if (found == computed.end())
      return std::numeric_limits<double>::infinity();
    largest = std::max(largest, std::abs(found->second - reference.at(quantity)[k]));
  }
  return largest;
}

double history_error(const History &history, const History &reference, const std::string &quantity,
                     double from, double to) {
  double scale = 0;
  for (const std::size_t k : rows_between(reference, from, to))
    scale = std::max(scale, std::abs(reference.at(quantity)[k]));
  return history_difference(history, reference, quantity, from, to) / scale;
}

double cpu_seconds() {
  timespec time{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

bool check(bool holds, const std::string &claim) {
  fmt::print("{}: {}: {}\n", program_invocation_short_name, holds ? "HOLDS" : "FAILS", claim);
  return holds;
}

} // namespace capsule
