#pragma once
// A meridian at fixed points: the matrices that take nodal values there, and the curve itself. Nodal positions and
// displacements are 2N: axial components, then radial ones. Throws what the basis throws (meridian.hpp).
#include "geometry/meridian.hpp"
#include <utility>

namespace capsule {

// A matrix that takes nodal values to points. Where both lie symmetrically about the equator, what is symmetric and what is
// antisymmetric there is multiplied by a quarter of the matrix each, which takes half the work: the same as the products of
// the whole but for rounding errors.
class BasisMatrix {
public:
  BasisMatrix() = default;
  // points x N.
  explicit BasisMatrix(Matrix whole) : whole_(std::move(whole)) {}
  // Of nodes and points that lie symmetrically, from the rows of the first half of the points, with that on the equator: a
  // mirrored field has the mirrored values times sign, 1 or -1.
  BasisMatrix(const Matrix &half, Eigen::Index points, double sign);

  bool is_mirrored() const { return antisymmetric_.size() > 0; }
  const Matrix &whole() const { return whole_; }
  Vector operator*(const Eigen::Ref<const Vector> &nodal) const;
  // The transposed matrix times values at the points.
  Vector transposed_times(const Eigen::Ref<const Vector> &values) const;
  // Rows that act on values at the points, times the matrix: they act on nodal values.
  friend Matrix operator*(const Eigen::Ref<const RowMatrix> &at_points, const BasisMatrix &matrix);

private:
  Matrix whole_, symmetric_, antisymmetric_;
  double sign_ = 1;
};

// Points along the meridian where fields are sampled, and the matrices that take nodal values there.
struct Sampling {
  Vector zeta;
  Vector weights;      // integral over [0, pi] = sum weights f
  BasisMatrix even[3]; // value, first and second derivative in zeta
  BasisMatrix odd[3];
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
