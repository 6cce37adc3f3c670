// Several capsules against steady trains, and their error estimates: the middle one of five in a row moves as one of a
// train; two alone part as opposed neighbours in a train return; gaps, shares of the pressure drop and the drop of a train
// err by less than estimated.
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

using namespace capsule;

namespace {

struct Kind {
  MembraneLaw law;
  double radius, capillary_number, viscosity_ratio;
};

// Equal capsules in a row in the tube, in front of each other at this spacing, around x = 0.
RunInput row_of(const std::string &name, const Kind &kind, std::size_t capsules, double spacing,
                double accuracy, double end) {
  RunInput run;
  run.name = name;
  Case &physics = run.physics;
  physics.accuracy = accuracy;
  physics.pore.shape = PoreShape::tube;
  physics.pore.entrance_distance = 12;
  physics.pore.exit_x = 18;
  physics.membrane.law = kind.law;
  physics.membrane.bending_ratio = 1e-2;
  physics.capsule.radius = kind.radius;
  physics.flow.capillary_number = kind.capillary_number;
  physics.flow.viscosity_ratio = kind.viscosity_ratio;
  physics.until.time = end;
  const Case one = physics;
  for (std::size_t k = 0; k < capsules; ++k) {
    Case &capsule = k == 0 ? physics : physics.followers.emplace_back(one);
    capsule.capsule.start_x = spacing * (static_cast<double>(capsules - 1) / 2 - static_cast<double>(k));
  }
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
  Case physics = row_of("", kind, 1, 0, accuracy, 1).physics;
  physics.flow.period = period;
  return physics;
}

SteadyRecord train_at(const Kind &kind, double period) {
  const Case physics = train_of(kind, period, 1e-5);
  return record_steady(refine(physics, find_steady(physics, {}, {}), {}).state, kind.viscosity_ratio);
}

// The middle one of five.
const Kind of_five{neo_hookean, 0.8, 0.02, 1};
constexpr double period = 2, settled = 3.6, apart = 0.05;

// Pairs and trains whose errors are looked at, and the gap at which they begin.
struct Estimated {
  Kind kind;
  double gap, accuracy;
};
const std::array estimated{Estimated{{neo_hookean, 0.8, 0.05, 1}, 0.2, 1e-3},
                           Estimated{{neo_hookean, 0.8, 0.05, 1}, 0.05, 1e-4},
                           Estimated{{neo_hookean, 0.6, 0.1, 5}, 0.1, 1e-3},
                           Estimated{{neo_hookean, 0.5, 0.2, 1}, 0.3, 1e-3},
                           Estimated{{{skalak, {1}}, 0.9, 0.05, 1}, 0.4, 1e-3},
                           Estimated{{{skalak, {0}}, 0.8, 0.04, 0.2}, 0.3, 1e-3},
                           Estimated{{{skalak, {3}}, 0.85, 0.02, 1}, 0.2, 1e-4},
                           Estimated{{{skalak, {1}}, 0.7, 0.1, 1}, 0.6, 1e-3}};

std::string name_of(const Estimated &row) {
  return fmt::format("{} R={} eps={} lambda={} gap={}",
                     row.kind.law.is(skalak) ? fmt::format("SK{}", row.kind.law.values()[0]) : "NH",
                     row.kind.radius, row.kind.capillary_number, row.kind.viscosity_ratio, row.gap);
}

// What is found of one quantity: the error of the value lies within `floor` of `difference`, as the refined value errs, too.
struct Errors {
  int all = 0, too_small = 0, too_large = 0; // below the error, above thirty times the error
  double most_beyond = 0;                    // of an error beyond its estimate, over the accuracy asked for
  Table table{"capsules,accuracy,quantity,difference,floor,estimate"};

