#include "scene/make_flow.hpp"

namespace capsule {

Wall make_wall(const std::optional<Pore> &pore, FlowType type, const FlowResolution &resolution) {
  if (!pore)
    return Wall(type == FlowType::extension ? extensional_flow : liquid_at_rest);
  return {*pore, resolution};
}

Flow make_flow(const std::optional<Pore> &pore, const FlowSpec &spec, const MeridianBasis &basis,
               const FlowResolution &resolution) {
  return {make_wall(pore, spec.type, resolution),
          make_membrane_mesh(basis, resolution),
          {.viscosity_ratios = {spec.viscosity_ratio}},
          resolution.solver_tolerance};
}

} // namespace capsule
