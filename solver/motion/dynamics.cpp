#include "motion/dynamics.hpp"
#include "membrane/load.hpp"
#include "motion/stops.hpp"
#include "paper/paper_system.hpp"
#include "scene/make_flow.hpp"
#include <utility>
#include <vector>

namespace capsule {
namespace {

// The integrator tries a shorter step first, and the march fails if none helps.
constexpr Advice advice{.at_the_wall = touching_advice, .at_the_end = "move pore.exit_x away"};

// The loads of all membranes of a scene.
struct Loads {
  std::shared_ptr<const Scene> scene;
  std::vector<std::vector<Eigen::Index>> rows; // of each membrane
  std::vector<double> capillary_numbers;

  Vector f(const Vector &position) const { // of flow.hpp
    Vector all(position.size());
    for (std::size_t k = 0; k < rows.size(); ++k)
      all(rows[k]) = membrane_load(scene->membrane_of(k), position(rows[k])) / capillary_numbers[k];
    return all;
  }
  Matrix frozen_jacobian(const Vector &position) const { // load.hpp
    Matrix all = Matrix::Zero(position.size(), position.size());
    for (std::size_t k = 0; k < rows.size(); ++k)
      all(rows[k], rows[k]) =
          frozen_load_jacobian(scene->membrane_of(k), position(rows[k]), capillary_numbers[k]);
    return all;
  }
};

Dynamics standard_dynamics(const Case &physics) {
  Dynamics dynamics;
  dynamics.scene = std::make_shared<const Scene>(make_scene(physics));
  const auto scene = dynamics.scene;
  std::vector<MembraneInFlow> membranes;
  Loads loads{scene, rows_of_capsules(*scene), {}};
  for (const Case *capsule : capsules_of(physics)) {
    membranes.push_back({scene->membrane_of(membranes.size()).basis, choose_resolution(*capsule).flow,
                         capsule->flow.viscosity_ratio, capsule->membrane.viscosity});
    loads.capillary_numbers.push_back(capsule->flow.capillary_number);
  }
  const auto flow = std::make_shared<const Flow>(make_flow(scene->pore, physics.flow, membranes));
  const auto recycled = dynamics.recycled;
  const FlowType type = physics.flow.type;
  const auto f = [loads](const Vector &position) { return loads.f(position); };
  dynamics.flow = [type, flow, scene, f, recycled](const Vector &position) {
    require_capsules(*scene, position, advice);
    return flow->solve(flow->interact(place_in_flow(type, position)), f(position), recycled->velocity);
  };
  dynamics.report = [type, flow, scene, f, recycled](const Vector &position, bool regular) {
    require_capsules(*scene, position, advice);
    const Interaction interaction = flow->interact(place_in_flow(type, position));
    const Vector load = f(position);
    RecycledFlow copy;
    if (!regular)
      copy = *recycled;
    RecycledFlow &used = regular ? *recycled : copy;
    FlowState state = flow->solve(interaction, load, used.velocity);
    state.pressure_shares = flow->reciprocal_pressure_drops(interaction, load, state, used.traction);
    state.pressure_drop_reciprocal = state.pressure_shares.sum();
    return state;
  };
  dynamics.load = f;
  dynamics.load_jacobian = [loads](const Vector &position) { return loads.frozen_jacobian(position); };
  dynamics.mobility = [flow, recycled](const Vector &position) {
    return flow->rough_mobility(flow->interact(position), recycled->velocity);
  };
  dynamics.jacobian = [flow, loads, recycled](const Vector &position) -> Matrix {
    const Interaction interaction = flow->interact(position);
    const Matrix mobility = flow->mobility(interaction, recycled->velocity);
    Matrix load = loads.frozen_jacobian(position);
    if (flow->has_friction()) {
      Recycled copy = recycled->velocity;
      load -=
          flow->friction_jacobian(interaction, flow->solve(interaction, loads.f(position), copy).velocity);
    }
    return times_blocks(mobility, load, loads.rows);
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
