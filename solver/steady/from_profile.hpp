#pragma once
// A case's steady state from a profile: Newton's method from its shape, or from what that shape relaxes to.
#include "observe/outcome.hpp"
#include "steady/mesh_change.hpp"

namespace capsule {

// `profile`: any shape of the same capsule near to the steady state, or one that relaxes to it with equal viscosities.
// On as many nodes as the profile may have been computed with. Throws InputError for less than four points, Interrupted,
// and NumericsFailure("unresolved") if nothing comes to rest, with the sizes of both if the profile is of another capsule.
SteadyState from_profile(const Case &input, const Profile &profile, const Control &control);

} // namespace capsule