  void add(const std::string &name, double accuracy, const std::string &quantity, double difference,
           double floor, double estimate) {
    ++all;
    too_small += difference - floor > estimate ? 1 : 0;
    most_beyond = std::max(most_beyond, (difference - floor - estimate) / accuracy);
    too_large += estimate > 30 * (difference + floor) ? 1 : 0;
    table.add(fmt::format("{},{:.0e},{},{:.3e},{:.3e},{:.3e}", name, accuracy, quantity, difference, floor,
                          estimate));
  }
};

// The largest errors along the way, at equal times.
void add_pair(Errors &errors, const std::string &directory, const Estimated &row, const RunInput &run,
              const StudyRun &coarse, const StudyRun &fine) {
  for (const char *quantity : {"min_gap#2", "pressure_share", "pressure_share#2", "spacing#2"}) {
    const std::string text = quantity, column = text.substr(0, text.find('#'));
    const std::string file = text.find('#') == std::string::npos ? "/series.csv" : "/series-2.csv";
    const Columns here = read_columns(fmt::format("{}/{}{}", directory, run.name, file)),
                  there = read_columns(fmt::format("{}/{}-refined{}", directory, run.name, file));
    double difference = 0;
    std::size_t rows = 0;
    for (std::size_t i = 0, k = 0; i < here.at("time").size(); ++i) {
      while (k < there.at("time").size() && there.at("time")[k] < here.at("time")[i] - 1e-9)
        ++k;
      if (k == there.at("time").size() || there.at("time")[k] > here.at("time")[i] + 1e-9)
        continue;
      difference = std::max(difference, std::abs(here.at(column)[i] - there.at(column)[k]));
      ++rows;
    }
    if (rows < 10)
      throw FileError(run.name + ": the refined run has other times");
    errors.add(name_of(row), row.accuracy, text + "@time", difference,
               fine.summary.error_estimate.at(text + "@time"),
               coarse.summary.error_estimate.at(text + "@time"));
  }
}

// Drop and speed of a train, with their estimates, at its accuracy and at a much smaller one.
std::string train_errors(const Estimated &row) {
  std::array<SeriesRow, 2> rows;
  std::array<std::map<std::string, double>, 2> estimates;
  for (std::size_t k = 0; k < 2; ++k) {
    const Case physics =
        train_of(row.kind, 2 * row.kind.radius + row.gap, k == 0 ? row.accuracy : 1e-2 * row.accuracy);
    const Outcome outcome = steady(physics, {}, {});
    if (outcome.status != Status::steady)
      throw FileError(name_of(row) + ": " + outcome.message);
    rows[k] = outcome.last.series.back();
    estimates[k] = outcome.error_estimate;
  }
  return fmt::format("{},{},{},{},{},{}", std::abs(rows[0].pressure_drop - rows[1].pressure_drop),
                     estimates[1].at("pressure_drop"), estimates[0].at("pressure_drop"),
                     std::abs(rows[0].v_g - rows[1].v_g), estimates[1].at("v_g"), estimates[0].at("v_g"));
}

bool study(const std::string &directory, unsigned jobs) {
  std::vector<RunInput> inputs{row_of("five", of_five, 5, period, 1e-4, settled),
                               row_of("nearer", of_five, 2, period - apart, 1e-5, settled),
                               row_of("farther", of_five, 2, period + apart, 1e-5, settled)};
  for (const Estimated &row : estimated) {
    inputs.push_back(row_of(fmt::format("pair-{}", inputs.size() / 2), row.kind, 2,
                            2 * row.kind.radius + row.gap, row.accuracy, 1.5));
    inputs.push_back(refined(inputs.back()));
  }
  const std::vector<StudyRun> runs = run_all(directory, jobs, inputs);
  std::vector<TextTask> tasks;
  for (const Estimated &row : estimated)
    tasks.push_back({"train " + name_of(row), [=] { return train_errors(row); }});
  const std::vector<std::string> trains = make_all(directory, jobs, tasks);

  const SteadyRecord train = train_at(of_five, period);
  const auto middle = [&](const char *quantity) { return runs[0].summary.quantities.at(quantity); };
  const double off_speed = std::abs(middle("v_g#3") / train.row.v_g - 1);
  const double off_drop = std::abs(middle("pressure_share#3") / train.row.pressure_drop - 1);
  Table of_middle("v_g,pressure_drop,pairing_growth_rate,parting");
  // The speed at which a pair parts falls exponentially with its spacing.
  const auto parting = [&](const StudyRun &run) {
    return run.summary.quantities.at("v_g") - run.summary.quantities.at("v_g#2");
  };
  const double near = runs[1].summary.quantities.at("spacing#2"),
               far = runs[2].summary.quantities.at("spacing#2");
  const double slope = std::log(parting(runs[2]) / parting(runs[1])) / (far - near);
  const double twice_slope = 2 * slope * parting(runs[1]) * std::exp(slope * (period - near));
  const double pairing = train.further.at("pairing_growth_rate");
  of_middle.add(fmt::format("{:.9f},{:.9f},{:.7f},{:.7f}", train.row.v_g, train.row.pressure_drop, pairing,
                            twice_slope));
  of_middle.write(directory + "/train.csv");

  Errors of_pairs, of_trains;
  for (std::size_t k = 0; k < estimated.size(); ++k) {
    const Estimated &row = estimated[k];
    const std::size_t run = 3 + 2 * k;
    add_pair(of_pairs, directory, row, inputs[run], runs[run], runs[run + 1]);
    const std::vector<std::string> cells = split_csv(trains[k]);
    const auto cell = [&](std::size_t at) { return std::stod(cells[at]); };
    of_trains.add(name_of(row), row.accuracy, "pressure_drop", cell(0), cell(1), cell(2));
    of_trains.add(name_of(row), row.accuracy, "v_g", cell(3), cell(4), cell(5));
  }
  of_pairs.table.write(directory + "/pairs.csv");
  of_trains.table.write(directory + "/trains.csv");

  bool holds =
      check(off_speed < 1e-4 && off_drop < 1e-4,
            fmt::format("the middle one of five has the speed of a train to {:.1e}, its drop to {:.1e}",
                        off_speed, off_drop));
  holds = check(std::abs(twice_slope / pairing - 1) < 0.03,
                fmt::format("opposed neighbours return with {:.5f}, pairs part with {:.5f}", pairing,
                            twice_slope)) &&
          holds;
  const auto counted_text = [](const Errors &errors) {
    return fmt::format("{} estimates: {} too small, {} more than thirty times the error", errors.all,
                       errors.too_small, errors.too_large);
  };
  holds = check(of_pairs.too_small == 0, "pairs, " + counted_text(of_pairs)) && holds;
  return check(of_trains.most_beyond < 1e-2,
               fmt::format("trains, {}, no error beyond its estimate by more than {:.1e} of the accuracy",
                           counted_text(of_trains), of_trains.most_beyond)) &&
         holds;
}

} // namespace

int main(int argc, char **argv) {
  return study_main(argc, argv, study);
}
