#include "flow/outlet.hpp"
#include "flow/undisturbed.hpp"
#include <cmath>

namespace capsule {
namespace {

constexpr int panel_points = 12;

// Eqs. 14 and 15.
Outlet plane_outlet(double x) {
  Outlet outlet;
  const Curve &curve = outlet.curve = disc_at(x, 1);
  const Vector none = Vector::Zero(panel_points);
  outlet.base_traction.resize(2 * none.size());
  outlet.base_traction << none, curve.r.unaryExpr(&poiseuille_shear);
  outlet.base_velocity.resize(2 * none.size());
  outlet.base_velocity << curve.r.unaryExpr(&poiseuille_velocity), none;
  outlet.row_points = {Vector::Constant(1, x), Vector::Zero(1)};
  outlet.row_weights = Vector::Unit(2, 0);
  outlet.base_row = poiseuille_velocity(0) / 2; // beta = 1/2 on the section
  return outlet;
}

Outlet cap_outlet(const Pore &pore) {
  Outlet outlet;
  const Curve &cap = outlet.curve = cap_behind_exit(up_to_outlet(pore));
  outlet.row_points = {cap.x, cap.r};
  outlet.row_weights.resize(2 * cap.size());
  outlet.row_weights << cap.area.cwiseProduct(cap.normal_x), cap.area.cwiseProduct(cap.normal_r);
  outlet.base_row = 0.5; // the flux pi over the azimuth's 2 pi
  return outlet;
}

} // namespace

Pore up_to_outlet(const Pore &pore) {
  return with_ends(pore, pore.exit_x, outlet_distance(pore.entrance_distance));
}

Curve disc_at(double x, double radius) {
  const Panels across = make_panels(Vector::LinSpaced(2, 0, radius), panel_points);
  Curve disc;
  disc.panel_points = panel_points;
  disc.weights = across.weights;
  disc.x = Vector::Constant(panel_points, x);
  disc.r = radius - across.points.array();
  disc.x_zeta = Vector::Zero(panel_points);
  disc.r_zeta = Vector::Constant(panel_points, -1);
  complete(disc);
  return disc;
}

Curve cap_behind_exit(const Pore &pore) {
  const WallPoint rim = wall_point(pore, pore.exit_arc);
  const double radius = std::hypot(rim.x - pore.exit_x, rim.r);
  const double half_angle = std::atan2(rim.r, rim.x - pore.exit_x);
  const Panels across = make_panels(Vector::LinSpaced(3, 0, half_angle), panel_points);
  const Eigen::ArrayXd angle = half_angle - across.points.array();
  Curve cap;
  cap.panel_points = panel_points;
  cap.weights = across.weights;
  cap.x = pore.exit_x + radius * angle.cos();
  cap.r = radius * angle.sin();
  cap.x_zeta = radius * angle.sin();
  cap.r_zeta = -radius * angle.cos();
  complete(cap);
  return cap;
}

Outlet make_outlet(const Pore &pore, double near_tolerance) {
  Outlet outlet = pore.shape == PoreShape::two_mouths ? cap_outlet(pore) : plane_outlet(pore.exit_x);
  outlet.near = NearRule(panel_points, near_tolerance);
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
  if (base_velocity.size() == 0)
    return Vector::Zero(2 * points.size());
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
