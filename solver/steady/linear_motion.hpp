#pragma once
// Small motions of the membrane about a shape at which it moves as a rigid body, exactly: the derivative of
// the nodes' velocity with respect to their position, for any viscosity ratio. Such a shape is steady, the
// inner liquid is at rest in the capsule's frame, and the outer velocity has the gradient (q_t/eps) t n on the
// membrane. A displacement d of the nodes then makes the velocity v' that solves
//   beta v' = (lambda - 1) D v' - (1/2 + D) w + (1/(8 pi)) S (f' - R v')
//   w  = (q_t/eps) (n.d) t          the jump of the disturbance's velocity across the undisplaced membrane
//   f' = change of the load in d, carried to the undisplaced membrane
//   R    friction in the membrane (membrane/surface_viscosity.hpp), on which a rigid motion makes no load
// with the wall's answers in S and D (derivation: paper-notes/equations.md). f' and w of the interpolated
// shape and load are integrated as they are at the quadrature points, not as interpolants of nodal values:
// with one derivative of the load more than the motion has, those would be the worst resolved part. So this is
// the derivative of the discrete motion up to errors of quadrature, but for the wall's answers, which come
// from nodal values. For lambda = 1 this is so for any other shape as well, but for the gradient of the
// inner flow, through which the nodes are displaced: d.grad u is added. Throws nothing.
#include "flow/flow.hpp"
#include "membrane/membrane.hpp"

namespace capsule {

// dv/d(position) for lambda = 1, 2N x 2N. `interaction` is that of one membrane at this position, with both layers;
// `velocity` that of the nodes.
Matrix linear_motion(const Interaction &interaction, const NodalLayers &layers, const Membrane &membrane,
                     const Vector &position, const Vector &velocity, double capillary_number);

} // namespace capsule
