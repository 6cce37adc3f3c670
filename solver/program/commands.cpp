#include "program/commands.hpp"
#include "base/atomic_file.hpp"
#include "base/digest.hpp"
#include "base/failure.hpp"
#include "base/text.hpp"
#include "case/identity.hpp"
#include "case/key_path.hpp"
#include "case/keys.hpp"
#include "case/new_case.hpp"
#include "case/physical.hpp"
#include "case/symbols.hpp"
#include "case/value_lists.hpp"
#include "compare/text_table.hpp"
#include "motion/to_rest.hpp"
#include "output/tables.hpp"
#include "program/fit_profiles.hpp"
#include "program/progress.hpp"
#include "program/remarks.hpp"
#include "program/run_list.hpp"
#include "scene/cost.hpp"
#include "scene/scene.hpp"
#include "steady/branch.hpp"
#include "steady/search.hpp"
#include "steady/steady_state.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <functional>
#include <iterator>
#include <set>
#include <sstream>
#include <utility>

namespace capsule {
namespace {

namespace fs = std::filesystem;

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
    throw InputError(fmt::format("error: --only {}: {} has {}; the same command with --list shows them\n",
                                 number, input.name, counted(input.runs.size(), "run")));
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
  for (const std::string &remark :
       computation.task.motion
           ? std::vector{wrinkle_remark(results), outlet_remark(results), unsteady_remark(results)}
           : std::vector{bearing_remark(results)})
    if (!remark.empty())
      fmt::print(stderr, "{}: {}\n", whole.name, remark);
  if (std::ranges::any_of(results, is_interrupted))
    return ExitCode::interrupted;
  return std::ranges::any_of(results, has_failed) ? ExitCode::numerics_failed : ExitCode::done;
}

// A group of a run as a table shows it, of several capsules one behind the other.
std::string group_text(const std::string &name, const Case &physics) {
  const Key &key = *find_key(name);
  std::vector<std::string> texts;
  for (const Case *capsule : capsules_of(physics)) {
    Case alone = *capsule; // the leading one has a list
    alone.followers.clear();
    if (const auto value = means_something(key, alone) ? get_value(key, alone) : std::nullopt) {
      const auto real = number(key, alone);
      texts.push_back(real ? number_text(std::stod(fmt::format("{:.4g}", *real))) : plain_text(*value));
    }
  }
  return fmt::format("{}", fmt::join(texts, " "));
}

// What is to be known of all runs before they are computed.
std::vector<std::string> remarks_on(const CaseInput &input) {
  std::vector<std::string> remarks;
  const RunInput *fastest = nullptr;
  double accuracy = 0;
  for (const RunInput &run : input.runs) {
    if (has_physical(run.physics) &&
        (fastest == nullptr || reynolds_number(run.physics) > reynolds_number(fastest->physics)))
      fastest = &run;
    if (!run.physics.followers.empty() && run.physics.flow.drive != DriveBy::pressure)
      accuracy = std::max(accuracy, run.physics.accuracy);
  }
  if (fastest != nullptr && fastest->physics.physical.pressure.si > 0)
    remarks.emplace_back("Q is the flow rate without a capsule, as the pressure drives it");
  if (fastest != nullptr)
    remarks.push_back(is_inertia_small(fastest->physics)
                          ? "Re is the Reynolds number of a liquid of " + density_text(fastest->physics)
                          : reynolds_text(fastest->physics));
  if (const std::string strong = strong_flow_remark(input); !strong.empty())
    remarks.push_back(strong);
  if (accuracy > 0)
    remarks.push_back(
        fmt::format("in the tube capsules move as if alone, to this accuracy, beyond a gap of about {:.1f}",
                    gap_without_interaction(accuracy)));
  if (std::ranges::any_of(input.runs, [](const RunInput &run) { return run.physics.followers.empty(); }))
    remarks.push_back(fmt::format("`steady` searches for about {} of one core at most",
                                  duration_text(seconds_of_search(most_work_of_search))));
  return remarks;
}

// Trains are shown as steady states, the only thing that they have, any other case as a march.
std::pair<CaseInput, Task> case_to_show(const Arguments &arguments) {
  const Task steady{.motion = false, .name = "steady"};
  try {
    const CaseInput input = read_case_of(arguments, steady);
    if (std::ranges::all_of(input.runs, [](const RunInput &run) { return run.physics.flow.period > 0; }))
      return {input, steady};
  } catch (const InputError &) { // told below, if it is wrong with a march, too
  }
  return {read_case_of(arguments), Task{}};
}

// Where runs would follow parts of one branch, only the one that begins farthest from its end on either side is left.
CaseInput different_branches(CaseInput input, const Task &task,
                             const std::function<BranchEnd(const Case &)> &end_of) {
  struct Start {
    Case rest;                    // the case but for the key
    double end = 0, distance = 0; // of the beginning from the end, with its sign
    std::size_t run = 0;
  };
  constexpr double rounding = 1e-12; // of a flow rate that is made a capillary number
  std::vector<Start> starts;
  for (std::size_t i = 0; i < input.runs.size(); ++i) {
    const Case &physics = input.runs[i].physics;
    const BranchEnd end = end_of(physics);
    Start start{with_number(physics, end.key, 1), end.value, number(end.key, physics) - end.value, i};
    for (const Physical &physical :
         physical_of(physics, end.key, end.value)) // by which it is given, or may be
      reset_value(*find_key(physical.key), start.rest);
    const auto same = std::ranges::find_if(starts, [&](const Start &other) {
      return other.distance * start.distance > 0 &&
             std::abs(other.end - start.end) <= rounding * std::abs(start.end) &&
             same_input(other.rest, start.rest, task);
    });
    if (same == starts.end())
      starts.push_back(start);
    else if (std::abs(start.distance) > std::abs(same->distance))
      *same = start;
  }
  std::vector<RunInput> kept;
  for (const Start &start : starts)
    kept.push_back(input.runs[start.run]);
  if (kept.size() < input.runs.size())
    fmt::print(stderr, "{}: {} of {} runs lie on the branches of the others\n", input.name,
               input.runs.size() - kept.size(), input.runs.size());
  input.runs = kept;
  return input;
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
                            const Control &control) { return steady(physics, from, control, march_to_rest); };
  return compute_runs(read_case_of(arguments, task), arguments, {task, method});
}

