#include "steady/mesh_change.hpp"
#include "base/failure.hpp"
#include "case/key_path.hpp"
#include "case/keys.hpp"
#include "geometry/node_density.hpp"
#include "steady/continuation.hpp"
#include "steady/newton.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace capsule {
namespace {

Resolution resolution_of(const Case &input, int nodes) {
  Case on_nodes = input;
  on_nodes.mesh.membrane = nodes;
  Resolution resolution = choose_resolution(on_nodes);
  // Newton's method needs a residual that is smooth where a panel becomes a near one.
  resolution.flow.near_tolerance = std::min(1e-9, resolution.flow.near_tolerance);
  resolution.flow.wall_panel *= std::min(1.0, 80.0 / nodes);
  return resolution;
}

// By Newton's method from the state on its own mesh.
SteadyState solved_on_mesh(const Case &input, int nodes, const SteadyState &state) {
  SteadyState moved = moved_to_mesh(input, nodes, state);
  moved.unknowns = solve_steady(*moved.system, moved.unknowns);
  return moved;
}

// Takes a state along a branch to the branch's end, on the same mesh.
void follow(const KeyPath &path, SteadyState &state, const Control &control) {
  constexpr Branch::Steps steps{.first = 0.1, .largest = 0.5, .tolerance = 1e-8};
  constexpr int most_steps = 60;
  Branch branch(*state.system, path, {state.unknowns, 0}, Branch::upwards(*state.system), steps,
                Branch::Trend::grows, control);
  for (int step = 0; branch.point().parameter < 1; ++step) {
    if (step == most_steps || branch.point().parameter < 0)
      throw NumericsFailure(failure_kind::unresolved, fmt::format("no way to {}", path.text(1)),
                            "try a finer mesh.membrane");
    branch.advance({});
  }
  state.unknowns = branch.at_parameter(1).unknowns;
}

} // namespace

std::shared_ptr<SteadySystem> system_on_mesh(const Case &input, const Vector &node_angle) {
  constexpr double longer = 1.3; // than undeformed; a tube that is too short is built again
  return std::make_shared<SteadySystem>(input, resolution_of(input, static_cast<int>(node_angle.size())),
                                        node_angle, longer * extent(input.capsule).half_length);
}

std::shared_ptr<SteadySystem> first_system(const Case &input) {
  const int nodes = input.mesh.membrane > 0 ? std::min(first_nodes, input.mesh.membrane) : first_nodes;
  return system_on_mesh(input, spectral_basis(nodes).nodes);
}

std::shared_ptr<SteadySystem> system_on_mesh(const Case &input, int nodes, const SteadyState &state) {
  constexpr double most_turning = 0.5; // of the tangent in a panel: in a fold kernels vary with it
  const Membrane &membrane = state.system->membrane();
  const Eigen::Index n = state.system->nodes();
  const Vector position = state.unknowns.head(2 * n);
  const MeridianBasis basis = spectral_basis(nodes);
  const Vector angles = suitable_angles(basis, membrane.basis, membrane.node_angle, position);
  Resolution resolution = resolution_of(input, nodes);
  resolution.flow.membrane_edges =
      halved_edges(basis, at_angles(angles, membrane.basis, membrane.node_angle, position),
                   even_membrane_edges(basis, resolution.flow.membrane_panel), most_turning);
  return std::make_shared<SteadySystem>(input, resolution, angles, position.head(n).cwiseAbs().maxCoeff());
}

int finer_mesh(int nodes) {
  constexpr double growth = 1.35;
  return static_cast<int>(std::ceil(growth * nodes));
}

Vector moved_to(const SteadySystem &to, const SteadySystem &from, const Vector &unknowns) {
  const Eigen::Index others = unknowns.size() - 2 * from.nodes();
  Vector moved(2 * to.nodes() + others);
  moved << at_angles(to.membrane().node_angle, from.membrane().basis, from.membrane().node_angle,
                     unknowns.head(2 * from.nodes())),
      unknowns.tail(others);
  return moved;
}

SteadyState moved_to_mesh(const Case &input, int nodes, const SteadyState &state) {
  const auto system = system_on_mesh(input, nodes, state);
  return {system, moved_to(*system, *state.system, state.unknowns)};
}

// A folded shape that its mesh hardly resolves is a poor guess on another mesh. The folds of a stiffer membrane are
// wider: there the mesh is changed.
SteadyState on_mesh(const Case &input, int nodes, const SteadyState &state, const Control &control) {
  try {
    return solved_on_mesh(input, nodes, state);
  } catch (const NumericsFailure &) {
    const double bending = input.membrane.bending_ratio;
    for (const double factor : {4, 16, 64})
      try {
        const KeyPath stiffer(bending_key, input, factor * std::max(bending, 1e-6));
        SteadyState moved{std::make_shared<SteadySystem>(*state.system), state.unknowns};
        follow(stiffer, moved, control);
        moved = solved_on_mesh(stiffer.at(1), nodes, moved);
        follow(KeyPath(bending_key, stiffer.at(1), bending), moved, control);
        return moved;
      } catch (const NumericsFailure &) {
        continue;
      }
    throw;
  }
}

int nodes_of(const CoarserMesh &mesh, Eigen::Index finer) {
  return std::max(3, static_cast<int>(mesh.nodes * static_cast<double>(finer)));
}

SteadyState moved_to_coarser(const SteadyState &state, const CoarserMesh &mesh) {
  const SteadySystem &system = *state.system;
  const Membrane &membrane = system.membrane();
  const int nodes = nodes_of(mesh, system.nodes());
  const Vector even = spectral_basis(nodes).nodes;
  const Vector angles = even + membrane.basis.odd(even, 0, membrane.node_angle - membrane.basis.nodes);
  Resolution resolution = resolution_of(system.input(), nodes);
  resolution.flow = system.resolution().flow;
  resolution.flow.wall_panel *= mesh.longer;
  const double tip = state.unknowns.head(system.nodes()).cwiseAbs().maxCoeff();
  const auto coarser = std::make_shared<SteadySystem>(system.input(), resolution, angles, tip);
  return {coarser, moved_to(*coarser, system, state.unknowns)};
}

SteadyState on_coarser(const SteadyState &state, const CoarserMesh &mesh) {
  SteadyState moved = moved_to_coarser(state, mesh);
  moved.unknowns = solve_steady(*moved.system, moved.unknowns);
  return moved;
}

} // namespace capsule
