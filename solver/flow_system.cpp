#include "flow_system.hpp"
#include "failure.hpp"
#include "pore.hpp"
#include <cmath>
#include <numbers>

namespace capsule {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double stokeslet_factor = 1 / (8 * pi);

double poiseuille(double r) {
  return 2 * (1 - r * r);
}

// Edges of the wall's panels by arc length from the exit: equal in the tube, halved towards the lip from both
// sides, and growing with the distance from the lip in the reservoir, where the flow decays like a power.
Vector wall_edges(const Pore &pore, const FlowResolution &resolution) {
  if (pore.shape == PoreShape::tube)
    return graded_edges(0, pore.entrance_arc, resolution.wall_panel, resolution.wall_panel, Graded::last);
  const double lip = pore.exit_x;
  const Vector tube = graded_edges(0, lip, resolution.lip_panel, resolution.wall_panel, Graded::last);
  const Vector reservoir =
      graded_edges(lip, pore.entrance_arc, resolution.lip_panel, pore.entrance_arc, Graded::first);
  Vector edges(tube.size() + reservoir.size() - 1);
  edges << tube, reservoir.tail(reservoir.size() - 1);
  return edges;
}

// Takes columns from quadrature points to nodes: matrix * blockdiag(even, odd).
Matrix to_nodes(const RowMatrix &matrix, const Matrix &even, const Matrix &odd) {
  const Eigen::Index q = even.rows();
  const Eigen::Index n = even.cols();
  Matrix result(matrix.rows(), 2 * n);
  result.leftCols(n).noalias() = matrix.leftCols(q) * even;
  result.rightCols(n).noalias() = matrix.rightCols(q) * odd;
  return result;
}

// Leaves out the last row: the radial velocity at the exit's axis point.
void drop_last_row(RowMatrix &matrix) {
  matrix.conservativeResize(matrix.rows() - 1, Eigen::NoChange);
}

} // namespace

FlowSystem::FlowSystem(const Case &physics, const MeridianBasis &basis, const FlowResolution &resolution)
    : capillary_number_(physics.flow.capillary_number), viscosity_ratio_(physics.flow.viscosity_ratio),
      type_(physics.flow.type), pore_(physics.pore.shape), resolution_(resolution), basis_(basis) {
  const double first_node = basis.nodes[0];
  panels_ = make_panels(graded_edges(0, pi, 0.75 * first_node, resolution.membrane_panel, Graded::both),
                        resolution.membrane_panel_points);
  self_ = make_self_rule(panels_, basis.nodes);
  for (int d = 0; d < 2; ++d) {
    even_[d] = basis.even(panels_.points, d);
    odd_[d] = basis.odd(panels_.points, d);
  }
  if (pore_ == PoreShape::none)
    return;
  const Pore pore = make_pore(physics);
  build_wall(pore);
  solve_empty_pore(pore);
}

void FlowSystem::build_wall(const Pore &pore) {
  const Panels along = make_panels(wall_edges(pore, resolution_), resolution_.wall_panel_points);
  const Eigen::Index n = along.points.size();
  wall_arc_ = along.points;
  wall_.panel_points = resolution_.wall_panel_points;
  wall_.weights = along.weights;
  for (Vector *field : {&wall_.x, &wall_.r, &wall_.x_zeta, &wall_.r_zeta})
    field->resize(n);
  for (Eigen::Index k = 0; k < n; ++k) {
    const WallPoint point = wall_point(pore, along.points[k]);
    wall_.x[k] = point.x;
    wall_.r[k] = point.r;
    wall_.x_zeta[k] = -point.normal_r;
    wall_.r_zeta[k] = point.normal_x;
  }
  complete(wall_);

  const Panels across = make_panels(Vector::LinSpaced(3, 0, 1), 16);
  const Eigen::Index m = across.points.size();
  exit_.panel_points = 16;
  exit_.weights = across.weights;
  exit_.x = Vector::Constant(m, pore.exit_x);
  exit_.r = 1 - across.points.array();
  exit_.x_zeta = Vector::Zero(m);
  exit_.r_zeta = Vector::Constant(m, -1);
  complete(exit_);

  wall_targets_.x.resize(n + 1);
  wall_targets_.r.resize(n + 1);
  wall_targets_.x << wall_.x, pore.exit_x;
  wall_targets_.r << wall_.r, 0;
}

