#include "program/commands.hpp"
#include "base/atomic_file.hpp"
#include "base/digest.hpp"
#include "base/failure.hpp"
#include "base/text.hpp"
#include "case/identity.hpp"
#include "case/new_case.hpp"
#include "case/physical.hpp"
#include "case/project.hpp"
#include "compare/comparison.hpp"
#include "compare/ledger.hpp"
#include "compare/text_table.hpp"
#include "motion/motion.hpp"
#include "output/tables.hpp"
#include "program/fit_profiles.hpp"
#include "program/progress.hpp"
#include "program/run_list.hpp"
#include "scene/cost.hpp"
#include "steady/branch.hpp"
#include "steady/steady_state.hpp"
#include <algorithm>
#include <atomic>
#include <chrono>
#include <csignal>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <set>
#include <unistd.h>

namespace capsule {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

// The only thing that a signal's handler may touch.
std::atomic<bool> signal_came = false;

// The first signal is noted, a second one ends the program at once.
void listen_to_signals() {
  struct sigaction action {};
  action.sa_handler = [](int) { signal_came = true; };
  action.sa_flags = static_cast<int>(SA_RESETHAND);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

// Reads the case. If there is none, the error suggests the project's case of this, or a similar, name.
CaseInput read_case_of(const Arguments &arguments, const Task &task = {}) {
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

// What is computed of a case, and by what.
struct Computation {
  Task task = {};
  Method method = march;
};

// results/<case> for marches, results/<case>/steady and results/<case>/branch for steady states. `taken`: the pool's place.
fs::path usual_place(const fs::path &results, const fs::path &taken, const CaseInput &input,
                     const Task &task) {
  if (results / input.name == taken)
    throw InputError(
        fmt::format("error: '{}' holds the runs of all cases: call the case '{}' otherwise, or give --out\n",
                    taken.string(), input.name));
  return task.motion ? results / input.name : results / input.name / task.name.substr(0, task.name.find(' '));
}

RunOptions run_options(const Arguments &arguments, const CaseInput &input, const Task &task = {}) {
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
  return result.summary && result.summary->status == "failed";
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

std::vector<RunResult> compute_case(const CaseInput &input, const Arguments &arguments,
                                    const Computation &computation = {}) {
  listen_to_signals();
  warn_of_inertia(input);
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

std::string unfinished_text(const RunState &state) {
  return state.fraction > 0 ? fmt::format("{:.0f} % done", 100 * state.fraction) : "to be computed";
}

// Prints one line for each run, for programs that distribute the runs: its number, the name of its directory, its identity,
// what there is of it.
ExitCode list_runs(const CaseInput &input, const RunOptions &options) {
  for (std::size_t i = 0; i < input.runs.size(); ++i) {
    const RunInput &run_input = input.runs[i];
    const RunState state = state_of(run_input, options);
    fmt::print("{}\t{}\t{}\t{}\n", i + 1, name_of(run_input, input),
               run_identity(run_input.physics, options.task),
               state.finished ? state.ending : unfinished_text(state));
  }
  return ExitCode::done;
}

CaseInput one_run_of(CaseInput input, std::size_t number) {
  if (number > input.runs.size())
    throw InputError(fmt::format("error: --only {}: {} has {}; `capsule run {} --list` shows them\n", number,
                                 input.name, counted(input.runs.size(), "run"), input.file.string()));
  input.runs = {input.runs[number - 1]};
  return input;
}

ExitCode compute_runs(const CaseInput &whole, const Arguments &arguments, const Computation &computation) {
  const RunOptions options = run_options(arguments, whole, computation.task);
  if (arguments.list)
    return list_runs(whole, options);
  const CaseInput input = arguments.only > 0 ? one_run_of(whole, arguments.only) : whole;
  write_run_list(whole, options.directory);
  const std::vector<RunResult> results = compute_case(input, arguments, computation);
  if (const std::string remark = computation.task.motion ? unsteady_remark(results) : ""; !remark.empty())
    fmt::print(stderr, "{}: {}\n", whole.name, remark);
  if (std::ranges::any_of(results, is_interrupted))
    return ExitCode::interrupted;
  return std::ranges::any_of(results, has_failed) ? ExitCode::numerics_failed : ExitCode::done;
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
  if (!comparisons.empty())
    fmt::print("\n{}\n", text_table(rows));
  if (!files.empty()) {
    write_table(files + ".csv", csv_table(rows));
    write_table(files + ".md", markdown_table(rows));
  }
}

} // namespace

ExitCode run_case(const Arguments &arguments) {
  return compute_runs(read_case_of(arguments), arguments, {});
}

ExitCode find_steady_states(const Arguments &arguments) {
  std::optional<Profile> from;
  Task task{.motion = false, .name = "steady"};
  if (!arguments.from.empty()) {
    from = read_last_profile(arguments.from);
    task.name += fmt::format(" --from {} {}", arguments.from,
                             digest(read_file(fs::path(arguments.from) / "profiles.csv")));
  }
  const Method method = [&](const Case &physics, const Checkpoint & /*none is saved*/,
                            const Control &control) { return steady(physics, from, control); };
  return compute_runs(read_case_of(arguments, task), arguments, {task, method});
}

ExitCode follow_branches(const Arguments &arguments) {
  const Task task{.motion = false,
                  .name = fmt::format("branch --along {} --to {}", arguments.along, arguments.to)};
  const CaseInput input = read_case_of(arguments, task);
  const auto end = [&](const Case &physics) { return end_of_branch(physics, arguments.along, arguments.to); };
  for (const auto &[name, physics] : input.runs)
    require_branch(physics, end(physics).key, end(physics).value);
  const Method method = [&](const Case &physics, const Checkpoint & /*none is saved*/,
                            const Control &control) {
    return follow_branch(physics, end(physics).key, end(physics).value, control);
  };
  return compute_runs(input, arguments, {task, method});
}

ExitCode fit_case(const Arguments &arguments) {
  listen_to_signals();
  const Task task{.motion = false, .name = "fit", .fit = true};
  const CaseInput input = read_case_of(arguments, task);
  return fit_profiles(arguments.profiles, arguments.together, input, run_options(arguments, input, task));
}

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

ExitCode show_case(const Arguments &arguments) {
  const CaseInput input = read_case_of(arguments);
  const RunOptions options = run_options(arguments, input);
  std::size_t finished = 0;
  double seconds_left = 0;
  for (const RunInput &run_input : input.runs) {
    const RunState state = state_of(run_input, options);
    const double left = (1 - state.fraction) * estimated_seconds(run_input.physics);
    finished += state.finished ? 1 : 0;
    seconds_left += left;
    const Case &physics = run_input.physics;
    fmt::print(
        "# {}: {}\n{}{}\n", name_of(run_input, input),
        state.finished ? fmt::format("finished in {}", duration_text(state.cpu_seconds))
                       : fmt::format("{}, about {} to go", unfinished_text(state), duration_text(left)),
        has_physical(physics) ? fmt::format("# {}\n", reynolds_text(physics)) : "", resolved_toml(physics));
  }
  fmt::print("# {}, {} finished, about {} of one core to go\n", counted(input.runs.size(), "run"), finished,
             duration_text(seconds_left));
  return ExitCode::done;
}

ExitCode create_case(const std::string &id, const std::string &like) {
  const fs::path directory = new_case(".", id, like);
  std::set<std::string> files;
  for (const fs::path &file : files_in(directory, [](const fs::path &) { return true; }))
    files.insert(file.filename());
  fmt::print("{}: {}\n", directory.string(), fmt::join(files, " "));
  return ExitCode::done;
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
    const PoreShape shape = input.physics.pore.shape;
    const bool in_the_mouth = shape == PoreShape::hyperbolic && at_the_end("x_g") < at_the_end("length") / 2;
    if (moving <= input.physics.accuracy || in_the_mouth || shape == PoreShape::two_mouths)
      continue;
    ++unsteady;
    fastest = std::max(fastest, moving);
    by_x_g = by_x_g || input.physics.until.x_g;
  }
  if (unsteady == 0)
    return "";
  return fmt::format(
      "not steady yet{}: the membrane still moves with {}{:.2g} relative to its centre; {} leads nearer, "
      "`capsule steady` tells whether there is a steady state",
      results.size() == 1 ? "" : fmt::format(", {} of {}", unsteady, counted(results.size(), "run")),
      unsteady == 1 ? "" : "up to ", fastest,
      by_x_g ? "a larger until.x_g (with pore.exit_x)" : "a larger until.time");
}

} // namespace capsule
