#pragma once
// Meshes for steady states, and steady states moved from one mesh to another. A mesh is a number of nodes, and the
// angles on the undeformed capsule at which they lie: evenly at first, then where a shape needs them
// (node_density.hpp). Throws NumericsFailure("unresolved") where no state is found on a mesh.
#include "observe/outcome.hpp"
#include "steady/steady_system.hpp"
#include <memory>

namespace capsule {

constexpr int first_nodes = 48; // of a shape without folds
constexpr int most_nodes = 420;

struct SteadyState {
  std::shared_ptr<SteadySystem> system; // with the parameters of the state
  Vector unknowns;
};

// The equations of a case with a node at each of these angles.
std::shared_ptr<SteadySystem> system_on_mesh(const Case &input, const Vector &node_angle);
// ... on the first mesh: even, and no finer than the case's.
std::shared_ptr<SteadySystem> first_system(const Case &input);
// ... on so many nodes, which lie where the shape of a state near by needs them.
std::shared_ptr<SteadySystem> system_on_mesh(const Case &input, int nodes, const SteadyState &state);

// How many nodes the next finer mesh has.
int finer_mesh(int nodes);

// Unknowns, or changes of them, on another system's nodes. What follows the positions stays as it is: speed, slack, and
// the parameter of a branch.
Vector moved_to(const SteadySystem &to, const SteadySystem &from, const Vector &unknowns);

// A state on so many nodes, not solved for: a guess.
SteadyState moved_to_mesh(const Case &input, int nodes, const SteadyState &state);
// The state itself on so many nodes; if need be by way of a stiffer membrane.
SteadyState on_mesh(const Case &input, int nodes, const SteadyState &state, const Control &control = {});
// A mesh that is coarser than another one: it has a share of the nodes, and the panels of its tube are so many times longer.
struct CoarserMesh {
  double nodes = 1, longer = 1;
};
int nodes_of(const CoarserMesh &mesh, Eigen::Index finer);
// The state itself on a coarser mesh, whose nodes are spread as its own are, whatever they suit; the other is the guess for
// that.
SteadyState on_coarser(const SteadyState &state, const CoarserMesh &mesh);
SteadyState moved_to_coarser(const SteadyState &state, const CoarserMesh &mesh);

} // namespace capsule
