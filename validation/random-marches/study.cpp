// Marches that are in no other file: is every end true, does the estimate bound the error, and does the advice help?
#include "study.hpp"
#include "base/failure.hpp"
#include "estimates.hpp"
#include "law/neo_hookean.hpp"
#include "motion/motion.hpp"
#include "motion/stops.hpp"
#include "observe/quantities.hpp"
#include "random_case.hpp"
#include "scene/resolution.hpp"
#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <map>
#include <set>

using namespace capsule;

namespace {

constexpr int marches = 60;
// Steps of a march and its companion, times the square of their nodes in hundreds. Thin films and weak flows take thousands
// of steps: what takes more work is said to be too long for this study.
constexpr double largest_work = 3500;
constexpr double largest_work_refined = 3 * largest_work; // also of a march that follows an advice
constexpr int repeats = 2; // of an advice, as "raise" and "lower" say no number

std::vector<Case> sample() {
  Sample of(20261130);
  std::vector<Case> cases(marches);
  for (Case &c : cases) {
    c = random_capsule(of);
    c.pore.opening_angle_deg = of.between(10, 89);
    c.flow.viscosity_ratio = of.log_between(1e-3, 1e3);
    c.accuracy = of.log_between(1e-4, 1e-2);
    c.until.x_g = 11.84;
  }
  return cases;
}

Outcome march_within(double limit, const Case &physics) {
  const double nodes = choose_resolution(physics).membrane_nodes / 100.0;
  double work = 0;
  Control control;
  control.interrupted = [&] {
    work += nodes * nodes;
    return work > limit;
  };
  return march(physics, {}, control);
}

std::string end_of(const Outcome &outcome) {
  if (outcome.status == Status::interrupted)
    return "too long";
  return outcome.failure.empty() ? word_of(outcome.status) : outcome.failure;
}

// A march that ends for a reason of the membrane's own.
bool is_told(const std::string &end) {
  return end == word_of(Status::reached) || end == word_of(Status::unbounded);
}

int nodes_of(const Case &physics, const Outcome &outcome) {
  return outcome.membrane_nodes > 0 ? outcome.membrane_nodes : choose_resolution(physics).membrane_nodes;
}

// `run` says then that errors may exceed their estimates.
bool is_warned(const Outcome &outcome) {
  return std::ranges::any_of(outcome.last.series,
                             [](const SeriesRow &row) { return row.dents >= dents_of_wrinkles; });
}

Case refined(const Case &physics, const Outcome &outcome) {
  Case fine = physics;
  fine.accuracy = std::max(1e-6, physics.accuracy / 10);
  fine.mesh.membrane = 7 * nodes_of(physics, outcome) / 5 + 1;
  return fine;
}

// What the program says of the end of a march.
StudyRun told_by(const Outcome &outcome) {
  StudyRun run;
  run.summary.error_estimate = outcome.error_estimate;
  for (const ReportedQuantity &quantity : reported_quantities()) {
    run.summary.quantities[quantity.name] = outcome.last.series.back().*quantity.value;
    for (const SeriesRow &row : outcome.last.series)
      run.history[quantity.name].push_back(row.*quantity.value);
  }
  if (const auto peak = entry_peak(outcome.last.series))
    for (const PeakQuantity &quantity : peak_quantities())
      run.summary.quantities[quantity.name] = (*peak).*quantity.value;
  for (const LargestQuantity &quantity : largest_quantities()) {
    const auto largest = largest_on_the_way(outcome.last.series, quantity.value, quantity.S);
    const std::string name = std::string("largest_") + quantity.name;
    run.summary.quantities[name] = largest->value;
    run.summary.quantities["x_g_at_" + name] = largest->x_g;
  }
  return run;
}

// What the messages of solver/motion/stops.cpp and their siblings advise, followed once.
struct Advice {
  const char *failure, *name;
  void (*follow)(Case &);
};
void finer_mesh(Case &c) {
  c.mesh.membrane = 3 * choose_resolution(c).membrane_nodes / 2;
}
void stricter(Case &c) {
  c.accuracy = std::max(1e-6, c.accuracy / 10);
}
void stiffer(Case &c) {
  c.membrane.bending_ratio *= 10;
}
void weaker_flow(Case &c) {
  c.flow.capillary_number /= 2;
}
void stronger_flow(Case &c) {
  c.flow.capillary_number *= 2;
}
void other_law(Case &c) {
  c.membrane.law = neo_hookean;
}
constexpr std::array advices{
    Advice{failure_kind::wrinkled, "bending", stiffer},
    Advice{failure_kind::wrinkled, "mesh", finer_mesh},
    Advice{failure_kind::self_contact, "bending", stiffer},
    Advice{failure_kind::self_contact, "mesh", finer_mesh},
    Advice{failure_kind::touching, "accuracy", stricter},
    Advice{failure_kind::touching, "mesh", finer_mesh},
    Advice{failure_kind::touching, "stronger flow", stronger_flow},
    Advice{failure_kind::touching, "bending", stiffer},
    Advice{failure_kind::unresolved, "mesh", finer_mesh},
    Advice{failure_kind::softening, "weaker flow", weaker_flow},
    Advice{failure_kind::softening, "law", other_law},
    Advice{failure_kind::volume, "accuracy", stricter},
    Advice{failure_kind::volume, "mesh", finer_mesh},
    Advice{failure_kind::unbounded, "weaker flow", weaker_flow},
};

// What helped, or nothing. Who follows an advice begins with the nodes that the failed run ended with.
std::string help(const Case &physics, const Outcome &failed) {
  const bool runs_away = failed.status == Status::unbounded;
  for (const Advice &advice : advices) {
    if (failed.failure != advice.failure)
      continue;
    Case changed = physics;
    if (advice.follow == finer_mesh)
      changed.mesh.membrane = nodes_of(physics, failed);
    for (int k = 1; k <= repeats; ++k) {
      advice.follow(changed);
      const Outcome outcome = march_within(largest_work_refined, changed);
      if (outcome.status == Status::reached || (!runs_away && is_told(end_of(outcome))))
        return fmt::format("{} x{}: {}", advice.name, k, end_of(outcome));
    }
  }
  return "nothing";
}

// A row for verdicts.csv, and below it the rows for estimates.csv.
std::string rows_of(const Case &physics, int number) {
  const bool is_skalak = physics.membrane.law.is(skalak);
  const double before = cpu_seconds();
  const Outcome outcome = march_within(largest_work, physics);
  const double seconds = cpu_seconds() - before;
  const std::string end = end_of(outcome);
  std::string row = fmt::format(
      "{},{},{},{:.4f},{:.4f},{:.5g},{:.4g},{:.4g},{:.4g},{:.4g},{},{},{:.4g},{:.3g}", number,
      is_skalak ? "skalak" : "neo-hookean",
      is_skalak ? fmt::format("{:.4g}", physics.membrane.law.values()[0]) : "", physics.capsule.radius,
      physics.capsule.aspect_ratio, physics.flow.capillary_number, physics.membrane.bending_ratio,
      physics.pore.opening_angle_deg, physics.flow.viscosity_ratio, physics.accuracy, end,
      nodes_of(physics, outcome), outcome.last.series.back().x_g, seconds);
  if (outcome.status == Status::interrupted)
    return row + ",,,";
  const Case fine = refined(physics, outcome);
  const Outcome exact = march_within(largest_work_refined, fine);
  row += fmt::format(",{},{},{}", end_of(exact), fine.mesh.membrane,
                     outcome.status == Status::reached ? "" : help(physics, outcome));
  if (outcome.error_estimate.empty() || exact.error_estimate.empty())
    return row;
  const StudyRun run = told_by(outcome), reference = told_by(exact);
  const bool warned = is_warned(outcome);
  for (const auto &[quantity, estimate] : outcome.error_estimate) {
    const std::string plain = quantity.substr(0, quantity.find('@'));
    const bool known = is_a_place(quantity) || plain == "flow_rate" || plain == "volume_change";
    if (known || !exact.error_estimate.contains(quantity))
      continue;
    const Verdict verdict = verdict_of(quantity, physics, run, reference);
    row += fmt::format("\n{},{},{:.9g},{:.3e},{:.3e},{:.3e},{:d},{:d},{}", number, quantity,
                       run.summary.quantities.at(plain), verdict.difference, verdict.floor, estimate,
                       verdict.determined(), warned, verdict.bounds() ? "bounds" : "too small");
  }
  return row;
}

double median(std::vector<double> values) {
  if (values.empty())
    return std::numeric_limits<double>::quiet_NaN();
  std::ranges::sort(values);
  return values[values.size() / 2];
}

bool study(const std::string &directory, unsigned jobs) {
  std::vector<TextTask> tasks;
  for (const Case &physics : sample()) {
    const int number = static_cast<int>(tasks.size()) + 1;
    tasks.push_back({fmt::format("{}", number), [=] { return rows_of(physics, number); }});
  }
  const std::string header = "number,law,dilatation,R_eq,aspect_ratio,capillary_number,bending_ratio,"
                             "opening_angle,viscosity_ratio,accuracy,end,nodes,x_g,seconds,refined_end,"
                             "refined_nodes,helps";
  const std::string header_of_estimates =
      "number,quantity,value,difference,floor,estimate,determined,warned,verdict";
  std::string text, estimates;
  for (const std::string &rows : make_all(directory, jobs, tasks)) {
    const std::size_t end = rows.find('\n');
    text += rows.substr(0, end) + "\n";
    if (end != std::string::npos)
      estimates += rows.substr(end + 1) + "\n";
  }
  write_atomically(directory + "/verdicts.csv", header + "\n" + text);
  write_atomically(directory + "/estimates.csv", header_of_estimates + "\n" + estimates);

  std::map<std::string, int> ends;
  int failures = 0, cured = 0, untold = 0, compared = 0, open = 0, helped = 0;
  const Rows rows(header, text);
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const std::string &end = rows.text(k, "end"), &fine = rows.text(k, "refined_end");
    ++ends[end];
    if (end == "too long")
      continue;
    if (end == "reached") {
      ++(fine == "reached" ? compared : open);
      if (fine != "reached")
        fmt::print("{}: reached, refined: {}\n", rows.text(k, "number"), fine);
      continue;
    }
    ++failures;
    cured += fine == "reached" ? 1 : 0;
    untold += fine == "too long" ? 1 : 0;
    helped += rows.text(k, "helps") == "nothing" ? 0 : 1;
    fmt::print("{}: {} at x_g = {}, refined: {}; helps: {}\n", rows.text(k, "number"), end,
               rows.text(k, "x_g"), fine, rows.text(k, "helps"));
  }
  for (const auto &[end, count] : ends)
    fmt::print("{}: {}\n", end, count);

