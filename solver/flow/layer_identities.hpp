#pragma once
// Two properties of the double layer D with the wall's answer that hold exactly and that quadrature loses (Pozrikidis,
// Boundary Integral and Singularity Methods for Linearized Viscous Flow, 1992, chapter 4):
//   - for a density that moves a membrane along the axis as a whole it is half of that motion on this membrane, and
//     nothing elsewhere;
//   - its flux through a membrane is minus half of the flux of the density on that membrane.
// (3.1) multiplies an error in the first by lambda and one in the second by 1/lambda: with the identities imposed, a march
// keeps its accuracy at any viscosity ratio, and the membrane its volume. Nodal fields are those of membrane_mesh.hpp,
// matrices have a column for each membrane. Throws nothing.
#include "flow/membrane_mesh.hpp"

namespace capsule {

struct LayerIdentities {
  Matrix motions, means; // motion along the axis as a whole; means^T field: the part of a field that it makes
  Matrix normals, fluxes; // fluxes^T field: the flux; that of a normal is 1

  // The part of a field that moves membranes as a whole.
  Vector whole_motion(const Vector &field) const { return motions * (means.transpose() * field); }
  // The velocity, changed along the normals until its flux is minus half of the density's.
  Vector with_flux(const Vector &velocity, const Vector &density) const;
  // A computed double layer, 2N x 2N, with both identities; velocities, 2N x n, without flux.
  Matrix double_layer(const Matrix &computed) const;
  Matrix without_flux(const Matrix &velocities) const;
};
LayerIdentities layer_identities(const MembraneMesh &mesh, const MembraneShape &shape);

// The normals of each membrane.
Matrix normals_of(const MembraneMesh &mesh, const MembraneShape &shape);

} // namespace capsule
