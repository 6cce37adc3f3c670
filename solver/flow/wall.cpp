#include "flow/wall.hpp"
#include "flow/joined_panels.hpp"
#include <algorithm>

namespace capsule {
namespace {

// Equal panels in the middle of a tube, or in all of it; longer ones towards its ends, where the disturbance
// decays like exp(-4.47 d).
Vector tube_edges(double length, const FlowResolution &resolution) {
  const double panel = resolution.wall_panel, longest = std::max(panel, 2.0); // methods.md
  const double outside = length / 2 - resolution.fine_half_length;
  if (outside < panel)
    return graded_edges(0, length, panel, panel, Graded::last);
  const Vector first = graded_edges(0, outside, panel, longest, Graded::last);
  const Vector middle = graded_edges(outside, length - outside, panel, panel, Graded::last);
  Vector edges(2 * first.size() + middle.size() - 2);
  edges << first, middle.segment(1, middle.size() - 2), length - first.reverse().array();
  return edges;
}

// Edges of the wall's panels by arc length: those of a tube; or equal in the pore, halved towards each lip from both
// sides, and growing with the distance from the lip in the reservoir, where the flow decays like a power.
Vector wall_edges(const Pore &pore, const FlowResolution &resolution) {
  if (pore.shape == PoreShape::tube)
    return tube_edges(pore.entrance_arc, resolution);
  const double lip = pore.exit_x;
  const bool two_mouths = pore.shape == PoreShape::two_mouths;
  const Vector tube = graded_edges(0, lip, resolution.lip_panel, resolution.wall_panel,
                                   two_mouths ? Graded::both : Graded::last);
  const auto outside = [&](double from, double to, double first_panel) -> Vector {
    const Vector edges = graded_edges(from, to, first_panel, pore.entrance_arc, Graded::first);
    return edges.tail(edges.size() - 1);
  };
  Vector before, behind;
  if (two_mouths) { // tractions jump where the wall meets the outlet; the other mouth is a mirror image
    const double outlet = up_to_outlet(pore).entrance_arc;
    const Vector near = outside(lip, outlet, resolution.lip_panel);
    const Vector far = outside(outlet, pore.entrance_arc, near[near.size() - 1] - near[near.size() - 2]);
    before.resize(near.size() + far.size());
    before << near, far;
    behind = lip - before.reverse().array();
  } else {
    before = outside(lip, pore.entrance_arc, resolution.lip_panel);
  }
  Vector edges(behind.size() + tube.size() + before.size());
  edges << behind, tube, before;
  return edges;
}

} // namespace

Panels wall_panels(const Pore &pore, const FlowResolution &resolution) {
  return make_panels(wall_edges(pore, resolution), resolution.wall_panel_points);
}

Curve wall_curve(const Pore &pore, const Panels &along) {
  const Eigen::Index n = along.points.size();
  Curve wall;
  wall.panel_points = along.rule.size();
  wall.weights = along.weights;
  for (Vector *field : {&wall.x, &wall.r, &wall.x_zeta, &wall.r_zeta})
    field->resize(n);
  for (Eigen::Index k = 0; k < n; ++k) {
    const WallPoint point = wall_point(pore, along.points[k]);
    wall.x[k] = point.x;
    wall.r[k] = point.r;
    wall.x_zeta[k] = -point.normal_r;
    wall.r_zeta[k] = point.normal_x;
  }
  complete(wall);
  return wall;
}

SelfRule self_rule_of_wall(const Panels &along) {
  return make_self_rule(along, along.points, 0); // the curvature jumps at the lip
}

Targets on_itself(const Curve &wall, const Panels &along, const SelfRule &self) {
  const Eigen::Index p = along.rule.size();
  const Matrix slopes = derivative_matrix(along.rule.nodes);
  Targets points{wall.x, wall.r, Vector(wall.size()), Vector(wall.size())};
  for (Eigen::Index k = 0; k < along.count(); ++k) {
    const double half = (along.edges[k + 1] - along.edges[k]) / 2;
    points.bend_x.segment(k * p, p) = slopes * wall.x_zeta.segment(k * p, p) / half;
    points.bend_r.segment(k * p, p) = slopes * wall.r_zeta.segment(k * p, p) / half;
  }
  for (Eigen::Index i = 0; i < wall.size(); ++i) {
    const double half_gap = self.sites[static_cast<std::size_t>(i)].gap / 2;
    points.bend_x[i] *= half_gap;
    points.bend_r[i] *= half_gap;
  }
  return points;
}

Wall::Wall(const Pore &pore, const FlowResolution &resolution)
    : panels_(wall_panels(pore, resolution)), curve_(wall_curve(pore, panels_)),
      near_tolerance_(resolution.near_tolerance),
      near_(resolution.wall_panel_points, resolution.near_tolerance),
      outlet_(make_outlet(pore, resolution.near_tolerance)) {
  fixed_near_ = FixedNearRule(curve_, resolution.near_tolerance);
  weights_.resize(2 * curve_.size() + 1);
  weights_ << stokeslet_factor * curve_.area, 1, stokeslet_factor * curve_.area;
  if (pore.shape == PoreShape::tube) {
    inverse_ = mirrored_inverse();
    closed_form_ = poiseuille_flow;
    base_pressure_drop_ = poiseuille_pressure_drop(pore.entrance_arc);
  } else {
    // Between two mouths the halves are expanded: joined panels need the whole inverse (compressed_wall.hpp).
    inverse_ = WallInverse(pore.shape == PoreShape::two_mouths
                               ? mirrored_inverse().matrix()
                               : RowMatrix(weights_.asDiagonal() * lu_inverse(matrix())));
    solve_base_flow();
  }
}

Wall::Wall(const Wall &whole, const Vector &edges)
    : panels_(make_panels(edges, static_cast<int>(whole.panels_.rule.size()))),
      curve_(on_longer_panels(whole.curve_, whole.panels_, panels_)), near_tolerance_(whole.near_tolerance_),
      near_(whole.near_), fixed_near_(curve_, near_tolerance_), outlet_(whole.outlet_),
      closed_form_(whole.closed_form_), base_pressure_drop_(whole.base_pressure_drop_) {
  constexpr int components = 2;
  const Joining joining(whole.panels_, panels_, components);
  inverse_ = whole.inverse_.joined(joining);
  weights_ = joining(whole.weights_);
  if (whole.base_forces_.size() > 0)
    base_forces_ = joining(whole.base_forces_);
}

// C of (3.1): velocity at points, 2 n, from tractions of the wall and P'.
RowMatrix Wall::response(const Targets &points, const SelfRule *self) const {
  const Eigen::Index n = curve_.size();
  RowMatrix wall;
  assemble_layer(ring_stokeslet, points, curve_, self, near_, wall);
  RowMatrix response(wall.rows(), 2 * n + 1);
  response.leftCols(n) = stokeslet_factor * wall.leftCols(n);
  response.col(n) = outlet_.column(outlet_.single_layer(points));
  response.rightCols(n) = stokeslet_factor * wall.rightCols(n);
  return response;
}

// A of (3.1).
RowMatrix Wall::matrix() const {
  const Eigen::Index n = curve_.size();
  const SelfRule self = self_rule_of_wall(panels_);
  const RowMatrix at_wall = response(on_itself(curve_, panels_, self), &self);
  RowMatrix matrix(2 * n + 1, 2 * n + 1);
  matrix.topRows(n) = at_wall.topRows(n);
  matrix.row(n) = outlet_.row_weights.transpose() * response(outlet_.row_points);
  matrix.bottomRows(n) = at_wall.bottomRows(n);
  return matrix;
}

WallInverse Wall::mirrored_inverse() const {
  const Eigen::Index half = curve_.size() / 2;
  const SelfRule self = self_rule_of_wall(panels_);
  const Targets wall = on_itself(curve_, panels_, self);
  const Targets first_half{wall.x.head(half), wall.r.head(half), wall.bend_x.head(half),
                           wall.bend_r.head(half)};
  const auto per_force = weights_.cwiseInverse().asDiagonal();
  return {response(first_half, &self) * per_force, outlet_.column(outlet_.single_layer(wall)),
          per_force * (response(outlet_.row_points).transpose() * outlet_.row_weights)};
}

void Wall::solve_base_flow() {
  const Eigen::Index n = curve_.size();
  const auto of_outlet = [&](const Targets &points) {
    return outlet_.base_field(points, outlet_.single_layer(points));
  };
  const Vector at_wall = of_outlet({curve_.x, curve_.r});
  Vector known(2 * n + 1);
  known << at_wall.head(n), outlet_.row_weights.dot(of_outlet(outlet_.row_points)) - outlet_.base_row,
      at_wall.tail(n);
  base_forces_ = -inverse_.answer(known);
  base_pressure_drop_ = -base_forces_[n];
}

double Wall::pressure_drop(const Vector &at_wall) const {
  return unknowns() == 0 ? 0 : inverse_.answer_of_outlet(at_wall);
}

Vector Wall::velocity_of(const Vector &at_wall, const Targets &points) const {
  if (unknowns() == 0)
    return Vector::Zero(2 * points.size());
  return response(points) * inverse_.answer(at_wall).cwiseQuotient(weights_);
}

Vector Wall::base_velocity(const Targets &points) const {
  if (closed_form_ != nullptr)
    return closed_form_(points);
  return response(points) * base_forces_.cwiseQuotient(weights_) +
         outlet_.base_field(points, outlet_.single_layer(points));
}

Vector Wall::base_velocity(const Targets &points, const RowMatrix &from_forces,
                           const RowMatrix &outlet_single) const {
  if (closed_form_ != nullptr)
    return closed_form_(points);
  return from_forces * base_forces_ + outlet_.base_field(points, outlet_single);
}

Matrix Wall::base_traction() const {
  const Eigen::Index n = curve_.size();
  const Vector traction = base_forces_.cwiseQuotient(weights_);
  Matrix table(n, 3);
  table << panels_.points, traction.head(n), traction.tail(n);
  return table;
}

} // namespace capsule
