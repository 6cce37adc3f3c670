#include "steady/from_profile.hpp"
#include "base/failure.hpp"
#include "geometry/quadrature.hpp"
#include "steady/newton.hpp"
#include "steady/relaxation.hpp"
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace capsule {
namespace {

// Values at ascending `at` from values f at ascending S, by the cubic through the four nearest points.
Vector interpolated(const Vector &S, const Vector &f, const Vector &at) {
  Vector result(at.size());
  for (Eigen::Index i = 0; i < at.size(); ++i) {
    const Eigen::Index above = std::upper_bound(S.begin(), S.end(), at[i]) - S.begin();
    const Eigen::Index first = std::clamp<Eigen::Index>(above - 2, 0, S.size() - 4);
    const Vector four = S.segment(first, 4);
    result[i] = (lagrange_matrix(four, Vector::Constant(1, at[i])) * f.segment(first, 4)).value();
  }
  return result;
}

// A profile's shape on the nodes, point by point of the undeformed membrane.
Vector unknowns_of(const Profile &profile, const Membrane &membrane) {
  const Eigen::Index n = membrane.basis.size();
  if (profile.S.size() < 4)
    throw InputError("error: a profile of at least four points is needed to begin with\n");
  // Undeformed arc length of the nodes, by chords much shorter than the distance of the nodes.
  const Vector zeta = Vector::LinSpaced(64 * n + 1, 0, std::numbers::pi);
  const Vector x = membrane.basis.even(zeta, 0) * membrane.reference.head(n);
  const Vector r = membrane.basis.odd(zeta, 0) * membrane.reference.tail(n);
  Vector arc = Vector::Zero(zeta.size());
  for (Eigen::Index k = 1; k < zeta.size(); ++k)
    arc[k] = arc[k - 1] + std::hypot(x[k] - x[k - 1], r[k] - r[k - 1]);
  const Vector S = interpolated(zeta, arc, membrane.basis.nodes) *
                   ((profile.S[profile.S.size() - 1] - profile.S[0]) / arc[zeta.size() - 1]);
  Vector unknowns = Vector::Zero(2 * n + 2);
  unknowns.head(n) = interpolated(profile.S, profile.x, S).array() - profile.x_g;
  unknowns.segment(n, n) = interpolated(profile.S, profile.r, S);
  unknowns[2 * n] = profile.velocity_x.mean();
  return unknowns;
}

} // namespace

SteadyState from_profile(const Case &input, const Profile &profile, const Control &control) {
  const int nodes = std::clamp(static_cast<int>(profile.S.size() / 4), first_nodes, most_nodes);
  const auto on_nodes_of = [&](std::shared_ptr<SteadySystem> system) -> SteadyState {
    const Vector unknowns = unknowns_of(profile, system->membrane());
    return {std::move(system), unknowns};
  };
  const SteadyState even = on_nodes_of(system_on_mesh(input, spectral_basis(nodes).nodes));
  SteadyState state = on_nodes_of(system_on_mesh(input, nodes, even));
  try {
    state.unknowns = solve_steady(*state.system, state.unknowns);
  } catch (const NumericsFailure &) {
    state.unknowns = solve_steady(*state.system, relaxed(*state.system, state.unknowns, control));
  }
  return state;
}

} // namespace capsule
