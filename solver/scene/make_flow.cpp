#include "scene/make_flow.hpp"

namespace capsule {

Wall make_wall(const Case &physics, const FlowResolution &resolution) {
  if (physics.pore.shape == PoreShape::none)
    return Wall(physics.flow.type == FlowType::extension ? extensional_flow : liquid_at_rest);
  return {make_pore(physics.pore), resolution};
}

Flow make_flow(const Case &physics, const MeridianBasis &basis, const FlowResolution &resolution) {
  return {
      make_wall(physics, resolution),
      make_membrane_mesh(basis, resolution),
      {.capillary_number = physics.flow.capillary_number, .viscosity_ratio = physics.flow.viscosity_ratio},
      resolution.solver_tolerance};
}

} // namespace capsule