// Velocity at points from phi: 2 n x (2 n_b + 1), less the last radial row where only the axial one is asked
// for.
RowMatrix FlowSystem::wall_response(const Targets &points, bool axis_only_last) const {
  RowMatrix wall;
  assemble_layer(Layer::single, points, wall_, nullptr, resolution_.near_tolerance, wall);
  RowMatrix exit;
  assemble_layer(Layer::single, points, exit_, nullptr, resolution_.near_tolerance, exit);
  RowMatrix response(wall.rows(), unknowns());
  response.leftCols(wall.cols()) = stokeslet_factor * wall;
  response.col(unknowns() - 1) = -stokeslet_factor * exit.leftCols(exit_.size()).rowwise().sum(); // f_x = -P
  if (axis_only_last)
    drop_last_row(response);
  return response;
}

// What is known on the exit section: the shear f_r = -4 r and the double layer of Poiseuille's velocity.
Vector FlowSystem::exit_field(const Targets &points) const {
  RowMatrix single;
  RowMatrix double_layer;
  assemble_layer(Layer::single, points, exit_, nullptr, resolution_.near_tolerance, single);
  assemble_layer(Layer::dbl, points, exit_, nullptr, resolution_.near_tolerance, double_layer);
  const Eigen::Index m = exit_.size();
  const Vector velocity = exit_.r.unaryExpr(&poiseuille);
  for (Eigen::Index i = 0; i < points.size(); ++i)
    if (points.x[i] == exit_.x[0]) // a plane's double layer vanishes on the plane itself
      double_layer.row(i).setZero();
  return -4 * stokeslet_factor * (single.rightCols(m) * exit_.r) + double_layer.leftCols(m) * velocity;
}

void FlowSystem::solve_empty_pore(const Pore &pore) {
  const RowMatrix response = wall_response(wall_targets_, true);
  wall_inverse_ = response.partialPivLu().inverse();
  if (pore_ == PoreShape::tube) {
    empty_pressure_drop_ = 8 * pore.entrance_arc;
    return;
  }
  Vector known = exit_field(wall_targets_);
  known.conservativeResize(unknowns());
  known[wall_.size()] -= poiseuille(0) / 2; // the axis point's row: beta = 1/2 on the exit section
  empty_traction_ = -wall_inverse_ * known;
  empty_pressure_drop_ = -empty_traction_[unknowns() - 1];
}

Vector FlowSystem::empty_velocity(const Targets &points) const {
  const Eigen::Index n = points.size();
  Vector velocity = Vector::Zero(2 * n);
  if (type_ == FlowType::extension)
    velocity << points.x, -0.5 * points.r;
  else if (pore_ == PoreShape::tube)
    velocity.head(n) = points.r.unaryExpr(&poiseuille);
  else if (pore_ == PoreShape::hyperbolic)
    velocity = wall_response(points, false) * empty_traction_ + exit_field(points);
  return velocity;
}

Matrix FlowSystem::empty_wall_traction() const {
  const Eigen::Index n = wall_.size();
  Matrix table(n, 3);
  table << wall_arc_, empty_traction_.head(n), empty_traction_.segment(n, n);
  return table;
}

FlowSystem::Interaction FlowSystem::interact(const Vector &position) const {
  return interact(position, viscosity_ratio_ != 1);
}

FlowSystem::Interaction FlowSystem::interact_in_full(const Vector &position) const {
  return interact(position, true);
}

