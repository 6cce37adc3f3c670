#pragma once
// The outline of a steady capsule as a camera sees it, and how far points are from it. Lengths are scaled with R_t. The
// meridian is the curve itself. In a silhouette a concave rear is hidden: up to its rim the outline is the rim's plane.
//   distance d = n.(P - X(zeta*)), with the foot zeta* of the perpendicular and the normal n out of the capsule
// is positive outside. Its derivative along anything that moves the meridian is -n.dX(zeta*), because the foot's own motion
// is along the tangent.
// Throws nothing.
#include "case/parameters.hpp"
#include "geometry/meridian.hpp"

namespace capsule {

// Points of the meridian that lie much closer than the nodes: between them it is a cubic (error h^4, 1e-8).
struct DenseMeridian {
  double step = 0; // in zeta
  Matrix even[2], odd[2];
};
DenseMeridian dense_meridian(const MeridianBasis &basis);

// The foot of a point's perpendicular.
struct Foot {
  double distance = 0;
  double normal_x = 0, normal_r = 0;
  double x = 0, r = 0; // where it is on the outline
  double at = 0;       // index of DenseMeridian, between its points
};

class Outline {
public:
  // Of nodal positions, 2N.
  Outline(const DenseMeridian &dense, const Vector &position, OutlineSeen seen);
  Foot foot(double x, double r) const;
  double front_x() const { return x_[x_.size() - 1]; }
  double rear_pole_x() const { return x_[0]; }

private:
  struct Point {
    double x, r, x_slope, r_slope, x_second, r_second; // in the index
  };
  Point at(double index) const;

  Vector x_, r_, x_slope_, r_slope_; // slopes per index
  double rim_ = 0;                   // index where the outline begins
  Point rim_point_{};
};

// Changes of the points of a dense meridian, points x columns each, at an index: rows x and r.
Eigen::Matrix<double, 2, Eigen::Dynamic> moved_at(const Matrix &even_values, const Matrix &odd_values,
                                                  double index);

} // namespace capsule
