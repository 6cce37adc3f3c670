#pragma once
// Nodes where a shape needs them, and shapes on other nodes. The nodes of a mesh are Gauss-Legendre colatitudes zeta,
// which lie at angles of the undeformed spheroid (Membrane::node_angle) that any smooth odd function of zeta may give:
// shapes keep their parities and the basis its exponential convergence. Here the angles follow from a shape: the nodes
// are the denser, the larger its first and second derivatives in the angle are, in a fold of the rear above all.
// Throws std::invalid_argument for fewer than three nodes.
#include "membrane/membrane.hpp"

namespace capsule {

// Angles for the nodes of a basis, that suit a position (2N, of the membrane's own nodes).
Vector suitable_angles(const Membrane &membrane, const Vector &position, const MeridianBasis &basis);

// Position, or a change of it, at the material points of other nodes on the same undeformed spheroid.
Vector at_angles(const Vector &angles, const Membrane &membrane, const Vector &position);

// Parts of the meridian in which the tangent turns by no more than given (radians), by halving of those between edges.
Vector halved_edges(const MeridianBasis &basis, const Vector &position, const Vector &edges,
                    double most_turning);

// What the last tenth of the waves of a basis has in a position, root of the sum of squares: where this is not small,
// the shape is poorly resolved.
double unresolved_part(const MeridianBasis &basis, const Vector &position);

} // namespace capsule
