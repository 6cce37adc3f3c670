#pragma once
// A case's steady state from nothing. At first the undeformed capsule relaxes in the tube with a stiff membrane, which is
// softened then (relaxation.hpp). If that fails, or leads to an unstable state, the capsule marches from the case's start,
// first to just behind the mouth.
// Or it relaxes in a weaker flow, from which a branch (homotopy.hpp) leads to the case's own. Where it does not come to rest
// at all, branches lead from a small stiff sphere in a weak flow to the case's capsule, one key after the other, the capillary
// number last. The mesh gets finer on the way where it must.
// A flow in which the capsule runs away, or in which neither leads to a state, may be too strong: a stiff membrane tells
// (strong_flow.hpp).
// A train begins with one capsule alone.
#include "observe/outcome.hpp"
#include "steady/mesh_change.hpp"
#include <functional>
#include <optional>

namespace capsule {

// What a search may cost, in linearisations of a steady state on 48 nodes (Control::spend): some hundred times the work of
// most.
constexpr double most_work_of_search = 1600;

// The shape at the end of a march (motion/to_rest.hpp); none where no march leads to the steady state.
// Throws NumericsFailure where the march ends before. Steady states do not know marches: who knows both may hand it in. An
// empty function: the search does without.
using MarchToRest = std::function<std::optional<Profile>(const Case &, MarchLength, const Control &)>;

// Throws NumericsFailure, of the kind "fold" when there is no steady state because the branch of growing capillary
// numbers turns back and the membrane runs away behind the fold: the text says where. Any other turn says nothing
// about the case, and is "unresolved"; "unbounded" where the capsule ran away in the last flow that was tried. Throws
// Interrupted.
SteadyState search_steady(const Case &input, const Control &control, const MarchToRest &march = {});

} // namespace capsule
