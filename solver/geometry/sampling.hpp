#pragma once
// A meridian at fixed points: the matrices that take nodal values there, and the curve itself. Nodal positions and
// displacements are 2N: axial components, then radial ones. Throws what the basis throws (meridian.hpp).
#include "geometry/meridian.hpp"

namespace capsule {

// Products of a matrix that takes nodal values to points, where both lie symmetrically about the equator: what is
// symmetric and what is antisymmetric there is multiplied by a quarter of the matrix each, which takes half the work. The same as its products but for rounding errors.
class MirroredMatrix {
public:
  MirroredMatrix() = default;
  // Such a matrix, points x N, whose values of a mirrored field are the mirrored ones times sign, 1 or -1.
  MirroredMatrix(const Matrix &matrix, double sign);
  Vector operator*(const Eigen::Ref<const Vector> &nodal) const;
  // The transposed matrix times values at the points.
  Vector transposed_times(const Eigen::Ref<const Vector> &values) const;

private:
  Matrix symmetric_, antisymmetric_;
  double sign_ = 1;
  Eigen::Index rows_ = 0;
};

// Points along the meridian where fields are sampled, and the matrices that take nodal values there.
struct Sampling {
  Vector zeta;
  Vector weights; // integral over [0, pi] = sum weights f
  Matrix even[3]; // value, first and second derivative in zeta; points x N
  Matrix odd[3];
  bool is_mirrored = false; // the points, and the nodes
  MirroredMatrix mirrored_even[3], mirrored_odd[3];

  // even[derivative] * nodal and odd[derivative] * nodal.
  Vector even_field(int derivative, const Eigen::Ref<const Vector> &nodal) const;
  Vector odd_field(int derivative, const Eigen::Ref<const Vector> &nodal) const;
  // even[derivative] and odd[derivative], transposed, times values at the points.
  Vector on_even_nodes(int derivative, const Eigen::Ref<const Vector> &values) const;
  Vector on_odd_nodes(int derivative, const Eigen::Ref<const Vector> &values) const;
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
