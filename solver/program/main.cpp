// The program `capsule`: its options and exit codes. What its commands do: commands.hpp.
#include "base/build_info.hpp"
#include "base/failure.hpp"
#include "base/text.hpp"
#include "program/check_commands.hpp"
#include "program/commands.hpp"
#include "program/list_keys.hpp"
#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <fmt/format.h>
#include <thread>

namespace {

using namespace capsule;

// CLI11's own accepts nan, and its message gives the largest double in full.
CLI::Validator above_zero() {
  return {[](const std::string &text) -> std::string {
            const auto number = to_number(text);
            const bool good = number && *number > 0 && std::isfinite(*number);
            return good ? "" : number ? fmt::format("'{}' is no number above 0", text) : not_a_number(text);
          },
          "> 0"};
}

void add_case(CLI::App &command, Arguments &arguments) {
  command.add_option("CASE", arguments.path, "a case directory or a .toml file")->type_name("")->required();
  command.add_option("--set", arguments.overrides, "a key's value instead of the file's; may be repeated")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  command
      .add_option("--out", arguments.out,
                  "where results go and are looked for, those of another version too; without it "
                  "results/<case>, with steady/ and branch/ below it, whose runs are shared between "
                  "cases through results/runs")
      ->type_name("DIRECTORY");
}

void add_jobs(CLI::App &command, Arguments &arguments) {
  command.add_option("--jobs", arguments.jobs, "runs at a time")
      ->type_name("NUMBER")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
}

void add_computing(CLI::App &command, Arguments &arguments) {
  add_case(command, arguments);
  add_jobs(command, arguments);
  command.add_flag("--fresh", arguments.fresh, "compute again what is finished, from the start");
  command
      .add_option("--time-limit", arguments.time_limit, "leave checkpoints and stop after so many seconds")
      ->type_name("SECONDS")
      ->check(above_zero());
}

void add_selection(CLI::App &command, Arguments &arguments) {
  command.add_flag("--list", arguments.list,
                   "list the runs instead: number, directory, identity, what there is; parted by tabs");
  command.add_option("--only", arguments.only, "compute only the run of this number, as --list counts")
      ->type_name("NUMBER")
      ->check(above_zero());
}

// Names a misspelt command; CLI11 would only say that one is missing.
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

ExitCode run_command(int argc, char **argv) {
  CLI::App app("Entrance of an elastic capsule in a pore");
  app.set_version_flag("--version",
                       fmt::format("capsule {} {}", build_info::version, build_info::git_commit));
  app.require_subcommand(1);
  app.footer(
      "Exit codes: 0 done, 1 a comparison differs, 2 bad input or usage, 3 the numerics failed, 4 files, "
      "130 interrupted (the same command goes on)");
  Arguments arguments;
  arguments.jobs = std::max(1u, std::thread::hardware_concurrency());
  std::string id, like = "example", word;
  ExitCode code = ExitCode::done;
  CLI::App &run_app = *app.add_subcommand("run", "compute every run of a case that is not finished yet");
  add_computing(run_app, arguments);
  add_selection(run_app, arguments);
  run_app.callback([&] { code = run_case(arguments); });
  CLI::App &steady_app =
      *app.add_subcommand("steady", "the steady shape of every run of a case, without marching in time");
  add_computing(steady_app, arguments);
  add_selection(steady_app, arguments);
  steady_app
      .add_option("--from", arguments.from,
                  "begin with the last profile of a run's directory instead of from nothing")
      ->type_name("DIRECTORY");
  steady_app.callback([&] { code = find_steady_states(arguments); });
  CLI::App &branch_app = *app.add_subcommand(
      "branch", "the steady states of every run along one of its keys, through folds: branch.csv");
  add_computing(branch_app, arguments);
  add_selection(branch_app, arguments);
  branch_app.add_option("--along", arguments.along, "the key that varies, from the case's value")
      ->type_name("KEY")
      ->required();
  branch_app
      .add_option("--to", arguments.to,
                  "the value of the key where the branch ends; of physical.flow_rate with its unit")
      ->type_name("VALUE")
      ->required();
  CLI::Option *fold_along = branch_app
                                .add_option("--fold-along", arguments.fold_along,
                                            "follow the last fold along this key: fold_curve.csv")
                                ->type_name("KEY");
  fold_along->needs(branch_app
                        .add_option("--fold-to", arguments.fold_to,
                                    "the value of that key where the curve of the fold ends")
                        ->type_name("VALUE")
                        ->needs(fold_along));
  branch_app.callback([&] { code = follow_branches(arguments); });
  CLI::App &fit_app = *app.add_subcommand(
      "fit", "the unknowns of a case's table [fit] from measured outlines of the capsule: fit.json");
  add_computing(fit_app, arguments);
  fit_app
      .add_option("--profile", arguments.profiles,
                  "an outline as CSV, `x [um],r [um]`, or a directory of them; may be repeated")
      ->type_name("FILE")
      ->required();
  fit_app.add_flag("--together", arguments.together,
                   "all of them are one capsule, at several flow rates: one fit");
  fit_app.callback([&] { code = fit_case(arguments); });
  CLI::App &check_app =
      *app.add_subcommand("check", "compute what is missing and compare with expected values");
  add_computing(check_app, arguments);
  check_app.add_option("--table", arguments.table, "write the comparison to TABLE.csv and TABLE.md, too")
      ->option_text("TABLE");
  check_app.callback([&] { code = check_case(arguments); });
  CLI::App &ledger_app = *app.add_subcommand(
      "ledger", "compute what is missing of all cases and write the ledger of the paper's claims");
  add_jobs(ledger_app, arguments);
  ledger_app.add_option("--table", arguments.table, "where to: TABLE.csv and TABLE.md")
      ->option_text("TABLE")
      ->required();
  ledger_app.callback([&] { code = write_ledger(arguments); });
  CLI::App &show_app =
      *app.add_subcommand("show", "the resolved input of every run, and what there is of it");
  add_case(show_app, arguments);
  show_app.callback([&] { code = show_case(arguments); });
  CLI::App &keys_app = *app.add_subcommand("keys", "every key of a case file, or those about a word");
  keys_app.add_option("WORD", word, "of a key's name or meaning, or its symbol: membrane, eps")
      ->type_name("");
  keys_app.callback([&] { code = list_keys(word); });
  CLI::App &new_app = *app.add_subcommand("new", "a new case directory cases/ID from another one");
  new_app.add_option("ID", id, "its name")->type_name("")->required();
  new_app.add_option("--like", like, "the case to copy: a directory, or the name of one in cases/")
      ->type_name("CASE")
      ->capture_default_str();
  new_app.callback([&] { code = create_case(id, like); });
  require_command(app, argc, argv);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError &error) {
    return app.exit(error) == 0 ? ExitCode::done : ExitCode::bad_input;
  }
  return code;
}

ExitCode fail(ExitCode code, const std::string &message) {
  fmt::print(stderr, "{}", message);
  return code;
}

// Runs the command and prints what it throws.
ExitCode run_or_fail(int argc, char **argv) {
  try {
    const ExitCode code = run_command(argc, argv);
    if (std::fflush(stdout) != 0)
      throw FileError("cannot write to standard output");
    return code;
  } catch (const InputError &error) { // its text is complete
    return fail(ExitCode::bad_input, error.what());
  } catch (const NumericsFailure &failure) {
    return fail(ExitCode::numerics_failed,
                fmt::format("error: {}: {}; {}\n", failure.kind, failure.what(), failure.advice));
  } catch (const FileError &error) {
    return fail(ExitCode::files_failed, fmt::format("error: {}\n", error.what()));
  } catch (const std::system_error &error) { // of standard output, for one
    return fail(ExitCode::files_failed, fmt::format("error: {}\n", error.what()));
  } catch (const std::exception &error) {
    return fail(ExitCode::numerics_failed, fmt::format("error: {}\n", error.what()));
  }
}

} // namespace

int main(int argc, char **argv) {
  return static_cast<int>(run_or_fail(argc, argv));
}
