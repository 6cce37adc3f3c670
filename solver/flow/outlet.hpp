#pragma once
// The section through which the liquid leaves the pore, S_P. It borders the wall's matrix A of (3.1) with one
// column, the pressure P' of the disturbance there, and one row, an equation for the velocity at some points. What is
// known of the undisturbed flow at unit flow rate on the section adds to that flow everywhere.
//   The plane section of eqs. 14 and 15: Poiseuille's flow is known on it, the row is the axial velocity at its centre.
//   The cap of a sphere behind a second mouth: nothing is known of the flow there but its rate, pi. The column is the jump
// of the pressure on a cap that lets the liquid through, as if a pump stood there; both reservoirs are at rest and have no
// pressure far away. The row is the flux through the cap: the column transposed. The wall goes on, at least to twice
// the distance: at its free end the flow's error is largest, and the flux would sum it.
// Velocities: 2 n, axial, then radial; tractions are those on the liquid, with the normal out of it, scaled as in
// undisturbed.hpp. Throws nothing.
#include "geometry/pore.hpp"
#include "integrals/layer_potential.hpp"

namespace capsule {

struct Outlet {
  Curve curve; // from the wall to the axis
  // What is known of the undisturbed flow: the traction besides the uniform pressure, and the velocity, 2 m; or nothing.
  Vector base_traction, base_velocity;
  Targets row_points; // where the row asks for the velocity, and the weights of both components there
  Vector row_weights;
  double base_row = 0; // what the row says of the undisturbed flow's layers
  NearRule near;       // of the curve's panels

  // The single layer of the section at any points, 2 n x 2 m, from which the other two follow.
  RowMatrix single_layer(const Targets &points) const;
  // Velocity made by the pressure P' = 1, and by what is known of the undisturbed flow.
  Vector column(const RowMatrix &single) const;
  Vector base_field(const Targets &points, const RowMatrix &single) const;
  // The row for point forces on rings (ring_stokeslet), or for velocities with normals (ring_stresslet): axial, then
  // radial components, without weights of the rings.
  Vector row(const RingKernel &kernel, const Rings &rings) const;
};

// The pore with two mouths as far as its outlet.
Pore up_to_outlet(const Pore &pore);
// A disc across the axis at x, with the normal downstream.
Curve disc_at(double x, double radius);
// The part of a sphere that closes the reservoir behind a second mouth where the wall ends: from the wall to the axis.
Curve cap_behind_exit(const Pore &pore);

Outlet make_outlet(const Pore &pore, double near_tolerance);

} // namespace capsule
