// How close must the capsules of a train come until they feel each other? Speed, pressure drop and apparent viscosity of
// steady trains against the distance of neighbours, on two meshes, for both laws and for rigid spheres.
#include "study.hpp"
#include "base/failure.hpp"
#include "law/neo_hookean.hpp"
#include "law/skalak.hpp"
#include "steady/newton.hpp"
#include "steady/refinement.hpp"
#include "steady/steady_state.hpp"
#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>

using namespace capsule;

namespace {

constexpr int coarse = 64, fine = 88; // nodes
constexpr double allowed = 1e-6;      // between the meshes, relative
constexpr double rigid = 0;           // the limit of weak flows

struct Train {
  const char *law;
  double radius, capillary_number;
};
constexpr std::array trains{Train{"rigid", 0.5, rigid},      Train{"rigid", 0.8, rigid},
                            Train{"neo-hookean", 0.8, 0.05}, Train{"skalak", 0.8, 0.05},
                            Train{"neo-hookean", 0.8, 0.1},  Train{"skalak", 0.8, 0.1}};
// Spacings of centres less the undeformed length, the widest first: nothing is felt there.
constexpr std::array spacings{4.7, 2.0, 1.5, 1.25, 1.0, 0.8, 0.6, 0.5, 0.4, 0.3, 0.25, 0.2, 0.15, 0.1};

Case case_of(const Train &train) {
  Case physics;
  physics.accuracy = 1e-6;
  physics.mesh.membrane = coarse;
  physics.membrane.law = train.law == std::string("neo-hookean") ? neo_hookean : MembraneLaw{skalak, {1}};
  physics.membrane.bending_ratio = 1e-2;
  physics.capsule.radius = train.radius;
  physics.flow.capillary_number = train.capillary_number == rigid ? 0.004 : train.capillary_number;
  physics.flow.period = 2 * train.radius + spacings[0];
  return physics;
}

struct Numbers {
  double speed, pressure_drop;
};

Numbers at_parameters(const Case &physics, SteadyState &state) {
  state.system->set_parameters(physics);
  state.unknowns = solve_steady(*state.system, state.unknowns);
  const FlowState flow = state.system->flow(state.unknowns.head(2 * state.system->nodes()));
  return {state.unknowns[2 * state.system->nodes()], flow.pressure_drop};
}

// What three ever weaker flows tend to.
Numbers rigid_limit(Case physics, SteadyState state) {
  std::array<Numbers, 3> in_flows{};
  for (Numbers &numbers : in_flows) {
    numbers = at_parameters(physics, state);
    physics.flow.capillary_number /= 2;
  }
  const auto limit = [&](double Numbers::*member) {
    return (8 * in_flows[2].*member - 6 * in_flows[1].*member + in_flows[0].*member) / 3;
  };
  return {limit(&Numbers::speed), limit(&Numbers::pressure_drop)};
}

// Rows of one train, from far apart to as close as it gets.
std::string rows_of(const Train &train) {
  Case physics = case_of(train);
  SteadyState state = on_mesh(physics, coarse, find_steady(physics, {}, {}));
  SteadyState finer = on_mesh(physics, fine, state);
  const bool is_rigid = train.capillary_number == rigid;
  std::string rows;
  for (const double spacing : spacings) {
    physics.flow.period = 2 * train.radius + spacing;
    try {
      const Numbers on_coarse = at_parameters(physics, state), on_fine = at_parameters(physics, finer);
      const SteadyRecord record =
          record_steady(finer); // of rigid spheres in the strongest of three weak flows
      const Numbers rough = is_rigid ? rigid_limit(physics, state) : on_coarse;
      const Numbers exact = is_rigid ? rigid_limit(physics, finer) : on_fine;
      rows += fmt::format("{}{},{},{},{:.6f},{:.6f},{:.9f},{:.9f},{:.9f},{:.9f},{:.6f},{:.6f},{:.9f}",
                          rows.empty() ? "" : "\n", train.law, train.radius, train.capillary_number,
                          physics.flow.period, is_rigid ? spacing : record.row.min_gap, exact.speed,
                          exact.pressure_drop, rough.speed, rough.pressure_drop,
                          1 + exact.pressure_drop / (8 * physics.flow.period),
                          record.further.at("growth_rate"), record.further.at("pairing_growth_rate"));
    } catch (const NumericsFailure &failure) {
      if (failure.kind != "touching" && failure.kind != "unresolved")
        throw;
      break;
    }
  }
  return rows;
}

// Rigid trains of scenes that were computed elsewhere: speed and pressure drop.
struct Known {
  double radius, spacing, speed, pressure_drop;
};
constexpr std::array known{Known{0.5, 0.25, 1.6626103, 0.450172}, Known{0.8, 0.2, 1.2715607, 6.918261},
                           Known{0.8, 0.4, 1.2733693, 7.266524}, Known{0.8, 1.0, 1.2753364, 7.696080},
                           Known{0.8, 4.7, 1.2754856, 7.735446}};

bool study(const std::string &directory, unsigned jobs) {
  std::vector<TextTask> tasks;
  for (const Train &train : trains)
    tasks.push_back({fmt::format("{} {} {}", train.law, train.radius, train.capillary_number),
                     [=] { return rows_of(train); }});
  const std::string header =
      "law,radius,capillary_number,period,min_gap,v_g,pressure_drop,coarse_v_g,coarse_pressure_drop,"
      "apparent_viscosity,growth_rate,pairing_growth_rate";
  Table table(header);
  Table reaches("law,radius,capillary_number,one_percent,one_per_mille,closest");
  double apart = 0, from_known = 0;
  std::size_t found = 0, k = 0;
  double at_a_radius = 0; // largest change of the drop at a gap of one
  bool stable = true, returns = true;
  for (const std::string &text : make_all(directory, jobs, tasks)) {
    const Train &train = trains[k++];
    table.add(text);
    double alone = 0, gap_before = 0, change_before = 0, closest = 0;
    std::array<double, 2> reach{};
    const Rows rows(header, text);
    for (std::size_t r = 0; r < rows.size(); ++r) {
      const double period = rows.value(r, "period"), gap = rows.value(r, "min_gap"),
                   speed = rows.value(r, "v_g"), drop = rows.value(r, "pressure_drop");
      apart = std::max({apart, std::abs(rows.value(r, "coarse_v_g") / speed - 1),
                        std::abs(rows.value(r, "coarse_pressure_drop") / drop - 1)});
      stable = stable && rows.value(r, "growth_rate") < 0;
      returns = returns && (gap > 1.6 || rows.value(r, "pairing_growth_rate") < 0);
      if (alone == 0)
        alone = drop;
      const double change = std::abs(drop / alone - 1);
      for (std::size_t level = 0; level < 2; ++level) { // between the last two gaps, exponentially
        const double share = level == 0 ? 1e-2 : 1e-3;
        if (reach[level] == 0 && change >= share && change_before > 0)
          reach[level] =
              gap + (gap_before - gap) * std::log(change / share) / std::log(change / change_before);
      }
      if (gap <= 1 && gap_before > 1)
        at_a_radius =
            std::max(at_a_radius, change * std::pow(change_before / change, (1 - gap) / (gap_before - gap)));
      gap_before = gap;
      change_before = change;
      closest = gap;
      for (const Known &row : known)
        if (train.capillary_number == rigid && row.radius == train.radius &&
            std::abs(period - 2 * row.radius - row.spacing) < 1e-9) {
          from_known =
              std::max({from_known, std::abs(speed / row.speed - 1), std::abs(drop / row.pressure_drop - 1)});
          ++found;
        }
    }
    reaches.add(fmt::format("{},{},{},{:.3f},{:.3f},{:.3f}", train.law, train.radius, train.capillary_number,
                            reach[0], reach[1], closest));
    fmt::print(
        "{} R = {} eps = {}: the drop differs by 1 % from gaps of {:.3f} on, by 0.1 % from {:.3f} on\n",
        train.law, train.radius, train.capillary_number, reach[0], reach[1]);
  }
  table.write(directory + "/trains.csv");
  reaches.write(directory + "/reaches.csv");
  const bool as_known = found == known.size() && from_known < 1e-4;
  bool holds =
      check(as_known, fmt::format("rigid trains are those computed elsewhere, to {:.1e}", from_known));
  holds = check(apart < allowed, fmt::format("two meshes are {:.1e} apart", apart)) && holds;
  holds = check(stable, "equal small motions of a train die away") && holds;
  holds = check(returns, "neighbours that are moved against each other return, up to gaps of 1.6") && holds;
  return check(at_a_radius < 0.015,
               fmt::format("at a gap of a pore radius drops add up to {:.1f} %", 100 * at_a_radius)) &&
         holds;
}

} // namespace

int main(int argc, char **argv) {
  return study_main(argc, argv, study);
}
