// Does error_estimate bound the error, and not by too much? Capsules of many kinds against refined runs.
#include "study.hpp"
#include "resolution.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

using namespace capsule;

namespace {

constexpr double first_x_g = -4;
constexpr double last_x_g = 11.5;

struct Capsule {
  LawName law;
  double dilatation, radius, aspect_ratio, capillary_number, viscosity_ratio, accuracy;
};

std::vector<Capsule> capsules() {
  constexpr LawName neo_hookean = LawName::neo_hookean;
  constexpr LawName skalak = LawName::skalak;
  return {
      {neo_hookean, 1, 0.8, 1, 0.09, 1, 1e-4}, {neo_hookean, 1, 0.7, 1, 0.06, 1, 1e-3},
      {neo_hookean, 1, 0.8, 1, 0.09, 5, 1e-5}, {skalak, 0, 0.9, 1, 0.04, 1, 1e-5},
      {skalak, 0, 0.9, 1, 0.04, 5, 1e-4},      {skalak, 0, 0.9, 1, 0.04, 0.2, 1e-6},
      {skalak, 0, 0.8, 1, 0.08, 1, 1e-6},      {skalak, 1, 1, 1, 0.05, 1, 1e-4},
      {skalak, 1, 1.1, 1, 0.02, 1, 1e-3},      {skalak, 1, 0.9, 1, 0.12, 10, 1e-4},
      {skalak, 0, 0.9, 0.5, 0.04, 1, 1e-4},    {skalak, 0, 0.9, 0.28, 0.04, 1, 1e-3},
      {skalak, 1, 0.8, 0.28, 0.04, 5, 1e-3},   {neo_hookean, 1, 0.7, 0.5, 0.08, 0.2, 1e-4},
  };
}

std::string name_of(const Capsule &capsule) {
  return fmt::format("{} R={} A/B={} eps={} lambda={}",
                     capsule.law == LawName::neo_hookean ? "NH" : fmt::format("SK{}", capsule.dilatation),
                     capsule.radius, capsule.aspect_ratio, capsule.capillary_number, capsule.viscosity_ratio);
}

RunInput run_of(const Capsule &capsule) {
  RunInput run;
  Case &physics = run.physics;
  physics.accuracy = capsule.accuracy;
  physics.capsule.radius = capsule.radius;
  physics.capsule.aspect_ratio = capsule.aspect_ratio;
  physics.membrane.law = capsule.law;
  physics.membrane.dilatation = capsule.dilatation;
  physics.flow.capillary_number = capsule.capillary_number;
  physics.flow.viscosity_ratio = capsule.viscosity_ratio;
  physics.until.x_g = last_x_g;
  return run;
}

// A hundred times the accuracy, on half as many nodes again.
RunInput refined(const RunInput &run) {
  RunInput fine = run;
  fine.name += "-refined";
  fine.physics.accuracy = std::max(1e-8, 0.01 * run.physics.accuracy);
  fine.physics.mesh.membrane = std::max(3 * choose_resolution(run.physics).membrane_nodes / 2,
                                        choose_resolution(fine.physics).membrane_nodes);
  return fine;
}

// What is known of one quantity of one run: its error lies within `floor` of `difference`, because the refined value has
// an error of its own.
struct Verdict {
  double difference, floor, estimate;
  bool determined() const { return difference > 2 * floor; }
  bool bounds() const { return difference - floor <= estimate; }
  bool is_sharp() const { return estimate <= 30 * (difference + floor); }
};

// What the accuracy asked for speaks of. The others are shown: a single value at the end can be right by accident.
bool is_promised(const std::string &quantity) {
  return quantity == "pressure_drop@x_g" || quantity == "v_g@x_g";
}

bool study(const std::string &directory, unsigned jobs) {
  std::vector<RunInput> inputs;
  for (const Capsule &capsule : capsules()) {
    RunInput run = run_of(capsule);
    run.name = fmt::format("{:02}", inputs.size() / 2);
    inputs.push_back(run);
    inputs.push_back(refined(run));
  }
  const std::vector<StudyRun> runs = run_all(directory, jobs, inputs);

  Table table("capsule,accuracy,quantity,value,difference,floor,estimate,determined,holds");
  std::string markdown =
      "| capsule | accuracy | quantity | true error | estimate | ratio | |\n|---|---|---|---|---|---|---|\n";
  bool holds = true;
  for (std::size_t k = 0; k < capsules().size(); ++k) {
    const Capsule capsule = capsules()[k];
    const Summary &summary = runs[2 * k].summary;
    const Summary &exact = runs[2 * k + 1].summary;
    if (summary.error_estimate.empty() || exact.error_estimate.empty()) {
      fmt::print("{}: {} {}; refined: {} {}\n", name_of(capsule), summary.status, summary.message,
                 exact.status, exact.message);
      holds = false;
      continue;
    }
    for (const auto &[quantity, estimate] : summary.error_estimate) {
      if (quantity == "x_g" || quantity.starts_with("x_g@")) // where rows are taken
        continue;
      const bool along = quantity.ends_with("@x_g");
      const std::string plain = quantity.substr(0, quantity.find('@'));
      const double value = quantity == "volume_change" ? 0 : exact.quantities.at(plain);
      const double error =
          along ? history_difference(runs[2 * k].history, runs[2 * k + 1].history, plain, first_x_g, last_x_g)
                : std::abs(summary.quantities.at(plain) - value);
      const double floor = quantity == "volume_change" ? 0 : exact.error_estimate.at(quantity);
      const Verdict verdict{error, floor, estimate};
      const bool good = verdict.bounds() && verdict.is_sharp();
      holds = holds && (good || !is_promised(quantity));
      table.add(fmt::format("{},{:.0e},{},{:.9g},{:.3e},{:.3e},{:.3e},{:d},{:d}", name_of(capsule),
                            capsule.accuracy, quantity, value, verdict.difference, floor, estimate,
                            verdict.determined(), good));
      markdown += fmt::format("| {} | {:.0e} | {} | {:.1e}{} | {:.1e} | {:.2g} | {} |\n", name_of(capsule),
                              capsule.accuracy, quantity, verdict.difference,
                              verdict.determined() ? "" : fmt::format(" ± {:.1e}", floor), estimate,
                              estimate / verdict.difference,
                              good               ? ""
                              : verdict.bounds() ? "more than 30 times"
                                                 : "too small");
    }
  }
  table.write(directory + "/estimates.csv");
  write_atomically("tables/error-estimate.md",
                   "**Error estimates.** Against refined runs; ± is what the refined run leaves open.\n\n" +
                       markdown);
  fmt::print("{}error-estimate: {}\n", markdown, holds ? "HOLDS" : "FAILS");
  return holds;
}

} // namespace

int main(int argc, char **argv) {
  return study_main(argc, argv, study);
}
