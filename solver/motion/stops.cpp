#include "motion/stops.hpp"
#include "base/failure.hpp"
#include "observe/outcome.hpp"
#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>

namespace capsule {
namespace {

constexpr double largest_volume_change = 1e-2;

constexpr std::array table{
    // The equations see the nodes only. Where a thin film is gone between them, steps get ever shorter.
    Stop{.kind = failure_kind::touching,
         .holds = [](const Instant &now) { return now.row.min_film <= 0; },
         .what = [](const Instant &) -> std::string {
           return "the membrane touches the wall between its nodes";
         },
         .advice = touching_advice},
    Stop{.kind = failure_kind::self_contact,
         .holds = [](const Instant &now) { return now.crosses_itself; },
         .what = [](const Instant &) -> std::string { return "the membrane crosses itself"; },
         .advice = "raise membrane.bending_ratio or refine mesh.membrane"},
    Stop{.kind = failure_kind::volume,
         .holds = [](const Instant &now) { return std::abs(now.row.volume_change) > largest_volume_change; },
         .what =
             [](const Instant &now) {
               return fmt::format("the volume has drifted by {:.2g} %", 100 * now.row.volume_change);
             },
         .advice = "try a stricter accuracy or time.tolerance (a smaller number), or a finer mesh.membrane"},
    Stop{.kind = failure_kind::wrinkled,
         .holds =
             [](const Instant &now) {
               return now.row.dents >= dents_of_wrinkles && now.row.roughness > now.roughness_limit;
             },
         .what =
             [](const Instant &now) {
               return fmt::format(
                   "the membrane has wrinkled: {} dents, most of their bending in waves that the "
                   "mesh barely resolves",
                   now.row.dents);
             },
         .advice = "raise membrane.bending_ratio, or mesh.membrane until it resolves the wrinkles"},
    Stop{.kind = failure_kind::softening,
         .holds = [](const Instant &now) { return now.softest && softens(*now.softest); },
         .what = [](const Instant &now) { return softening_text(*now.softest); },
         .advice = softening_advice},
    Stop{.kind = failure_kind::burst,
         .holds = [](const Instant &now) { return now.bursts; },
         .what =
             [](const Instant &now) {
               return fmt::format("the membrane bursts with an area stretch of {:.6g} at S = {:.4g} and a "
                                  "tension of {:.6g} at S = {:.4g}",
                                  now.row.max_area_stretch, now.row.S_at_max_area_stretch,
                                  now.row.max_tension, now.row.S_at_max_tension);
             },
         .advice = "until.area_stretch and until.tension say what it bears"},
    Stop{.kind = failure_kind::unbounded,
         .holds = [](const Instant &now) { return now.row.max_stretch > runaway_stretch; },
         .what =
             [](const Instant &) {
               return fmt::format("the membrane is stretched beyond {} and still growing", runaway_stretch);
             },
         .advice = "no steady state need exist: lower flow.capillary_number"},
};

} // namespace

double wrinkle_roughness_on_chosen_nodes(double accuracy) {
  return std::min(wrinkle_roughness, std::cbrt(accuracy));
}

double beyond_bearing(const UntilSpec &limits, const LargestStrain &strain) {
  double beyond = -std::numeric_limits<double>::infinity();
  if (limits.area_stretch)
    beyond = std::max(beyond, strain.area_stretch - *limits.area_stretch);
  if (limits.tension)
    beyond = std::max(beyond, strain.tension - *limits.tension);
  return beyond;
}

std::span<const Stop> stops() {
  return table;
}

void throw_if_stopped(const Instant &instant) {
  for (const Stop &stop : stops())
    if (stop.holds(instant))
      throw NumericsFailure(stop.kind, stop.what(instant), stop.advice);
}

} // namespace capsule
