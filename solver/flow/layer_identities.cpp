#include "flow/layer_identities.hpp"

namespace capsule {

Matrix normals_of(const MembraneMesh &mesh, const MembraneShape &shape) {
  Matrix normals = Matrix::Zero(2 * mesh.nodes, std::ssize(mesh.parts));
  for (Eigen::Index k = 0; k < normals.cols(); ++k) {
    const MembraneMesh::Part &part = mesh.parts[static_cast<std::size_t>(k)];
    const Eigen::Index first = part.first_node, n = part.nodes();
    normals.col(k).segment(first, n) = shape.nodes.normal_x.segment(first, n);
    normals.col(k).segment(mesh.nodes + first, n) = shape.nodes.normal_r.segment(first, n);
  }
  return normals;
}

LayerIdentities layer_identities(const MembraneMesh &mesh, const MembraneShape &shape) {
  LayerIdentities identities;
  identities.normals = normals_of(mesh, shape);
  identities.fluxes = shape.nodes.area.replicate(2, 1).asDiagonal() * identities.normals;
  identities.motions = Matrix::Zero(2 * mesh.nodes, identities.normals.cols());
  identities.means = identities.motions;
  for (Eigen::Index k = 0; k < identities.motions.cols(); ++k) {
    const MembraneMesh::Part &part = mesh.parts[static_cast<std::size_t>(k)];
    const Vector area = shape.nodes.area.segment(part.first_node, part.nodes());
    identities.motions.col(k).segment(part.first_node, part.nodes()).setOnes();
    identities.means.col(k).segment(part.first_node, part.nodes()) = area / area.sum();
    identities.normals.col(k) /= area.sum();
  }
  return identities;
}

Vector LayerIdentities::with_flux(const Vector &velocity, const Vector &density) const {
  return velocity - normals * (fluxes.transpose() * (velocity + 0.5 * density));
}

Matrix LayerIdentities::double_layer(const Matrix &computed) const {
  const Matrix layer = computed + (0.5 * motions - computed * motions) * means.transpose();
  return layer - normals * (fluxes.transpose() * layer + 0.5 * fluxes.transpose());
}

Matrix LayerIdentities::without_flux(const Matrix &velocities) const {
  return velocities - normals * (fluxes.transpose() * velocities);
}

} // namespace capsule
