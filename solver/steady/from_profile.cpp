#include "steady/from_profile.hpp"
#include "base/failure.hpp"
#include "geometry/quadrature.hpp"
#include "steady/newton.hpp"
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
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

// From a shape that is too far off for Newton's method, the way that it takes itself with equal viscosities: implicit
// steps in time, which get longer as the motion dies away, until they are Newton's.
Vector relaxed(SteadySystem &system, Vector shape, const Control &control) {
  constexpr int most_steps = 100;
  constexpr double first_step = 0.1, shortest_step = 1e-5, long_step = 100;
  constexpr double intended = 0.2, too_much = 0.6; // part of the motion that its linearisation misses
  const Eigen::Index n2 = 2 * system.nodes();
  shape.head(n2 / 2).array() -= system.residual(shape)[n2]; // its centre to where the equations want it
  system.fit_tube(shape);
  SteadySystem::Linearisation linear = system.linearise(shape);
  double step = first_step;
  for (int k = 0; k < most_steps && step > shortest_step; ++k) {
    throw_if_interrupted(control);
    Matrix implicit = linear.jacobian;
    implicit.diagonal().head(n2).array() -= 1 / step;
    const Vector change = implicit.partialPivLu().solve(-linear.residual);
    double error = std::numeric_limits<double>::infinity();
    std::optional<SteadySystem::Linearisation> next;
    if (system.admissible_step(shape, change) == 1)
      try {
        system.fit_tube(shape + change);
        next = system.linearise(shape + change);
        error = (next->residual - change / step).head(n2).cwiseAbs().maxCoeff() /
                linear.residual.head(n2).cwiseAbs().maxCoeff();
      } catch (const NumericsFailure &) { // no capsule: the step is too long
      }
    if (error < too_much) {
      shape += change;
      linear = std::move(*next);
      if (step > long_step)
        return shape;
    }
    step *= std::clamp(std::sqrt(intended / error), 0.25, 3.0);
  }
  throw NumericsFailure("unresolved", "the profile to begin with does not come to rest in the tube",
                        "leave --from away, or begin with a profile of a later x_g");
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
