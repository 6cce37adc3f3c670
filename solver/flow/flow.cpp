#include "flow/flow.hpp"
#include "base/failure.hpp"
#include "geometry/pore.hpp"
#include <cmath>
#include <numbers>

namespace capsule {
namespace {

constexpr double pi = std::numbers::pi;
constexpr int exit_points = 12;

double poiseuille(double r) {
  return 2 * (1 - r * r);
}

// Equal panels in the middle of a tube, or in all of it; longer ones towards its ends, where the disturbance
// decays like exp(-4.47 d).
Vector tube_edges(double length, const FlowResolution &resolution) {
  constexpr double longest = 0.75;
  const double panel = resolution.wall_panel;
  const double outside = length / 2 - resolution.fine_half_length;
  if (outside < panel || panel > longest)
    return graded_edges(0, length, panel, panel, Graded::last);
  const Vector first = graded_edges(0, outside, panel, longest, Graded::last);
  const Vector middle = graded_edges(outside, length - outside, panel, panel, Graded::last);
  Vector edges(2 * first.size() + middle.size() - 2);
  edges << first, middle.segment(1, middle.size() - 2), length - first.reverse().array();
  return edges;
}

// Edges of the wall's panels by arc length from the exit: those of a tube; or equal in the pore, halved
// towards the lip from both sides, and growing with the distance from the lip in the reservoir, where the
// flow decays like a power.
Vector wall_edges(const Pore &pore, const FlowResolution &resolution) {
  if (pore.shape == PoreShape::tube)
    return tube_edges(pore.entrance_arc, resolution);
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

// One target's kernels in the rows `target` and `second + target` of a matrix, radial sources from the column
// `radial` on.
KernelRow kernel_row(RowMatrix &matrix, Eigen::Index target, Eigen::Index second, Eigen::Index radial) {
  double *const axial_row = matrix.row(target).data();
  double *const radial_row = matrix.row(second + target).data();
  return {axial_row, axial_row + radial, radial_row, radial_row + radial};
}

// The last solutions belong to shapes along a smooth way: the new shape as a combination of theirs, by least
// squares, continues them. Far from them, the last one is as good.
Vector continued(const FlowSystem::Corrector &corrector, const Vector &position) {
  constexpr double negligible = 1e-6; // a way beside another one
  constexpr double far = 20;          // times the ways between them
  if (corrector.positions.empty())
    return Vector::Zero(position.size());
  const auto steps = static_cast<Eigen::Index>(corrector.positions.size()) - 1;
  if (steps == 0)
    return corrector.solutions[0];
  Matrix ways(position.size(), steps), changes(position.size(), steps);
  for (Eigen::Index k = 0; k < steps; ++k) {
    const auto earlier = static_cast<std::size_t>(k + 1);
    ways.col(k) = corrector.positions[earlier] - corrector.positions[0];
    changes.col(k) = corrector.solutions[earlier] - corrector.solutions[0];
  }
  Eigen::CompleteOrthogonalDecomposition<Matrix> decomposition(position.size(), steps);
  decomposition.setThreshold(negligible);
  decomposition.compute(ways);
  const Vector shares = decomposition.solve(position - corrector.positions[0]);
  if (!(shares.cwiseAbs().maxCoeff() < far)) // or no number
    return corrector.solutions[0];
  return corrector.solutions[0] + changes * shares;
}

void remember(const Vector &position, const Vector &solution, FlowSystem::Corrector &corrector) {
  constexpr std::size_t kept = 4;
  corrector.positions.insert(corrector.positions.begin(), position);
  corrector.solutions.insert(corrector.solutions.begin(), solution);
  if (corrector.positions.size() > kept) {
    corrector.positions.pop_back();
    corrector.solutions.pop_back();
  }
}

NumericsFailure unresolved(const char *what) {
  return {"unresolved", what, "try a finer mesh.membrane"};
}

Matrix inverse_of(const Matrix &system) {
  Matrix inverse = system.partialPivLu().inverse();
  if (!inverse.allFinite())
    throw unresolved("the membrane's system is singular");
  return inverse;
}

// Generalised conjugate residuals, preconditioned with an earlier shape's inverse and started from the
// continuation of the last solutions.
//   residual_of   a guess
//   apply         the matrix to a direction
//   matrix        all of it, for a fresh inverse
template <class Residual, class Apply, class Build>
Vector solve(const Vector &position, double tolerance, FlowSystem::Corrector &corrector,
             const Residual &residual_of, const Apply &apply, const Build &matrix) {
  constexpr int few = 10; // corrections, of which a fresh inverse costs some tens
  if (corrector.inverse.size() == 0)
    corrector.inverse = inverse_of(matrix());
  Vector solution = continued(corrector, position);
  for (const bool fresh : {false, true}) {
    if (fresh)
      corrector.inverse = inverse_of(matrix());
    Vector residual = residual_of(solution);
    std::vector<Vector> directions, images;
    for (int k = 0; k <= few; ++k) {
      Vector direction = corrector.inverse * residual; // nearly the error
      if (direction.cwiseAbs().maxCoeff<Eigen::PropagateNaN>() <=
          tolerance * solution.cwiseAbs().maxCoeff()) {
        solution += direction;
        remember(position, solution, corrector);
        return solution;
      }
      Vector image = apply(direction);
      for (std::size_t j = 0; j < images.size(); ++j) {
        const double share = images[j].dot(image);
        image -= share * images[j];
        direction -= share * directions[j];
      }
      const double norm = image.norm();
      if (!(norm > 0)) // or no number: the inverse is no use
        break;
      images.push_back(image / norm);
      directions.push_back(direction / norm);
      const double share = images.back().dot(residual);
      solution += share * directions.back();
      residual -= share * images.back();
    }
  }
  throw unresolved("the membrane's system does not converge");
}

} // namespace

Vector even_membrane_edges(const MeridianBasis &basis, double largest_panel) {
  return graded_edges(0, pi, 0.75 * basis.nodes[0], largest_panel, Graded::both);
}

FlowSystem::FlowSystem(const Case &physics, const MeridianBasis &basis, const FlowResolution &resolution)
    : capillary_number_(physics.flow.capillary_number), viscosity_ratio_(physics.flow.viscosity_ratio),
      type_(physics.flow.type), pore_(physics.pore.shape), resolution_(resolution), basis_(basis),
      slope_even_(basis.even(basis.nodes, 1)), slope_odd_(basis.odd(basis.nodes, 1)),
      near_(resolution.membrane_panel_points, resolution.near_tolerance),
      exit_near_(exit_points, resolution.near_tolerance) {
  panels_ = make_panels(resolution.membrane_edges.size() > 0
                            ? resolution.membrane_edges
                            : even_membrane_edges(basis, resolution.membrane_panel),
                        resolution.membrane_panel_points);
  self_ = make_self_rule(panels_, basis.nodes);
  even_bend_ = bend(self_, [&](const Vector &zeta) { return basis.even(zeta, 2); });
  odd_bend_ = bend(self_, [&](const Vector &zeta) { return basis.odd(zeta, 2); });
  for (int d = 0; d < 2; ++d) {
    even_[d] = basis.even(panels_.points, d);
    odd_[d] = basis.odd(panels_.points, d);
  }
  if (pore_ == PoreShape::none)
    return;
  const Pore pore = make_pore(physics.pore);
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
  wall_near_ = FixedNearRule(wall_, resolution_.near_tolerance);

  const Panels across = make_panels(Vector::LinSpaced(2, 0, 1), exit_points);
  const Eigen::Index m = across.points.size();
  exit_.panel_points = exit_points;
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

// Velocity at points from tractions of the wall and P': 2 n x (2 n_b + 1).
RowMatrix FlowSystem::wall_response(const Targets &points) const {
  RowMatrix wall;
  const NearRule near(wall_.panel_points, resolution_.near_tolerance);
  assemble_layer(ring_stokeslet, points, wall_, nullptr, near, wall);
  RowMatrix exit;
  assemble_layer(ring_stokeslet, points, exit_, nullptr, exit_near_, exit);
  const Eigen::Index n = wall_.size();
  RowMatrix response(wall.rows(), unknowns());
  response.leftCols(n) = stokeslet_factor * wall.leftCols(n);
  response.col(n) = -stokeslet_factor * exit.leftCols(exit_.size()).rowwise().sum(); // f_x = -P
  response.rightCols(n) = stokeslet_factor * wall.rightCols(n);
  return response;
}

// What is known on the exit section: the shear f_r = -4 r and the double layer of Poiseuille's velocity.
Vector FlowSystem::exit_field(const RowMatrix &single, const RowMatrix &double_layer) const {
  const Eigen::Index m = exit_.size();
  return -4 * stokeslet_factor * (single.rightCols(m) * exit_.r) +
         double_layer.leftCols(m) * exit_.r.unaryExpr(&poiseuille);
}

Vector FlowSystem::exit_field(const Targets &points) const {
  RowMatrix single;
  RowMatrix double_layer;
  assemble_layer(ring_stokeslet, points, exit_, nullptr, exit_near_, single);
  assemble_layer(ring_stresslet, points, exit_, nullptr, exit_near_, double_layer);
  for (Eigen::Index i = 0; i < points.size(); ++i)
    if (points.x[i] == exit_.x[0]) // a plane's double layer vanishes on the plane itself
      double_layer.row(i).setZero();
  return exit_field(single, double_layer);
}

void FlowSystem::solve_empty_pore(const Pore &pore) {
  const Eigen::Index n = wall_.size();
  const RowMatrix response = wall_response(wall_targets_).topRows(unknowns()); // without a radial axis point
  force_.resize(unknowns());
  force_ << stokeslet_factor * wall_.area, 1, stokeslet_factor * wall_.area;
  wall_inverse_ = force_.asDiagonal() * response.partialPivLu().inverse();
  if (pore_ == PoreShape::tube) {
    empty_pressure_drop_ = 8 * pore.entrance_arc;
    return;
  }
  Vector known = exit_field(wall_targets_).head(unknowns());
  known[n] -= poiseuille(0) / 2; // the axis point's row: beta = 1/2 on the exit section
  empty_force_ = -wall_inverse_ * known;
  empty_pressure_drop_ = -empty_force_[n];
}

Vector FlowSystem::empty_velocity(const Targets &points) const {
  const Eigen::Index n = points.size();
  Vector velocity = Vector::Zero(2 * n);
  if (type_ == FlowType::extension)
    velocity << points.x, -0.5 * points.r;
  else if (pore_ == PoreShape::tube)
    velocity.head(n) = points.r.unaryExpr(&poiseuille);
  else if (pore_ == PoreShape::hyperbolic)
    velocity = wall_response(points) * empty_force_.cwiseQuotient(force_) + exit_field(points);
  return velocity;
}

Matrix FlowSystem::empty_wall_traction() const {
  const Eigen::Index n = wall_.size();
  const Vector traction = empty_force_.cwiseQuotient(force_);
  Matrix table(n, 3);
  table << wall_arc_, traction.head(n), traction.tail(n);
  return table;
}

FlowSystem::Interaction FlowSystem::interact(const Vector &position) const {
  return interact(position, has_inner_flow());
}

FlowSystem::Interaction FlowSystem::interact_in_full(const Vector &position) const {
  return interact(position, true);
}

FlowSystem::Interaction FlowSystem::interact(const Vector &position, bool with_double_layers) const {
  const Eigen::Index n = basis_.size();
  Interaction shape;
  shape.position = position;
  const auto x = position.head(n), r = position.tail(n);
  shape.nodes = {x, r, even_bend_ * x, odd_bend_ * r};
  Curve &membrane = shape.membrane;
  membrane.panel_points = panels_.rule.size();
  membrane.weights = panels_.weights;
  membrane.x = even_[0] * shape.nodes.x;
  membrane.r = odd_[0] * shape.nodes.r;
  membrane.x_zeta = even_[1] * shape.nodes.x;
  membrane.r_zeta = odd_[1] * shape.nodes.r;
  complete(membrane);
  shape.on_nodes = {n,
                    shape.nodes.x,
                    shape.nodes.r,
                    slope_even_ * shape.nodes.x,
                    slope_odd_ * shape.nodes.r,
                    basis_.weights,
                    {},
                    {},
                    {},
                    {}};
  complete(shape.on_nodes);

  assemble_layer(ring_stokeslet, shape.nodes, membrane, &self_, near_, shape.single_mm);
  if (with_double_layers)
    assemble_layer(ring_stresslet, shape.nodes, membrane, &self_, near_, shape.double_mm);
  if (has_wall()) {
    couple_to_wall(shape);
    refine_near_wall(shape);
    add_near_rows(shape);
    couple_to_exit(shape);
  }
  if (pore_ != PoreShape::hyperbolic)
    shape.empty_velocity = empty_velocity(shape.nodes);
  return shape;
}

void FlowSystem::couple_to_wall(Interaction &shape) const {
  const Eigen::Index n = basis_.size();
  const Eigen::Index n_b = wall_.size();
  const Rings wall = rings_of(wall_, 0, n_b);
  const Rings nodes = rings_of(shape.on_nodes, 0, n);
  shape.from_wall.resize(2 * n, unknowns());
  for (Eigen::Index j = 0; j < n; ++j)
    ring_stokeslet.plain(shape.nodes.x[j], shape.nodes.r[j], wall,
                         kernel_row(shape.from_wall, j, n, n_b + 1));
  RowMatrix axis(2, 2 * n);
  ring_stokeslet.plain(exit_.x[0], 0, nodes, kernel_row(axis, 0, 1, n));
  shape.to_axis = axis.row(0);
  if (shape.double_mm.size() == 0)
    return;
  shape.double_bm.resize(unknowns(), 2 * n);
  for (Eigen::Index i = 0; i < n_b; ++i)
    ring_stresslet.plain(wall_.x[i], wall_.r[i], nodes, kernel_row(shape.double_bm, i, n_b + 1, n));
  ring_stresslet.plain(exit_.x[0], 0, nodes, kernel_row(axis, 0, 1, n));
  shape.double_bm.row(n_b) = axis.row(0);
}

// Nodes that the wall's panels are too long for.
void FlowSystem::refine_near_wall(Interaction &shape) const {
  const Eigen::Index n = basis_.size();
  const Eigen::Index p = wall_.panel_points;
  const Eigen::Index radial = wall_.size() + 1;
  for (Eigen::Index j = 0; j < n; ++j)
    wall_near_.at_near_panels(ring_stokeslet, shape.nodes.x[j], shape.nodes.r[j],
                              [&](Eigen::Index first, KernelBlock &block) {
                                block.array().rowwise() /= wall_.area.segment(first, p).transpose().array();
                                KernelBlock difference(4, p);
                                for (int component = 0; component < 4; ++component) {
                                  auto stored = shape.from_wall.row(component < 2 ? j : n + j)
                                                    .segment(component % 2 == 0 ? first : radial + first, p);
                                  difference.row(component) = stored - block.row(component);
                                  stored = block.row(component);
                                }
                                shape.to_wall.push_back({j, first, std::move(difference)});
                              });
}

// Wall points that the rule on the nodes is too coarse for: it converges like exp(-2 pi d/h), h the distance
// of the nodes and d theirs to the point.
void FlowSystem::add_near_rows(Interaction &shape) const {
  const Eigen::Index n = basis_.size();
  const double spacings = 1.1 * -std::log(resolution_.near_tolerance) / (2 * pi);
  const Eigen::ArrayXd reach = spacings * pi / static_cast<double>(n) * shape.on_nodes.arc.array();
  const double largest = reach.maxCoeff();
  const double low = shape.nodes.x.minCoeff() - largest;
  const double high = shape.nodes.x.maxCoeff() + largest;
  std::vector<Eigen::Index> near;
  for (Eigen::Index i = 0; i < wall_.size(); ++i)
    if (wall_.x[i] > low && wall_.x[i] < high &&
        ((shape.nodes.x.array() - wall_.x[i]).square() + (shape.nodes.r.array() - wall_.r[i]).square() <
         reach.square())
            .any())
      near.push_back(i);
  if (near.empty())
    return;
  const auto count = static_cast<Eigen::Index>(near.size());
  Targets points{wall_.x(near), wall_.r(near)};
  assemble_layer(ring_stokeslet, points, shape.membrane, nullptr, near_, shape.near_single);
  if (shape.double_mm.size() > 0)
    assemble_layer(ring_stresslet, points, shape.membrane, nullptr, near_, shape.near_double);
  shape.near_row = near;
  for (Eigen::Index i = 0; i < count; ++i)
    shape.near_row.push_back(wall_.size() + 1 + near[static_cast<std::size_t>(i)]);
}

void FlowSystem::couple_to_exit(Interaction &shape) const {
  RowMatrix single;
  assemble_layer(ring_stokeslet, shape.nodes, exit_, nullptr, exit_near_, single);
  shape.from_wall.col(wall_.size()) = -stokeslet_factor * single.leftCols(exit_.size()).rowwise().sum();
  if (pore_ != PoreShape::hyperbolic)
    return;
  RowMatrix double_layer;
  assemble_layer(ring_stresslet, shape.nodes, exit_, nullptr, exit_near_, double_layer);
  shape.empty_velocity = shape.from_wall * empty_force_ + exit_field(single, double_layer);
}

// b from nodal loads, without factors.
Vector FlowSystem::single_at_wall(const Interaction &shape, const Vector &load) const {
  const Eigen::Index n = basis_.size();
  const Eigen::Index n_b = wall_.size();
  const Eigen::Index p = wall_.panel_points;
  const Vector force = shape.on_nodes.area.replicate(2, 1).cwiseProduct(load);
  Vector velocity = shape.from_wall.transpose() * force;
  for (const auto &[node, first, block] : shape.to_wall) {
    velocity.segment(first, p) += force[node] * block.row(0) + force[n + node] * block.row(2);
    velocity.segment(n_b + 1 + first, p) += force[node] * block.row(1) + force[n + node] * block.row(3);
  }
  velocity[n_b] = shape.to_axis.dot(force);
  if (!shape.near_row.empty())
    velocity(shape.near_row) = shape.near_single * at_panels(load);
  return velocity;
}

// The double layer's part of b from nodal velocities, without its factor.
Vector FlowSystem::double_at_wall(const Interaction &shape, const Vector &density) const {
  Vector velocity = shape.double_bm * shape.on_nodes.area.replicate(2, 1).cwiseProduct(density);
  if (!shape.near_row.empty())
    velocity(shape.near_row) = shape.near_double * at_panels(density);
  return velocity;
}

// The same as matrices, unknowns x 2N.
Matrix FlowSystem::single_at_wall(const Interaction &shape) const {
  const Eigen::Index n = basis_.size();
  const Eigen::Index n_b = wall_.size();
  const Eigen::Index p = wall_.panel_points;
  Matrix result = shape.from_wall.transpose();
  for (const auto &[node, first, block] : shape.to_wall) {
    result.col(node).segment(first, p) += block.row(0);
    result.col(n + node).segment(first, p) += block.row(2);
    result.col(node).segment(n_b + 1 + first, p) += block.row(1);
    result.col(n + node).segment(n_b + 1 + first, p) += block.row(3);
  }
  result.row(n_b) = shape.to_axis;
  result *= shape.on_nodes.area.replicate(2, 1).asDiagonal();
  if (!shape.near_row.empty())
    result(shape.near_row, Eigen::all) = to_nodes(shape.near_single, even_[0], odd_[0]);
  return result;
}

Matrix FlowSystem::double_at_wall(const Interaction &shape) const {
  Matrix result = shape.double_bm * shape.on_nodes.area.replicate(2, 1).asDiagonal();
  if (!shape.near_row.empty())
    result(shape.near_row, Eigen::all) = to_nodes(shape.near_double, even_[0], odd_[0]);
  return result;
}

// C A^(-1), empty without a wall.
RowMatrix FlowSystem::answer_of_wall(const Interaction &shape) const {
  return has_wall() ? RowMatrix(shape.from_wall * wall_inverse_) : RowMatrix();
}

Matrix FlowSystem::single_layer(const Interaction &shape, const RowMatrix &answer) const {
  Matrix layer = to_nodes(shape.single_mm, even_[0], odd_[0]);
  if (has_wall())
    layer -= answer * single_at_wall(shape);
  return stokeslet_factor / capillary_number_ * layer;
}

Matrix FlowSystem::double_layer(const Interaction &shape, const RowMatrix &answer) const {
  Matrix layer = to_nodes(shape.double_mm, even_[0], odd_[0]);
  if (has_wall())
    layer -= answer * double_at_wall(shape);
  return layer;
}

FlowSystem::Layers FlowSystem::layers(const Interaction &shape) const {
  const RowMatrix answer = answer_of_wall(shape);
  return {single_layer(shape, answer), double_layer(shape, answer)};
}

// beta - (lambda - 1) (D_MM - C A^(-1) D_BM) on nodal velocities.
Matrix FlowSystem::membrane_operator(const Interaction &shape, const RowMatrix &answer) const {
  const Matrix layer = double_layer(shape, answer);
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
  Vector double_layer = shape.double_mm * at_panels(velocity);
  if (has_wall())
    double_layer -= shape.from_wall * (wall_inverse_ * double_at_wall(shape, velocity));
  return (1 + viscosity_ratio_) / 2 * velocity - (viscosity_ratio_ - 1) * double_layer;
}

// right is the velocity without what v does and without the wall, at_wall what is on the wall without v: the
// wall's answer to both is found at once.
Vector FlowSystem::membrane_velocity(const Interaction &shape, const Vector &right, const Vector &at_wall,
                                     Memory &memory) const {
  const double excess = viscosity_ratio_ - 1;
  return solve(
      shape.position, resolution_.solver_tolerance, memory.velocity,
      [&](const Vector &velocity) {
        Vector residual =
            right + excess * (shape.double_mm * at_panels(velocity)) - (1 + viscosity_ratio_) / 2 * velocity;
        if (has_wall())
          residual -=
              shape.from_wall * (wall_inverse_ * (at_wall + excess * double_at_wall(shape, velocity)));
        return residual;
      },
      [&](const Vector &velocity) { return apply_membrane_operator(shape, velocity); },
      [&] { return membrane_operator(shape, answer_of_wall(shape)); });
}

FlowState FlowSystem::flow(const Interaction &shape, const Vector &load, Memory &memory) const {
  const Vector strength = stokeslet_factor / capillary_number_ * at_panels(load);
  FlowState state;
  state.velocity = shape.empty_velocity + shape.single_mm * strength;
  Vector at_wall; // b of the head comment
  if (has_wall())
    at_wall = stokeslet_factor / capillary_number_ * single_at_wall(shape, load);
  if (has_inner_flow()) {
    state.velocity = membrane_velocity(shape, state.velocity, at_wall, memory);
    if (has_wall())
      at_wall += (viscosity_ratio_ - 1) * double_at_wall(shape, state.velocity);
  } else if (has_wall()) {
    state.velocity -= shape.from_wall * (wall_inverse_ * at_wall);
  }
  if (!state.velocity.allFinite())
    throw NumericsFailure("not-a-number", "the membrane's velocity is not a number",
                          "try a finer mesh.membrane");
  if (has_wall())
    state.pressure_drop = wall_inverse_.row(wall_.size()).dot(at_wall);
  return state;
}

Vector FlowSystem::outer_velocity(const Targets &points, const Interaction &shape, const Vector &load,
                                  const FlowState &state) const {
  RowMatrix layer;
  assemble_layer(ring_stokeslet, points, shape.membrane, nullptr, near_, layer);
  Vector velocity =
      empty_velocity(points) + layer * (stokeslet_factor / capillary_number_ * at_panels(load)).eval();
  if (has_inner_flow()) {
    assemble_layer(ring_stresslet, points, shape.membrane, nullptr, near_, layer);
    velocity += (viscosity_ratio_ - 1) * (layer * at_panels(state.velocity));
  }
  if (has_wall()) {
    Vector at_wall = stokeslet_factor / capillary_number_ * single_at_wall(shape, load);
    if (has_inner_flow())
      at_wall += (viscosity_ratio_ - 1) * double_at_wall(shape, state.velocity);
    velocity -= wall_response(points) * (wall_inverse_ * at_wall).cwiseQuotient(force_);
  }
  return velocity;
}

Matrix FlowSystem::mobility(const Interaction &shape, Memory &memory) const {
  const RowMatrix answer = answer_of_wall(shape);
  Matrix single = single_layer(shape, answer);
  if (!has_inner_flow())
    return single;
  memory.velocity.inverse = inverse_of(membrane_operator(shape, answer));
  return memory.velocity.inverse * single;
}

// sigma_e n from v_e on the membrane: v_e/2 = S t/(8 pi) + D v_e inside; t is free up to a pressure.
Vector FlowSystem::empty_traction(const Interaction &shape, Memory &memory) const {
  Vector normal(2 * basis_.size());
  normal << shape.on_nodes.normal_x, shape.on_nodes.normal_r;
  const Vector weighted = normal.cwiseProduct(shape.on_nodes.area.replicate(2, 1));
  const Vector known = 0.5 * shape.empty_velocity - shape.double_mm * at_panels(shape.empty_velocity);
  const auto apply = [&](const Vector &traction) {
    return Vector(stokeslet_factor * (shape.single_mm * at_panels(traction)) +
                  normal * weighted.dot(traction));
  };
  return solve(
      shape.position, resolution_.solver_tolerance, memory.traction,
      [&](const Vector &traction) { return Vector(known - apply(traction)); }, apply,
      [&]() -> Matrix {
        return stokeslet_factor * to_nodes(shape.single_mm, even_[0], odd_[0]) +
               normal * weighted.transpose();
      });
}

double FlowSystem::reciprocal_pressure_drop(const Interaction &shape, const Vector &load,
                                            const Vector &velocity, Memory &memory) const {
  // int f dA = 2 pi sum area f at the nodes
  const Vector area2 = shape.on_nodes.area.replicate(2, 1);
  double sum = -(load.array() * shape.empty_velocity.array() * area2.array()).sum() / capillary_number_;
  if (has_inner_flow()) {
    sum += (viscosity_ratio_ - 1) *
           (velocity.array() * empty_traction(shape, memory).array() * area2.array()).sum();
  }
  return 2 * sum;
}

} // namespace capsule