FlowSystem::Interaction FlowSystem::interact(const Vector &position, bool with_double_layers) const {
  const Eigen::Index n = basis_.size();
  Interaction shape;
  shape.nodes = {position.head(n), position.tail(n)};
  Curve &membrane = shape.membrane;
  membrane.panel_points = panels_.rule.size();
  membrane.weights = panels_.weights;
  membrane.x = even_[0] * shape.nodes.x;
  membrane.r = odd_[0] * shape.nodes.r;
  membrane.x_zeta = even_[1] * shape.nodes.x;
  membrane.r_zeta = odd_[1] * shape.nodes.r;
  complete(membrane);

  const double tolerance = resolution_.near_tolerance;
  assemble_layer(Layer::single, shape.nodes, membrane, &self_, tolerance, shape.single_mm);
  if (with_double_layers)
    assemble_layer(Layer::dbl, shape.nodes, membrane, &self_, tolerance, shape.double_mm);
  if (has_wall()) {
    assemble_layer(Layer::single, wall_targets_, membrane, nullptr, tolerance, shape.single_bm);
    drop_last_row(shape.single_bm);
    if (with_double_layers) {
      assemble_layer(Layer::dbl, wall_targets_, membrane, nullptr, tolerance, shape.double_bm);
      drop_last_row(shape.double_bm);
    }
    shape.from_wall = wall_response(shape.nodes, false);
  }
  shape.empty_velocity = pore_ == PoreShape::hyperbolic
                             ? Vector(shape.from_wall * empty_traction_ + exit_field(shape.nodes))
                             : empty_velocity(shape.nodes);
  return shape;
}

// C A^(-1): empty without a wall.
Matrix FlowSystem::wall_answer(const Interaction &shape) const {
  return has_wall() ? Matrix(shape.from_wall * wall_inverse_) : Matrix();
}

Matrix FlowSystem::layer_with_wall(const RowMatrix &to_membrane, const RowMatrix &to_wall,
                                   const Matrix &wall_answer) const {
  Matrix layer = to_nodes(to_membrane, even_[0], odd_[0]);
  if (has_wall())
    layer -= wall_answer * to_nodes(to_wall, even_[0], odd_[0]);
  return layer;
}

FlowSystem::Layers FlowSystem::layers(const Interaction &shape) const {
  const Matrix answer = wall_answer(shape);
  return {stokeslet_factor / capillary_number_ * layer_with_wall(shape.single_mm, shape.single_bm, answer),
          layer_with_wall(shape.double_mm, shape.double_bm, answer)};
}

// beta - (lambda - 1) (D_MM - C A^(-1) D_BM) on nodal velocities.
Matrix FlowSystem::membrane_operator(const Interaction &shape) const {
  const Matrix layer = layer_with_wall(shape.double_mm, shape.double_bm, wall_answer(shape));
  return (1 + viscosity_ratio_) / 2 * Matrix::Identity(layer.rows(), layer.cols()) -
         (viscosity_ratio_ - 1) * layer;
}

// Nodal values -> values at the quadrature points, both components.
Vector FlowSystem::at_panels(const Vector &nodal) const {
  const Eigen::Index n = basis_.size();
  Vector values(2 * panels_.points.size());
  values << even_[0] * nodal.head(n), odd_[0] * nodal.tail(n);
  return values;
}

Vector FlowSystem::apply_membrane_operator(const Interaction &shape, const Vector &velocity) const {
  const Vector density = at_panels(velocity);
  Vector double_layer = shape.double_mm * density;
  if (has_wall())
    double_layer -= shape.from_wall * (wall_inverse_ * (shape.double_bm * density));
  return (1 + viscosity_ratio_) / 2 * velocity - (viscosity_ratio_ - 1) * double_layer;
}

// Corrections with an earlier shape's inverse; a fresh one when they gain less than a digit each.
Vector FlowSystem::membrane_velocity(const Interaction &shape, const Vector &right, Memory &memory) const {
  constexpr double enough = 1e-10;
  const double scale = right.cwiseAbs().maxCoeff();
  const auto refresh = [&] { memory.inverse = membrane_operator(shape).partialPivLu().inverse(); };
  if (memory.inverse.size() == 0)
    refresh();
  Vector velocity = memory.inverse * right;
  double before = scale;
  for (int k = 0; k < 12; ++k) {
    const Vector residual = right - apply_membrane_operator(shape, velocity);
    const double error = residual.cwiseAbs().maxCoeff();
    if (error <= enough * scale)
      return velocity;
    if (error > 0.1 * before)
      refresh();
    before = error;
    velocity += memory.inverse * residual;
  }
  throw NumericsFailure("unresolved", "the membrane's system does not converge", "try a finer mesh.membrane");
}

