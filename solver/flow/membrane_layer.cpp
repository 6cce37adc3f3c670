#include "flow/membrane_layer.hpp"
#include <algorithm>
#include <utility>

namespace capsule {
namespace {

// Kernels without areas, 2 n_t x 2 n_s.
RowMatrix kernels_between(const RingKernel &kernel, const Targets &targets, const Curve &sources) {
  const Eigen::Index to = targets.size(), from = sources.size();
  const Rings rings = rings_of(sources, 0, from);
  RowMatrix matrix(2 * to, 2 * from);
  for (Eigen::Index j = 0; j < to; ++j)
    kernel.plain(targets.x[j], targets.r[j], rings, kernel_row(matrix, j, to, from));
  return matrix;
}

} // namespace

Curve moved(Curve curve, double shift) {
  curve.x.array() += shift;
  return curve;
}

KernelRow kernel_row(RowMatrix &matrix, Eigen::Index target, Eigen::Index second, Eigen::Index radial) {
  double *const axial_row = matrix.row(target).data();
  double *const radial_row = matrix.row(second + target).data();
  return {axial_row, axial_row + radial, radial_row, radial_row + radial};
}

RowMatrix layer_with_images(const RingKernel &kernel, const Targets &targets, const Curve &curve,
                            const SelfRule *self, const NearRule &near, std::span<const Image> images) {
  RowMatrix matrix;
  assemble_layer(kernel, targets, curve, self, near, matrix);
  RowMatrix image;
  for (const auto &[shift, amplitude] : images) {
    assemble_layer(kernel, targets, moved(curve, shift), nullptr, near, image);
    matrix += amplitude * image;
  }
  return matrix;
}

MembraneLayer::MembraneLayer(const RingKernel &kernel, const MembraneMesh &mesh, const MembraneShape &shape,
                             std::span<const Image> images)
    : mesh_(&mesh), area_(shape.nodes.area) {
  const std::size_t membranes = mesh.parts.size();
  for (std::size_t k = 0; k < membranes; ++k)
    own_.push_back(layer_with_images(kernel, targets_of(mesh, shape, k), panels_of(mesh, shape, k),
                                     &mesh.parts[k].self, mesh.near, images));
  for (std::size_t from = 0; from < membranes; ++from)
    for (std::size_t to = 0; to < membranes; ++to)
      if (to != from)
        add_pair(kernel, shape, images, to, from);
}

// The stokeslet is symmetric: forces on one membrane make the velocities on the other that those on the other make on it.
void MembraneLayer::add_pair(const RingKernel &kernel, const MembraneShape &shape,
                             std::span<const Image> images, std::size_t to, std::size_t from) {
  const Curve sources = nodes_of(*mesh_, shape, from);
  const Targets targets = targets_of(*mesh_, shape, to);
  const NodesNearby nearby(*mesh_, shape, from);
  const Eigen::Index n = targets.size();
  std::vector<Eigen::Index> near;
  for (Eigen::Index j = 0; j < n; ++j)
    if (!images.empty() || nearby.hold(targets.x[j], targets.r[j])) // images act from panels
      near.push_back(j);
  Pair pair{to, from, {}, {}, {}};
  const auto opposite =
      std::ranges::find_if(pairs_, [&](const Pair &other) { return other.to == from && other.from == to; });
  pair.from_nodes = &kernel == &ring_stokeslet && opposite != pairs_.end()
                        ? RowMatrix(opposite->from_nodes.transpose())
                        : kernels_between(kernel, targets, sources);
  if (!near.empty()) {
    pair.from_panels = layer_with_images(kernel, {targets.x(near), targets.r(near)},
                                         panels_of(*mesh_, shape, from), nullptr, mesh_->near, images);
    pair.near = near;
    for (const Eigen::Index j : near)
      pair.near.push_back(n + j);
  }
  pairs_.push_back(std::move(pair));
}

Vector MembraneLayer::velocity(const Vector &density) const {
  Vector result(2 * mesh_->nodes);
  std::vector<Vector> at_panels, forces;
  for (std::size_t k = 0; k < own_.size(); ++k) {
    const MembraneMesh::Part &part = mesh_->parts[k];
    const Vector of_part = density(mesh_->rows(k));
    at_panels.push_back(part.values_at_panels(of_part));
    result(mesh_->rows(k)) = own_[k] * at_panels[k];
    forces.push_back(area_.segment(part.first_node, part.nodes()).replicate(2, 1).cwiseProduct(of_part));
  }
  for (const Pair &pair : pairs_) {
    Vector made = pair.from_nodes * forces[pair.from];
    if (!pair.near.empty())
      made(pair.near) = pair.from_panels * at_panels[pair.from];
    result(mesh_->rows(pair.to)) += made;
  }
  return result;
}

Matrix MembraneLayer::matrix() const {
  Matrix result(2 * mesh_->nodes, 2 * mesh_->nodes);
  for (std::size_t k = 0; k < own_.size(); ++k)
    result(mesh_->rows(k), mesh_->rows(k)) = mesh_->parts[k].on_nodes(own_[k]);
  for (const Pair &pair : pairs_) {
    const MembraneMesh::Part &part = mesh_->parts[pair.from];
    Matrix made = pair.from_nodes * area_.segment(part.first_node, part.nodes()).replicate(2, 1).asDiagonal();
    if (!pair.near.empty())
      made(pair.near, Eigen::all) = part.on_nodes(pair.from_panels);
    result(mesh_->rows(pair.to), mesh_->rows(pair.from)) = made;
  }
  return result;
}

} // namespace capsule
