#include "program/check_commands.hpp"
#include "base/failure.hpp"
#include "base/text.hpp"
#include "case/project.hpp"
#include "compare/comparison.hpp"
#include "compare/ledger.hpp"
#include "compare/text_table.hpp"
#include "program/run_list.hpp"
#include <algorithm>
#include <fmt/format.h>

namespace capsule {
namespace {

namespace fs = std::filesystem;

// Adds the summary of a study, validation/<name>/study.cpp, to the table as one run, if there is one.
void add_study(const std::string &name, RunTable &table) {
  RunResult result;
  result.directory = fs::path("results") / name;
  if (!fs::exists(result.directory / "summary.json"))
    return;
  result.summary = read_summary(result.directory);
  table.add(name, {result});
}

// Adds these cases of the project, computed where they are not finished, and studies to the table. Returns false if a case
// was interrupted.
bool add_project_cases(const std::vector<std::string> &names, const fs::path &published,
                       const Arguments &arguments, RunTable &table) {
  for (const std::string &name : names) {
    const auto found = find_project_case(published.parent_path().parent_path(), name);
    if (!found)
      add_study(name, table);
    if (!found || table.has(name))
      continue;
    const CaseInput input = read_case(found->file);
    Arguments where = arguments;
    where.out = found->stored.string();
    const std::vector<RunResult> results = compute_case(input, where);
    if (std::ranges::any_of(results, is_interrupted))
      return false;
    table.add(name, results);
  }
  return true;
}

// A table must not take the place of what it is compared with.
void require_other_file(const std::string &table, const fs::path &expectations) {
  if (std::error_code ignored; !table.empty() && fs::equivalent(table + ".csv", expectations, ignored))
    throw InputError(fmt::format("error: --table {}: '{}' holds what is expected; give another name\n", table,
                                 expectations.string()));
}

// Prints the comparisons if there are any, and writes them to files if these have a name.
void show_comparisons(const std::vector<Comparison> &comparisons, const std::string &files) {
  const std::vector<TextRow> rows = comparison_rows(comparisons);
  if (!files.empty()) {
    write_table(files + ".csv", csv_table(rows));
    write_table(files + ".md", markdown_table(rows));
  }
  if (comparisons.empty())
    return;
  fmt::print("\n{}\n", text_table(rows));
}

} // namespace

ExitCode check_case(const Arguments &arguments) {
  const CaseInput input = read_case_of(arguments);
  const auto published = find_expectations(input.file);
  std::vector<Expectation> expectations = own_expectations(input.file, input.name);
  if (published)
    std::ranges::move(expectations_of(read_expectations(*published), input.name),
                      std::back_inserter(expectations));
  require_other_file(arguments.table, input.file.parent_path() / "expected.csv");
  require_other_file(arguments.table, published.value_or(""));
  write_run_list(input, run_options(arguments, input).directory);
  const std::vector<RunResult> results = compute_case(input, arguments);
  if (std::ranges::any_of(results, is_interrupted))
    return ExitCode::interrupted;
  RunTable table;
  table.add(input.name, results);
  if (published && !add_project_cases(referenced_cases(expectations), *published, arguments, table))
    return ExitCode::interrupted;
  std::vector<Comparison> comparisons = compare(expectations, input.name, table);
  // Overrides may leave some of the runs out on purpose.
  if (!arguments.overrides.empty())
    std::erase_if(comparisons, &Comparison::no_such_run);
  const auto unexpected = [&](const RunResult &r) {
    return has_failed(r) && !failure_is_expected(comparisons, r);
  };
  const auto failures = std::ranges::count_if(results, unexpected);
  const auto count = [&](Verdict verdict) {
    return std::ranges::count(comparisons, verdict, &Comparison::verdict);
  };
  const bool all = std::ranges::all_of(comparisons, &Comparison::as_recorded);
  if (comparisons.empty())
    fmt::print(stderr, "warning: no expectations for {}\n", input.name);
  show_comparisons(comparisons, arguments.table);
  fmt::print("{}: {}: {} of {} agree, {} differ, {} not decidable; {} failed unexpectedly\n", input.name,
             failures > 0          ? "FAILS"
             : comparisons.empty() ? "NOTHING TO COMPARE"
             : all                 ? "AS RECORDED"
                                   : "NOT AS RECORDED",
             count(Verdict::agrees), counted(comparisons.size(), "row"), count(Verdict::differs),
             count(Verdict::not_decidable), counted(static_cast<std::size_t>(failures), "run"));
  return failures > 0 ? ExitCode::numerics_failed : all ? ExitCode::done : ExitCode::differs;
}

ExitCode write_ledger(const Arguments &arguments) {
  const auto published = find_expectations(fs::current_path() / "case.toml");
  if (!published)
    throw InputError("error: there is no tables/published.csv here or above\n");
  require_other_file(arguments.table, *published);
  const fs::path root = published->parent_path().parent_path();
  const std::vector<Expectation> expectations = read_expectations(*published);
  std::vector<std::string> names = referenced_cases(expectations);
  for (const Expectation &row : expectations)
    names.push_back(row.case_name);
  RunTable table;
  if (!add_project_cases(names, *published, arguments, table))
    return ExitCode::interrupted;
  std::vector<std::string> cases = table.cases(); // without the studies
  std::erase_if(cases, [&](const std::string &name) { return !find_project_case(root, name); });
  std::vector<Comparison> comparisons;
  for (const Expectation &row : expectations)
    for (const std::string &name : row.case_name == "*" ? cases : std::vector{row.case_name}) {
      const std::vector<Comparison> more = compare({row}, name, table);
      comparisons.insert(comparisons.end(), more.begin(), more.end());
    }
  const Ledger ledger = make_ledger(comparisons);
  write_table(arguments.table + ".csv", ledger.csv);
  write_table(arguments.table + ".md", ledger.markdown);
  fmt::print("{}: {}; {} not as recorded\n", arguments.table, ledger.summary,
             counted(static_cast<std::size_t>(ledger.not_as_recorded), "row"));
  return ledger.not_as_recorded == 0 ? ExitCode::done : ExitCode::differs;
}

} // namespace capsule
