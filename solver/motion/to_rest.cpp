#include "motion/to_rest.hpp"
#include "base/failure.hpp"
#include "case/case.hpp"
#include "motion/march.hpp"
#include "scene/resolution.hpp"

namespace capsule {

std::optional<Profile> march_to_rest(const Case &target, MarchLength length, const Control &control) {
  constexpr double long_way = 16, behind_mouth = 1.5, beyond = 8;
  constexpr double step = 0.15; // of a march, in linearisations of a steady state
  if (target.flow.type != FlowType::pore || target.flow.drive != DriveBy::flow_rate)
    return {};
  const bool is_long = length == MarchLength::far_into_tube;
  Case input = target;
  input.accuracy = is_long ? 1e-4 : 3e-3; // on coarse meshes thin membranes wrinkle
  if (input.pore.shape == PoreShape::two_mouths)
    input.pore.shape = PoreShape::hyperbolic;
  input.flow.viscosity_ratio = 1;
  input.flow.period = 0;
  input.membrane.viscosity = {};
  input.time = {};
  input.output = {};
  input.until = {};
  input.until.x_g =
      is_long ? input.capsule.start_x + long_way : extent(input.capsule).half_length + behind_mouth;
  input.pore.exit_x = *input.until.x_g + beyond;
  const double nodes = choose_resolution(input).membrane_nodes;
  Control each_step;
  each_step.interrupted = [&] {
    spend(control, step, nodes);
    return false;
  };
  const Outcome outcome = [&] {
    try {
      return march_once(input, {}, each_step, Role::main);
    } catch (const InputError &error) { // a start that only a steady state may have
      throw NumericsFailure(failure_kind::unresolved, error.what(), "");
    }
  }();
  if (outcome.status != Status::reached)
    throw NumericsFailure(outcome.failure, outcome.message, "");
  return outcome.last.profiles.back();
}

} // namespace capsule
