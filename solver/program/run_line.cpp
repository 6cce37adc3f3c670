#include "program/run_line.hpp"
#include "base/text.hpp"
#include "case/key_path.hpp"
#include "case/physical.hpp"
#include "observe/outcome.hpp"
#include "observe/unit_of.hpp"
#include <algorithm>
#include <fmt/format.h>
#include <utility>
#include <vector>

namespace capsule {
namespace {

// Labels and quantities; a run tells those that it has.
std::vector<std::pair<std::string, std::string>> told_quantities(const RunResult &result) {
  const Summary &summary = *result.summary;
  std::vector<std::pair<std::string, std::string>> told;
  const bool steady = summary.status == word_of(Status::steady);
  if (!summary.along.empty())
    told.emplace_back("end at " + summary.along, "time"); // on a branch the key takes the place of the time
  else if (!steady)
    told = {{"t", "time"}, {"x_g", "x_g"}};
  told.emplace_back("v_g", "v_g");
  for (std::size_t k = 1; k <= result.input.physics.followers.size(); ++k)
    for (const char *name : {"x_g", "v_g"})
      told.emplace_back(name + capsule_mark(k), name + capsule_mark(k));
  told.insert(told.end(), {{"pressure drop", "pressure_drop"},
                           {"transit time", "transit_time"},
                           {"pulse height", "transit_pulse_height"}});
  return told;
}

// Whether it ends the steady states of a flow that grows: the last fold, behind which the membrane runs away.
bool ends_steady_states(const FoldPlace &fold, const RunResult &result) {
  const Summary &summary = *result.summary;
  return summary.status == word_of(Status::unbounded) && fold.value == summary.folds.back().value &&
         is_critical(summary.along, result.input.physics.flow.capillary_number, fold.value);
}

std::string in_own_units(const RunResult &result) {
  const Summary &summary = *result.summary;
  const Case &physics = result.input.physics;
  if (!has_physical(physics))
    return "";
  if (!summary.along.empty()) { // along most keys the scales change
    std::string places;
    const auto tell = [&](const char *what, double value, bool critical) {
      for (const Physical &physical : physical_of(physics, summary.along, value)) {
        std::string name(last_component(physical.key));
        std::ranges::replace(name, '_', ' ');
        places += fmt::format("\n  {} at a {} of {}{}", what, name, physical.text,
                              critical ? ", the critical " + name : "");
      }
    };
    for (const FoldPlace &fold : summary.folds)
      tell("fold", fold.value, ends_steady_states(fold, result));
    if (const auto end = summary.quantities.find("time"); end != summary.quantities.end())
      tell("end", end->second, false);
    return places;
  }
  const Scales scales = physical_scales(physics);
  std::string text;
  for (const auto &[label, name] : told_quantities(result)) {
    const auto value = summary.quantities.find(name);
    const auto unit = unit_of(name.substr(0, name.find('#')));
    if (value == summary.quantities.end() || !has_scale(unit, scales))
      continue;
    const TypedUnit own = own_unit(physics, unit->dimension);
    text += fmt::format("  {} {:.4g} {}", label, value->second * scales.*unit->scale / own.si, own.name);
  }
  return text.empty() ? "" : "\n  in the case's units:" + text;
}

} // namespace

std::string run_line(const RunResult &result, const std::string &name, bool computed_before) {
  const Summary &summary = *result.summary;
  std::string text = fmt::format("{}: {}", name, summary.status);
  if (const std::string reason = summary.reason(); !reason.empty())
    text += fmt::format(" ({})", reason);
  const auto add = [&](const std::string &label, const std::string &quantity, int digits = 6) {
    if (const auto value = summary.quantities.find(quantity); value != summary.quantities.end())
      text += fmt::format("  {} {:.{}g}", label, value->second, digits);
  };
  for (const auto &[value, stretch, error] : summary.folds)
    text += fmt::format("  fold at {} {}, stretch {:.3g}", summary.along, number_with_error(value, error),
                        stretch);
  if (const auto &end = summary.end_of_fold_curve)
    text += fmt::format("  at {} = {:.6g} the last one at {}, stretch {:.3g}", end->along, end->value,
                        number_with_error(end->fold.value, end->fold.error), end->fold.stretch);
  for (const auto &[label, quantity] : told_quantities(result))
    add(label, quantity);
  if (!summary.along.empty() && summary.folds.empty() && summary.failure.empty())
    text += "  no fold on the way";
  add("CPU seconds", "cpu_seconds", 3);
  return text +
         fmt::format("{}  -> {}", computed_before ? " (computed before)" : "", result.directory.string()) +
         in_own_units(result);
}

} // namespace capsule