  int all = 0, too_small = 0, too_small_where_warned = 0;
  std::set<std::string> warned;
  std::vector<double> ways, values;
  const Rows estimated(header_of_estimates, estimates);
  for (std::size_t k = 0; k < estimated.size(); ++k) {
    const std::string &quantity = estimated.text(k, "quantity");
    const bool is_warned = estimated.text(k, "warned") == "1";
    ++all;
    if (is_warned)
      warned.insert(estimated.text(k, "number"));
    if (estimated.text(k, "verdict") != "bounds") {
      ++(is_warned ? too_small_where_warned : too_small);
      fmt::print("{}: {}: error {}, estimate {}: too small{}\n", estimated.text(k, "number"), quantity,
                 estimated.text(k, "difference"), estimated.text(k, "estimate"),
                 is_warned ? ", as the run says that it may be" : "");
    }
    const double ratio = estimated.value(k, "estimate") / estimated.value(k, "difference");
    (is_of_the_way(quantity) ? ways : values).push_back(ratio);
  }
  bool holds = check(too_small == 0,
                     fmt::format("of {} estimates of {} marches {} are too small without a warning, and {} "
                                 "with one, which {} marches have that wrinkled on their way; {} marches "
                                 "that arrive have a refined one that does not",
                                 all, compared, too_small, too_small_where_warned, warned.size(), open));
  holds &= check(median(ways) < 10,
                 fmt::format("the median estimate of a largest error along the way is {:.1f} times "
                             "the error (of a value at the end {:.1f} times)",
                             median(ways), median(values)));
  holds &= check(
      cured == 0 && untold == 0,
      fmt::format("of {} marches that do not arrive {} do on a finer mesh with a stricter accuracy, and "
                  "{} take too long there",
                  failures, cured, untold));
  holds &= check(10 * helped >= 9 * failures,
                 fmt::format("the advice helps in {} of {} marches that do not arrive", helped, failures));
  return holds;
}

} // namespace

int main(int argc, char **argv) {
  return study_main(argc, argv, study);
}
