#include "flow/wall_coupling.hpp"
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace capsule {
namespace {

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

} // namespace

WallCoupling::WallCoupling(const Wall &wall, const MembraneMesh &mesh, const MembraneShape &shape,
                           std::size_t membrane, Layers layers, std::span<const Image> images,
                           const Drive &drive)
    : wall_(&wall), part_(&mesh.parts[membrane]), nodes_(nodes_of(mesh, shape, membrane)) {
  const Targets targets = targets_of(mesh, shape, membrane);
  const Eigen::Index n = nodes_.size();
  if (wall_->unknowns() == 0) {
    from_wall_.resize(2 * n, 0);
    double_at_wall_.resize(0, 2 * n);
    base_velocity_ = wall_->base_velocity(targets);
    return;
  }
  couple(layers, images);
  refine_near_wall();
  add_near_rows(mesh, shape, membrane, layers, images);
  couple_to_outlet(targets, images, drive);
}

void WallCoupling::couple(Layers layers, std::span<const Image> images) {
  stokeslets_from_wall(*wall_, nodes_, from_wall_);
  if (layers == Layers::both)
    stresslets_at_wall(*wall_, nodes_, double_at_wall_);
  if (images.empty())
    return;
  from_wall_to_images_ = RowMatrix::Zero(from_wall_.rows(), from_wall_.cols());
  RowMatrix image = from_wall_to_images_;
  for (const auto &[shift, amplitude] : images) {
    const Curve nodes = moved(nodes_, shift);
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
void WallCoupling::refine_near_wall() {
  const Eigen::Index n = nodes_.size();
  const Curve &wall = wall_->curve();
  const Eigen::Index p = wall.panel_points;
  const Eigen::Index radial = wall.size() + 1;
  for (Eigen::Index j = 0; j < n; ++j)
    wall_->near().at_near_panels(
        ring_stokeslet, nodes_.x[j], nodes_.r[j], [&](Eigen::Index first, KernelBlock &block) {
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

// Wall points that the rule on the nodes is too coarse for.
void WallCoupling::add_near_rows(const MembraneMesh &mesh, const MembraneShape &shape, std::size_t membrane,
                                 Layers layers, std::span<const Image> images) {
  const Curve &wall = wall_->curve();
  const NodesNearby nearby(mesh, shape, membrane);
  std::vector<Eigen::Index> near;
  for (Eigen::Index i = 0; i < wall.size(); ++i)
    if (nearby.hold(wall.x[i], wall.r[i]) || std::ranges::any_of(images, [&](const Image &image) {
          return nearby.hold(wall.x[i] - image.shift, wall.r[i]);
        }))
      near.push_back(i);
  if (near.empty())
    return;
  const Targets points{wall.x(near), wall.r(near)};
  const Curve panels = panels_of(mesh, shape, membrane);
  near_single_ = layer_with_images(ring_stokeslet, points, panels, nullptr, mesh.near, images);
  if (layers == Layers::both)
    near_double_ = layer_with_images(ring_stresslet, points, panels, nullptr, mesh.near, images);
  near_row_ = near;
  for (const Eigen::Index i : near)
    near_row_.push_back(wall.size() + 1 + i);
}

void WallCoupling::couple_to_outlet(const Targets &targets, std::span<const Image> images,
                                    const Drive &drive) {
  const Outlet &outlet = wall_->outlet();
  const Eigen::Index n = nodes_.size();
  to_outlet_ = outlet.row(ring_stokeslet, rings_of(nodes_, 0, n));
  for (const auto &[shift, amplitude] : images) {
    const Curve nodes = moved(nodes_, shift);
    to_outlet_ += amplitude * outlet.row(ring_stokeslet, rings_of(nodes, 0, n));
  }
  const RowMatrix single = outlet.single_layer(targets);
  auto column = from_wall_.col(wall_->outlet_unknown());
  column = outlet.column(single);
  base_velocity_ = wall_->base_velocity(targets, from_wall_, single);
  column += base_velocity_ / drive.resistance;
}

// b from nodal densities.
Vector WallCoupling::single_at_wall(const Vector &density) const {
  if (wall_->unknowns() == 0)
    return {};
  const Eigen::Index n = nodes_.size();
  const Eigen::Index radial = wall_->curve().size() + 1;
  const Eigen::Index p = wall_->curve().panel_points;
  const Vector force = nodes_.area.replicate(2, 1).cwiseProduct(density);
  Vector velocity = from_wall_.transpose() * force;
  for (const auto &[node, first, block] : to_wall_) {
    velocity.segment(first, p) += force[node] * block.row(0) + force[n + node] * block.row(2);
    velocity.segment(radial + first, p) += force[node] * block.row(1) + force[n + node] * block.row(3);
  }
  if (from_wall_to_images_.size() > 0)
    velocity += from_wall_to_images_.transpose() * force;
  velocity[wall_->outlet_unknown()] = to_outlet_.dot(force);
  if (!near_row_.empty())
    velocity(near_row_) = near_single_ * part_->values_at_panels(density);
  return velocity;
}

Vector WallCoupling::double_at_wall(const Vector &density) const {
  Vector velocity = double_at_wall_ * nodes_.area.replicate(2, 1).cwiseProduct(density);
  if (!near_row_.empty())
    velocity(near_row_) = near_double_ * part_->values_at_panels(density);
  return velocity;
}

Matrix WallCoupling::single_at_wall() const {
  const Eigen::Index n = nodes_.size();
  if (wall_->unknowns() == 0)
    return Matrix(0, 2 * n);
  const Eigen::Index radial = wall_->curve().size() + 1;
  const Eigen::Index p = wall_->curve().panel_points;
  Matrix result = from_wall_.transpose();
  for (const auto &[node, first, block] : to_wall_) {
    result.col(node).segment(first, p) += block.row(0);
    result.col(n + node).segment(first, p) += block.row(2);
    result.col(node).segment(radial + first, p) += block.row(1);
    result.col(n + node).segment(radial + first, p) += block.row(3);
  }
  if (from_wall_to_images_.size() > 0)
    result += from_wall_to_images_.transpose();
  result.row(wall_->outlet_unknown()) = to_outlet_;
  result *= nodes_.area.replicate(2, 1).asDiagonal();
  if (!near_row_.empty())
    result(near_row_, Eigen::all) = part_->on_nodes(near_single_);
  return result;
}

Matrix WallCoupling::double_at_wall() const {
  Matrix result = double_at_wall_ * nodes_.area.replicate(2, 1).asDiagonal();
  if (!near_row_.empty())
    result(near_row_, Eigen::all) = part_->on_nodes(near_double_);
  return result;
}

} // namespace capsule
