// The program `capsule`: its commands and exit codes.
//   0 done; 1 a comparison differs; 2 bad input or usage; 3 the numerics failed; 4 files; 130 interrupted
#include "base/atomic_file.hpp"
#include "base/build_info.hpp"
#include "base/failure.hpp"
#include "base/text.hpp"
#include "case/identity.hpp"
#include "case/keys.hpp"
#include "case/new_case.hpp"
#include "case/project.hpp"
#include "compare/comparison.hpp"
#include "compare/ledger.hpp"
#include "motion/motion.hpp"
#include "output/provenance.hpp"
#include "output/tables.hpp"
#include "program/case_runs.hpp"
#include "program/progress.hpp"
#include "scene/cost.hpp"
#include "steady/branch.hpp"
#include "steady/steady_state.hpp"
#include <CLI/CLI.hpp>
#include <atomic>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <set>
#include <thread>
#include <unistd.h>

namespace {

using namespace capsule;
namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

enum ExitCode {
  done = 0,
  differs = 1,
  bad_input = 2,
  numerics_failed = 3,
  files_failed = 4,
  interrupted = 130
};

// The only thing a signal's handler may touch.
std::atomic<bool> signal_came = false;

// Once: a second signal ends the program at once.
void listen_to_signals() {
  struct sigaction action {};
  action.sa_handler = [](int) { signal_came = true; };
  action.sa_flags = static_cast<int>(SA_RESETHAND);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

// What the commands that read a case have in common.
struct Arguments {
  std::string path;
  std::vector<std::string> overrides;
  std::string out;
  unsigned jobs = std::max(1u, std::thread::hardware_concurrency());
  bool fresh = false;
  double time_limit = 0; // seconds; 0: none
  std::string table;     // files of the comparison, without their endings
  bool list = false;     // the runs, instead of computing them
  std::size_t only = 0;  // one run of a sweep, counted from 1; 0: all
  std::string from;      // directory of a run whose last profile is near to the steady state
  std::string along;     // the key that varies on a branch
  double to = 0;         // and where it goes
};

// A case of the project that is called by its name alone, or by a name that is nearly right, is named in full.
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

// What is computed of a case, and what computes it.
struct Method {
  Task task = {};
  March compute = march;
};

// results/<case> for its motion, results/<case>/steady and results/<case>/branch for its steady states.
fs::path usual_place(const fs::path &results, const CaseInput &input, const Task &task) {
  return task.motion ? results / input.name : results / input.name / task.name.substr(0, task.name.find(' '));
}

RunOptions run_options(const Arguments &arguments, const CaseInput &input, const Task &task = {}) {
  const fs::path results = "results";
  RunOptions options;
  options.directory = arguments.out.empty() ? usual_place(results, input, task) : fs::path(arguments.out);
  options.pool = arguments.out.empty() ? results / "runs" : fs::path();
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

std::vector<RunResult> compute_case(const CaseInput &input, const RunOptions &options,
                                    const March &march_or_solve) {
  listen_to_signals();
  std::vector<RunResult> results = compute(input, options, march_or_solve);
  for (const RunResult &result : results)
    if (has_failed(result))
      fmt::print(stderr, "{}: {}: {}\n", result.directory.string(), result.summary->failure,
                 result.summary->message);
  const auto unfinished = std::ranges::count_if(results, is_interrupted);
  if (unfinished > 0)
    fmt::print(stderr, "interrupted: {} of {} to finish; the same command {}\n", unfinished,
               counted(results.size(), "run"),
               options.task.motion ? "goes on from the last checkpoint" : "begins with them again");
  return results;
}

std::vector<RunResult> compute_case(const CaseInput &input, const Arguments &arguments,
                                    const Method &method = {}) {
  return compute_case(input, run_options(arguments, input, method.task), method.compute);
}

// What a study (validation/<name>/study.cpp) has left in its results' summary.json, as one run.
void add_study(const std::string &name, RunTable &table) {
  RunResult result;
  result.directory = fs::path("results") / name;
  if (!fs::exists(result.directory / "summary.json"))
    return;
  result.summary = read_summary(result.directory);
  table.add(name, {result});
}

// Computes these cases of the project where they are not finished, into the table; whether all are now.
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

// One line a run, for programs that share the runs out: its number, the name of its directory, its identity, what
// there is of it.
int list_runs(const CaseInput &input, const RunOptions &options) {
  for (std::size_t i = 0; i < input.runs.size(); ++i) {
    const RunInput &run_input = input.runs[i];
    const RunState state = state_of(run_input, options);
    fmt::print("{}\t{}\t{}\t{}\n", i + 1, run_input.name.empty() ? input.name : run_input.name,
               run_identity(run_input.physics, options.task),
               state.finished       ? state.ending
               : state.fraction > 0 ? fmt::format("{:.0f} % done", 100 * state.fraction)
                                    : "to be computed");
  }
  return done;
}

CaseInput one_run_of(CaseInput input, std::size_t number) {
  if (number > input.runs.size())
    throw InputError(fmt::format("error: --only {}: {} has {}; `capsule run {} --list` shows them\n", number,
                                 input.name, counted(input.runs.size(), "run"), input.file.string()));
  input.runs = {input.runs[number - 1]};
  return input;
}

int run(const CaseInput &whole, const Arguments &arguments, const Method &method) {
  const RunOptions options = run_options(arguments, whole, method.task);
  if (arguments.list)
    return list_runs(whole, options);
  const CaseInput input = arguments.only > 0 ? one_run_of(whole, arguments.only) : whole;
  write_run_list(whole, options);
  const std::vector<RunResult> results = compute_case(input, arguments, method);
  if (const std::string remark = method.task.motion ? unsteady_remark(results) : ""; !remark.empty())
    fmt::print(stderr, "{}: {}\n", whole.name, remark);
  if (std::ranges::any_of(results, is_interrupted))
    return interrupted;
  return std::ranges::any_of(results, has_failed) ? numerics_failed : done;
}

int run(const Arguments &arguments, const Method &method = {}) {
  return run(read_case_of(arguments, method.task), arguments, method);
}

int run_steady(const Arguments &arguments) {
  std::optional<Profile> from;
  Task task{.motion = false, .name = "steady"};
  if (!arguments.from.empty()) {
    from = read_last_profile(arguments.from);
    task.name += fmt::format(" --from {} {}", arguments.from, identity_of(arguments.from));
  }
  return run(arguments, {task, [&](const Case &physics, const Checkpoint & /*none is saved*/,
                                   const Control &control) { return steady(physics, from, control); }});
}

int run_branch(const Arguments &arguments) {
  const Task task{.motion = false,
                  .name =
                      fmt::format("branch --along {} --to {}", arguments.along, number_text(arguments.to))};
  const CaseInput whole = read_case_of(arguments, task);
  for (const RunInput &input : whole.runs)
    require_branch(input.physics, arguments.along, arguments.to);
  return run(whole, arguments,
             {task, [&](const Case &physics, const Checkpoint & /*none is saved*/, const Control &control) {
                return follow_branch(physics, arguments.along, arguments.to, control);
              }});
}

int check(const Arguments &arguments) {
  const CaseInput input = read_case_of(arguments);
  const auto published = find_expectations(input.file);
  std::vector<Expectation> expectations = own_expectations(input.file, input.name);
  if (published)
    std::ranges::move(expectations_of(read_expectations(*published), input.name),
                      std::back_inserter(expectations));
  write_run_list(input, run_options(arguments, input));
  const std::vector<RunResult> results = compute_case(input, arguments);
  if (std::ranges::any_of(results, is_interrupted))
    return interrupted;
  RunTable table;
  table.add(input.name, results);
  if (published && !add_project_cases(referenced_cases(expectations), *published, arguments, table))
    return interrupted;
  std::vector<Comparison> comparisons = compare(expectations, input.name, table);
  // Who chooses some of the runs does not ask for the others.
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
  const std::vector<TextRow> rows = comparison_rows(comparisons);
  if (comparisons.empty())
    fmt::print(stderr, "warning: no expectations for {}\n", input.name);
  else
    fmt::print("\n{}\n", text_table(rows));
  if (!arguments.table.empty()) {
    write_atomically(arguments.table + ".csv", csv_table(rows));
    write_atomically(arguments.table + ".md", markdown_table(rows));
  }
  fmt::print("{}: {}: {} of {} agree, {} differ, {} not decidable; {} failed unexpectedly\n", input.name,
             failures > 0          ? "FAILS"
             : comparisons.empty() ? "NOTHING TO COMPARE"
             : all                 ? "AS RECORDED"
                                   : "NOT AS RECORDED",
             count(Verdict::agrees), counted(comparisons.size(), "row"), count(Verdict::differs),
             count(Verdict::not_decidable), counted(static_cast<std::size_t>(failures), "run"));
  return failures > 0 ? numerics_failed : all ? done : differs;
}

// All cases that the table of published values speaks of.
int ledger(const Arguments &arguments) {
  const auto published = find_expectations(fs::current_path() / "case.toml");
  if (!published)
    throw InputError("error: there is no tables/published.csv here or above\n");
  const fs::path root = published->parent_path().parent_path();
  const std::vector<Expectation> expectations = read_expectations(*published);
  std::vector<std::string> names = referenced_cases(expectations);
  for (const Expectation &row : expectations)
    names.push_back(row.case_name);
  RunTable table;
  if (!add_project_cases(names, *published, arguments, table))
    return interrupted;
  std::vector<std::string> cases = table.cases(); // without the studies
  std::erase_if(cases, [&](const std::string &name) { return !find_project_case(root, name); });
  std::vector<Comparison> comparisons;
  for (const Expectation &row : expectations)
    for (const std::string &name : row.case_name == "*" ? cases : std::vector{row.case_name}) {
      const std::vector<Comparison> more = compare({row}, name, table);
      comparisons.insert(comparisons.end(), more.begin(), more.end());
    }
  const Ledger ledger = make_ledger(comparisons);
  write_atomically(arguments.table + ".csv", ledger.csv);
  write_atomically(arguments.table + ".md", ledger.markdown);
  fmt::print("{}: {}; {} not as recorded\n", arguments.table, ledger.summary,
             counted(static_cast<std::size_t>(ledger.not_as_recorded), "row"));
  return ledger.not_as_recorded == 0 ? done : differs;
}

int show(const Arguments &arguments) {
  const CaseInput input = read_case_of(arguments);
  const RunOptions options = run_options(arguments, input);
  std::size_t finished = 0;
  double seconds_left = 0;
  for (const RunInput &run_input : input.runs) {
    const RunState state = state_of(run_input, options);
    const double left = (1 - state.fraction) * estimated_seconds(run_input.physics);
    finished += state.finished ? 1 : 0;
    seconds_left += left;
    fmt::print("# {}: {}{}\n{}\n", run_input.name.empty() ? input.name : run_input.name,
               state.finished       ? fmt::format("finished in {}", duration_text(state.cpu_seconds))
               : state.fraction > 0 ? fmt::format("{:.0f} % done", 100 * state.fraction)
                                    : "to be computed",
               state.finished ? "" : fmt::format(", about {} to go", duration_text(left)),
               resolved_toml(run_input.physics));
  }
  fmt::print("# {}, {} finished, about {} of one core to go\n", counted(input.runs.size(), "run"), finished,
             duration_text(seconds_left));
  return done;
}

int list_keys() {
  std::string section;
  for (const Key &key : keys()) {
    const std::string here = key.name.substr(0, key.name.find('.'));
    fmt::print("{}{:<28}{}\n{:<28}default: {}; allowed: {}\n", here == section ? "" : "\n", key.name,
               key.meaning, "", default_text(key), allowed_text(key));
    section = here;
  }
  fmt::print("\n{:<26}values of another case file, relative to this one, that this one overrides;\n"
             "{:<26}of several, [\"a\", \"b\"]: the runs of each\n"
             "sweep.\"any.key\" = [...]   one run per value; several sweeps make every combination\n",
             "inherit", "");
  return done;
}

int create(const std::string &id, const std::string &like) {
  const fs::path directory = new_case(".", id, like);
  std::set<std::string> files;
  for (const fs::path &file : files_in(directory, [](const fs::path &) { return true; }))
    files.insert(file.filename());
  fmt::print("{}: {}\n", directory.string(), fmt::join(files, " "));
  return done;
}

// CLI11's own takes nan, and says the largest double in full.
CLI::Validator above_zero() {
  return {[](const std::string &text) -> std::string {
            const auto number = to_number(text);
            const bool good = number && *number > 0 && std::isfinite(*number);
            return good ? "" : fmt::format("'{}' is no number above 0", text);
          },
          "> 0"};
}

void add_case(CLI::App &command, Arguments &arguments) {
  command.add_option("CASE", arguments.path, "a case directory or a .toml file")->required();
  command
      .add_option("--set", arguments.overrides,
                  "a key's value instead of the file's, as key=value; may be repeated")
      ->allow_extra_args(false);
  command.add_option("--out", arguments.out,
                     "where results go and are looked for, those of another version too; without it "
                     "results/<case>, with steady/ and branch/ below it, whose runs are shared between "
                     "cases through results/runs");
}

void add_jobs(CLI::App &command, Arguments &arguments) {
  command.add_option("--jobs", arguments.jobs, "runs at a time")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
}

void add_computing(CLI::App &command, Arguments &arguments) {
  add_case(command, arguments);
  add_jobs(command, arguments);
  command.add_flag("--fresh", arguments.fresh, "compute again what is finished, from the start");
  command
      .add_option("--time-limit", arguments.time_limit, "leave checkpoints and stop after so many seconds")
      ->check(above_zero());
}

void add_selection(CLI::App &command, Arguments &arguments) {
  command.add_flag("--list", arguments.list,
                   "list the runs instead: number, directory, identity, what there is; parted by tabs");
  command.add_option("--only", arguments.only, "compute only the run of this number, as --list counts")
      ->check(above_zero());
}

// A misspelt command is said to be one; CLI11 would only miss the right one.
void require_command(const CLI::App &app, int argc, char **argv) {
  const std::string word = argc > 1 ? argv[1] : "-";
  std::vector<std::string> names;
  for (const CLI::App *command : app.get_subcommands({}))
    names.push_back(command->get_name());
  if (word.starts_with("-") || std::ranges::find(names, word) != names.end())
    return;
  const std::string near = nearest_word(word, names);
  throw InputError(fmt::format("error: unknown command '{}'\n{}`capsule --help` lists the commands\n", word,
                               near.empty() ? "" : fmt::format("did you mean '{}'? ", near)));
}

int run_command(int argc, char **argv) {
  CLI::App app("Entrance of an elastic capsule in a pore");
  app.set_version_flag("--version",
                       fmt::format("capsule {} {}", build_info::version, build_info::git_commit));
  app.require_subcommand(1);
  app.footer(
      "Exit codes: 0 done, 1 a comparison differs, 2 bad input or usage, 3 the numerics failed, 4 files, "
      "130 interrupted (the same command goes on)");
  Arguments arguments;
  std::string id, like = "example";
  int code = done;
  CLI::App &run_app = *app.add_subcommand("run", "compute every run of a case that is not finished yet");
  add_computing(run_app, arguments);
  add_selection(run_app, arguments);
  run_app.callback([&] { code = run(arguments); });
  CLI::App &steady_app =
      *app.add_subcommand("steady", "the steady shape of every run of a case, without marching in time");
  add_computing(steady_app, arguments);
  add_selection(steady_app, arguments);
  steady_app.add_option("--from", arguments.from,
                        "begin with the last profile of a run's directory instead of from nothing");
  steady_app.callback([&] { code = run_steady(arguments); });
  CLI::App &branch_app = *app.add_subcommand(
      "branch", "the steady states of every run along one of its keys, through folds: branch.csv");
  add_computing(branch_app, arguments);
  add_selection(branch_app, arguments);
  branch_app.add_option("--along", arguments.along, "the key that varies, from the case's value")->required();
  branch_app.add_option("--to", arguments.to, "the value of the key where the branch ends")->required();
  branch_app.callback([&] { code = run_branch(arguments); });
  CLI::App &check_app =
      *app.add_subcommand("check", "compute what is missing and compare with expected values");
  add_computing(check_app, arguments);
  check_app.add_option("--table", arguments.table, "write the comparison to TABLE.csv and TABLE.md, too")
      ->option_text("TABLE");
  check_app.callback([&] { code = check(arguments); });
  CLI::App &ledger_app = *app.add_subcommand(
      "ledger", "compute what is missing of all cases and write the ledger of the paper's claims");
  add_jobs(ledger_app, arguments);
  ledger_app.add_option("--table", arguments.table, "where to: TABLE.csv and TABLE.md")
      ->option_text("TABLE")
      ->required();
  ledger_app.callback([&] { code = ledger(arguments); });
  CLI::App &show_app =
      *app.add_subcommand("show", "the resolved input of every run, and what there is of it");
  add_case(show_app, arguments);
  show_app.callback([&] { code = show(arguments); });
  app.add_subcommand("keys", "every key of a case file")->callback([&] { code = list_keys(); });
  CLI::App &new_app = *app.add_subcommand("new", "a new case directory cases/ID from another one");
  new_app.add_option("ID", id, "its name")->required();
  new_app.add_option("--like", like, "the case to copy: a directory, or the name of one in cases/")
      ->capture_default_str();
  new_app.callback([&] { code = create(id, like); });
  require_command(app, argc, argv);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError &error) {
    return app.exit(error) == 0 ? done : bad_input;
  }
  return code;
}

} // namespace

int main(int argc, char **argv) {
  int code = done;
  try {
    code = run_command(argc, argv);
    if (std::fflush(stdout) != 0)
      throw FileError("cannot write to standard output");
  } catch (const InputError &error) {
    fmt::print(stderr, "{}", error.what());
    return bad_input;
  } catch (const NumericsFailure &failure) {
    fmt::print(stderr, "error: {}: {}; {}\n", failure.kind, failure.what(), failure.advice);
    return numerics_failed;
  } catch (const FileError &error) {
    fmt::print(stderr, "error: {}\n", error.what());
    return files_failed;
  } catch (const std::system_error &error) { // of standard output, for one
    fmt::print(stderr, "error: {}\n", error.what());
    return files_failed;
  } catch (const std::exception &error) {
    fmt::print(stderr, "error: {}\n", error.what());
    return numerics_failed;
  }
  return code;
}
