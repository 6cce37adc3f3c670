#include "steady/from_profile.hpp"
#include "base/failure.hpp"
#include "geometry/quadrature.hpp"
#include "geometry/sampling.hpp"
#include "steady/newton.hpp"
#include "steady/relaxation.hpp"
#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
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

// Arc length of the meridian before the flow at ascending angles from a pole on, by chords.
Vector initial_arc(const Membrane &membrane, const Vector &zeta) {
  const Eigen::Index n = membrane.basis.size();
  const Vector x = membrane.basis.even(zeta, 0, membrane.initial.head(n));
  const Vector r = membrane.basis.odd(zeta, 0, membrane.initial.tail(n));
  Vector arc = Vector::Zero(zeta.size());
  for (Eigen::Index k = 1; k < zeta.size(); ++k)
    arc[k] = arc[k - 1] + std::hypot(x[k] - x[k - 1], r[k] - r[k - 1]);
  return arc;
}

// Angles much nearer to each other than the nodes.
Vector fine_angles(const Membrane &membrane) {
  return Vector::LinSpaced(64 * membrane.basis.size() + 1, 0, std::numbers::pi);
}

// A profile's shape on the nodes, point by point of the undeformed membrane.
Vector unknowns_of(const Profile &profile, const Membrane &membrane) {
  const Eigen::Index n = membrane.basis.size();
  if (profile.S.size() < 4)
    throw InputError("error: a profile of at least four points is needed to begin with\n");
  const Vector zeta = fine_angles(membrane), arc = initial_arc(membrane, zeta);
  const Vector S = interpolated(zeta, arc, membrane.basis.nodes) *
                   ((profile.S[profile.S.size() - 1] - profile.S[0]) / arc[zeta.size() - 1]);
  Vector unknowns = Vector::Zero(2 * n + 2);
  unknowns.head(n) = interpolated(profile.S, profile.x, S).array() - profile.x_g;
  unknowns.segment(n, n) = interpolated(profile.S, profile.r, S);
  unknowns[2 * n] = profile.velocity_x.mean();
  return unknowns;
}

// As many nodes as the profile may have been computed with.
int nodes_of(const Profile &profile) {
  return std::clamp(static_cast<int>(profile.S.size() / 4), first_nodes, most_nodes);
}

// The shape on so many nodes, where it needs them.
SteadyState on_suitable_nodes(const Case &input, const Profile &profile, int nodes) {
  const auto on_nodes_of = [&](std::shared_ptr<SteadySystem> system) -> SteadyState {
    const Vector unknowns = unknowns_of(profile, system->membrane());
    return {std::move(system), unknowns};
  };
  const SteadyState even = on_nodes_of(system_on_mesh(input, spectral_basis(nodes_of(profile)).nodes));
  return on_nodes_of(system_on_mesh(input, nodes, even));
}

} // namespace

std::string other_capsule(const Case &input, const Profile &profile) {
  constexpr double same_radius = 0.01;   // a march of a loose accuracy may lose as much volume
  constexpr double same_meridian = 1e-4; // before the flow, which no march changes
  const MeridianBasis basis = spectral_basis(nodes_of(profile));
  const Membrane membrane = make_membrane(input.capsule, input.membrane, basis, basis.nodes, basis.weights);
  const Trace shape = trace(membrane.at_nodes, unknowns_of(profile, membrane).head(2 * basis.size()));
  const double volume_by_pi = (basis.weights.array() * shape.r.array().square() * shape.x_zeta.array()).sum();
  const double radius = std::cbrt(0.75 * volume_by_pi); // pi r^2 dx = 4/3 pi R^3
  const double meridian = initial_arc(membrane, fine_angles(membrane)).tail(1).value();
  const double meridian_of_profile = profile.S[profile.S.size() - 1] - profile.S[0];
  std::string differ;
  if (!(std::abs(radius / input.capsule.radius - 1) < same_radius))
    differ = fmt::format("radius {:.3g} there, {:.3g} here", radius, input.capsule.radius);
  else if (!(std::abs(meridian_of_profile / meridian - 1) < same_meridian))
    differ = fmt::format("a meridian of {:.6g} there, {:.6g} here", meridian_of_profile, meridian);
  return differ.empty() ? "" : "the profile to begin with is of another capsule: " + differ;
}

std::optional<SteadyState> solved_from_profile(const Case &input, const Profile &profile,
                                               const Control &control) {
  constexpr std::array finer{
      1.0, 1.35, 2.4}; // times the nodes of the profile: a sharp rim may need more than a march has
  constexpr double work_of_newton = 6;
  for (const double more : finer)
    try {
      const int nodes = std::min(static_cast<int>(more * nodes_of(profile)), most_nodes);
      spend(control, work_of_newton, nodes);
      SteadyState state = on_suitable_nodes(input, profile, nodes);
      state.unknowns = solve_steady(*state.system, state.unknowns);
      return state;
    } catch (const NumericsFailure &) { // a finer mesh may resolve it
    }
  return {};
}

SteadyState from_profile(const Case &input, const Profile &profile, const Control &control) {
  if (auto state = solved_from_profile(input, profile, control))
    return *state;
  SteadyState state = on_suitable_nodes(input, profile, nodes_of(profile));
  try {
    state.unknowns = solve_steady(*state.system, relaxed(*state.system, state.unknowns, control));
  } catch (const NumericsFailure &) {
    if (const std::string other = other_capsule(input, profile); !other.empty())
      throw NumericsFailure(failure_kind::unresolved, other,
                            "begin with a profile of this one, or leave --from away");
    throw;
  }
  return state;
}

} // namespace capsule
