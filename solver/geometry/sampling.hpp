#pragma once
// A meridian at fixed points: the matrices that take nodal values there, and the curve itself. Nodal positions and
// displacements are 2N: axial components, then radial ones. Throws what the basis throws (meridian.hpp).
#include "geometry/meridian.hpp"

namespace capsule {

// Points along the meridian where fields are sampled, and the matrices that take nodal values there.
struct Sampling {
  Vector zeta;
  Vector weights; // integral over [0, pi] = sum weights f
  Matrix even[3]; // value, first and second derivative in zeta; points x N
  Matrix odd[3];
};
Sampling sample(const MeridianBasis &basis, const Vector &zeta, const Vector &weights);

// The curve at the points of a sampling.
struct Trace {
  Vector x, r;
  Vector x_zeta, r_zeta; // derivatives in zeta
  Vector arc;            // ds/dzeta
};
Trace trace(const Sampling &at, const Vector &position);

// Change of the area element r ds/dzeta relative to it by a displacement of the nodes: points x 2N.
Matrix area_change(const Sampling &at, const Trace &curve);

} // namespace capsule
