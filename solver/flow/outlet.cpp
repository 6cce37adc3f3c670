#include "flow/outlet.hpp"
#include "flow/undisturbed.hpp"

namespace capsule {

Outlet plane_outlet(double x, double near_tolerance) {
  constexpr int points = 12;
  const Panels across = make_panels(Vector::LinSpaced(2, 0, 1), points);
  Outlet outlet;
  Curve &curve = outlet.curve;
  curve.panel_points = points;
  curve.weights = across.weights;
  curve.x = Vector::Constant(points, x);
  curve.r = 1 - across.points.array();
  curve.x_zeta = Vector::Zero(points);
  curve.r_zeta = Vector::Constant(points, -1);
  complete(curve);
  const Vector none = Vector::Zero(points);
  outlet.base_traction.resize(2 * points);
  outlet.base_traction << none, curve.r.unaryExpr(&poiseuille_shear);
  outlet.base_velocity.resize(2 * points);
  outlet.base_velocity << curve.r.unaryExpr(&poiseuille_velocity), none;
  outlet.row_points = {Vector::Constant(1, x), Vector::Zero(1)};
  outlet.row_weights = Vector::Unit(2, 0);
  outlet.base_row = poiseuille_velocity(0) / 2; // beta = 1/2 on the section
  outlet.near = NearRule(points, near_tolerance);
  return outlet;
}

RowMatrix Outlet::single_layer(const Targets &points) const {
  RowMatrix single;
  assemble_layer(ring_stokeslet, points, curve, nullptr, near, single);
  return single;
}

Vector Outlet::column(const RowMatrix &single) const {
  Vector normal(2 * curve.size());
  normal << curve.normal_x, curve.normal_r;
  return -stokeslet_factor * (single * normal);
}

Vector Outlet::base_field(const Targets &points, const RowMatrix &single) const {
  RowMatrix double_layer;
  assemble_layer(ring_stresslet, points, curve, nullptr, near, double_layer);
  for (Eigen::Index i = 0; i < points.size(); ++i)
    if (points.x[i] == curve.x[0]) // a plane's double layer vanishes on the plane itself
      double_layer.row(i).setZero();
  return stokeslet_factor * (single * base_traction) + double_layer * base_velocity;
}

Vector Outlet::row(const RingKernel &kernel, const Rings &rings) const {
  const Eigen::Index n = rings.count;
  const Eigen::Index points = row_points.size();
  RowMatrix at_point(2, 2 * n);
  Vector sum = Vector::Zero(2 * n);
  for (Eigen::Index k = 0; k < points; ++k) {
    double *const axial = at_point.row(0).data();
    double *const radial = at_point.row(1).data();
    kernel.plain(row_points.x[k], row_points.r[k], rings, {axial, axial + n, radial, radial + n});
    sum +=
        row_weights[k] * at_point.row(0).transpose() + row_weights[points + k] * at_point.row(1).transpose();
  }
  return sum;
}

} // namespace capsule
