#include "output/results.hpp"
#include "base/atomic_file.hpp"
#include "base/failure.hpp"
#include "case/case_file.hpp"
#include "case/identity.hpp"
#include "case/keys.hpp"
#include "observe/outcome.hpp"
#include "output/checkpoint.hpp"
#include "output/paraview.hpp"
#include "output/provenance.hpp"
#include "output/summary.hpp"
#include "output/tables.hpp"
#include <algorithm>
#include <fmt/format.h>

namespace capsule {
namespace {

namespace fs = std::filesystem;

bool is_result(const fs::path &file) {
  const std::string name = file.filename().string();
  return name == "summary.json" || name == "series.csv" || name == "series_physical.csv" ||
         name == "profiles.csv" || name == "resolved.toml" || name == "run.json" || name == "membrane.pvd" ||
         name == "branch.csv" || (name.starts_with("membrane_") && name.ends_with(".vtp"));
}

// A temporary file that a killed process has left of a run's files. Any other may be what another process is writing.
bool is_left_over(const fs::path &file) {
  return std::ranges::any_of(
      final_names(file), [](const fs::path &name) { return is_result(name) || name == "checkpoint.json"; });
}

Case input_of(const fs::path &directory, const Task &task) {
  return read_resolved(directory / "resolved.toml", task);
}

// Where the first differs from the second: "flow.viscosity_ratio = 1, no until.time".
std::string what_differs(const Case &first, const Case &second) {
  std::string text;
  for (const Key &key : keys()) {
    const auto value = value_of(key, first), instead = value_of(key, second);
    if (key.name == "title" || key.name == "paper" ||
        (value ? value_text(*value) : "") == (instead ? value_text(*instead) : ""))
      continue;
    text += text.empty() ? "" : ", ";
    text += value ? fmt::format("{} = {}", key.name, value_text(*value)) : fmt::format("no {}", key.name);
  }
  return text;
}

} // namespace

void write_results(const fs::path &directory, const Case &physics, const Outcome &outcome,
                   const Effort &effort, const Task &task) {
  const std::vector<Profile> &profiles = outcome.last.profiles;
  write_atomically(directory / "series.csv", series_csv(outcome.last.series));
  if (in_physical_units(physics, outcome))
    write_atomically(directory / "series_physical.csv", physical_series_csv(physics, outcome.last.series));
  write_atomically(directory / "profiles.csv", profiles_csv(profiles));
  if (!outcome.along.empty())
    write_atomically(directory / "branch.csv", branch_csv(outcome));
  for (std::size_t i = 0; i < profiles.size(); ++i)
    write_atomically(directory / surface_name(i), surface_vtp(profiles[i], outcome.along));
  write_atomically(directory / "membrane.pvd", surfaces_pvd(profiles, outcome.along));
  write_atomically(directory / "resolved.toml", resolved_toml(physics));
  write_atomically(directory / "run.json", provenance_text(physics, effort, task));
  write_atomically(directory / "summary.json", summary_text(physics, outcome, effort));
  remove_checkpoint(directory);
}

bool is_finished(const fs::path &directory, const std::string &identity) {
  std::error_code ignored;
  return fs::exists(directory / "summary.json", ignored) && identity_of(directory) == identity;
}

bool is_finished_input(const fs::path &directory, const Case &physics, const Task &task) {
  std::error_code ignored;
  if (!fs::exists(directory / "summary.json", ignored) || !fs::exists(directory / "resolved.toml", ignored) ||
      task_of(directory) != task.name)
    return false;
  try {
    return same_input(input_of(directory, task), physics, task);
  } catch (const InputError &) { // no longer a valid input
    return false;
  }
}

std::string other_results(const fs::path &directory, const Case &physics, const Task &task) {
  std::error_code ignored;
  try {
    if (!fs::exists(directory / "summary.json", ignored))
      return fs::exists(directory / "checkpoint.json", ignored) &&
                     !read_checkpoint(directory, run_identity(physics, task))
                 ? "an interrupted run"
                 : "";
    if (const std::string made_by = task_of(directory); made_by != task.name)
      return fmt::format("the results of `capsule {}`", made_by);
    const Case other = input_of(directory, task);
    return same_input(other, physics, task) ? "" : fmt::format("a run with {}", what_differs(other, physics));
  } catch (const std::exception &) { // damaged files, or no longer a valid input
    return "results that cannot be read any more";
  }
}

void remove_results(const fs::path &directory) {
  remove_file(directory / "summary.json");
  for (const fs::path &file :
       files_in(directory, [](const fs::path &f) { return is_result(f) || is_left_over(f); }))
    remove_file(file);
}

void share_results(const fs::path &from, const fs::path &to) {
  std::error_code ignored;
  if (fs::equivalent(from / "summary.json", to / "summary.json", ignored))
    return;
  make_directories(to);
  remove_results(to);
  for (const fs::path &file : files_in(from, is_result))
    if (file.filename() != "summary.json")
      share_file(file, to / file.filename());
  share_file(from / "summary.json", to / "summary.json");
}

} // namespace capsule
