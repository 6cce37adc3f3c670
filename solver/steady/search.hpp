#pragma once
// A case's steady state from nothing. At first the undeformed capsule relaxes in the tube with a stiff membrane, which is
// softened then (relaxation.hpp). If that fails, branches (homotopy.hpp) lead to a flat capsule that is wider than the tube from
// a small stiff sphere, one key after the other, the capillary number last. Any other capsule, and a flat one that these
// lose, marches from the case's start to just behind the mouth.
// A flow in which the capsule runs away, or in which neither leads to a state, may be too strong: a stiff membrane tells
// (strong_flow.hpp). Then the capsule relaxes in weaker flows, from which a branch leads to the case's own, and last come
// the branches from a small stiff sphere for every spheroid. A state that is unstable is left for one that a long march
// reaches, if that is stable.
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
// about the case, and is "unresolved", or "wrinkled" or "softening" if that was seen. Throws Interrupted.
SteadyState search_steady(const Case &input, const Control &control, const MarchToRest &march = {});

} // namespace capsule
