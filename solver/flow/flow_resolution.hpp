#pragma once
// How finely the flow is resolved.
// Lengths of the wall in R_t, of a membrane in zeta.
#include "base/linear_algebra.hpp"
#include <limits>

namespace capsule {

struct FlowResolution {
  int membrane_panel_points = 12;
  double membrane_panel = 0.25; // largest panel in zeta
  Vector membrane_edges = {};   // of the panels in zeta; empty: they follow from membrane_panel
  int wall_panel_points = 12;   // even where the wall is its own mirror image (wall_inverse.hpp)
  double wall_panel = 0.75;     // largest panel in the tube
  // Of a tube without a mouth: half-width of the middle part that has panels of this length. A steady capsule
  // stays there; further out the panels double in length.
  double fine_half_length = std::numeric_limits<double>::infinity();
  double lip_panel = 0.02;         // panel at the lip
  double near_tolerance = 1e-8;    // of near panels
  double solver_tolerance = 1e-10; // relative, of velocities that are found by iteration (lambda != 1)
};

} // namespace capsule
