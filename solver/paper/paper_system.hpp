#pragma once
// Section 3 of the paper, exactly: the preset numerics = "paper", baseline of every comparison.
//   Geometry (eq. 19), membrane velocity (eq. 23) and wall traction (eq. 24) are cubic B-splines; eq. 16 is
//   collocated at the nodes of the membrane and of the wall and at the axis point of the exit section; the
//   dense system of eq. 29 is factored anew for each shape. Regular elements take 5 Gauss points. On the
//   elements that end at the collocation point the kernels are split: the smooth part takes the same 5
//   points, the logarithm the 12-point rule for it. The entrance section S_E carries neither traction nor a
//   contribution of its velocity.
// Where the paper is silent:
// - The membrane's nodes are equidistant in the parameter zeta of the ellipse, hence denser where it is
//   curved; Table 1's Delta zeta = pi/N_M says the same.
// - The sizes of the wall's elements grow linearly with the distance to the lip, h = h_0 + g a; in the tube
//   they are bounded.
// - The exit's nodes are equidistant; the corner (L_P, 1) belongs to the wall.
// Positions and velocities are nodal, 2(N_M + 1): axial, then radial.
#include "case/parameters.hpp"
#include "flow/flow_state.hpp"
#include "geometry/pore.hpp"
#include "paper/paper_load.hpp"

namespace capsule {

// The sources of a boundary at the points of a rule, element after element.
struct ElementSamples {
  Vector x, r;
  Vector normal_x, normal_r; // (-r', x')/|.|
  Vector area;               // r ds and the rule's weight
};

// A boundary made of elements, with all that its integrals need.
struct ElementCurve {
  Vector x, r;                // of the nodes
  ElementSamples gauss;       // the regular rule
  ElementSamples first, last; // the logarithmic rule, graded towards the element's first and last node
};

// The rules of an element and its B-splines there.
struct ElementRules {
  UnitRule gauss, logarithm;
  ShapeTable at_gauss, at_first, at_last;
};

// A known density at the points of the three rules.
struct Density {
  LoadSamples gauss, first, last;
};

struct PaperSystem {
  double capillary_number = 0;
  double viscosity_ratio = 1;
  int membrane_elements = 0, wall_elements = 0, exit_elements = 0; // N_M, N_B, N_P
  ElementRules rules;
  PaperLoad load;
  ElementCurve wall, exit;
  Density exit_unit, exit_shear, exit_velocity; // (1, 0), (0, -4 r), (2(1 - r^2), 0)
  // Equations of the wall and the exit for the traction and the pressure; column: equation, row: unknown.
  Matrix fixed_block;
  Vector fixed_right_side;
  double empty_pressure = 0; // P_np at x = L_P, negative

  // Throws NumericsFailure if the shape makes the system singular.
  FlowState flow(const Vector &position) const;
};

// Throws InputError unless the pore is hyperbolic and the flow goes through it.
PaperSystem make_paper_system(const Pore &pore, const CapsuleSpec &capsule, const MembraneSpec &material,
                              const FlowSpec &flow, const MeshSpec &mesh);

} // namespace capsule
