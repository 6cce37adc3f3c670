#include "program/commands.hpp"
#include "base/atomic_file.hpp"
#include "base/digest.hpp"
#include "base/failure.hpp"
#include "base/text.hpp"
#include "case/identity.hpp"
#include "case/new_case.hpp"
#include "case/physical.hpp"
#include "output/tables.hpp"
#include "program/fit_profiles.hpp"
#include "program/progress.hpp"
#include "program/run_list.hpp"
#include "scene/cost.hpp"
#include "scene/scene.hpp"
#include "steady/branch.hpp"
#include "steady/steady_state.hpp"
#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <set>

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
        "# {}: {}\n{}{}{}\n", name_of(run_input, input),
        state.finished ? fmt::format("finished in {}", duration_text(state.cpu_seconds))
                       : fmt::format("{}, about {} to go", unfinished_text(state), duration_text(left)),
        has_physical(physics) ? fmt::format("# {}\n# {}\n", flow_rate_text(physics), reynolds_text(physics))
                              : "",
        physics.followers.empty() || physics.flow.drive == DriveBy::pressure
            ? ""
            : fmt::format(
                  "# in the tube capsules move as if alone, to this accuracy, beyond a gap of about {:.1f}\n",
                  gap_without_interaction(physics.accuracy)),
        resolved_toml(physics));
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
    if (!summary || summary->status != word_of(Status::reached))
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
    by_x_g = by_x_g || input.physics.until.by_place();
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
