#pragma once
// The shape to which a march leads from a case's own start, far in the tube: a beginning for Newton's method where nothing
// else leads to the steady state.
#include "observe/outcome.hpp"
#include <optional>

namespace capsule {

struct Case;

// The last profile of a march with equal viscosities and a membrane without friction, on which no steady shape depends:
// to behind the mouth at accuracy 3e-3, or far into the tube at 1e-4. None for a flow that is not the pore's
// at a given rate. Asks `control` for the work of each step. Throws NumericsFailure where the march does not arrive, or cannot
// begin.
std::optional<Profile> march_to_rest(const Case &target, MarchLength length, const Control &control);

} // namespace capsule
