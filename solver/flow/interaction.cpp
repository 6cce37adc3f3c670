#include "flow/interaction.hpp"
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace capsule {
namespace {

// One target's kernels in the rows `target` and `second + target` of a matrix, radial sources from the column
// `radial` on.
KernelRow kernel_row(RowMatrix &matrix, Eigen::Index target, Eigen::Index second, Eigen::Index radial) {
  double *const axial_row = matrix.row(target).data();
  double *const radial_row = matrix.row(second + target).data();
  return {axial_row, axial_row + radial, radial_row, radial_row + radial};
}

// Velocity at the nodes from forces of the wall's points.
void stokeslets_from_wall(const Wall &wall, const Curve &nodes, RowMatrix &matrix) {
  const Eigen::Index n = nodes.size();
  const Eigen::Index n_b = wall.curve().size();
  const Rings rings = rings_of(wall.curve(), 0, n_b);
  matrix.resize(2 * n, wall.unknowns());
  for (Eigen::Index j = 0; j < n; ++j)
    ring_stokeslet.plain(nodes.x[j], nodes.r[j], rings, kernel_row(matrix, j, n, n_b + 1));
}

// Velocity in the wall's equations from the velocities of the nodes.
void stresslets_at_wall(const Wall &wall, const Curve &nodes, RowMatrix &matrix) {
  const Eigen::Index n = nodes.size();
  const Eigen::Index n_b = wall.curve().size();
  const Rings rings = rings_of(nodes, 0, n);
  matrix.resize(wall.unknowns(), 2 * n);
  for (Eigen::Index i = 0; i < n_b; ++i)
    ring_stresslet.plain(wall.curve().x[i], wall.curve().r[i], rings, kernel_row(matrix, i, n_b + 1, n));
  matrix.row(n_b) = wall.outlet().row(ring_stresslet, rings);
}

Curve moved(Curve curve, double shift) {
  curve.x.array() += shift;
  return curve;
}

} // namespace

Interaction::Interaction(std::shared_ptr<const Wall> wall, const MembraneMesh &mesh, const Vector &position,
                         Layers layers, std::span<const Image> images, Drive drive)
    : wall_(std::move(wall)), mesh_(&mesh), images_(images.begin(), images.end()), drive_(drive),
      shape_(shape_at(mesh, position)) {
  assemble(ring_stokeslet, shape_.targets, &mesh.self, single_);
  if (layers == Layers::both)
    assemble(ring_stresslet, shape_.targets, &mesh.self, double_);
  if (wall_->unknowns() == 0) {
    from_wall_.resize(2 * mesh.nodes, 0);
    double_at_wall_.resize(0, 2 * mesh.nodes);
    base_velocity_ = wall_->base_velocity(shape_.targets);
    return;
  }
  couple_to_wall(layers);
  refine_near_wall();
  add_near_rows(layers);
  couple_to_outlet();
}

// Of the membranes and their images.
void Interaction::assemble(const RingKernel &kernel, const Targets &targets, const SelfRule *self,
                           RowMatrix &matrix) const {
  assemble_layer(kernel, targets, shape_.panels, self, mesh_->near, matrix);
  RowMatrix image;
  for (const auto &[shift, amplitude] : images_) {
    assemble_layer(kernel, targets, moved(shape_.panels, shift), nullptr, mesh_->near, image);
    matrix += amplitude * image;
  }
}

void Interaction::couple_to_wall(Layers layers) {
  stokeslets_from_wall(*wall_, shape_.nodes, from_wall_);
  if (layers == Layers::both)
    stresslets_at_wall(*wall_, shape_.nodes, double_at_wall_);
  if (images_.empty())
    return;
  from_wall_to_images_ = RowMatrix::Zero(from_wall_.rows(), from_wall_.cols());
  RowMatrix image = from_wall_to_images_;
  for (const auto &[shift, amplitude] : images_) {
    const Curve nodes = moved(shape_.nodes, shift);
    stokeslets_from_wall(*wall_, nodes, image);
    from_wall_to_images_ += amplitude * image;
    if (layers == Layers::both) {
      RowMatrix stresslets;
      stresslets_at_wall(*wall_, nodes, stresslets);
      double_at_wall_ += amplitude * stresslets;
    }
  }
}

// Nodes that the wall's panels are too long for.
void Interaction::refine_near_wall() {
  const Eigen::Index n = mesh_->nodes;
  const Curve &wall = wall_->curve();
  const Eigen::Index p = wall.panel_points;
  const Eigen::Index radial = wall.size() + 1;
  for (Eigen::Index j = 0; j < n; ++j)
    wall_->near().at_near_panels(
        ring_stokeslet, shape_.nodes.x[j], shape_.nodes.r[j], [&](Eigen::Index first, KernelBlock &block) {
          block.array().rowwise() /= wall.area.segment(first, p).transpose().array();
          KernelBlock difference(4, p);
          for (int component = 0; component < 4; ++component) {
            auto stored = from_wall_.row(component < 2 ? j : n + j)
                              .segment(component % 2 == 0 ? first : radial + first, p);
            difference.row(component) = stored - block.row(component);
            stored = block.row(component);
          }
          to_wall_.push_back({j, first, std::move(difference)});
        });
}

// Wall points that the rule on the nodes is too coarse for: it converges like exp(-2 pi d/h), h the distance
// of the nodes and d theirs to the point.
void Interaction::add_near_rows(Layers layers) {
  constexpr double pi = std::numbers::pi;
  const Curve &wall = wall_->curve();
  const double spacings = 1.1 * -std::log(mesh_->near_tolerance) / (2 * pi);
  Eigen::ArrayXd reach(mesh_->nodes);
  for (const MembraneMesh::Part &part : mesh_->parts)
    reach.segment(part.first_node, part.nodes()) =
        spacings * pi / static_cast<double>(part.nodes()) *
        shape_.nodes.arc.array().segment(part.first_node, part.nodes());
  const double largest = reach.maxCoeff();
  const double low = shape_.nodes.x.minCoeff() - largest;
  const double high = shape_.nodes.x.maxCoeff() + largest;
  const auto near_to_membranes = [&](double x, double r) {
    return x > low && x < high &&
           ((shape_.nodes.x.array() - x).square() + (shape_.nodes.r.array() - r).square() < reach.square())
               .any();
  };
  std::vector<Eigen::Index> near;
  for (Eigen::Index i = 0; i < wall.size(); ++i)
    if (near_to_membranes(wall.x[i], wall.r[i]) || std::ranges::any_of(images_, [&](const Image &image) {
          return near_to_membranes(wall.x[i] - image.shift, wall.r[i]);
        }))
      near.push_back(i);
  if (near.empty())
    return;
  const Targets points{wall.x(near), wall.r(near)};
  assemble(ring_stokeslet, points, nullptr, near_single_);
  if (layers == Layers::both)
    assemble(ring_stresslet, points, nullptr, near_double_);
  near_row_ = near;
  for (const Eigen::Index i : near)
    near_row_.push_back(wall.size() + 1 + i);
}

void Interaction::couple_to_outlet() {
  const Outlet &outlet = wall_->outlet();
  const Eigen::Index n = mesh_->nodes;
  to_outlet_ = outlet.row(ring_stokeslet, rings_of(shape_.nodes, 0, n));
  for (const auto &[shift, amplitude] : images_) {
    const Curve nodes = moved(shape_.nodes, shift);
    to_outlet_ += amplitude * outlet.row(ring_stokeslet, rings_of(nodes, 0, n));
  }
  const RowMatrix single = outlet.single_layer(shape_.targets);
  auto column = from_wall_.col(wall_->outlet_unknown());
  column = outlet.column(single);
  base_velocity_ = wall_->base_velocity(shape_.targets, from_wall_, single);
  column += base_velocity_ / drive_.resistance;
}

// b from nodal densities.
Vector Interaction::single_at_wall(const Vector &density) const {
  if (wall_->unknowns() == 0)
    return {};
  const Eigen::Index n = mesh_->nodes;
  const Eigen::Index radial = wall_->curve().size() + 1;
  const Eigen::Index p = wall_->curve().panel_points;
  const Vector force = shape_.nodes.area.replicate(2, 1).cwiseProduct(density);
  Vector velocity = from_wall_.transpose() * force;
  for (const auto &[node, first, block] : to_wall_) {
    velocity.segment(first, p) += force[node] * block.row(0) + force[n + node] * block.row(2);
    velocity.segment(radial + first, p) += force[node] * block.row(1) + force[n + node] * block.row(3);
  }
  if (!images_.empty())
    velocity += from_wall_to_images_.transpose() * force;
  velocity[wall_->outlet_unknown()] = to_outlet_.dot(force);
  if (!near_row_.empty())
    velocity(near_row_) = near_single_ * mesh_->at_panels(density);
  return velocity;
}

Vector Interaction::double_at_wall(const Vector &density) const {
  Vector velocity = double_at_wall_ * shape_.nodes.area.replicate(2, 1).cwiseProduct(density);
  if (!near_row_.empty())
    velocity(near_row_) = near_double_ * mesh_->at_panels(density);
  return velocity;
}

Matrix Interaction::single_at_wall() const {
  if (wall_->unknowns() == 0)
    return Matrix(0, 2 * mesh_->nodes);
  const Eigen::Index n = mesh_->nodes;
  const Eigen::Index radial = wall_->curve().size() + 1;
  const Eigen::Index p = wall_->curve().panel_points;
  Matrix result = from_wall_.transpose();
  for (const auto &[node, first, block] : to_wall_) {
    result.col(node).segment(first, p) += block.row(0);
    result.col(n + node).segment(first, p) += block.row(2);
    result.col(node).segment(radial + first, p) += block.row(1);
    result.col(n + node).segment(radial + first, p) += block.row(3);
  }
  if (!images_.empty())
    result += from_wall_to_images_.transpose();
  result.row(wall_->outlet_unknown()) = to_outlet_;
  result *= shape_.nodes.area.replicate(2, 1).asDiagonal();
  if (!near_row_.empty())
    result(near_row_, Eigen::all) = mesh_->on_nodes(near_single_);
  return result;
}

Matrix Interaction::double_at_wall() const {
  Matrix result = double_at_wall_ * shape_.nodes.area.replicate(2, 1).asDiagonal();
  if (!near_row_.empty())
    result(near_row_, Eigen::all) = mesh_->on_nodes(near_double_);
  return result;
}

Vector Interaction::answer_of_wall(const Vector &at_wall) const {
  if (wall_->unknowns() == 0) // BLAS takes no matrix without columns
    return Vector::Zero(2 * mesh_->nodes);
  return from_wall_ * (wall_->inverse() * at_wall);
}

Vector Interaction::velocity_at(const Targets &points, const Vector &single_density,
                                const Vector &double_density) const {
  RowMatrix layer;
  assemble(ring_stokeslet, points, nullptr, layer);
  Vector velocity = layer * mesh_->at_panels(single_density);
  Vector at_wall = single_at_wall(single_density);
  if (double_density.size() > 0) {
    assemble(ring_stresslet, points, nullptr, layer);
    velocity += layer * mesh_->at_panels(double_density);
    at_wall += double_at_wall(double_density);
  }
  return velocity - wall_->velocity_of(at_wall, points);
}

} // namespace capsule
