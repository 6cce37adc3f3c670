#include "resolution.hpp"
#include <algorithm>
#include <cmath>
#include <numbers>

namespace capsule {

Resolution choose_resolution(const Case &physics) {
  const double digits = -std::log10(physics.accuracy);
  // The rim of a flat spheroid folds more sharply than any part of a sphere.
  const double flatness = std::max(1.0, 1 / physics.capsule.aspect_ratio);
  Resolution resolution;
  resolution.membrane_nodes =
      physics.mesh.membrane > 0
          ? physics.mesh.membrane
          : static_cast<int>(std::lround(std::max(64.0, 16 + 16 * digits) * std::sqrt(flatness)));
  const int nodes = resolution.membrane_nodes;
  resolution.energy_points = nodes * 5 / 4 + 8;
  resolution.time_tolerance = physics.time.tolerance > 0 ? physics.time.tolerance : 1e-3 * physics.accuracy;

  FlowResolution &flow = resolution.flow;
  // A panel of p Gauss points resolves about two thirds of the waves that p equidistant nodes would.
  flow.membrane_panel = 0.65 * std::numbers::pi * flow.membrane_panel_points / nodes;
  flow.near_tolerance = std::min(1e-6, 1e-3 * physics.accuracy);
  flow.wall_panel_points = digits > 5 ? 12 : 10;
  flow.lip_panel = digits > 5 ? 0.02 : 0.08;
  if (physics.mesh.wall > 0) // about two fifths of the points lie in the tube
    flow.wall_panel = physics.pore.exit_x * flow.wall_panel_points / (0.4 * physics.mesh.wall);
  else
    // A sharp rim close to the wall rides over panels that are too long: the pressure drop then oscillates.
    flow.wall_panel = std::clamp(1.15 - 0.1 * digits, 0.4, 1.0) / std::sqrt(flatness);
  return resolution;
}

} // namespace capsule
