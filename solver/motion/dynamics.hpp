#pragma once
// The equations of motion of a case, whichever numerics it asks for: position of the membrane's nodes ->
// velocity.
#include "flow/flow_state.hpp"
#include "flow/recycled_solver.hpp"
#include "scene/scene.hpp"
#include <functional>
#include <memory>

namespace capsule {

struct Case;

struct Dynamics {
  std::shared_ptr<const Scene> scene;
  // Throw NumericsFailure when the shape is no capsule in the pore any more.
  std::function<FlowState(const Vector &position)> flow;
  // The same with the second route to the pressure drop. A row is regular if it is due whatever profiles are asked for
  // (stations.hpp): its flow is one like others, and no later flow or report depends on those of other rows.
  std::function<FlowState(const Vector &position, bool regular)> report;
  // Only of the standard preset: the membranes' load, f of flow.hpp, and its derivative with frozen nodal areas; d velocity/
  // d load, the mobility; and d velocity/d position with frozen mobility and the exact derivative of load and friction.
  std::function<Vector(const Vector &position)> load;
  std::function<Matrix(const Vector &position)> load_jacobian, mobility, jacobian;
  // What earlier shapes have left behind to speed up the next one. A march empties it where it begins, so that it depends
  // on its start alone.
  std::shared_ptr<RecycledFlow> recycled = std::make_shared<RecycledFlow>();
};

// Builds what stays fixed: reference shape, matrices, the wall's factors and the empty pore's flow.
Dynamics make_dynamics(const Case &physics);

} // namespace capsule
