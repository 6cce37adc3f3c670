#include "output/results.hpp"
#include "base/atomic_file.hpp"
#include "base/digest.hpp"
#include "base/failure.hpp"
#include "case/case_file.hpp"
#include "case/identity.hpp"
#include "case/keys.hpp"
#include "case/physical.hpp"
#include "case/value_lists.hpp"
#include "observe/outcome.hpp"
#include "output/checkpoint.hpp"
#include "output/paraview.hpp"
#include "output/provenance.hpp"
#include "output/summary.hpp"
#include "output/tables.hpp"
#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <iterator>
#include <string_view>

namespace capsule {
namespace {

namespace fs = std::filesystem;

constexpr const char *summary_name = "summary.json", *provenance_name = "run.json";

// Takes a whole number away from the front of a text that begins with something and that number.
bool take_numbered(std::string_view &text, std::string_view begin) {
  const std::size_t end = std::min(text.find_first_not_of("0123456789", begin.size()), text.size());
  if (!text.starts_with(begin) || end <= begin.size())
    return false;
  text.remove_prefix(end);
  return true;
}

// "membrane_0003.vtp", "membrane-2_0003.vtp"
bool is_surface(std::string_view name) {
  constexpr std::string_view begin = "membrane";
  if (!name.starts_with(begin))
    return false;
  name.remove_prefix(begin.size());
  take_numbered(name, "-");
  return take_numbered(name, "_") && name == ".vtp";
}

// "series-2.csv" of the second capsule
bool is_of_follower(std::string_view name) {
  for (const std::string_view table : {"series", "series_physical", "profiles"})
    if (std::string_view rest = name; rest.starts_with(table)) {
      rest.remove_prefix(table.size());
      if (take_numbered(rest, "-") && rest == ".csv")
        return true;
    }
  return false;
}

// Names that a run may give to its files.
bool is_result(const fs::path &file) {
  constexpr std::array names{summary_name,          "series.csv",    "series_physical.csv", "profiles.csv",
                             "resolved.toml",       provenance_name, "membrane.pvd",        "branch.csv",
                             "branch_physical.csv", "wall.vtp"};
  const std::string name = file.filename().string();
  return std::ranges::find(names, name) != names.end() || is_surface(name) || is_of_follower(name);
}

// The files that the run in a directory has left there.
std::vector<fs::path> files_of_run(const fs::path &directory) {
  const Written written = written_in(directory);
  if (!written.by_a_run)
    return {};
  return files_in(directory, [&](const fs::path &file) {
    const std::string name = file.filename().string();
    const bool of_earlier_version = written.digests.empty() && !written.altered;
    return of_earlier_version ? is_result(file) : name == provenance_name || written.digests.contains(name);
  });
}

// Puts the files with these names first and last.
void set_ends(std::vector<fs::path> &files, const char *first, const char *last) {
  std::ranges::stable_sort(files, {}, [&](const fs::path &file) {
    return file.filename() == first ? 0 : file.filename() == last ? 2 : 1;
  });
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
  const std::vector<const Case *> capsules = capsules_of(physics);
  FileContents files;
  for (std::size_t k = 0; k < capsules.size(); ++k) {
    const CapsuleRecord record =
        k == 0 ? CapsuleRecord{outcome.last.series, profiles} : outcome.last.followers.at(k - 1);
    const std::string mark = k == 0 ? "" : fmt::format("-{}", k + 1);
    files.emplace_back("series" + mark + ".csv", series_csv(record.series));
    if (in_physical_units(physics, outcome))
      files.emplace_back("series_physical" + mark + ".csv", physical_series_csv(*capsules[k], record.series));
    files.emplace_back("profiles" + mark + ".csv", profiles_csv(record.profiles));
    for (std::size_t i = 0; i < record.profiles.size(); ++i)
      files.emplace_back(surface_name(i, k), surface_vtp(record.profiles[i], outcome.along));
  }
  if (!outcome.along.empty())
    files.emplace_back("branch.csv", branch_csv(outcome));
  if (!outcome.fold_along.empty())
    files.emplace_back("fold_curve.csv", fold_curve_csv(outcome));
  if (!outcome.branch.empty() && has_physical(physics))
    files.emplace_back("branch_physical.csv", physical_branch_csv(physics, outcome));
  if (const auto pore = task.motion ? make_pore(physics.pore) : std::nullopt)
    files.emplace_back("wall.vtp", wall_vtp(*pore));
  files.emplace_back("membrane.pvd", surfaces_pvd(profiles, outcome.along, capsules.size()));
  files.emplace_back("resolved.toml", resolved_toml(physics));
  files.emplace_back("summary.json", summary_text(physics, outcome, effort));
  remove_results(directory);
  require_free(directory);
  write_atomically(directory / provenance_name, provenance_text(physics, effort, task, files));
  for (const auto &[name, content] : files)
    write_atomically(directory / name, content);
  remove_checkpoint(directory);
}

bool is_finished(const fs::path &directory, const std::string &identity) {
  std::error_code ignored;
  return fs::exists(directory / summary_name, ignored) && written_in(directory).identity == identity;
}

bool is_finished_input(const fs::path &directory, const Case &physics, const Task &task) {
  std::error_code ignored;
  if (!fs::exists(directory / summary_name, ignored) || !fs::exists(directory / "resolved.toml", ignored))
    return false;
  if (const Written written = written_in(directory); written.altered || written.task != task.name)
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
    if (!fs::exists(directory / summary_name, ignored)) {
      const FoundCheckpoint found = read_checkpoint(directory, run_identity(physics, task));
      return found.of_another_run ? "an interrupted run" : "";
    }
    const Written written = written_in(directory);
    if (written.altered)
      return "results whose run.json was altered";
    if (written.task != task.name)
      return fmt::format("the results of `capsule {}`", written.task);
    const Case other = input_of(directory, task);
    return same_input(other, physics, task) ? "" : fmt::format("a run with {}", what_differs(other, physics));
  } catch (const std::exception &) { // damaged files, or no longer a valid input
    return "results that cannot be read any more";
  }
}

void require_free(const fs::path &directory) {
  std::error_code ignored;
  if (!fs::exists(directory, ignored))
    return;
  const std::vector<fs::path> own = files_of_run(directory);
  std::vector<std::string> taken;
  for (const fs::path &file : files_in(directory, is_result))
    if (std::ranges::find(own, file) == own.end())
      taken.push_back(file.filename().string());
  if (has_foreign_checkpoint(directory))
    taken.emplace_back("checkpoint.json");
  if (taken.empty())
    return;
  std::ranges::sort(taken);
  const bool one = taken.size() == 1;
  throw FileError(
      fmt::format("cannot write into '{}': {} {} not of a run{}; move {} away, or give another --out",
                  directory.string(), fmt::join(taken, ", "), one ? "is" : "are",
                  written_in(directory).altered
                      ? fmt::format(", or of one whose run.json was altered and does not name {} any more",
                                    one ? "it" : "them")
                      : "",
                  one ? "it" : "them"));
}

std::vector<fs::path> set_aside_altered(const fs::path &directory) {
  const Written written = written_in(directory);
  std::vector<fs::path> altered;
  const auto set_aside = [&](const fs::path &file) {
    std::error_code ec;
    fs::path aside = file;
    for (int k = 1; fs::exists(fs::symlink_status(aside, ec)); ++k)
      aside = fmt::format("{}.altered{}", file.string(), k == 1 ? "" : fmt::format("-{}", k));
    fs::rename(file, aside, ec);
    if (ec)
      fail_at("cannot rename", file, ec.value());
    altered.push_back(aside);
  };
  for (const auto &[name, as_written] : written.digests) {
    const fs::path file = directory / name;
    std::error_code ignored;
    if (fs::exists(file, ignored) && digest(read_file(file)) != as_written)
      set_aside(file);
  }
  if (written.altered) {
    std::vector<fs::path> unaltered = files_of_run(directory);
    set_ends(unaltered, summary_name, provenance_name);
    unaltered.pop_back();
    std::ranges::for_each(unaltered, remove_file);
    set_aside(directory / provenance_name); // last: it says whose the others are
  }
  return altered;
}

bool is_complete(const fs::path &directory) {
  return std::ranges::all_of(written_in(directory).digests, [&](const auto &file) {
    std::error_code ignored;
    return fs::exists(directory / file.first, ignored);
  });
}

void remove_results(const fs::path &directory) {
  std::vector<fs::path> files = files_of_run(directory);
  std::ranges::move(files_in(directory, is_left_over), std::back_inserter(files));
  set_ends(files, summary_name, provenance_name);
  for (const fs::path &file : files)
    remove_file(file);
}

void share_results(const fs::path &from, const fs::path &to) {
  std::error_code ignored;
  if (fs::exists(to / summary_name, ignored) && fs::exists(to / provenance_name, ignored) &&
      is_complete(to) && read_file(from / provenance_name) == read_file(to / provenance_name))
    return;
  make_directories(to);
  remove_results(to);
  std::vector<fs::path> files = files_of_run(from);
  set_ends(files, provenance_name, summary_name);
  for (const fs::path &file : files)
    copy_atomically(file, to / file.filename());
}

} // namespace capsule
