#pragma once
// The flow around a membrane in a scene's pore, or in unbounded liquid where there is none. Throws what Flow
// and Wall throw.
#include "flow/flow.hpp"
#include "geometry/pore.hpp"
#include <optional>

namespace capsule {

Wall make_wall(const std::optional<Pore> &pore, FlowType type, const FlowResolution &resolution);
Flow make_flow(const std::optional<Pore> &pore, const FlowSpec &spec, const MeridianBasis &basis,
               const FlowResolution &resolution, const SurfaceViscosity &of_membrane = {});

} // namespace capsule
