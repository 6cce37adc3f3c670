#include "resolution.hpp"
#include <algorithm>
#include <cmath>
#include <numbers>

namespace capsule {

Resolution choose_resolution(const Case &physics) {
  const double digits = -std::log10(physics.accuracy);
  Resolution resolution;
  resolution.membrane_nodes =
      physics.mesh.membrane > 0 ? physics.mesh.membrane : static_cast<int>(48 + 12 * digits);
  const int nodes = resolution.membrane_nodes;
  resolution.energy_points = nodes * 5 / 4 + 8;
  FlowResolution &flow = resolution.flow;
  // A Gauss panel of p points resolves about p pi / (pi + 1) modes' half waves.
  flow.membrane_panel = 0.65 * std::numbers::pi * flow.membrane_panel_points / nodes;
  flow.near_tolerance = std::min(1e-6, physics.accuracy * 1e-3);
  resolution.time_tolerance = physics.time.tolerance > 0 ? physics.time.tolerance : 0.01 * physics.accuracy;
  return resolution;
}

} // namespace capsule
