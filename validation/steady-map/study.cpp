// The steady pressure drop and film over the plane of size and capillary number, both laws: each row of the map goes
// from point to neighbouring point.
#include "study.hpp"
#include "base/failure.hpp"
#include "law/neo_hookean.hpp"
#include "law/skalak.hpp"
#include "steady/growth_rates.hpp"
#include "steady/mesh_change.hpp"
#include "steady/newton.hpp"
#include "steady/refinement.hpp"
#include "steady/steady_state.hpp"
#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <map>
#include <sstream>

using namespace capsule;

namespace {

constexpr int rows = 10, columns = 20; // of each law: sizes, capillary numbers
constexpr int nodes = 72;
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

// From a steady state to the neighbour at a higher capillary number, in shorter steps if need be; false where there is
// none. Beyond a fold Newton's method may find the far side of the branch, where small motions grow.
bool go(const Case &from, double capillary_number, SteadyState &state, int halvings = 3) {
  Case to = from;
  to.flow.capillary_number = capillary_number;
  state.system->set_parameters(to);
  try {
    const Vector found = solve_steady(*state.system, state.unknowns);
    if (growth_rates(*state.system, found, 1)[0].real() < 0) {
      state.unknowns = found;
      return true;
    }
  } catch (const NumericsFailure &) {
  }
  if (halvings == 0)
    return false;
  to.flow.capillary_number = std::sqrt(from.flow.capillary_number * capillary_number);
  return go(from, to.flow.capillary_number, state, halvings - 1) &&
         go(to, capillary_number, state, halvings - 1);
}

// A stable steady state from nothing: the other branch where the neighbour's ends because the rear buckles.
bool begin_again(const Case &physics, SteadyState &state) {
  try {
    SteadyState found = on_mesh(physics, nodes, find_steady(physics, {}, {}));
    if (growth_rates(*found.system, found.unknowns, 1)[0].real() >= 0)
      return false;
    state = std::move(found);
    return true;
  } catch (const NumericsFailure &) {
    return false;
  }
}

// One size: lines of the map from the middle capillary number upwards and downwards, as far as there are stable steady
// states. The last line, "end,...", compares the middle point with another mesh.
std::string row_of_map(const MembraneLaw &law, int row) {
  constexpr int middle = columns / 3;
  const Case start = case_at(law, row, middle);
  const SteadyState middle_state = on_mesh(start, nodes, find_steady(start, {}, {}));
  std::map<int, std::string> lines;
  const auto look_at = [&](const SteadyState &state, int column) {
    const Case now = case_at(law, row, column);
    state.system->set_parameters(now);
    const SteadyRecord record = record_steady(state, 1);
    lines[column] =
        fmt::format("{},{:.3g},{:.6f},{:.7f},{:.7f},{:.7f},{:.6f},{:.5f}\n", law.law().name, radius_of(row),
                    now.flow.capillary_number, record.row.pressure_drop, record.row.v_g, record.row.min_film,
                    record.row.max_stretch, record.further.at("growth_rate"));
    return record.row.pressure_drop;
  };
  const double pressure = look_at(middle_state, middle);
  const double finer = record_steady(on_mesh(start, finer_mesh(nodes), middle_state), 1).row.pressure_drop;
  for (const int towards : {-1, 1}) {
    SteadyState state = on_mesh(start, nodes, middle_state);
    for (int column = middle + towards; column >= 0 && column < columns; column += towards) {
      if (!go(case_at(law, row, column - towards), capillary_number_of(column), state) &&
          !begin_again(case_at(law, row, column), state))
        break;
      look_at(state, column);
    }
  }
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
  const bool resolved = worst <= allowed;
  const bool soon = seconds <= 480;
  fmt::print("steady-map: {} points, {} more were not reached\n", points, 2 * rows * columns - points);
  fmt::print("steady-map: {}: {:.1f} s of one core; {}: two meshes are {:.1e} apart\n",
             soon ? "HOLDS" : "FAILS", seconds, resolved ? "HOLDS" : "FAILS", worst);
  return soon && resolved;
}

} // namespace

int main(int argc, char **argv) {
  return study_main(argc, argv, study);
}
