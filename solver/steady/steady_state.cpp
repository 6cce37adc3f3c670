#include "steady/steady_state.hpp"
#include "base/failure.hpp"
#include "case/physical.hpp"
#include "scene/scene.hpp"
#include "steady/from_profile.hpp"
#include "steady/refinement.hpp"
#include <fmt/format.h>

namespace capsule {

SteadyState find_steady(const Case &input, const std::optional<Profile> &from, const Control &control,
                        const MarchToRest &march) {
  return from ? from_profile(input, *from, control) : search_steady(input, control, march);
}

Outcome steady(const Case &input, const std::optional<Profile> &from, const Control &control,
               const MarchToRest &march) {
  Outcome outcome;
  try {
    const RefinedState refined = refine(input, find_steady(input, from, control, march), control);
    const SteadyRecord record = record_steady(refined.state);
    outcome.status = Status::steady;
    const bool stable = record.further.at("growth_rate") <= 0;
    for (const std::string &remark : {from ? other_capsule(input, *from) : "", refined.warning,
                                      std::string(stable ? "" : "this steady state is unstable")})
      if (!remark.empty())
        outcome.message += (outcome.message.empty() ? "" : "; ") + remark;
    outcome.error_estimate = refined.error_estimate;
    outcome.error_estimate.merge(errors_of_further(refined, record));
    outcome.further = record.further;
    if (const auto empty = empty_resistance(input))
      outcome.further["empty_resistance"] = *empty;
    outcome.membrane_nodes = static_cast<int>(refined.state.system->nodes());
    outcome.last.series = {record.row};
    outcome.last.profiles = {record.profile};
  } catch (const NumericsFailure &failure) {
    outcome.status = Status::failed;
    outcome.failure = failure.kind;
    outcome.message = fmt::format("{}; {}", failure.what(), with_physical_keys(failure.advice, input));
  } catch (const Interrupted &) {
    outcome.status = Status::interrupted;
  }
  return outcome;
}

} // namespace capsule
