#include "scene/cost.hpp"
#include "case/case.hpp"
#include "membrane/surface_viscosity.hpp"
#include "scene/resolution.hpp"
#include <algorithm>
#include <cmath>
#include <limits>

namespace capsule {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

} // namespace

double estimated_seconds(const Case &physics) {
  const Resolution chosen = choose_resolution(physics);
  const UntilSpec &until = physics.until;
  const double last_start = capsules_of(physics).back()->capsule.start_x;
  double way = until.x_g.value_or(until.last_x_g ? infinite : 11.84) - physics.capsule.start_x;
  way = std::min(way, until.last_x_g.value_or(infinite) - last_start);
  // An entrance of the paper takes 1.6 units of time per length.
  const double duration = std::min(1.6 * way, until.time.value_or(infinite));
  if (physics.numerics == Numerics::paper) {
    // Nearly all of a step is the LU decomposition of eq. 29.
    const double unknowns = chosen.membrane_nodes + std::max(physics.mesh.wall, 120);
    return duration / physics.time.step * 4e-3 * std::pow(unknowns / 180, 3);
  }
  const double size = std::pow(chosen.membrane_nodes / 96.0, 3);
  if (physics.time.scheme != Scheme::bdf) {
    const double stages = physics.time.scheme == Scheme::euler ? 1 : 4;
    return 1.6 * stages * 3e-3 * size * duration / physics.time.step;
  }
  const bool velocity_is_explicit =
      physics.flow.viscosity_ratio == 1 && !is_viscous(physics.membrane.viscosity);
  const double whole_entrance = velocity_is_explicit ? 0.7 : 2;
  const auto others = static_cast<double>(physics.followers.size());
  constexpr double of_a_pair = 0.15; // of the cost of one: each acts on each
  return (1 + others) * (1 + of_a_pair * others) * whole_entrance *
         std::pow(chosen.membrane_nodes / 64.0, 2) * duration / 25;
}

double seconds_of_search(double work) {
  constexpr double linearisation = 5e-3; // on 48 nodes
  return linearisation * work;
}

} // namespace capsule
