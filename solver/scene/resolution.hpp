#pragma once
// Mesh, quadrature and time tolerance, chosen from the accuracy asked for. Keys of the case override what they name.
// How the numbers were found: paper-notes/methods.md. Throws nothing.
#include "flow/flow_resolution.hpp"

namespace capsule {

struct Case;

struct Resolution {
  int membrane_nodes = 64; // N
  double clustering = 0;   // of the nodes where the rear of a flat capsule folds, 1 - A/B
  int energy_points = 160; // where the elastic energy is sampled
  int wall_points = 400;   // N_B, about
  FlowResolution flow;
  double time_tolerance = 1e-6; // absolute error of the nodes' positions in a step
};

Resolution choose_resolution(const Case &physics);

} // namespace capsule
