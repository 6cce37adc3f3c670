#pragma once
// Nodes where a shape needs them, and shapes on other nodes. The nodes zeta of a basis lie at angles of the undeformed
// capsule (reference_shape.hpp). Here the angles follow from a shape: the nodes are the denser, the larger its first and
// second derivatives in the angle are, in a fold of the rear above all. Positions are 2N.
// Throws std::invalid_argument for fewer than three nodes.
#include "geometry/meridian.hpp"

namespace capsule {

// Angles for the nodes of a new basis that suit a position, which is given on a basis with nodes at node_angle.
Vector suitable_angles(const MeridianBasis &new_basis, const MeridianBasis &basis, const Vector &node_angle,
                       const Vector &position);

// Position, or a change of it, at the material points of other angles.
Vector at_angles(const Vector &angles, const MeridianBasis &basis, const Vector &node_angle,
                 const Vector &position);

// Amplitude of the last tenth of the basis' waves in a position, root of the sum of squares: not small where the shape
// is poorly resolved.
double unresolved_part(const MeridianBasis &basis, const Vector &position);

} // namespace capsule
