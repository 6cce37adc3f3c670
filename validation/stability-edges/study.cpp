// How far away must the edges of the scene be? The exit plane and the entrance section by the flow around one and the
// same shape, which has no error of a march; the start by marches.
#include "study.hpp"
#include "motion/dynamics.hpp"
#include "motion/motion.hpp"
#include "observe/gauge.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

using namespace capsule;

namespace {

constexpr double in_tube = 3;        // x_g of the shape in the tube
constexpr double far_exit = 20;      // stands for a pore that never ends
constexpr double far_entrance = 960; // and for a reservoir without end
constexpr double far_start = -8;

Case table1() {
  Case physics = physics_of("table1-mesh");
  physics.accuracy = 1e-5;               // of the wall
  physics.membrane.bending_ratio = 1e-4; // no wrinkles that noise could start sooner or later
  physics.mesh.membrane = 48;
  physics.pore.exit_x = far_exit;
  physics.pore.entrance_distance = far_entrance;
  return physics;
}

Vector shape_at(double x_g) {
  Case physics = table1();
  physics.accuracy = 1e-4;
  physics.pore.exit_x = in_tube + 7;
  physics.capsule.start_x = -3;
  physics.until.x_g = x_g;
  return march(physics, {}, {}).last.position;
}

struct Seen {
  double pressure_drop, v_g;
};

Seen seen(const Case &physics, const Vector &position) {
  const Dynamics dynamics = make_dynamics(physics);
  const FlowState state = dynamics.flow(position);
  return {state.pressure_drop,
          Gauge(dynamics.scene->pore, dynamics.scene->membrane).row(0, position, state.velocity).v_g};
}

struct Distance {
  double value;
  double pressure_error, velocity_error; // relative
};

// What changes with a distance, relative to the flow with all edges far away.
std::vector<Distance> changes(const std::string &what, const std::vector<double> &values,
                              const Vector &position, const std::function<void(Case &, double)> &set,
                              Table &table) {
  const Seen exact = seen(table1(), position);
  std::vector<Distance> found;
  for (const double value : values) {
    Case physics = table1();
    set(physics, value);
    const Seen now = seen(physics, position);
    found.push_back(
        {value, std::abs(now.pressure_drop / exact.pressure_drop - 1), std::abs(now.v_g / exact.v_g - 1)});
    table.add(fmt::format("{},{:g},{:.4e},{:.4e}", what, value, found.back().pressure_error,
                          found.back().velocity_error));
    fmt::print("{} {:g}: pressure drop changes by {:.1e}, v_g by {:.1e}\n", what, value,
               found.back().pressure_error, found.back().velocity_error);
  }
  return found;
}

// From which distance on all errors are below a bound.
double enough(const std::vector<Distance> &found, double bound) {
  double distance = NAN;
  for (auto one = found.rbegin();
       one != found.rend() && std::max(one->pressure_error, one->velocity_error) < bound; ++one)
    distance = one->value;
  return distance;
}

void report(const std::string &what, const std::vector<Distance> &found, Table &needs) {
  for (const double bound : {1e-3, 1e-4, 1e-5, 1e-6}) {
    needs.add(fmt::format("{},{:g},{:g}", what, bound, enough(found, bound)));
    fmt::print("{}: {:g} is enough for {:g}\n", what, enough(found, bound), bound);
  }
}

bool exits(const Vector &position, Table &table, Table &needs) {
  const std::vector<Distance> found = changes(
      "exit", {1.5, 2, 2.5, 3, 3.5, 4, 4.5, 5, 6}, position,
      [](Case &c, double distance) { c.pore.exit_x = in_tube + distance; }, table);
  report("exit", found, needs);
  const double need = enough(found, 1e-4);
  return check(need <= 4,
               fmt::format("an exit 4 radii beyond the centre is far enough for 1e-4 (from {:g} on)", need));
}

bool entrances(const std::vector<std::pair<std::string, Vector>> &shapes, Table &table, Table &needs) {
  bool holds = true;
  for (const auto &[name, position] : shapes) {
    const std::vector<Distance> found = changes(
        "entrance" + name, {7.5, 15, 30, 60, 120}, position,
        [](Case &c, double distance) { c.pore.entrance_distance = distance; }, table);
    report("entrance" + name, found, needs);
    holds = holds && enough(found, 1e-5) <= 30;
  }
  return check(holds, "the entrance section at 30, the default, is far enough for 1e-5");
}

bool starts(const std::string &directory, unsigned jobs, Table &table, Table &needs) {
  const std::vector<double> positions{-1.25, -1.5, -2, -3, -4, far_start};
  std::vector<RunInput> inputs;
  for (const double start : positions) {
    Case physics = table1();
    physics.accuracy = 1e-4;
    physics.pore.exit_x = 10;
    physics.pore.entrance_distance = 30;
    physics.capsule.start_x = start;
    physics.until.x_g = in_tube;
    inputs.push_back({fmt::format("start={:g}", start), physics});
  }
  const std::vector<StudyRun> runs = run_all(directory, jobs, inputs);
  std::vector<Distance> found;
  for (std::size_t k = 0; k + 1 < runs.size(); ++k) {
    const auto error = [&](const char *quantity) {
      return history_error(runs[k].history, runs.back().history, quantity, -1, in_tube);
    };
    const auto peak = [&](const char *quantity) {
      return std::abs(runs[k].summary.quantities.at(quantity) - runs.back().summary.quantities.at(quantity));
    };
    found.push_back({-positions[k], error("pressure_drop"), error("v_g")});
    table.add(fmt::format("start,{:g},{:.4e},{:.4e}", found.back().value, found.back().pressure_error,
                          found.back().velocity_error));
    fmt::print("start {:g}: {}; history from x_g = -1 to {:g}: pressure drop changes by {:.1e}, v_g by "
               "{:.1e}; the peak by "
               "{:.1e}, its place by {:.1e}\n",
               positions[k], runs[k].summary.status, in_tube, found.back().pressure_error,
               found.back().velocity_error, peak("peak_pressure_drop"), peak("x_g_at_peak"));
  }
  report("start", found, needs);
  const double need = enough(found, 1e-4);
  return check(
      need <= 4,
      fmt::format("the start at -4, the default, is far enough for 1e-4 from x_g = -1 on (from -{:g} on)",
                  need));
}

bool study(const std::string &directory, unsigned jobs) {
  make_directories(directory);
  Table table("edge,distance,pressure_drop,v_g");
  Table needs("edge,accuracy,distance");
  const Vector inside = shape_at(in_tube);
  const bool exit = exits(inside, table, needs);
  const bool entrance =
      entrances({{"-tube", inside}, {"-mouth", shape_at(0)}, {"-reservoir", shape_at(-2)}}, table, needs);
  const bool start = starts(directory, jobs, table, needs);
  table.write(directory + "/edges.csv");
  needs.write(directory + "/needs.csv");
  return exit && entrance && start;
}

} // namespace

int main(int argc, char **argv) {
  return study_main(argc, argv, study);
}
