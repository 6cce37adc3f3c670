#pragma once
// The liquid between two capsules on the axis, from their meridians as chains of points. Chords are off a curve of
// curvature k by k h^2/8, h their length; so is the gap. Lengths in R_t. Throws what the basis throws (meridian.hpp).
#include "geometry/meridian.hpp"

namespace capsule {

// From the upstream to the downstream pole, both included.
struct Chain {
  Vector x, r;
};
// As many chords to each node of a membrane at a position, 2N.
Chain chain_of(const MeridianBasis &basis, const Vector &position, int chords_per_node);

// Whether a point of one lies in the other.
bool overlap(const Chain &a, const Chain &b);

// The shortest distance of two that do not overlap, and where on the first.
struct Gap {
  double width, x, r;
};
Gap gap_between(const Chain &a, const Chain &b);
// Of two membranes at their positions. Chains are made only where the nodes tell that these may be nearest.
Gap gap_between(const MeridianBasis &basis_a, const Vector &position_a, const MeridianBasis &basis_b,
                const Vector &position_b, int chords_per_node);

} // namespace capsule
