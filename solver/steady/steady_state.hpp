#pragma once
// The steady state of a case without marching in time, from nothing (search.hpp) or from a profile
// (from_profile.hpp), on a mesh that is fine enough (refinement.hpp).
#include "observe/outcome.hpp"
#include "steady/mesh_change.hpp"
#include "steady/search.hpp"
#include <optional>

namespace capsule {

// On a first mesh. Throws what search_steady and from_profile throw.
SteadyState find_steady(const Case &input, const std::optional<Profile> &from, const Control &control,
                        const MarchToRest &march = {});

// status: steady, failed or interrupted. Series and profiles of the outcome hold one entry. Nothing is saved on the way.
Outcome steady(const Case &input, const std::optional<Profile> &from, const Control &control,
               const MarchToRest &march = {});

} // namespace capsule