ExitCode follow_branches(const Arguments &arguments) {
  const bool follows_fold = !arguments.fold_along.empty();
  Task task{.motion = false,
            .name = fmt::format("branch --along {} --to {}", arguments.along, arguments.to),
            .branch = true};
  if (follows_fold)
    task.name += fmt::format(" --fold-along {} --fold-to {}", arguments.fold_along, arguments.fold_to);
  CaseInput input = read_case_of(arguments, task);
  const auto end = [&](const Case &physics) { return end_of_branch(physics, arguments.along, arguments.to); };
  const auto second = [&](const Case &physics) {
    return follows_fold ? std::optional(
                              end_of_branch(physics, arguments.fold_along, arguments.fold_to, fold_to_option))
                        : std::nullopt;
  };
  for (const RunInput &run : input.runs)
    require_branch(run.physics, end(run.physics), second(run.physics));
  const Method method = [&](const Case &physics, const Checkpoint & /*none is saved*/,
                            const Control &control) {
    return follow_branch(physics, end(physics), control, march_to_rest, second(physics));
  };
  return compute_runs(different_branches(std::move(input), task, end), arguments, {task, method});
}

ExitCode fit_case(const Arguments &arguments) {
  listen_to_signals();
  const Task task{.motion = false, .name = "fit", .fit = true};
  const CaseInput input = read_case_of(arguments, task);
  return fit_profiles(arguments.profiles, arguments.together, input, run_options(arguments, input, task));
}

ExitCode show_case(const Arguments &arguments) {
  const auto [input, task] = case_to_show(arguments);
  const RunOptions options = run_options(arguments, input, task);
  std::size_t finished = 0;
  double seconds_left = 0;
  const bool is_physical =
      std::ranges::any_of(input.runs, [](const RunInput &run) { return has_physical(run.physics); });
  const auto row = [&](TextRow groups, const TextRow &physical, const std::string &state) {
    if (is_physical)
      std::ranges::copy(physical, std::back_inserter(groups));
    groups.push_back(state);
    return groups;
  };
  std::vector<TextRow> table{row({"run", "law", "R_eq", "eps", "lambda", "delta"}, {"Q", "Re"}, "state")};
  for (const RunInput &run_input : input.runs) {
    const Case &physics = run_input.physics;
    const RunState state = state_of(run_input, options);
    // Of a search there is no estimate, but a limit, which a remark tells.
    const double left = task.motion ? (1 - state.fraction) * estimated_seconds(physics) : 0;
    const std::string to_go = task.motion ? fmt::format(", about {} to go", duration_text(left)) : "";
    finished += state.finished ? 1 : 0;
    seconds_left += left;
    table.push_back(
        row({name_of(run_input, input), group_text("membrane.law", physics),
             group_text("capsule.radius", physics), group_text(flow_key, physics),
             group_text("flow.viscosity_ratio", physics), group_text("membrane.bending_ratio", physics)},
            {flow_rate_text(physics, physics.flow.capillary_number),
             has_physical(physics) ? fmt::format("{:.2g}", reynolds_number(physics)) : ""},
            state.finished ? fmt::format("finished in {}", duration_text(state.cpu_seconds))
                           : unfinished_text(state) + to_go));
    if (&run_input == &input.runs.front())
      fmt::print("{}\n", resolved_toml(physics));
    else
      fmt::print("# {}, where it differs from the first run\n{}\n", name_of(run_input, input),
                 changed_toml(physics, input.runs.front().physics));
  }
  for (const std::string &remark : remarks_on(input))
    fmt::print("# {}\n", remark);
  std::istringstream lines(text_table(table));
  for (std::string line; std::getline(lines, line);)
    fmt::print("# {}\n", line);
  fmt::print("# {}, {} finished{}\n", counted(input.runs.size(), "run"), finished,
             task.motion ? fmt::format(", about {} of one core to go", duration_text(seconds_left)) : "");
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

} // namespace capsule