FlowState FlowSystem::flow(const Interaction &shape, const Vector &load, Memory &memory) const {
  const Vector strength = stokeslet_factor / capillary_number_ * at_panels(load);
  FlowState state;
  state.velocity = shape.empty_velocity + shape.single_mm * strength;
  Vector at_wall; // b of the head comment
  if (has_wall()) {
    at_wall = shape.single_bm * strength;
    state.velocity -= shape.from_wall * (wall_inverse_ * at_wall);
  }
  if (viscosity_ratio_ != 1) {
    state.velocity = membrane_velocity(shape, state.velocity, memory);
    if (has_wall())
      at_wall += (viscosity_ratio_ - 1) * (shape.double_bm * at_panels(state.velocity));
  }
  if (has_wall())
    state.pressure_drop = wall_inverse_.row(unknowns() - 1).dot(at_wall);
  return state;
}

Vector FlowSystem::outer_velocity(const Targets &points, const Interaction &shape, const Vector &load,
                                  const FlowState &state) const {
  const Vector strength = stokeslet_factor / capillary_number_ * at_panels(load);
  RowMatrix layer;
  assemble_layer(Layer::single, points, shape.membrane, nullptr, resolution_.near_tolerance, layer);
  Vector velocity = empty_velocity(points) + layer * strength;
  Vector at_wall = has_wall() ? Vector(shape.single_bm * strength) : Vector();
  if (viscosity_ratio_ != 1) {
    const Vector density = (viscosity_ratio_ - 1) * at_panels(state.velocity);
    assemble_layer(Layer::dbl, points, shape.membrane, nullptr, resolution_.near_tolerance, layer);
    velocity += layer * density;
    if (has_wall())
      at_wall += shape.double_bm * density;
  }
  if (has_wall())
    velocity -= wall_response(points, false) * (wall_inverse_ * at_wall);
  return velocity;
}

Matrix FlowSystem::mobility(const Interaction &shape) const {
  const Matrix single = stokeslet_factor / capillary_number_ *
                        layer_with_wall(shape.single_mm, shape.single_bm, wall_answer(shape));
  return viscosity_ratio_ == 1 ? single : membrane_operator(shape).partialPivLu().solve(single);
}

double FlowSystem::reciprocal_pressure_drop(const Interaction &shape, const Vector &load,
                                            const Vector &velocity) const {
  const Eigen::Index n = basis_.size();
  // int f dA = 2 pi sum area f at the nodes
  const Vector arc = ((basis_.even(basis_.nodes, 1) * shape.nodes.x).array().square() +
                      (basis_.odd(basis_.nodes, 1) * shape.nodes.r).array().square())
                         .sqrt();
  const Vector area = basis_.weights.array() * arc.array() * shape.nodes.r.array();
  Vector area2(2 * n);
  area2 << area, area;
  double sum = -(load.array() * shape.empty_velocity.array() * area2.array()).sum() / capillary_number_;
  if (viscosity_ratio_ != 1) {
    // sigma_e n from v_e on the membrane: v_e/2 = S t/(8 pi) + D v_e inside; t is free up to a pressure.
    Vector normal(2 * n);
    normal << -(basis_.odd(basis_.nodes, 1) * shape.nodes.r).array() / arc.array(),
        (basis_.even(basis_.nodes, 1) * shape.nodes.x).array() / arc.array();
    Matrix single = stokeslet_factor * to_nodes(shape.single_mm, even_[0], odd_[0]);
    single += normal * (normal.array() * area2.array()).matrix().transpose();
    const Vector known =
        0.5 * shape.empty_velocity - to_nodes(shape.double_mm, even_[0], odd_[0]) * shape.empty_velocity;
    const Vector traction = single.partialPivLu().solve(known);
    sum += (viscosity_ratio_ - 1) * (velocity.array() * traction.array() * area2.array()).sum();
  }
  return 2 * sum;
}

} // namespace capsule
