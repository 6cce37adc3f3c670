#pragma once
// Is a flow too strong for a capsule that does not come to rest in it? A stiff membrane, which few nodes show, answers: it is
// let loose in a weaker flow, and a branch of growing flow leads to the case's own or to a fold.
#include "base/failure.hpp"
#include "observe/outcome.hpp"
#include "steady/homotopy.hpp"
#include "steady/mesh_change.hpp"
#include <optional>

namespace capsule {

// A flow that squeezes little, and a bending stiffness ratio from which on a membrane is as good as one without.
inline constexpr double weak_flow = 5e-3, thinnest = 1e-7;

// Whether a branch ends for good: in a fold, or where the membrane's law softens.
bool ends_branch(const NumericsFailure &failure);

// What such an end on the way of growing flow says of the case.
NumericsFailure no_steady_state(const NumericsFailure &end);

// The case's state, if the stiff membrane has one in its flow and softens to the case's; none where this tells nothing. Throws
// NumericsFailure: "fold" where the stiff membrane's fold, followed to the case's, lies at a weaker flow, or where it has a
// fold in this flow as it gets softer; "softening" where the stiff membrane's law softens, which does not prove that the case's
// does. Throws what it asks of `control`.
std::optional<SteadyState> by_stiff_membrane(const Case &input, const Control &control);

// As the membrane gets softer in a flow weaker than the case's, a homotopy has come to a fold: throws "fold" if, followed to
// the case's stiffness, it lies at a flow weaker than the case's.
void throw_if_too_strong(const Homotopy &homotopy, const Case &input, const Control &control);

} // namespace capsule
