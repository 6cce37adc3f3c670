#include "motion/dynamics.hpp"
#include "flow/flow.hpp"
#include "membrane/load.hpp"
#include "paper/paper_system.hpp"
#include <utility>

namespace capsule {
namespace {

// The integrator tries a shorter step first, and the march fails if none helps.
constexpr Advice advice{.at_the_wall = "try a smaller accuracy or a finer mesh",
                        .at_the_end = "move pore.exit_x away"};

Dynamics standard_dynamics(const Case &physics) {
  Dynamics dynamics;
  dynamics.scene = std::make_shared<const Scene>(make_scene(physics));
  const auto scene = dynamics.scene;
  const auto system =
      std::make_shared<const FlowSystem>(physics, scene->membrane.basis, choose_resolution(physics).flow);
  const auto memory = std::make_shared<FlowSystem::Memory>();
  const FlowType type = physics.flow.type;
  dynamics.forget = [memory] { *memory = {}; };
  dynamics.flow = [type, system, scene, memory](const Vector &position) {
    require_capsule(scene->pore, position, advice);
    return system->flow(system->interact(place_in_flow(type, position)),
                        membrane_load(scene->membrane, position), *memory);
  };
  dynamics.report = [type, system, scene, memory](const Vector &position, bool regular) {
    const FlowSystem::Interaction shape = system->interact(place_in_flow(type, position));
    const Vector load = membrane_load(scene->membrane, position);
    FlowSystem::Memory copy = *memory;
    FlowState state = system->flow(shape, load, copy);
    state.pressure_drop_reciprocal = system->reciprocal_pressure_drop(shape, load, state.velocity, copy);
    if (regular)
      memory->traction = std::move(copy.traction);
    return state;
  };
  dynamics.jacobian = [system, scene, memory](const Vector &position) -> Matrix {
    return system->mobility(system->interact(position), *memory) *
           frozen_load_jacobian(scene->membrane, position, 1);
  };
  return dynamics;
}

Dynamics paper_dynamics(const Case &physics) {
  Dynamics dynamics;
  dynamics.scene = std::make_shared<const Scene>(make_scene(physics));
  const auto scene = dynamics.scene;
  const auto system = std::make_shared<const PaperSystem>(make_paper_system(physics));
  dynamics.flow = [system, scene](const Vector &position) {
    require_capsule(scene->pore, position, advice);
    return system->flow(position);
  };
  dynamics.forget = [] {};
  dynamics.report = [flow = dynamics.flow](const Vector &position, bool /*regular*/) {
    return flow(position); // the second route is the standard preset's
  };
  return dynamics;
}

} // namespace

Dynamics make_dynamics(const Case &physics) {
  return physics.numerics == Numerics::paper ? paper_dynamics(physics) : standard_dynamics(physics);
}

} // namespace capsule
