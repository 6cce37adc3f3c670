#include "scene/resolution.hpp"
#include "case/case.hpp"
#include <algorithm>
#include <cmath>
#include <numbers>

namespace capsule {

Resolution choose_resolution(const Case &physics) {
  const double digits = -std::log10(physics.accuracy);
  const double aspect = aspect_ratio(physics.capsule);
  // The rim of a flat spheroid folds more sharply than any part of a sphere, as does the rear of a long one. One that is
  // wider than the tube rides closer to the wall: over panels that are too long the pressure drop oscillates.
  const double elongation = std::max(aspect, 1 / aspect);
  // A thin inner liquid lets the rear fold in more quickly and more sharply.
  const double thin_liquid = 1 + 0.5 * std::clamp(-std::log10(physics.flow.viscosity_ratio), 0.0, 1.0);
  const bool tight = extent(physics.capsule).half_width > 0.95;
  Resolution resolution;
  resolution.membrane_nodes =
      physics.mesh.membrane > 0
          ? physics.mesh.membrane
          : static_cast<int>(std::lround((20 - 5.5 * std::max(0.0, 1 - aspect)) * std::max(digits, 2.8) *
                                         std::pow(elongation, 0.72) * thin_liquid));
  if (physics.flow.type == FlowType::pore) // an extension folds no rear
    resolution.clustering = std::max(0.0, 1 - aspect);
  const int nodes = resolution.membrane_nodes;
  resolution.energy_points = nodes * 5 / 4 + 8;
  resolution.time_tolerance =
      physics.time.tolerance > 0 ? physics.time.tolerance : 1e-3 * std::min(physics.accuracy, 2e-3);

  FlowResolution &flow = resolution.flow;
  // A panel of p Gauss points resolves about two thirds of the waves that p equidistant nodes would.
  flow.membrane_panel = 0.65 * std::numbers::pi * flow.membrane_panel_points / nodes;
  flow.near_tolerance = std::min(1e-6, 1e-3 * physics.accuracy);
  if (physics.time.scheme == Scheme::bdf)
    flow.solver_tolerance = 0.03 * resolution.time_tolerance;
  flow.wall_panel_points = digits > 4.5 || (tight && digits > 2.5) ? 12 : digits > 2.5 || tight ? 10 : 8;
  flow.lip_panel = digits > 5 ? 0.02 : digits > 3.5 ? 0.08 : digits > 2.5 ? 0.16 : 0.32;
  // About two fifths of the wall's points lie in the tube, a quarter between two mouths.
  const double in_tube = physics.pore.shape == PoreShape::two_mouths ? 0.25 : 0.4;
  const double tube_points = physics.pore.exit_x * flow.wall_panel_points;
  const double panel = std::clamp(1.15 - 0.1 * digits, 0.4, 0.8) - (tight ? 0.25 : 0);
  resolution.wall_points = physics.mesh.wall > 0
                               ? physics.mesh.wall
                               : static_cast<int>(std::lround(tube_points / (in_tube * panel)));
  flow.wall_panel = tube_points / (in_tube * resolution.wall_points);
  return resolution;
}

} // namespace capsule
