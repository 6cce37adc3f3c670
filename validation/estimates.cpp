#include "estimates.hpp"
#include <algorithm>
#include <cmath>

namespace capsule {
namespace {

// The error that an estimate speaks of: the largest of all rows, of those around the peak, or of the last ones, and of
// the value that summary.json reports. The time adds up along the way.
double error_of(const std::string &quantity, const Case &physics, const StudyRun &run,
                const StudyRun &exact) {
  const double first_x_g = physics.capsule.start_x, last_x_g = physics.until.x_g.value();
  if (quantity == "volume_change")
    return std::abs(run.summary.quantities.at(quantity));
  const std::string plain = quantity.substr(0, quantity.find('@'));
  const auto largest = [&](const std::string &name, double from, double to) {
    return history_difference(run.history, exact.history, name, from, to);
  };
  if (is_of_the_way(quantity))
    return largest(plain, first_x_g, last_x_g);
  const double of_the_value =
      std::abs(run.summary.quantities.at(quantity) - exact.summary.quantities.at(quantity));
  if (quantity.starts_with("x_g_at_") || quantity.starts_with("largest_") || quantity.starts_with("transit_"))
    return of_the_value;
  if (quantity == "peak_pressure_drop") {
    const double peak = exact.summary.quantities.at("x_g_at_peak");
    return std::max(of_the_value, largest("pressure_drop", peak - 0.5, peak + 0.5));
  }
  return std::max(of_the_value, largest(quantity, quantity == "time" ? first_x_g : last_x_g - 2, last_x_g));
}

} // namespace

Verdict verdict_of(const std::string &quantity, const Case &physics, const StudyRun &run,
                   const StudyRun &exact) {
  return {error_of(quantity, physics, run, exact),
          quantity == "volume_change" ? 0 : exact.summary.error_estimate.at(quantity),
          run.summary.error_estimate.at(quantity)};
}

} // namespace capsule
