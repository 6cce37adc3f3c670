#include "motion/dynamics.hpp"
#include "membrane/load.hpp"
#include "paper/paper_system.hpp"
#include "scene/make_flow.hpp"
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
  const auto flow =
      std::make_shared<const Flow>(make_flow(scene->pore, physics.flow, scene->membrane.basis,
                                             choose_resolution(physics).flow, physics.membrane.viscosity));
  const auto recycled = dynamics.recycled;
  const FlowType type = physics.flow.type;
  const double capillary_number = physics.flow.capillary_number;
  const auto f = [scene, capillary_number](const Vector &position) { // of flow.hpp
    return Vector(membrane_load(scene->membrane, position) / capillary_number);
  };
  dynamics.flow = [type, flow, scene, f, recycled](const Vector &position) {
    require_capsule(scene->pore, position, advice);
    return flow->solve(flow->interact(place_in_flow(type, position)), f(position), recycled->velocity);
  };
  dynamics.report = [type, flow, f, recycled](const Vector &position, bool regular) {
    const Interaction interaction = flow->interact(place_in_flow(type, position));
    const Vector load = f(position);
    RecycledFlow copy = *recycled;
    FlowState state = flow->solve(interaction, load, copy.velocity);
    state.pressure_drop_reciprocal = flow->reciprocal_pressure_drop(interaction, load, state, copy.traction);
    if (regular)
      recycled->traction = std::move(copy.traction);
    return state;
  };
  dynamics.jacobian = [flow, scene, f, capillary_number, recycled](const Vector &position) -> Matrix {
    const Interaction interaction = flow->interact(position);
    const Matrix mobility = flow->mobility(interaction, recycled->velocity);
    Matrix load = frozen_load_jacobian(scene->membrane, position, capillary_number);
    if (flow->has_friction()) {
      Recycled copy = recycled->velocity;
      load -= flow->friction_jacobian(interaction, flow->solve(interaction, f(position), copy).velocity);
    }
    return mobility * load;
  };
  return dynamics;
}

Dynamics paper_dynamics(const Case &physics) {
  Dynamics dynamics;
  dynamics.scene = std::make_shared<const Scene>(make_scene(physics));
  const auto scene = dynamics.scene;
  const auto system = std::make_shared<const PaperSystem>(
      make_paper_system(scene->pore.value(), physics.capsule, physics.membrane, physics.flow, physics.mesh));
  dynamics.flow = [system, scene](const Vector &position) {
    require_capsule(scene->pore, position, advice);
    return system->flow(position);
  };
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
