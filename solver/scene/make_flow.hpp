#pragma once
// The flow of a case around its membrane.
#include "case/case.hpp"
#include "flow/flow.hpp"

namespace capsule {

// Throws InputError for a pore that is none (pore.hpp).
Wall make_wall(const Case &physics, const FlowResolution &resolution);
Flow make_flow(const Case &physics, const MeridianBasis &basis, const FlowResolution &resolution);

} // namespace capsule
