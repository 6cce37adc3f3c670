#include "scene/make_flow.hpp"
#include <algorithm>
#include <utility>
#include <vector>

namespace capsule {

Wall make_wall(const std::optional<Pore> &pore, FlowType type, const FlowResolution &resolution) {
  if (!pore)
    return Wall(type == FlowType::extension ? extensional_flow : liquid_at_rest);
  return {*pore, resolution};
}

Flow make_flow(const std::optional<Pore> &pore, const FlowSpec &spec, const MeridianBasis &basis,
               const FlowResolution &resolution, const SurfaceViscosity &of_membrane) {
  return make_flow(pore, spec, {{basis, resolution, spec.viscosity_ratio, of_membrane}});
}

Flow make_flow(const std::optional<Pore> &pore, const FlowSpec &spec,
               const std::vector<MembraneInFlow> &membranes) {
  FlowResolution resolution = membranes.front().resolution;
  FlowParameters parameters;
  std::vector<MembraneMesh> meshes;
  for (const MembraneInFlow &membrane : membranes) {
    const FlowResolution &needed = membrane.resolution;
    resolution.wall_panel_points = std::max(resolution.wall_panel_points, needed.wall_panel_points);
    resolution.wall_panel = std::min(resolution.wall_panel, needed.wall_panel);
    resolution.lip_panel = std::min(resolution.lip_panel, needed.lip_panel);
    resolution.solver_tolerance = std::min(resolution.solver_tolerance, needed.solver_tolerance);
    parameters.viscosity_ratios.push_back(membrane.viscosity_ratio);
    parameters.surface_viscosities.push_back(membrane.viscosity);
    meshes.push_back(make_membrane_mesh(membrane.basis, needed));
  }
  Wall wall = make_wall(pore, spec.type, resolution);
  if (spec.drive == DriveBy::pressure)
    parameters.drive.resistance = wall.base_pressure_drop();
  return {std::move(wall), join(meshes), parameters, resolution.solver_tolerance};
}

} // namespace capsule
