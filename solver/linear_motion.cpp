#include "linear_motion.hpp"
#include <numbers>
#include <utility>

namespace capsule {
namespace {

// Shape and load f = q/eps at points of the meridian, from what they are at the nodes.
struct Frame {
  Matrix even[3], odd[3]; // nodes -> points: value and derivatives in zeta
  Vector r, arc;
  Vector tangent_x, tangent_r; // downstream; the normal is (-tangent_r, tangent_x)
  Vector turning;              // of the tangent, d alpha/dzeta
  Vector load_tangent, load_normal, load_tangent_zeta, load_normal_zeta;
};

Frame frame_at(const Vector &zeta, const MeridianBasis &basis, const Vector &position, const Vector &load) {
  const Eigen::Index n = basis.size();
  Frame frame;
  for (int d = 0; d < 3; ++d) {
    frame.even[d] = basis.even(zeta, d);
    frame.odd[d] = basis.odd(zeta, d);
  }
  frame.r = frame.odd[0] * position.tail(n);
  const Eigen::ArrayXd x_zeta = frame.even[1] * position.head(n);
  const Eigen::ArrayXd r_zeta = frame.odd[1] * position.tail(n);
  const Eigen::ArrayXd x_second = frame.even[2] * position.head(n);
  const Eigen::ArrayXd r_second = frame.odd[2] * position.tail(n);
  const Eigen::ArrayXd arc = (x_zeta.square() + r_zeta.square()).sqrt();
  const Eigen::ArrayXd t_x = x_zeta / arc;
  const Eigen::ArrayXd t_r = r_zeta / arc;
  const Eigen::ArrayXd turning = (x_zeta * r_second - r_zeta * x_second) / arc.square();
  const Eigen::ArrayXd f_x = frame.even[0] * load.head(n);
  const Eigen::ArrayXd f_r = frame.odd[0] * load.tail(n);
  const Eigen::ArrayXd f_x_zeta = frame.even[1] * load.head(n);
  const Eigen::ArrayXd f_r_zeta = frame.odd[1] * load.tail(n);
  const Eigen::ArrayXd f_t = f_x * t_x + f_r * t_r;
  const Eigen::ArrayXd f_n = f_r * t_x - f_x * t_r;
  frame.arc = arc;
  frame.tangent_x = t_x;
  frame.tangent_r = t_r;
  frame.turning = turning;
  frame.load_tangent = f_t;
  frame.load_normal = f_n;
  frame.load_tangent_zeta = f_x_zeta * t_x + f_r_zeta * t_r + turning * f_n;
  frame.load_normal_zeta = f_r_zeta * t_x - f_x_zeta * t_r - turning * f_t;
  return frame;
}

// A vector at each point that depends on a displacement there.
struct Pointwise {
  Eigen::ArrayXd xx, xr, rx, rr;
};

// tt (t.d) t + tn (n.d) t + nt (t.d) n + nn (n.d) n
Pointwise dyads(const Frame &frame, const Eigen::ArrayXd &tt, const Eigen::ArrayXd &tn,
                const Eigen::ArrayXd &nt, const Eigen::ArrayXd &nn) {
  const auto t_x = frame.tangent_x.array();
  const auto t_r = frame.tangent_r.array();
  const Eigen::ArrayXd n_x = -t_r;
  const Eigen::ArrayXd n_r = t_x;
  return {tt * t_x * t_x + tn * t_x * n_x + nt * n_x * t_x + nn * n_x * n_x,
          tt * t_x * t_r + tn * t_x * n_r + nt * n_x * t_r + nn * n_x * n_r,
          tt * t_r * t_x + tn * t_r * n_x + nt * n_r * t_x + nn * n_r * n_x,
          tt * t_r * t_r + tn * t_r * n_r + nt * n_r * t_r + nn * n_r * n_r};
}

// Of the displacement's derivative of this order; 2 points x 2N.
Matrix of_displacement(const Frame &frame, const Pointwise &map, int derivative) {
  const Matrix &even = frame.even[derivative];
  const Matrix &odd = frame.odd[derivative];
  Matrix result(2 * even.rows(), 2 * even.cols());
  result << map.xx.matrix().asDiagonal() * even, map.xr.matrix().asDiagonal() * odd,
      map.rx.matrix().asDiagonal() * even, map.rr.matrix().asDiagonal() * odd;
  return result;
}

// Change of the area element r s' relative to it, points x 2N.
Matrix area_change(const Frame &frame) {
  const Eigen::Index n = frame.even[0].cols();
  Matrix change(frame.r.size(), 2 * n);
  change << (frame.tangent_x.array() / frame.arc.array()).matrix().asDiagonal() * frame.even[1],
      (frame.tangent_r.array() / frame.arc.array()).matrix().asDiagonal() * frame.odd[1];
  change.rightCols(n) += frame.r.cwiseInverse().asDiagonal() * frame.odd[0];
  return change;
}

// Change of the nodal load in a displacement.
Matrix nodal_load_change(const Membrane &membrane, const Vector &position, const Frame &at_nodes,
                         const Vector &load, double capillary_number) {
  const Eigen::Index n = membrane.basis.size();
  const Vector mass = capillary_number * nodal_area(membrane, position);
  Matrix change = -energy_hessian(membrane, position);
  const Matrix area = area_change(at_nodes);
  for (const Eigen::Index first : {Eigen::Index{0}, n}) {
    auto rows = change.middleRows(first, n);
    rows = mass.cwiseInverse().asDiagonal() * rows;
    rows -= load.segment(first, n).asDiagonal() * area;
  }
  return change;
}

// f' of the head comment at points: the change of the load and of the area that it acts on, less the stress of its
// jump on the strips that the displacement sweeps.
Matrix carried_load_change(const Frame &frame, const Matrix &nodal_change, const Vector &load) {
  const Eigen::Index points = frame.r.size();
  const Eigen::Index n = frame.even[0].cols();
  const Matrix area = area_change(frame);
  Matrix change(2 * points, 2 * n);
  change.topRows(points) = frame.even[0] * nodal_change.topRows(n);
  change.bottomRows(points) = frame.odd[0] * nodal_change.bottomRows(n);
  change.topRows(points) += (frame.even[0] * load.head(n)).asDiagonal() * area;
  change.bottomRows(points) += (frame.odd[0] * load.tail(n)).asDiagonal() * area;

  const auto r = frame.r.array();
  const auto arc = frame.arc.array();
  const auto f_t = frame.load_tangent.array();
  const auto f_n = frame.load_normal.array();
  // r [(f_t d_t - f_n d_n) t + (f_n d_t - f_t d_n) n] over r s', differentiated
  const Eigen::ArrayXd r_zeta = arc * frame.tangent_r.array();
  const Eigen::ArrayXd growth_t = (frame.load_tangent_zeta.array() + r_zeta / r * f_t) / arc;
  const Eigen::ArrayXd growth_n = (frame.load_normal_zeta.array() + r_zeta / r * f_n) / arc;
  const Eigen::ArrayXd turning = 2 * frame.turning.array() * f_t / arc;
  change -=
      of_displacement(frame, dyads(frame, growth_t, turning - growth_n, turning + growth_n, -growth_t), 0);
  change -= of_displacement(frame, dyads(frame, f_t / arc, -f_n / arc, f_n / arc, -f_t / arc), 1);
  // The hoop stress on the strip between the two surfaces.
  const Eigen::ArrayXd none = Eigen::ArrayXd::Zero(points);
  const Pointwise hoop{none, none, -f_n * frame.tangent_r.array() / r, f_n * frame.tangent_x.array() / r};
  change -= of_displacement(frame, hoop, 0);
  return change;
}

// w of the head comment.
Matrix slip(const Frame &frame) {
  const Eigen::ArrayXd none = Eigen::ArrayXd::Zero(frame.r.size());
  return of_displacement(frame, dyads(frame, none, frame.load_tangent, none, none), 0);
}

// What a field at the panels' points has more than the interpolant of its values at the nodes.
Matrix beyond_nodes(const Frame &at_panels, const Matrix &panel_field, const Matrix &nodal_field) {
  const Eigen::Index n = nodal_field.rows() / 2;
  const Eigen::Index points = panel_field.rows() / 2;
  Matrix rest = panel_field;
  rest.topRows(points) -= at_panels.even[0] * nodal_field.topRows(n);
  rest.bottomRows(points) -= at_panels.odd[0] * nodal_field.bottomRows(n);
  return rest;
}

} // namespace

LinearMotion linear_motion(const FlowSystem &flow, const FlowSystem::Interaction &shape,
                           const Membrane &membrane, const Vector &position, double capillary_number) {
  const Vector load = membrane_load(membrane, position) / capillary_number;
  const Frame at_nodes = frame_at(membrane.basis.nodes, membrane.basis, position, load);
  const Frame at_panels = frame_at(flow.panel_points(), membrane.basis, position, load);
  const Matrix nodal_change = nodal_load_change(membrane, position, at_nodes, load, capillary_number);
  const Matrix change = carried_load_change(at_nodes, nodal_change, load);
  const Matrix jump = slip(at_nodes);

  LinearMotion motion;
  FlowSystem::Layers layers = flow.layers(shape);
  motion.double_layer = std::move(layers.dbl);
  motion.equal_viscosities =
      layers.single * change - 0.5 * jump - motion.double_layer * jump +
      shape.single_mm * beyond_nodes(at_panels, carried_load_change(at_panels, nodal_change, load), change) /
          (8 * std::numbers::pi) -
      shape.double_mm * beyond_nodes(at_panels, slip(at_panels), jump);
  return motion;
}

} // namespace capsule
