#pragma once
// A case's steady state from a profile: by Newton's method from its shape, on more nodes if its own do not get there, or from what
// that shape relaxes to.
#include "observe/outcome.hpp"
#include "steady/mesh_change.hpp"
#include <optional>
#include <string>

namespace capsule {

// By Newton's method only; none if it does not get there. `profile`: any shape of the same capsule near to the steady state.
// Throws InputError for less than four points, Interrupted, and what it asks of `control`.
std::optional<SteadyState> solved_from_profile(const Case &input, const Profile &profile,
                                               const Control &control);

// The shape may be one that relaxes to the steady state with equal viscosities, too, on as many nodes as the profile may have
// been computed with. Throws InputError for less than four points, Interrupted,
// and NumericsFailure("unresolved") if nothing comes to rest, with the sizes of both if the profile is of another capsule.
SteadyState from_profile(const Case &input, const Profile &profile, const Control &control);

// "the profile to begin with is of another capsule: radius 0.8 there, 0.9 here"; empty if it is of this one. The volume and
// the length of the meridian before the flow tell. A state is found from it all the same, but not always the one that is
// found from nothing. Throws InputError for less than four points.
std::string other_capsule(const Case &input, const Profile &profile);

} // namespace capsule
