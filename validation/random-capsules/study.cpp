// Capsules that are in no other file: are their steady states found, what is said where they are not, are their errors as
// small as estimated, and does a march end in the same state?
#include "study.hpp"
#include "base/atomic_file.hpp"
#include "law/skalak.hpp"
#include "motion/motion.hpp"
#include "motion/to_rest.hpp"
#include "observe/quantities.hpp"
#include "random_case.hpp"
#include "steady/steady_state.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>

using namespace capsule;

namespace {

constexpr int capsules = 200;
constexpr int marched_every = 5;       // of the capsules
constexpr double allowed_apart = 1e-3; // march and steady state, relative, in speed and pressure drop
constexpr double refined_accuracy = 1e-7;
constexpr double same_state = 1e-2;  // of the pressure drop, relative
constexpr double told_apart = 1e-10; // an error that the refined state shows

std::vector<Case> sample() {
  Sample of(20261130);
  std::vector<Case> cases(capsules);
  for (Case &c : cases)
    c = random_capsule(of);
  return cases;
}

// From the mouth into a tube that is long enough to come to rest.
std::string march_columns(Case physics, const SeriesRow &steady_row) {
  physics.until.x_g = 20;
  physics.pore.exit_x = 28;
  const Outcome outcome = march(physics, {}, {});
  if (outcome.status != Status::reached)
    return fmt::format("{},,", outcome.failure.empty() ? word_of(outcome.status) : outcome.failure);
  const SeriesRow &end = outcome.last.series.back();
  const bool at_rest = std::max(end.max_axial_residual, end.max_radial_velocity) < physics.accuracy;
  return fmt::format("{},{:.3g},{:.3g}", at_rest ? "at rest" : "moving",
                     std::abs(end.v_g / steady_row.v_g - 1),
                     std::abs(end.pressure_drop / steady_row.pressure_drop - 1));
}

// How many quantities err by more than the refined state's rounding, how many of them by more than estimated; the largest and
// the median error in parts of the estimate.
std::string estimate_columns(Case physics, const Outcome &found) {
  physics.accuracy = refined_accuracy;
  const Outcome refined = steady(physics, found.last.profiles.at(0), {}, march_to_rest);
  if (refined.status != Status::steady)
    return ",,,";
  const SeriesRow &row = found.last.series.at(0), &exact = refined.last.series.at(0);
  if (std::abs(row.pressure_drop / exact.pressure_drop - 1) > same_state)
    return ",,,";
  std::vector<double> parts;
  for (const ReportedQuantity &quantity : reported_quantities()) {
    const double error = std::abs(row.*quantity.value - exact.*quantity.value);
    if (quantity.error == ErrorEstimate::of_all && is_reported(quantity, row) && error > told_apart)
      parts.push_back(error / found.error_estimate.at(quantity.name));
  }
  if (parts.empty())
    return "0,0,,";
  std::ranges::sort(parts);
  return fmt::format("{},{},{:.3g},{:.3g}", parts.size(),
                     std::ranges::count_if(parts, [](double part) { return part > 1; }), parts.back(),
                     parts[parts.size() / 2]);
}

std::string row_of(const Case &physics, int number) {
  const double before = cpu_seconds();
  const Outcome found = steady(physics, {}, {}, march_to_rest);
  const double seconds = cpu_seconds() - before;
  const bool is_skalak = physics.membrane.law.is(skalak);
  std::string row = fmt::format(
      "{},{},{},{:.4f},{:.4f},{:.5g},{:.4g}", number, is_skalak ? "skalak" : "neo-hookean",
      is_skalak ? fmt::format("{:.4g}", physics.membrane.law.values()[0]) : "", physics.capsule.radius,
      physics.capsule.aspect_ratio, physics.flow.capillary_number, physics.membrane.bending_ratio);
  if (found.status != Status::steady)
    return row + fmt::format(",{},,,,,{:.3g},,,,,,,", found.failure, seconds);
  const SeriesRow &state = found.last.series.at(0);
  return row + fmt::format(",steady,{:.8g},{:.8g},{:.3g},{},{:.3g},{},{}", state.v_g, state.pressure_drop,
                           found.further.at("growth_rate"), found.membrane_nodes, seconds,
                           number % marched_every == 0 ? march_columns(physics, state) : ",,",
                           estimate_columns(physics, found));
}

bool study(const std::string &directory, unsigned jobs) {
  std::vector<TextTask> tasks;
  for (const Case &physics : sample()) {
    const int number = static_cast<int>(tasks.size()) + 1;
    tasks.push_back({fmt::format("{}", number), [=] { return row_of(physics, number); }});
  }
  const std::string header =
      "number,law,dilatation,R_eq,aspect_ratio,capillary_number,bending_ratio,verdict,v_g,pressure_drop,"
      "growth_rate,nodes,seconds,march,v_g_apart,pressure_drop_apart,quantities_that_err,estimates_too_small,"
      "largest_error_in_estimates,median_error_in_estimates";
  std::string text;
  for (const std::string &row : make_all(directory, jobs, tasks))
    text += row + "\n";
  write_atomically(directory + "/verdicts.csv", header + "\n" + text);
  std::map<std::string, int> verdicts;
  std::vector<double> seconds;
  int unstable = 0, compared = 0, apart = 0, moving = 0, estimates = 0, too_small = 0;
  double worst = 0, largest = 0;
  std::vector<double> typical;
  const Rows rows(header, text);
  for (std::size_t k = 0; k < rows.size(); ++k) {
    ++verdicts[rows.text(k, "verdict")];
    seconds.push_back(rows.value(k, "seconds"));
    unstable += rows.text(k, "verdict") == "steady" && rows.value(k, "growth_rate") > 0 ? 1 : 0;
    moving += rows.text(k, "march") == "moving" ? 1 : 0;
    if (const std::string &part = rows.text(k, "largest_error_in_estimates"); !part.empty()) {
      estimates += static_cast<int>(rows.value(k, "quantities_that_err"));
      too_small += static_cast<int>(rows.value(k, "estimates_too_small"));
      largest = std::max(largest, rows.value(k, "largest_error_in_estimates"));
      typical.push_back(rows.value(k, "median_error_in_estimates"));
    }
    if (rows.text(k, "march") != "at rest")
      continue;
    const double distance = std::max(rows.value(k, "v_g_apart"), rows.value(k, "pressure_drop_apart"));
    ++compared;
    worst = std::max(worst, distance);
    apart += distance > allowed_apart ? 1 : 0;
  }
  for (const auto &[verdict, count] : verdicts)
    fmt::print("{}: {}\n", verdict, count);
  std::ranges::sort(seconds);
  const int told = verdicts["steady"] + verdicts["fold"] + verdicts["softening"];
  bool holds = check(told >= 0.97 * capsules,
                     fmt::format("{} of {} end as found, or where a branch or a law ends", told, capsules));
  holds &= check(unstable == 0, fmt::format("{} of the states found are unstable", unstable));
  holds &= check(
      seconds.back() < 20 * seconds[capsules / 2],
      fmt::format("the longest search took {:.1f} times the median", seconds.back() / seconds[capsules / 2]));
  holds &=
      check(apart == 0,
            fmt::format("of {} marches that come to rest {} end in another state; largest distance {:.1e}; "
                        "{} still move at the end",
                        compared, apart, worst, moving));
  std::ranges::sort(typical);
  holds &=
      check(too_small == 0,
            fmt::format("{} of {} error estimates are too small; the largest error is {:.2g} "
                        "of its estimate, half of the errors of a capsule are below 1/{:.0f} "
                        "of it (median of {})",
                        too_small, estimates, largest, 1 / typical.at(typical.size() / 2), typical.size()));
  return holds;
}

} // namespace

int main(int argc, char **argv) {
  return study_main(argc, argv, study);
}
