// Several capsules in one tube. Beside steady trains: the middle one of five in a row moves as one of a train; two alone
// part as opposed neighbours in a train return. Beside one capsule alone: far apart in the tube nothing is felt, in the
// reservoir it is. Error estimates of pairs and trains, and what several capsules cost.
#include "study.hpp"
#include "base/csv.hpp"
#include "law/neo_hookean.hpp"
#include "law/skalak.hpp"
#include "scene/resolution.hpp"
#include "steady/refinement.hpp"
#include "steady/steady_state.hpp"
#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <map>
#include <utility>

using namespace capsule;

namespace {

struct Kind {
  MembraneLaw law;
  double radius, capillary_number, viscosity_ratio;
};

std::string text_of(const Kind &kind) {
  return fmt::format("{} R={} eps={} lambda={}",
                     kind.law.is(skalak) ? fmt::format("SK{}", kind.law.values()[0]) : "NH", kind.radius,
                     kind.capillary_number, kind.viscosity_ratio);
}

// Equal capsules that start at these places, the leading one's first.
RunInput capsules_at(const std::string &name, const Kind &kind, const std::vector<double> &starts,
                     double accuracy, double end_time) {
  RunInput run;
  run.name = name;
  Case &physics = run.physics;
  physics.accuracy = accuracy;
  physics.membrane.law = kind.law;
  physics.membrane.bending_ratio = 1e-2;
  physics.capsule.radius = kind.radius;
  physics.flow.capillary_number = kind.capillary_number;
  physics.flow.viscosity_ratio = kind.viscosity_ratio;
  physics.until.time = end_time;
  const Case one = physics;
  for (std::size_t k = 0; k < starts.size(); ++k)
    (k == 0 ? physics : physics.followers.emplace_back(one)).capsule.start_x = starts[k];
  return run;
}

// In a row in a long tube, around x = 0.
RunInput row_in_tube(const std::string &name, const Kind &kind, std::size_t capsules, double spacing,
                     double accuracy, double end_time) {
  std::vector<double> starts;
  for (std::size_t k = 0; k < capsules; ++k)
    starts.push_back(spacing * (static_cast<double>(capsules - 1) / 2 - static_cast<double>(k)));
  RunInput run = capsules_at(name, kind, starts, accuracy, end_time);
  const auto put_into_tube = [](Case &capsule) {
    capsule.pore.shape = PoreShape::tube;
    capsule.pore.entrance_distance = 12;
    capsule.pore.exit_x = 18;
  };
  put_into_tube(run.physics);
  std::ranges::for_each(run.physics.followers, put_into_tube);
  return run;
}

RunInput refined(const RunInput &run) {
  RunInput fine = run;
  fine.name += "-refined";
  const int nodes = 3 * choose_resolution(run.physics).membrane_nodes / 2;
  const auto refine = [&](Case &capsule) {
    capsule.accuracy /= 30;
    capsule.mesh.membrane = std::max(nodes, choose_resolution(capsule).membrane_nodes);
  };
  refine(fine.physics);
  std::ranges::for_each(fine.physics.followers, refine);
  return fine;
}

Case train_of(const Kind &kind, double period, double accuracy) {
  Case physics = row_in_tube("", kind, 1, 0, accuracy, 1).physics;
  physics.flow.period = period;
  return physics;
}

// A column of one capsule's series.csv; capsules are numbered from 1.
struct Column {
  std::string run;
  std::size_t capsule;
  std::string quantity;
};

// The largest difference of two columns at equal times.
double largest_difference(const std::string &directory, const Column &one, const Column &other) {
  const auto columns = [&](const Column &of) {
    return read_columns(fmt::format("{}/{}/series{}.csv", directory, of.run,
                                    of.capsule == 1 ? "" : fmt::format("-{}", of.capsule)));
  };
  const Columns here = columns(one), there = columns(other);
  const std::vector<double> &time = here.at("time"), &other_time = there.at("time");
  double difference = 0;
  std::size_t rows = 0;
  for (std::size_t i = 0, k = 0; i < time.size(); ++i) {
    while (k < other_time.size() && other_time[k] < time[i] - 1e-9)
      ++k;
    if (k == other_time.size() || other_time[k] > time[i] + 1e-9)
      continue;
    difference = std::max(difference, std::abs(here.at(one.quantity)[i] - there.at(other.quantity)[k]));
    ++rows;
  }
  if (rows < 10)
    throw FileError(one.run + " and " + other.run + " have rows at different times");
  return difference;
}

// ---- Five in a row, and one of a train ----

const Kind of_five{neo_hookean, 0.8, 0.02, 1};
constexpr double spacing_of_five = 2;
constexpr double time_to_settle = 3.6;     // of the shapes
constexpr double change_of_spacing = 0.05; // of two pairs, one nearer and one farther
const char *const five = "five", *const nearer = "nearer", *const farther = "farther";

std::vector<RunInput> rows_beside_train() {
  return {row_in_tube(five, of_five, 5, spacing_of_five, 1e-4, time_to_settle),
          row_in_tube(nearer, of_five, 2, spacing_of_five - change_of_spacing, 1e-5, time_to_settle),
          row_in_tube(farther, of_five, 2, spacing_of_five + change_of_spacing, 1e-5, time_to_settle)};
}

using Runs = std::map<std::string, StudyRun>;

bool as_in_a_train(const std::string &directory, const Runs &runs) {
  const Case physics = train_of(of_five, spacing_of_five, 1e-5);
  const SteadyRecord train = record_steady(refine(physics, find_steady(physics, {}, {}), {}).state);
  const auto middle = [&](const char *quantity) { return runs.at(five).summary.quantities.at(quantity); };
  const double off_speed = std::abs(middle("v_g#3") / train.row.v_g - 1);
  const double off_drop = std::abs(middle("pressure_share#3") / train.row.pressure_drop - 1);
  // The speed at which a pair parts falls exponentially with its spacing.
  const auto parting = [&](const char *pair) {
    const auto &end = runs.at(pair).summary.quantities;
    return end.at("v_g") - end.at("v_g#2");
  };
  const auto spacing = [&](const char *pair) { return runs.at(pair).summary.quantities.at("spacing#2"); };
  const double slope = std::log(parting(farther) / parting(nearer)) / (spacing(farther) - spacing(nearer));
  const double twice_slope =
      2 * slope * parting(nearer) * std::exp(slope * (spacing_of_five - spacing(nearer)));
  const double pairing = train.further.at("pairing_growth_rate");
  Table table("v_g,pressure_drop,pairing_growth_rate,parting");
  table.add(fmt::format("{:.9f},{:.9f},{:.7f},{:.7f}", train.row.v_g, train.row.pressure_drop, pairing,
                        twice_slope));
  table.write(directory + "/train.csv");
  const bool as_one =
      check(off_speed < 1e-4 && off_drop < 1e-4,
            fmt::format("the middle one of five has the speed of a train to {:.1e}, its drop to {:.1e}",
                        off_speed, off_drop));
  return check(std::abs(twice_slope / pairing - 1) < 0.03,
               fmt::format("opposed neighbours return with {:.5f}, pairs part with {:.5f}", pairing,
                           twice_slope)) &&
         as_one;
}

// ---- Far apart ----

const Kind far_apart{neo_hookean, 0.8, 0.05, 1};
constexpr double accuracy_far_apart = 1e-4, four_radii = 4;
constexpr double before_mouth = -6; // where the leading one starts in the reservoir
constexpr std::array distances_in_reservoir{2.0, 3.0, 4.0, 6.0, 9.0};

std::string pair_in_reservoir(double distance) {
  return fmt::format("reservoir-{}", distance);
}

std::vector<RunInput> far_apart_and_alone() {
  std::vector<RunInput> inputs{
      row_in_tube("four-radii-apart", far_apart, 2, four_radii, accuracy_far_apart, 4),
      row_in_tube("alone", far_apart, 1, 0, accuracy_far_apart, 4)};
  for (const double distance : distances_in_reservoir) {
    const double behind = before_mouth - distance;
    inputs.push_back(capsules_at(pair_in_reservoir(distance), far_apart, {before_mouth, behind}, 1e-5, 2));
    inputs.push_back(capsules_at(pair_in_reservoir(distance) + "-alone", far_apart, {behind}, 1e-5, 2));
  }
  return inputs;
}

bool as_if_alone(const std::string &directory, const Runs &runs) {
  const auto &end = runs.at("alone").summary.quantities;
  double off_speed = 0, off_drop = 0;
  for (const std::size_t capsule : {1, 2}) {
    const auto off = [&](const char *quantity, const char *alone) {
      return largest_difference(directory, {"four-radii-apart", capsule, quantity}, {"alone", 1, alone}) /
             end.at(alone);
    };
    off_speed = std::max(off_speed, off("v_g", "v_g"));
    off_drop = std::max(off_drop, off("pressure_share", "pressure_drop_reciprocal"));
  }
  const bool in_tube =
      check(std::max(off_speed, off_drop) < accuracy_far_apart,
            fmt::format("four radii apart in the tube the speeds are those of one alone to {:.1e}, the "
                        "drops to {:.1e}",
                        off_speed, off_drop));
  Table table("distance,change,speed");
  std::vector<double> changes;
  double last_speed = 0;
  for (const double distance : distances_in_reservoir) {
    const std::string pair = pair_in_reservoir(distance), alone = pair + "-alone";
    changes.push_back(largest_difference(directory, {pair, 2, "v_g"}, {alone, 1, "v_g"}));
    last_speed = runs.at(alone).summary.quantities.at("v_g");
    table.add(fmt::format("{},{:.4e},{:.6f}", distance, changes.back(), last_speed));
  }
  table.write(directory + "/reservoir.csv");
  // From the second distance on: at the first one the capsules are nearer than their own size.
  const double power = std::log(changes.back() / changes[1]) /
                       std::log(distances_in_reservoir.back() / distances_in_reservoir[1]);
  return check(power < -1.5 && power > -2.5,
               fmt::format("in the reservoir the first one changes the second one's speed like "
                           "distance^{:.2f}, at a distance of {} by {:.1f} %",
                           power, distances_in_reservoir.back(), 100 * changes.back() / last_speed)) &&
         in_tube;
}

// ---- Error estimates ----

struct Neighbours {
  Kind kind;
  double gap, accuracy; // the gap at which pairs begin
};
// Of pairs and of trains.
const std::array neighbours{Neighbours{{neo_hookean, 0.8, 0.05, 1}, 0.2, 1e-3},
                            Neighbours{{neo_hookean, 0.8, 0.05, 1}, 0.05, 1e-4},
                            Neighbours{{neo_hookean, 0.6, 0.1, 5}, 0.1, 1e-3},
                            Neighbours{{neo_hookean, 0.5, 0.2, 1}, 0.3, 1e-3},
                            Neighbours{{{skalak, {1}}, 0.9, 0.05, 1}, 0.4, 1e-3},
                            Neighbours{{{skalak, {0}}, 0.8, 0.04, 0.2}, 0.3, 1e-3},
                            Neighbours{{{skalak, {3}}, 0.85, 0.02, 1}, 0.2, 1e-4},
                            Neighbours{{{skalak, {1}}, 0.7, 0.1, 1}, 0.6, 1e-3}};
// Of trains only: the walls that estimates compare with were chosen on those above, these are a test.
const std::array further_trains{Neighbours{{neo_hookean, 0.7, 0.15, 1}, 0.15, 1e-3},
                                Neighbours{{{skalak, {1}}, 0.95, 0.03, 1}, 0.3, 1e-3},
                                Neighbours{{neo_hookean, 0.9, 0.02, 5}, 0.5, 1e-4},
                                Neighbours{{{skalak, {0}}, 0.6, 0.1, 0.5}, 0.2, 1e-3},
                                Neighbours{{{skalak, {5}}, 0.8, 0.1, 1}, 0.1, 1e-3},
                                Neighbours{{neo_hookean, 0.75, 0.03, 10}, 1, 1e-4},
                                Neighbours{{{skalak, {2}}, 0.5, 0.1, 1}, 0.05, 1e-3},
                                Neighbours{{neo_hookean, 0.85, 0.08, 0.2}, 0.25, 1e-5}};

std::string text_of(const Neighbours &row) {
  return fmt::format("{} gap={}", text_of(row.kind), row.gap);
}

// Of one quantity: its error lies within `floor` of `difference`, since the refined value errs, too.
struct Difference {
  std::string quantity;
  double difference, floor, estimate;
};

struct Calibration {
  int all = 0, too_small = 0, too_large = 0; // below the error, above thirty times the error
  Table table{"capsules,accuracy,quantity,difference,floor,estimate"};

