// CPU time against error, for three scenes and every scheme that the solver keeps; how the time grows, and where it
// goes. All times are measured here, one thing at a time:
//   standard           whole marches at rising accuracy, the companion that estimates the error apart
//   rk4, euler         on the standard discretisation with 0.9 of the longest stable step: error of the computed
//                      history; time of an evaluation of the velocity, the mean over shapes on the way, times their
//                      number
//   paper              error of the stored history; time of a step times the number of steps
#include "study.hpp"
#include "base/decompositions.hpp"
#include "base/failure.hpp"
#include "membrane/load.hpp"
#include "motion/dynamics.hpp"
#include "motion/motion.hpp"
#include "motion/split_bdf.hpp"
#include "motion/time_step.hpp"
#include "observe/gauge.hpp"
#include "scene/make_flow.hpp"
#include "scene/resolution.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numeric>
#include <optional>

using namespace capsule;
namespace fs = std::filesystem;

namespace {

constexpr double first_x_g = -4;
constexpr double last_x_g = 11.5;
const fs::path home = "validation/speed-accuracy";

struct Scene {
  std::string name;
  std::vector<double> accuracies; // the first also gives the discretisation for the explicit schemes
  bool explicit_marches;          // whether they are computed, or only what they would cost
  int reference_nodes;
  double reference_tolerance;  // of a time step
  std::vector<fs::path> paper; // where stored histories lie, one in each directory
};

const std::vector<Scene> &scenes() {
  static const std::vector<Scene> list{
      {"table1",
       {1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7},
       true,
       160,
       2e-12,
       {home / "paper-numerics/table1", "cases/table1-mesh/paper-numerics"}},
      {"skalak5", {1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7}, true, 160, 2e-12, {home / "paper-numerics/skalak5"}},
      {"ellipsoid", {1e-2, 1e-3, 1e-4, 1e-5}, false, 280, 2e-11, {home / "paper-numerics/ellipsoid"}},
  };
  return list;
}

Case physics_of(const Scene &scene, double accuracy) {
  Case physics = read_case(home / (scene.name + ".toml")).runs.front().physics;
  physics.accuracy = accuracy;
  return physics;
}

// ---- What is drawn: one point of the chart ----

struct Point {
  std::string scheme;
  std::string label; // of the mesh or the accuracy asked for
  int nodes = 0;
  double steps = 0;
  double seconds = NAN;               // of the march
  double seconds_with_estimate = NAN; // and of its companion
  std::string failure;                // why there is no history
  History history;
};

struct Errors {
  double history, steady, volume;
};

Errors errors_of(const Point &point, const History &reference) {
  const std::vector<double> &volume = point.history.at("volume_change");
  double drift = 0;
  for (const double change : volume)
    drift = std::max(drift, std::abs(change));
  return {history_error(point.history, reference, "pressure_drop", first_x_g, last_x_g),
          history_error(point.history, reference, "pressure_drop", last_x_g, last_x_g), drift};
}

// ---- Marches ----

// Shapes on the way: the checkpoints, spread evenly over the steps, and the last.
struct TimedMarch {
  Point point;
  std::vector<Vector> shapes;
};

TimedMarch timed_march(const Case &physics, const std::string &label) {
  TimedMarch result;
  const double began = cpu_seconds();
  double marched = began;
  Control control;
  control.progress = [&](const SeriesRow & /*row*/, long /*steps*/) { marched = cpu_seconds(); };
  control.save = [&](const Checkpoint &checkpoint) { result.shapes.push_back(checkpoint.position); };
  const Outcome outcome = march(physics, {}, control);
  const double ended = cpu_seconds();
  result.shapes.push_back(outcome.last.position);
  result.point = {"standard",
                  label,
                  choose_resolution(physics).membrane_nodes,
                  static_cast<double>(outcome.last.steps),
                  marched - began,
                  ended - began,
                  outcome.failure,
                  history_of(outcome.last.series)};
  return result;
}

// Seconds of a call, the mean over a tenth of a second at least.
template <class Function>
double seconds_of(const Function &function) {
  function(); // what the first call allocates or keeps
  const double began = cpu_seconds();
  double spent = 0;
  int calls = 0;
  while (spent < 0.1) {
    function();
    spent = cpu_seconds() - began;
    ++calls;
  }
  return spent / calls;
}

double mean(const std::vector<double> &values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

struct Evaluation {
  double seconds;     // of the velocity of a shape
  double stable_rate; // the fastest decay
};

Evaluation evaluation_on(const Case &physics, std::vector<Vector> shapes) {
  const Dynamics dynamics = make_dynamics(physics);
  shapes.push_back(dynamics.scene->start);
  std::vector<double> seconds;
  double fastest = 0;
  for (const Vector &shape : shapes) {
    *dynamics.recycled = {};
    seconds.push_back(seconds_of([&] { dynamics.flow(shape); }));
    fastest = std::max(fastest, eigenvalues(dynamics.jacobian(shape)).cwiseAbs().maxCoeff());
  }
  return {mean(seconds), fastest};
}

// ---- Explicit schemes ----

struct ExplicitPlan {
  std::size_t scene;
  Point point;
  RunInput run;
  double seconds_per_step;
};

void set_steps(Point &point, double steps, double seconds_per_step) {
  point.steps = steps;
  point.seconds = steps * seconds_per_step;
}

void plan_explicit(std::size_t scene, const Case &standard, const std::vector<Vector> &shapes,
                   double duration, const std::string &label, std::vector<ExplicitPlan> &plans) {
  const Evaluation evaluation = evaluation_on(standard, shapes);
  for (const Scheme scheme : {Scheme::rk4, Scheme::euler}) {
    Case physics = standard;
    physics.time.scheme = scheme;
    physics.time.step =
        std::stod(fmt::format("{:.1e}", 0.9 * stability_limit(scheme) / evaluation.stable_rate));
    const std::string name = scheme == Scheme::rk4 ? "rk4" : "euler";
    ExplicitPlan plan{scene, {}, {}, (scheme == Scheme::rk4 ? 4 : 1) * evaluation.seconds};
    plan.point.scheme = name;
    plan.point.label = label;
    plan.point.nodes = choose_resolution(physics).membrane_nodes;
    plan.run = {fmt::format("{}-{}-{}", scenes()[scene].name, name, label), physics};
    plan.point.failure = "not computed";
    set_steps(plan.point, std::ceil(duration / physics.time.step), plan.seconds_per_step);
    plans.push_back(plan);
  }
}

// ---- The paper's numerics ----

// Steps to the last row of the chart.
double steps_until_last(const History &history, double step) {
  const std::vector<double> &x_g = history.at("x_g");
  const auto last = std::ranges::find_if(x_g, [](double x) { return x > last_x_g - 1e-6; });
  return last == x_g.end()
             ? NAN
             : std::ceil(history.at("time")[static_cast<std::size_t>(last - x_g.begin())] / step);
}

std::vector<Point> paper_points(const Scene &scene) {
  std::vector<Point> points;
  std::vector<fs::path> directories;
  for (const fs::path &parent : scene.paper)
    std::copy_if(
        fs::directory_iterator(parent), {}, std::back_inserter(directories),
        [](const fs::path &entry) { return fs::is_directory(entry); }); // beside them: the list of runs
  for (const fs::path &directory : directories) {
    const Case physics = read_resolved(directory / "resolved.toml");
    const StudyRun run = read_run(directory);
    const Dynamics dynamics = make_dynamics(physics);
    Point point;
    point.scheme = "paper";
    point.label = fmt::format("{}", physics.mesh.membrane);
    point.nodes = physics.mesh.membrane;
    point.history = run.history;
    point.failure = run.summary.failure;
    point.steps = steps_until_last(run.history, physics.time.step);
    point.seconds = point.steps * seconds_of([&] { dynamics.flow(dynamics.scene->start); });
    points.push_back(point);
  }
  std::ranges::sort(points, {}, &Point::nodes);
  return points;
}

// ---- References ----

RunInput reference_run(const Scene &scene, const std::string &which, double nodes_ratio,
                       double tolerance_ratio) {
  RunInput run{scene.name + "-" + which, physics_of(scene, 1e-8)};
  run.physics.mesh.membrane = static_cast<int>(std::lround(scene.reference_nodes * nodes_ratio));
  run.physics.time.tolerance = scene.reference_tolerance * tolerance_ratio;
  return run;
}

// ---- How the time grows ----

// Seconds of one velocity against a number of the mesh, "membrane" or "wall".
Table growth_with(const std::string &mesh, const std::string &column, const std::vector<int> &numbers) {
  const auto seconds = [](const Case &physics) {
    const Dynamics dynamics = make_dynamics(physics);
    return seconds_of([&] { dynamics.flow(dynamics.scene->start); });
  };
  Table table(column + ",lambda1,lambda5,paper");
  for (const int number : numbers) {
    const auto on_mesh = [&](Case physics) {
      (mesh == "wall" ? physics.mesh.wall : physics.mesh.membrane) = number;
      return physics;
    };
    const Case paper = read_case(home / "table1.toml", {"numerics=paper"}).runs.front().physics;
    table.add(fmt::format("{},{:.4g},{:.4g},{:.4g}", number, seconds(on_mesh(physics_of(scenes()[0], 1e-4))),
                          seconds(on_mesh(physics_of(scenes()[1], 1e-4))), seconds(on_mesh(paper))));
  }
  return table;
}

void measure_growth(const fs::path &directory) {
  growth_with("membrane", "nodes", {32, 64, 96, 128, 192, 256}).write(directory / "growth-membrane.csv");
  growth_with("wall", "elements", {60, 120, 240, 480}).write(directory / "growth-wall.csv");
}

// ---- Where the time goes ----

struct Shares {
  double load = 0, interaction = 0, system = 0, jacobian = 0, integrator = 0, observables = 0;
  double membrane_part = 0; // of the interaction
};

// The standard preset's march, put together from the solver's parts with a clock around each. Load and interaction are
// computed once more for their clocks.
Shares measure_shares(const Case &physics, const std::vector<Vector> &shapes, double rows) {
  const Resolution resolution = choose_resolution(physics);
  const Dynamics dynamics = make_dynamics(physics);
  const Membrane &membrane = dynamics.scene->membrane;
  const Flow flow = make_flow(dynamics.scene->pore, physics.flow, membrane.basis, resolution.flow);
  const Gauge gauge(dynamics.scene->pore, membrane);
  Shares shares;
  double velocity = 0;  // load, interaction and systems
  double flow_load = 0; // the load's part of it
  const auto clocked = [](double &sum, const auto &function) {
    const double began = cpu_seconds();
    auto result = function();
    sum += cpu_seconds() - began;
    return result;
  };
  const SplitEquations equations{
      .load =
          [&](const Vector &position) {
            return clocked(shares.load, [&] { return dynamics.load(position); });
          },
      .rate = [&](const Vector &position) -> SplitEquations::Rate {
        clocked(flow_load, [&] { return membrane_load(membrane, position); });
        clocked(shares.interaction, [&] { return flow.interact(position); });
        return {clocked(velocity, [&] { return dynamics.report(position, true).velocity; })};
      },
      .mobility =
          [&](const Vector &position) {
            return clocked(shares.jacobian, [&] { return dynamics.mobility(position); });
          },
      .load_jacobian =
          [&](const Vector &position) {
            return clocked(shares.jacobian, [&] { return dynamics.load_jacobian(position); });
          }};
  const double began = cpu_seconds();
  SplitBdf integrator(equations, 0, dynamics.scene->start, resolution.time_tolerance);
  while (gauge.centre(integrator.state_at(integrator.time())) < last_x_g)
    integrator.step();
  const double once = flow_load + shares.interaction;
  shares.system = std::max(0.0, velocity - once);
  shares.integrator = cpu_seconds() - began - once - velocity - shares.load - shares.jacobian;
  shares.load += flow_load;

  const Flow membrane_alone = make_flow(std::nullopt, physics.flow, membrane.basis, resolution.flow);
  std::vector<double> alone, all, row;
  for (const Vector &shape : shapes) {
    alone.push_back(seconds_of([&] { membrane_alone.interact(shape); }));
    all.push_back(seconds_of([&] { flow.interact(shape); }));
    row.push_back(seconds_of([&] {
      gauge.row(0, shape, shape); // as long with any velocity
      gauge.crosses_itself(shape);
    }));
  }
  shares.membrane_part = mean(alone) / mean(all);
  shares.observables = rows * mean(row);
  return shares;
}

std::string shares_row(const std::string &scene, const Shares &shares) {
  return fmt::format("{},{:.4g},{:.4g},{:.4g},{:.4g},{:.4g},{:.4g},{:.4g}", scene,
                     shares.interaction * shares.membrane_part,
                     shares.interaction * (1 - shares.membrane_part), shares.system, shares.load,
                     shares.jacobian, shares.integrator, shares.observables);
}

// ---- Tables ----

// The paper's numerics on 60 elements, or on its next mesh that reaches the end; null if none does.
const Point *baseline_of(const std::vector<Point> &points) {
  const auto found = std::ranges::find_if(points, [](const Point &point) {
    return point.scheme == "paper" && point.nodes >= 60 && point.failure.empty();
  });
  return found == points.end() ? nullptr : &*found;
}

struct SceneResult {
  const Scene *scene = nullptr;
  std::vector<Point> points; // scheme after scheme
  History reference;
  double reference_error = 0;
};

std::string markdown_row(const SceneResult &result, const Point &point) {
  const std::string head =
      fmt::format("| {} | {} {} | {} | ", result.scene->name, point.scheme, point.label, point.nodes);
  if (point.history.empty())
    return head + fmt::format("{:.0f} | {:.3g} | {} | | | | |\n", point.steps, point.seconds, point.failure);
  if (!point.failure.empty())
    return head + fmt::format("| | fails: {} at x_g = {:.3g} | | | | |\n", point.failure,
                              point.history.at("x_g").back());
  const Errors errors = errors_of(point, result.reference);
  std::string row = head + fmt::format("{:.0f} | {:.3g} | {:.1e} | {:.1e} | {:.1e} |", point.steps,
                                       point.seconds, errors.history, errors.steady, errors.volume);
  if (const Point *baseline = baseline_of(result.points))
    row += fmt::format(" {:.3g} | {:.3g} |\n", baseline->seconds / point.seconds,
                       errors_of(*baseline, result.reference).history / errors.history);
  else
    row += " | |\n";
  return row;
}

void write_scene(const fs::path &directory, const SceneResult &result) {
  std::vector<std::string> schemes;
  for (const Point &point : result.points)
    if (std::ranges::find(schemes, point.scheme) == schemes.end())
      schemes.push_back(point.scheme);
  for (const std::string &scheme : schemes) {
    Table table("label,nodes,steps,seconds,seconds_with_estimate,history_error,steady_error,volume_drift");
    for (const Point &point : result.points) {
      if (point.scheme != scheme || !point.failure.empty())
        continue;
      const Errors errors = errors_of(point, result.reference);
      table.add(fmt::format("{},{},{:.0f},{:.4g},{:.4g},{:.3e},{:.3e},{:.3e}", point.label, point.nodes,
                            point.steps, point.seconds, point.seconds_with_estimate, errors.history,
                            errors.steady, errors.volume));
    }
    table.write(directory / fmt::format("{}-{}.csv", result.scene->name, scheme));
  }
}

// The claims: against the baseline at least 300 times less time at an error at least 10 times smaller, by one and
// the same march; and the accuracy asked for reached.
bool judge(const SceneResult &result) {
  const Point *baseline = baseline_of(result.points);
  const double allowed = baseline ? 0.1 * errors_of(*baseline, result.reference).history : INFINITY;
  bool holds = true;
  double ratio = 0;
  for (const Point &point : result.points) {
    if (point.scheme != "standard")
      continue;
    const double error = errors_of(point, result.reference).history;
    const double asked = std::stod(point.label);
    if (!(error <= asked)) {
      holds = false;
      fmt::print("{}: error {:.1e} where {:.0e} was asked for\n", result.scene->name, error, asked);
    }
    if (baseline && error < allowed)
      ratio = std::max(ratio, baseline->seconds / point.seconds);
  }
  fmt::print("{}: error of the reference {:.1e}; ", result.scene->name, result.reference_error);
  if (!baseline) {
    fmt::print("the paper's numerics reach the end on no mesh\n");
    return holds;
  }
  fmt::print(
      "at less than a tenth of its error {:.0f} times faster than the paper's numerics on {} elements\n",
      ratio, baseline->nodes);
  return holds && ratio >= 300;
}

bool study(const std::string &output, unsigned jobs) {
  const fs::path directory = output;
  make_directories(directory);
  std::vector<SceneResult> results;
  std::vector<ExplicitPlan> plans;
  Table shares("scene,membrane,wall,system,load,jacobian,integrator,observables");
  for (std::size_t s = 0; s < scenes().size(); ++s) {
    const Scene &scene = scenes()[s];
    SceneResult result;
    result.scene = &scene;
    for (const double accuracy : scene.accuracies) {
      const Case physics = physics_of(scene, accuracy);
      const std::string label = fmt::format("{:.0e}", accuracy);
      const TimedMarch timed = timed_march(physics, label);
      fmt::print("{} {}: {:.2f} s\n", scene.name, label, timed.point.seconds);
      result.points.push_back(timed.point);
      if (accuracy == scene.accuracies.front())
        plan_explicit(s, physics, timed.shapes, timed.point.history.at("time").back(), label, plans);
      if (accuracy == 1e-4)
        shares.add(shares_row(scene.name,
                              measure_shares(physics, timed.shapes,
                                             static_cast<double>(timed.point.history.at("x_g").size()))));
    }
    results.push_back(result);
  }
  shares.write(directory / "shares.csv");
  measure_growth(directory);
  for (SceneResult &result : results) {
    const std::vector<Point> paper = paper_points(*result.scene);
    result.points.insert(result.points.end(), paper.begin(), paper.end());
  }

  // Histories only; nothing is timed from here on.
  std::vector<RunInput> inputs;
  for (const Scene &scene : scenes()) {
    inputs.push_back(reference_run(scene, "reference", 1, 1));
    inputs.push_back(reference_run(scene, "second-reference", 0.85, 4));
  }
  const std::vector<StudyRun> reference_runs = run_all(output, jobs, inputs, Found::of_any);
  inputs.clear();
  for (const ExplicitPlan &plan : plans)
    if (scenes()[plan.scene].explicit_marches)
      inputs.push_back(plan.run);
  const std::vector<StudyRun> runs = run_all(output, jobs, inputs);
  auto run = runs.begin();
  for (ExplicitPlan &plan : plans) {
    if (scenes()[plan.scene].explicit_marches) {
      plan.point.failure = run->summary.failure;
      plan.point.history = run->history;
      set_steps(plan.point, run->summary.quantities.at("steps"), plan.seconds_per_step);
      ++run;
    }
    results[plan.scene].points.push_back(plan.point);
  }

  bool holds = true;
  Table references("scene,error");
  std::string markdown =
      "| scene | scheme | N_M | steps | CPU s | error of the history | of the steady value | "
      "volume drift | times faster | times more accurate |\n|" +
      std::string("---|---|---|---|---|---|---|---|---|---|\n");
  for (std::size_t s = 0; s < results.size(); ++s) {
    SceneResult &result = results[s];
    result.reference = reference_runs[2 * s].history;
    result.reference_error = history_error(reference_runs[2 * s + 1].history, result.reference,
                                           "pressure_drop", first_x_g, last_x_g);
    references.add(fmt::format("{},{:.3e}", result.scene->name, result.reference_error));
    write_scene(directory, result);
    for (const Point &point : result.points)
      markdown += markdown_row(result, point);
    holds = judge(result) && holds;
  }
  references.write(directory / "references.csv");
  write_atomically("tables/speed-accuracy.md",
                   "**Speed and accuracy.** Times faster and more accurate than the "
                   "paper's numerics on 60 elements, measured in one run.\n\n" +
                       markdown);
  fmt::print("{}speed-accuracy: {}\n", markdown, holds ? "HOLDS" : "FAILS");
  return holds;
}

} // namespace

int main(int argc, char **argv) {
  return study_main(argc, argv, study);
}
