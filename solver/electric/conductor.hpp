#pragma once
// The electric resistance of a pore with membranes in it. The liquid conducts, wall and membranes insulate, the
// electrodes are far away on both sides. Resistances are in units of rho/(pi R_t), the resistivity over pi R_t: that of a
// pore radius of empty tube is 1.
//   With the current that has the field 1 in the empty tube, the potential is u_0 without and u = u_0 + w with membranes.
// Laplace's equation, as integrals over wall B and membranes M (9.1 of paper-notes/equations.md), leaves
//   0 = A (w on B; w_+) + D_BM u,   u_0 = (1/2 + D_MM) u + D_MB (w; w_+)
// The membranes change the resistance by w_+, the disturbance far away behind a section: in the tube, where the wall goes
// on without end, or behind a second mouth, where the section is a cap. At the other end w vanishes. The last row of A says
// that w carries no current: w_+ on the section itself, or behind a second mouth, where the potential of a current fades,
// no flux through a circle around the tube. A is of the second kind and inverted once; distant panels of the wall are
// joined (joined_panels.hpp). Membranes act on what is far from them by the rule on their nodes.
#include "electric/solid_harmonics.hpp"
#include "flow/joined_panels.hpp"
#include "flow/outlet.hpp"
#include "geometry/pore.hpp"
#include <optional>
#include <vector>

namespace capsule {

// Potentials are smoother than tractions: a resolution with as many digits of the resistance as one has of the flow.
FlowResolution conductor_resolution(FlowResolution resolution);
// Two points less on each panel: the error is then larger (methods.md), where with fewer nodes and longer panels in the tube, all
// that the companion of a march has, it is the same, as it is made at the lips.
FlowResolution coarser_conductor(FlowResolution resolution);

class Conductor {
public:
  // On a wall that goes on further than the pore.
  Conductor(const Pore &pore, const FlowResolution &resolution);

  // Between the electrodes and the end of the pore, or the electrodes behind it; of a tube between its ends.
  double empty_resistance() const { return empty_resistance_; }
  // What the membranes add at a position, 2N. It depends on the position alone. Throws NumericsFailure("unresolved") if
  // their potential is not found.
  double change(const MembraneMesh &mesh, const Vector &position) const;

private:
  // A section that the current passes evenly at the empty pore's end, with the normal into the liquid, and the difference of
  // u_0 there from what it is far behind it.
  struct Electrode {
    Curve section;
    FixedNearRule near;
    double field = 1, potential = 0;
    SolidHarmonics sources, dipoles; // of a cap, which is far away from the pore
    // The layer of 1 on the section.
    Vector layer(const RingKernel &kernel, const Targets &points) const;
  };
  Electrode cap_electrode(Curve cap, double centre_x, double middle) const;

  // Around the tube, in the solid: the flux through it is the tube's.
  struct Circle {
    double x, radius;
  };

  // The wall, or what a place feels of it. Its unknowns are dipoles, potentials times area, and w_+.
  struct Surface {
    Panels along;
    Curve wall;
    FixedNearRule near;
    Targets points;    // of the equations, but for that of the circle
    RowMatrix inverse; // equations -> unknowns
    Vector base;       // unknowns of u_0; empty where u_0 = x
  };

  // Between surface and membranes.
  struct Coupling {
    RowMatrix to_nodes;   // the surface's unknowns -> potential at the nodes
    RowMatrix from_nodes; // nodes x equations: dipoles at the nodes -> left sides, by the rule on the nodes
    Vector area;          // its weights
    std::vector<Eigen::Index> near; // equations that are too near for it
    RowMatrix from_panels;          // these, from the quadrature points
    // The left sides from the membranes' potential.
    Vector at_wall(const Vector &potential, const Vector &on_panels) const;
  };

  const Surface &felt_by(const MembraneMesh &mesh, const Vector &position) const;
  Coupling couple(const Surface &surface, const MembraneMesh &mesh, const MembraneShape &shape) const;
  Vector source_in_equations() const;
  Vector flux_of_dipoles(const Curve &dipoles) const;
  double flux_of_sources(const Curve &sources) const;
  Vector behind_section(const Targets &points) const;
  Vector source_of_current(const Targets &points, const Vector &behind_section) const;

  double tolerance_;             // of near panels and of potentials
  Electrode out_, in_;           // behind the section out_ the wall has no end; none closes a tube
  std::optional<Circle> circle_; // of the last equation, which is that of a point otherwise
  Surface whole_;
  mutable std::vector<Surroundings> place_; // the last one
  mutable Surface felt_;                    // there
  double empty_resistance_ = 0;
};

} // namespace capsule