  void add(const Neighbours &row, const Difference &of) {
    ++all;
    too_small += of.difference - of.floor > of.estimate ? 1 : 0;
    too_large += of.estimate > 30 * (of.difference + of.floor) ? 1 : 0;
    table.add(fmt::format("{},{:.0e},{},{:.3e},{:.3e},{:.3e}", text_of(row), row.accuracy, of.quantity,
                          of.difference, of.floor, of.estimate));
  }
  std::string text() const {
    return fmt::format("{} estimates: {} too small, {} more than thirty times the error", all, too_small,
                       too_large);
  }
};

std::string name_of_pair(std::size_t k) {
  return fmt::format("pair-{}", k + 1);
}

std::vector<RunInput> pairs_and_refined() {
  std::vector<RunInput> inputs;
  for (std::size_t k = 0; k < neighbours.size(); ++k) {
    const Neighbours &row = neighbours[k];
    inputs.push_back(
        row_in_tube(name_of_pair(k), row.kind, 2, 2 * row.kind.radius + row.gap, row.accuracy, 1.5));
    inputs.push_back(refined(inputs.back()));
  }
  return inputs;
}

// The largest errors along the way, at equal times.
void add_pair(const std::string &directory, const Runs &runs, std::size_t k, Calibration &calibration) {
  const std::string pair = name_of_pair(k), fine = pair + "-refined";
  for (const auto &[quantity, capsule] :
       {std::pair("min_gap", 2), {"pressure_share", 1}, {"pressure_share", 2}, {"spacing", 2}}) {
    const auto of = static_cast<std::size_t>(capsule);
    const std::string name = capsule == 1 ? quantity : fmt::format("{}#2", quantity);
    calibration.add(neighbours[k], {name + "@time",
                                    largest_difference(directory, {pair, of, quantity}, {fine, of, quantity}),
                                    runs.at(fine).summary.error_estimate.at(name + "@time"),
                                    runs.at(pair).summary.error_estimate.at(name + "@time")});
  }
}

constexpr const char *train_header = "quantity,difference,estimate_of_finer,estimate";

// A line for each quantity of a train, at its accuracy and at a hundredth of it.
std::string train_differences(const Neighbours &row) {
  std::array<Outcome, 2> outcomes;
  for (std::size_t k = 0; k < 2; ++k) {
    const double accuracy = k == 0 ? row.accuracy : 1e-2 * row.accuracy;
    outcomes[k] = steady(train_of(row.kind, 2 * row.kind.radius + row.gap, accuracy), {}, {});
    if (outcomes[k].status != Status::steady)
      throw FileError(text_of(row) + ": " + outcomes[k].message);
  }
  std::string lines;
  const auto add = [&](const std::string &quantity, const auto &value) {
    lines += fmt::format("{}{},{},{},{}", lines.empty() ? "" : "\n", quantity,
                         std::abs(value(outcomes[0]) - value(outcomes[1])),
                         outcomes[1].error_estimate.at(quantity), outcomes[0].error_estimate.at(quantity));
  };
  for (const auto &[quantity, value] : {std::pair("pressure_drop", &SeriesRow::pressure_drop),
                                        {"v_g", &SeriesRow::v_g},
                                        {"min_gap", &SeriesRow::min_gap}})
    add(quantity, [member = value](const Outcome &of) { return of.last.series.back().*member; });
  for (const char *rate : {"growth_rate", "pairing_growth_rate"})
    add(rate, [rate](const Outcome &of) { return of.further.at(rate); });
  return lines;
}

std::vector<Neighbours> all_trains() {
  std::vector<Neighbours> all(neighbours.begin(), neighbours.end());
  all.insert(all.end(), further_trains.begin(), further_trains.end());
  return all;
}

void add_train(const Neighbours &row, const std::string &lines, Calibration &calibration) {
  const Rows rows(train_header, lines);
  for (std::size_t k = 0; k < rows.size(); ++k)
    calibration.add(row, {rows.text(k, "quantity"), rows.value(k, "difference"),
                          rows.value(k, "estimate_of_finer"), rows.value(k, "estimate")});
}

bool estimates_are_bounds(const std::string &directory, unsigned jobs, const Runs &runs) {
  const std::vector<Neighbours> rows = all_trains();
  std::vector<TextTask> tasks;
  for (const Neighbours &row : rows)
    tasks.push_back({"train " + text_of(row), [=] { return train_differences(row); }});
  const std::vector<std::string> texts = make_all(directory, jobs, tasks);
  Calibration of_pairs, of_trains;
  for (std::size_t k = 0; k < neighbours.size(); ++k)
    add_pair(directory, runs, k, of_pairs);
  for (std::size_t k = 0; k < rows.size(); ++k)
    add_train(rows[k], texts[k], of_trains);
  of_pairs.table.write(directory + "/pairs.csv");
  of_trains.table.write(directory + "/trains.csv");
  const bool pairs_hold = check(of_pairs.too_small == 0, "pairs, " + of_pairs.text());
  return check(of_trains.too_small == 0, "trains, " + of_trains.text()) && pairs_hold;
}

// ---- Cost ----

const std::array of_cost{
    Neighbours{{neo_hookean, 0.8, 0.05, 1}, 0.4, 1e-3}, Neighbours{{neo_hookean, 0.8, 0.05, 1}, 0.4, 1e-4},
    Neighbours{{{skalak, {1}}, 0.9, 0.05, 1}, 0.4, 1e-3},
    Neighbours{{{skalak, {1}}, 0.9, 0.05, 1}, 0.4, 1e-4}, Neighbours{{neo_hookean, 0.6, 0.1, 5}, 0.4, 1e-3}};
constexpr std::array numbers_of_capsules{1, 2, 4};

std::string name_of_cost(std::size_t row, int capsules) {
  return fmt::format("cost-{}-of-{}", row + 1, capsules);
}

std::vector<RunInput> runs_of_cost() {
  std::vector<RunInput> inputs;
  for (std::size_t k = 0; k < of_cost.size(); ++k)
    for (const int capsules : numbers_of_capsules)
      inputs.push_back(row_in_tube(name_of_cost(k, capsules), of_cost[k].kind,
                                   static_cast<std::size_t>(capsules),
                                   2 * of_cost[k].kind.radius + of_cost[k].gap, of_cost[k].accuracy, 3));
  return inputs;
}

bool cost_is_bounded(const std::string &directory, const Runs &runs) {
  Table table("capsules,accuracy,one,two,four");
  std::array<double, numbers_of_capsules.size()> sums{};
  for (std::size_t k = 0; k < of_cost.size(); ++k) {
    std::string line = fmt::format("{},{:.0e}", text_of(of_cost[k]), of_cost[k].accuracy);
    for (std::size_t n = 0; n < sums.size(); ++n) {
      const double seconds =
          runs.at(name_of_cost(k, numbers_of_capsules[n])).summary.quantities.at("cpu_seconds");
      sums[n] += seconds;
      line += fmt::format(",{:.3f}", seconds);
    }
    table.add(line);
  }
  table.write(directory + "/cost.csv");
  const double of_two = sums[1] / sums[0], of_four = sums[2] / sums[0];
  return check(
      of_two < 2.6 && of_four < 6,
      fmt::format("two capsules take {:.2f} times the CPU time of one, four {:.2f} times", of_two, of_four));
}

bool study(const std::string &directory, unsigned jobs) {
  std::vector<RunInput> inputs;
  for (const auto &some : {rows_beside_train(), far_apart_and_alone(), pairs_and_refined(), runs_of_cost()})
    inputs.insert(inputs.end(), some.begin(), some.end());
  const std::vector<StudyRun> computed = run_all(directory, jobs, inputs);
  Runs runs;
  for (std::size_t k = 0; k < inputs.size(); ++k)
    runs.emplace(inputs[k].name, computed[k]);
  bool holds = as_in_a_train(directory, runs);
  holds = as_if_alone(directory, runs) && holds;
  holds = estimates_are_bounds(directory, jobs, runs) && holds;
  return cost_is_bounded(directory, runs) && holds;
}

} // namespace

int main(int argc, char **argv) {
  return study_main(argc, argv, study);
}
