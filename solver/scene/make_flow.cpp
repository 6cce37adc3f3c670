#include "scene/make_flow.hpp"
#include <utility>

namespace capsule {

Wall make_wall(const std::optional<Pore> &pore, FlowType type, const FlowResolution &resolution) {
  if (!pore)
    return Wall(type == FlowType::extension ? extensional_flow : liquid_at_rest);
  return {*pore, resolution};
}

Flow make_flow(const std::optional<Pore> &pore, const FlowSpec &spec, const MeridianBasis &basis,
               const FlowResolution &resolution, const SurfaceViscosity &of_membrane) {
  Wall wall = make_wall(pore, spec.type, resolution);
  FlowParameters parameters{.viscosity_ratios = {spec.viscosity_ratio}, .surface_viscosities = {of_membrane}};
  if (spec.drive == DriveBy::pressure)
    parameters.drive.resistance = wall.base_pressure_drop();
  return {std::move(wall), make_membrane_mesh(basis, resolution), parameters, resolution.solver_tolerance};
}

} // namespace capsule
