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
constexpr int middle = columns / 3;
constexpr int nodes = 52;
constexpr double bending_ratio = 1e-2; // softer shells buckle in the weakest flows
constexpr auto columns_of_map =
    "law,radius,capillary_number,pressure_drop,v_g,min_film,max_stretch,growth_rate";
constexpr double allowed = 1e-4; // relative, of the pressure drop against another mesh

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

// Shown each steady state at a column's capillary number, and its linearisation.
using Look = std::function<void(const SteadyState &, const SteadySystem::Linearisation &, int column)>;

// Along the branch from a steady state to a capillary number, as far as the branch is found and does not turn, the membrane
// does not soften, and no part is stretched too far: steady states end there, or soon behind it.
void follow(const Case &from, SteadyState state, double to, const Look &look) {
  constexpr Branch::Steps steps{
      .first = 0.1, .largest = 0.4, .tolerance = 1e-6, .largest_unresolved_part = 3e-6};
  constexpr double farthest_stretch = 2.5;
  const KeyPath path("flow.capillary_number", from, to);
  std::vector<double> stops;
  for (int column = 0; column < columns; ++column)
    stops.push_back(path.part(capillary_number_of(column)));
  try {
    Branch branch(*state.system, path, {state.unknowns, 0}, Branch::upwards(*state.system), steps);
    while (branch.point().parameter < 1 && !branch.turned() && !branch.wants_a_finer_mesh() &&
           state.system->largest_stretch(branch.point().unknowns) < farthest_stretch) {
      branch.advance(stops);
      branch.require_stiffness(1);
      if (const auto column = std::ranges::find(stops, branch.point().parameter); column != stops.end()) {
        state.unknowns = branch.point().unknowns;
        look(state, branch.linearisation(), static_cast<int>(column - stops.begin()));
      }
    }
  } catch (const NumericsFailure &) { // the branch is not found any further
  }
}

struct Row {
  std::string text;
  std::size_t points = 0; // that were reached
  double apart = 0;       // relative difference of two meshes
};

// From a steady state of the row's middle: lines of the map upwards and downwards, as far as there are stable steady states.
// The strongest flow's is compared with another mesh in some rows, because that costs as much as ten points.
Row row_of_map(const MembraneLaw &law, int row, const SteadyState &chain) {
  constexpr int compared = 4; // every fourth row
  const Case start = case_at(law, row, middle);
  const SteadyState middle_state = on_mesh(start, nodes, chain);
  std::map<int, std::string> lines;
  std::pair<int, SteadyState> strongest{0, {}};
  double pressure = 0;
  const Gauge gauge = gauge_of(*middle_state.system);
  const auto look_at = [&](const SteadyState &state, const SteadySystem::Linearisation &linear, int column) {
    const SteadyRecord record = record_steady(state, linear, gauge);
    if (!(record.further.at("growth_rate") < 0))
      return;
    lines[column] =
        fmt::format("{},{:.3g},{:.6f},{:.7f},{:.7f},{:.7f},{:.6f},{:.5f}\n", law.law().name, radius_of(row),
                    capillary_number_of(column), record.row.pressure_drop, record.row.v_g,
                    record.row.min_film, record.row.max_stretch, record.further.at("growth_rate"));
    if (column > strongest.first) {
      strongest = {column, state};
      pressure = record.row.pressure_drop;
    }
  };
  look_at(middle_state, middle_state.system->linearise(middle_state.unknowns), middle);
  for (const int end : {0, columns - 1})
    follow(start, middle_state, capillary_number_of(end), look_at);
  Row result{.text = "", .points = lines.size()};
  if (row % compared == 0) {
    const auto &[column, state] = strongest;
    const SteadyState finer = on_mesh(case_at(law, row, column), finer_mesh(nodes), state);
    result.apart = std::abs(record_steady(finer).row.pressure_drop / pressure - 1);
  }
  for (int column = 0; column < columns; ++column) // gnuplot draws grids: each row as long as the others
    result.text += lines.contains(column)
                       ? lines[column]
                       : fmt::format("{},{:.3g},{:.6f},NaN,NaN,NaN,NaN,NaN\n", law.law().name, radius_of(row),
                                     capillary_number_of(column));
  return result;
}

// Rows begin on the branch of the middle capillary number along the size. The last line tells the points that were reached,
// how much two meshes differ, and the CPU time.
std::string rows_of_map(const MembraneLaw &law) {
  const Case smallest = case_at(law, 0, middle);
  const KeyPath path("capsule.radius", smallest, radius_of(rows - 1));
  std::vector<double> stops;
  for (int row = 0; row < rows; ++row)
    stops.push_back(path.part(radius_of(row)));
  SteadyState state = on_mesh(smallest, nodes, find_steady(smallest, {}, {}));
  Branch branch(*state.system, path, {state.unknowns, 0}, Branch::upwards(*state.system),
                {.first = 0.2, .largest = 0.5, .tolerance = 1e-6});
  std::string text = std::string(columns_of_map) + "\n";
  std::size_t points = 0;
  double apart = 0;
  for (int k = 0; k < rows; ++k) {
    while (branch.point().parameter < stops[static_cast<std::size_t>(k)])
      branch.advance(stops);
    state.unknowns = branch.point().unknowns;
    const Row row = row_of_map(law, k, state);
    text += row.text + "\n";
    points += row.points;
    apart = std::max(apart, row.apart);
  }
  return text + fmt::format("{},{:.3e},{:.2f}", points, apart, cpu_seconds());
}

bool study(const std::string &directory, unsigned jobs) {
  std::vector<TextTask> tasks;
  for (const MembraneLaw &law : mapped_laws)
    tasks.push_back({law.law().name, [&law] { return rows_of_map(law); }});
  const std::vector<std::string> texts = make_all(directory, jobs, tasks);

  int points = 0;
  double worst = 0, seconds = 0;
  for (std::size_t k = 0; k < tasks.size(); ++k) {
    const std::size_t end = texts[k].rfind('\n') + 1;
    const Rows sums("points,apart,seconds", texts[k].substr(end));
    points += static_cast<int>(sums.value(0, "points"));
    worst = std::max(worst, sums.value(0, "apart"));
    seconds += sums.value(0, "seconds");
    write_atomically(directory + "/" + tasks[k].name + ".csv", texts[k].substr(0, end));
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
