// The steady pressure drop and film over the plane of size and capillary number, both laws: each row of the map lies on a
// branch.
#include "study.hpp"
#include "base/failure.hpp"
#include "case/key_path.hpp"
#include "law/neo_hookean.hpp"
#include "law/skalak.hpp"
#include "steady/continuation.hpp"
#include "steady/mesh_change.hpp"
#include "steady/refinement.hpp"
#include "steady/steady_state.hpp"
#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <functional>
#include <map>
#include <sstream>

using namespace capsule;

namespace {

constexpr int rows = 10, columns = 20; // of each law: sizes, capillary numbers
constexpr int nodes = 60;
constexpr double bending_ratio = 1e-2; // softer shells buckle in the weakest flows
constexpr double allowed = 1e-4;       // relative, of the pressure drop against another mesh

const std::array<MembraneLaw, 2> mapped_laws{MembraneLaw(neo_hookean), MembraneLaw(skalak, {0})};

double radius_of(int row) {
  return 0.65 + 0.05 * row;
}
double capillary_number_of(int column) {
  return 0.01 * std::pow(20.0, column / (columns - 1.0)); // 0.01 to 0.2
}

Case case_at(const MembraneLaw &law, int row, int column) {
  Case physics;
  physics.accuracy = 1e-4;
  physics.membrane.law = law;
  physics.membrane.bending_ratio = bending_ratio;
  physics.capsule.radius = radius_of(row);
  physics.flow.capillary_number = capillary_number_of(column);
  return physics;
}

// Along the branch from a steady state to a capillary number at its end: through folds, as far as the branch is found and
// no part is stretched without end. `look` is shown each steady state at a column's capillary number.
void follow(const Case &from, SteadyState state, double to,
            const std::function<void(const SteadyState &, int)> &look) {
  constexpr int most_steps = 50;
  constexpr double farthest_stretch = 4;
  constexpr Branch::Steps steps{
      .first = 0.02, .largest = 0.1, .tolerance = 1e-8, .largest_unresolved_part = 3e-5};
  const KeyPath path("flow.capillary_number", from, to);
  try {
    Branch branch(*state.system, path, {state.unknowns, 0}, Branch::upwards(*state.system), steps);
    for (int step = 0; step < most_steps && branch.point().parameter >= 0 && branch.point().parameter < 1 &&
                       !branch.wants_a_finer_mesh() &&
                       state.system->largest_stretch(branch.point().unknowns) < farthest_stretch;
         ++step) {
      const double before = branch.point().parameter;
      branch.advance();
      const double after = branch.point().parameter;
      for (int column = 0; column < columns; ++column)
        if (const double part = path.part(capillary_number_of(column));
            std::min(before, after) < part && part <= std::max(before, after)) {
          state.unknowns = branch.at_parameter(part).unknowns;
          look(state, column);
        }
    }
  } catch (const NumericsFailure &) { // the branch is not found any further
  }
}

// One size: lines of the map from the middle capillary number upwards and downwards, as far as there are stable steady
// states. Where a branch turns twice, the first of two stable ones counts. The last line, "end,...", compares the middle
// point with another mesh.
std::string row_of_map(const MembraneLaw &law, int row) {
  constexpr int middle = columns / 3;
  const Case start = case_at(law, row, middle);
  const SteadyState middle_state = on_mesh(start, nodes, find_steady(start, {}, {}));
  std::map<int, std::string> lines;
  const auto look_at = [&](const SteadyState &state, int column) {
    const SteadyRecord record = record_steady(state, 1);
    if (record.further.at("growth_rate") < 0 && !lines.contains(column))
      lines[column] =
          fmt::format("{},{:.3g},{:.6f},{:.7f},{:.7f},{:.7f},{:.6f},{:.5f}\n", law.law().name, radius_of(row),
                      capillary_number_of(column), record.row.pressure_drop, record.row.v_g,
                      record.row.min_film, record.row.max_stretch, record.further.at("growth_rate"));
    return record.row.pressure_drop;
  };
  const double pressure = look_at(middle_state, middle);
  const double finer = record_steady(on_mesh(start, finer_mesh(nodes), middle_state), 1).row.pressure_drop;
  for (const int end : {0, columns - 1})
    follow(start, middle_state, capillary_number_of(end), look_at);
  std::string text;
  for (int column = 0; column < columns; ++column) // gnuplot draws grids: each row as long as the others
    text += lines.contains(column) ? lines[column]
                                   : fmt::format("{},{:.3g},{:.6f},NaN,NaN,NaN,NaN,NaN\n", law.law().name,
                                                 radius_of(row), capillary_number_of(column));
  return text +
         fmt::format("end,{},{:.3e},{:.2f}\n", lines.size(), std::abs(finer / pressure - 1), cpu_seconds());
}

bool study(const std::string &directory, unsigned jobs) {
  std::vector<TextTask> tasks;
  for (const MembraneLaw &law : mapped_laws)
    for (int row = 0; row < rows; ++row)
      tasks.push_back(
          {fmt::format("{} {}", law.law().name, row), [&law, row] { return row_of_map(law, row); }});
  const std::vector<std::string> texts = make_all(directory, jobs, tasks);

  const std::string head = "law,radius,capillary_number,pressure_drop,v_g,min_film,max_stretch,growth_rate";
  int points = 0, looked_at = 0;
  double worst = 0, seconds = 0;
  for (const MembraneLaw &law : mapped_laws) {
    std::string file = head + "\n";
    for (int row = 0; row < rows; ++row) {
      const std::string &text = texts[static_cast<std::size_t>(looked_at++)];
      const std::size_t end = text.rfind("end,");
      file += text.substr(0, end);
      std::istringstream cells(text.substr(end + 4));
      int found = 0;
      double difference = 0, spent = 0;
      char comma = 0;
      cells >> found >> comma >> difference >> comma >> spent;
      file += "\n";
      points += found;
      worst = std::max(worst, difference);
      seconds += spent;
      if (found < columns)
        fmt::print("{} R = {:.2f}: {} of {} points\n", law.law().name, radius_of(row), found, columns);
    }
    write_atomically(directory + "/" + law.law().name + ".csv", file);
  }
  Table summary("points,without,pressure_drop_apart,cpu_seconds");
  summary.add(fmt::format("{},{},{:.3e},{:.1f}", points, 2 * rows * columns - points, worst, seconds));
  summary.write(directory + "/summary.csv");
  fmt::print("steady-map: {} points, {} more were not reached; {:.1f} s of one core\n", points,
             2 * rows * columns - points, seconds);
  return check(worst <= allowed, fmt::format("two meshes are {:.1e} apart", worst));
}

} // namespace

int main(int argc, char **argv) {
  return study_main(argc, argv, study);
}
