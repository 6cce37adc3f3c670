#pragma once
// The flow around a membrane in a scene's pore, or in unbounded liquid where there is none. Throws what Flow
// and Wall throw.
#include "flow/flow.hpp"
#include "geometry/pore.hpp"
#include <optional>
#include <vector>

namespace capsule {

Wall make_wall(const std::optional<Pore> &pore, FlowType type, const FlowResolution &resolution);
Flow make_flow(const std::optional<Pore> &pore, const FlowSpec &spec, const MeridianBasis &basis,
               const FlowResolution &resolution, const SurfaceViscosity &of_membrane = {});
// Around several, with the wall that the most demanding one needs.
struct MembraneInFlow {
  MeridianBasis basis;
  FlowResolution resolution;
  double viscosity_ratio = 1;
  SurfaceViscosity viscosity;
};
Flow make_flow(const std::optional<Pore> &pore, const FlowSpec &spec,
               const std::vector<MembraneInFlow> &membranes);

} // namespace capsule
