// How fast does the motion converge with the number of the membrane's nodes? Table 1's capsule from x_g = -4 into
// the tube, all other errors small.
#include "study.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <iterator>

using namespace capsule;

namespace {

constexpr double last_x_g = 2;

RunInput entrance(int nodes) {
  RunInput run = read_case("cases/table1-mesh").runs.front();
  run.name = fmt::format("membrane={}", nodes);
  run.physics.accuracy = 1e-6; // of the wall, the near panels and the time steps
  run.physics.mesh.membrane = nodes;
  run.physics.until.x_g = last_x_g;
  return run;
}

bool study(const std::string &directory, unsigned jobs) {
  const std::vector<int> nodes{40, 48, 56, 64, 72, 80, 88, 96, 144};
  std::vector<RunInput> inputs;
  std::ranges::transform(nodes, std::back_inserter(inputs), entrance);
  const std::vector<StudyRun> runs = run_all(directory, jobs, inputs);

  Table table("nodes,pressure_drop,v_g,max_stretch,order");
  bool high_order = true;
  double before = 0;
  for (std::size_t k = 0; k + 1 < runs.size(); ++k) {
    const auto error = [&](const char *quantity) {
      return history_error(runs[k].history, runs.back().history, quantity, -4, last_x_g);
    };
    const double pressure = error("pressure_drop");
    const double order = // none for the first
        k == 0 ? NAN : std::log(before / pressure) / std::log(static_cast<double>(nodes[k]) / nodes[k - 1]);
    table.add(fmt::format("{},{:.3e},{:.3e},{:.3e},{:.2f}", nodes[k], pressure, error("v_g"),
                          error("max_stretch"), order));
    fmt::print("N = {:3}: error of the pressure drop {:.1e}, local order {:.1f}\n", nodes[k], pressure,
               order);
    if (nodes[k] > 56)
      high_order = high_order && order >= 6;
    before = pressure;
  }
  table.write(directory + "/convergence.csv");
  fmt::print("space-convergence: {}: local order at least 6 from 56 nodes to 96\n",
             high_order ? "HOLDS" : "FAILS");
  return high_order;
}

} // namespace

int main(int argc, char **argv) {
  return study_main(argc, argv, study);
}
