#include "program/fit_profiles.hpp"
#include "base/atomic_file.hpp"
#include "base/csv.hpp"
#include "base/digest.hpp"
#include "base/failure.hpp"
#include "base/text.hpp"
#include "case/identity.hpp"
#include "case/keys.hpp"
#include "case/physical.hpp"
#include "output/fit_files.hpp"
#include "program/workers.hpp"
#include <algorithm>
#include <ctime>
#include <fmt/format.h>
#include <set>
#include <variant>

namespace capsule {
namespace {

namespace fs = std::filesystem;

// The files that are named, and those of a directory in their order.
std::vector<fs::path> files_of(const std::vector<std::string> &paths) {
  std::vector<fs::path> files;
  for (const fs::path path : paths) {
    std::error_code ignored;
    if (!fs::is_directory(path, ignored)) {
      files.push_back(path);
      continue;
    }
    std::vector<fs::path> inside =
        files_in(path, [](const fs::path &file) { return file.extension() == ".csv"; });
    if (inside.empty())
      throw InputError(fmt::format("error: --profile {}: no .csv file in this directory\n", path.string()));
    std::ranges::sort(inside);
    std::ranges::move(inside, std::back_inserter(files));
  }
  std::set<std::string> names;
  for (const fs::path &file : files)
    if (!names.insert(file.stem().string()).second)
      throw InputError(fmt::format("error: --profile {}: two files are called '{}'\n", file.string(),
                                   file.stem().string()));
  return files;
}

// One fit of several: its contours and its place.
struct Job {
  std::vector<Contour> contours;
  fs::path directory;
  std::string identity;
};

std::string identity_of(const Case &physics, const std::vector<Contour> &contours) {
  std::string content;
  for (const Contour &contour : contours)
    content += contour.file.filename().string() + "\n" + read_file(contour.file);
  return run_identity(physics, {.motion = false, .name = "fit " + digest(content), .fit = true});
}

// Of contours that are fitted together: one scale for all of their flow rates.
void check_together(const Case &physics, const std::vector<Contour> &contours) {
  if (contours.size() < 2)
    return;
  if (physics.physical.flow_rate.si > 0)
    throw InputError("error: physical.flow_rate is of one contour, not of several together\n"
                     "give '# flow_rate = ...' in each file instead\n");
  const auto without =
      std::ranges::find(contours, false, [](const Contour &c) { return c.flow_rate.has_value(); });
  if (without != contours.end() &&
      std::ranges::any_of(contours, [](const Contour &c) { return c.flow_rate.has_value(); }))
    throw InputError(csv_error(without->file, 1, "no flow rate, but other files have one") +
                     "with --together, give '# flow_rate = ...' in each file or in none\n");
}

std::string report(const Case &physics, const FitRow &row, const fs::path &directory) {
  if (!row.failure.empty())
    return fmt::format("{}: failed: {}\n", row.name, row.failure);
  std::string text = fmt::format("{}: {}", row.name, row.law);
  for (const FittedValue &value : row.values) {
    const Key *key = find_key(value.name);
    const auto *measured = key == nullptr ? nullptr : std::get_if<Measured>(&key->field);
    const TypedUnit unit = measured == nullptr ? TypedUnit{} : own_unit(physics, measured->dimension);
    text += fmt::format("  {} {:.5g} +- {:.2g}{}{}", last_component(value.name), value.value / unit.si,
                        value.standard_error / unit.si, unit.name.empty() ? "" : " ", unit.name);
  }
  return fmt::format("{}  residual {:.2g}  -> {}\n", text, row.residual, directory.string());
}

// Whether it was interrupted.
bool fit_and_write(const Case &physics, const Job &job, FitStarts &starts,
                   const std::function<bool()> &stop) {
  const std::clock_t began = std::clock();
  FitOutcome outcome;
  Control control;
  control.interrupted = stop;
  try {
    outcome.result = fit_contours(physics, job.contours, starts, control);
  } catch (const NumericsFailure &failure) {
    outcome.failure = fmt::format("{}; {}", failure.what(), with_physical_keys(failure.advice, physics));
  } catch (const Interrupted &) {
    return true;
  }
  outcome.cpu_seconds = static_cast<double>(std::clock() - began) / CLOCKS_PER_SEC;
  write_fit(job.directory, job.identity, job.contours, outcome);
  const FitRow row = *read_fit(job.directory, job.identity);
  fmt::print("{}", report(physics, row, job.directory));
  for (const std::string &warning : outcome.result.warnings)
    fmt::print(stderr, "{}: warning: {}\n", row.name, warning);
  std::fflush(stdout);
  return false;
}

// A part of the list, in a process of its own: neighbours follow each other.
bool fit_part(const Case &physics, std::span<const Job> jobs, bool fresh, const std::function<bool()> &stop) {
  FitStarts starts;
  for (const Job &job : jobs)
    if ((fresh || !read_fit(job.directory, job.identity)) && fit_and_write(physics, job, starts, stop))
      return true;
  return false;
}

} // namespace

ExitCode fit_profiles(const std::vector<std::string> &profiles, bool together, const CaseInput &input,
                      const RunOptions &options) {
  if (input.runs.size() != 1)
    throw InputError(fmt::format("error: {}: a fit has one case, not a sweep of {}\n", input.file.string(),
                                 counted(input.runs.size(), "run")));
  const Case &physics = input.runs.front().physics;
  const std::vector<fs::path> files = files_of(profiles);
  std::vector<Job> jobs;
  std::string errors;
  for (const fs::path &file : files) {
    try {
      const Contour contour = read_contour(file, physics);
      if (!together || jobs.empty())
        jobs.push_back(
            {{}, files.size() == 1 || together ? options.directory : options.directory / file.stem(), ""});
      jobs.back().contours.push_back(contour);
    } catch (const InputError &error) {
      errors += error.what();
    }
  }
  if (jobs.empty() || (together && !errors.empty()))
    throw InputError(errors);
  if (together)
    check_together(physics, jobs.front().contours);
  for (Job &job : jobs)
    job.identity = identity_of(physics, job.contours);
  fmt::print(stderr, "{}", errors);

  const auto parts = std::min<std::size_t>(options.jobs, jobs.size());
  bool interrupted = false;
  std::exception_ptr lost;
  if (parts == 1)
    interrupted = fit_part(physics, jobs, options.fresh, options.stop);
  else {
    SharedState shared(parts);
    const auto part = [&](std::size_t index) {
      const std::size_t from = index * jobs.size() / parts, to = (index + 1) * jobs.size() / parts;
      return fit_part(physics, std::span(jobs).subspan(from, to - from), options.fresh,
                      [&] { return shared.stops(); })
                 ? 1
                 : 0;
    };
    const auto watch = [&] {
      if (options.stop())
        shared.stop();
    };
    run_in_processes({parts, options.jobs, part, watch,
                      [&](std::size_t, int stopped) { interrupted = interrupted || stopped == 1; },
                      [&](std::size_t, const std::exception_ptr &failure) { lost = failure; }},
                     shared);
  }
  std::vector<FitRow> rows;
  for (const Job &job : jobs)
    if (const auto row = read_fit(job.directory, job.identity))
      rows.push_back(*row);
  if (!rows.empty())
    write_fit_tables(options.directory, rows);
  if (lost)
    std::rethrow_exception(lost);
  if (interrupted || rows.size() < jobs.size()) {
    fmt::print(stderr, "interrupted: {} of {} to finish; the same command goes on with them\n",
               jobs.size() - rows.size(), counted(jobs.size(), "fit"));
    return ExitCode::interrupted;
  }
  if (!errors.empty())
    return ExitCode::bad_input;
  return std::ranges::any_of(rows, [](const FitRow &row) { return !row.failure.empty(); })
             ? ExitCode::numerics_failed
             : ExitCode::done;
}

} // namespace capsule
