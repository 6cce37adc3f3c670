#pragma once
// The electric resistance of a pore with membranes in it. The liquid conducts, wall and membranes insulate, the
// electrodes are far away on both sides. Resistances are in units of rho/(pi R_t), the resistivity over pi R_t: that of a
// pore radius of empty tube is 1.
//   With the current that has the field 1 in the empty tube, the potential is u_0 without and u = u_0 + w with membranes.
// Laplace's equation, as integrals over wall B and membranes M (9.1 of paper-notes/equations.md), leaves
//   0 = A (w on B; w_+) + D_BM u,   u_0 = (1/2 + D_MM) u + D_MB (w; w_+)
// The membranes change the resistance by w_+, the disturbance far away in the tube, where the wall goes on without end
// behind a section; at the other end w vanishes. A is of the second kind and inverted once.
#include "flow/membrane_mesh.hpp"
#include "flow/outlet.hpp"
#include "geometry/pore.hpp"

namespace capsule {

// Potentials are smoother than tractions: a resolution with as many digits of the resistance as one has of the flow.
FlowResolution conductor_resolution(FlowResolution resolution);

class Conductor {
public:
  // On a wall that goes on further than the pore.
  Conductor(const Pore &pore, const FlowResolution &resolution);

  // Between the electrodes and the end of the pore; of a tube between its ends.
  double empty_resistance() const { return empty_resistance_; }
  // What the membranes add at a position, 2N. Throws NumericsFailure("unresolved") if their potential is not found.
  double change(const MembraneMesh &mesh, const Vector &position) const;

private:
  RowMatrix response(const Targets &points) const;
  Vector behind_section(const Targets &points) const;
  Vector source_of_current(const Targets &points) const;

  double tolerance_; // of near panels and of potentials
  Curve wall_;
  FixedNearRule near_;
  Outlet section_;    // behind which the wall has no end
  Curve cap_;         // that closes the reservoir
  Targets points_;    // of the equations: the wall's and the one of w_+
  RowMatrix inverse_; // A^(-1)
  Vector base_;       // u_0 on the wall and behind the section; empty where u_0 = x
  double empty_resistance_ = 0;
};

} // namespace capsule
