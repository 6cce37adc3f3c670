#pragma once
// The capsule before the flow, a spheroid or a red cell centred at x = 0, and its stress-free shape, which is smaller by
// 1/(1 + alpha_p). Its points are told by an angle in [0, pi] from the upstream to the downstream pole:
// X = -A cos(angle), R = B sin(angle), A and B of extent(); of a red cell -X is half of Evans and Fung's thickness, which
// is cos(angle) times a polynomial in R. The nodes of a mesh lie at angles that any smooth odd function of zeta may give:
// shapes keep their parities and the basis its exponential convergence.
// Throws nothing.
#include "base/linear_algebra.hpp"
#include "case/parameters.hpp"

namespace capsule {

// Points at these angles, 2N: axial components, then radial ones. Before the flow, and free of stress.
Vector initial_position(const CapsuleSpec &capsule, const Vector &angle);
Vector reference_position(const CapsuleSpec &capsule, const Vector &angle);

// Angles for nodes zeta, denser where the rear of a flat capsule folds. clustering: 0 for angles that are zeta.
Vector clustered_angles(const Vector &zeta, double clustering);

} // namespace capsule
