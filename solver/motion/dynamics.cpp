#include "motion/dynamics.hpp"
#include "base/failure.hpp"
#include "flow/flow.hpp"
#include "geometry/pore.hpp"
#include "geometry/quadrature.hpp"
#include "geometry/reference_shape.hpp"
#include "membrane/load.hpp"
#include "paper/paper_system.hpp"
#include "scene/resolution.hpp"
#include <algorithm>
#include <memory>
#include <numbers>
#include <optional>
#include <utility>

namespace capsule {
namespace {

Vector start_position(const Membrane &membrane, double start_x) {
  Vector start = membrane.reference;
  start.head(membrane.basis.size()).array() += start_x;
  return start;
}

// Where the flow finds the membrane. In an extension the centre of the flow moves with the capsule: it is an unstable
// place to be, and rounding errors would grow as exp(t).
Vector place_in_flow(const Case &physics, Vector position) {
  if (physics.flow.type == FlowType::extension) {
    auto x = position.head(position.size() / 2);
    x.array() -= x.mean();
  }
  return position;
}

// How close to the sections at the pore's ends a membrane may come; their flow is assumed to be Poiseuille's.
constexpr double section_margin = 0.1;

// What no flow can be computed for: the integrator then tries a shorter step, and the march fails if none
// helps.
void require_capsule(const std::optional<Pore> &pore, const Vector &position) {
  const Eigen::Index n = position.size() / 2;
  if (!position.allFinite())
    throw NumericsFailure("not-a-number", "the membrane's position is not a number",
                          "try a finer mesh.membrane");
  if (position.tail(n).minCoeff() < 0)
    throw NumericsFailure("folded", "the membrane crosses the axis", "try a larger membrane.bending_ratio");
  if (!pore)
    return;
  if (position.head(n).maxCoeff() > pore->exit_x - section_margin ||
      (pore->shape == PoreShape::tube &&
       position.head(n).minCoeff() < section_margin - pore->entrance_distance))
    throw NumericsFailure("exit", "the membrane reaches the end of the pore", "move pore.exit_x away");
  for (Eigen::Index k = 0; k < n; ++k)
    if (position[n + k] >= wall_radius(*pore, position[k]))
      throw NumericsFailure("touching", "the membrane touches the wall",
                            "try a smaller accuracy or a finer mesh");
}

Dynamics standard_dynamics(const Case &physics) {
  const Resolution resolution = choose_resolution(physics);
  Dynamics dynamics;
  dynamics.membrane = standard_membrane(physics, resolution);
  dynamics.start = start_position(dynamics.membrane, physics.capsule.start_x);
  const auto system = std::make_shared<const FlowSystem>(physics, dynamics.membrane.basis, resolution.flow);
  const auto membrane = std::make_shared<const Membrane>(dynamics.membrane);
  std::optional<Pore> pore;
  if (physics.pore.shape != PoreShape::none)
    pore = make_pore(physics.pore);
  const auto memory = std::make_shared<FlowSystem::Memory>();
  dynamics.forget = [memory] { *memory = {}; };
  dynamics.flow = [physics, system, membrane, pore, memory](const Vector &position) {
    require_capsule(pore, position);
    return system->flow(system->interact(place_in_flow(physics, position)),
                        membrane_load(*membrane, position), *memory);
  };
  dynamics.report = [physics, system, membrane, memory](const Vector &position, bool regular) {
    const FlowSystem::Interaction shape = system->interact(place_in_flow(physics, position));
    const Vector load = membrane_load(*membrane, position);
    FlowSystem::Memory copy = *memory;
    FlowState state = system->flow(shape, load, copy);
    state.pressure_drop_reciprocal = system->reciprocal_pressure_drop(shape, load, state.velocity, copy);
    if (regular)
      memory->traction = std::move(copy.traction);
    return state;
  };
  dynamics.jacobian = [system, membrane, memory](const Vector &position) -> Matrix {
    return system->mobility(system->interact(position), *memory) *
           frozen_load_jacobian(*membrane, position, 1);
  };
  return dynamics;
}

Dynamics paper_dynamics(const Case &physics) {
  constexpr int cubic = 3;
  const MeridianBasis basis = spline_basis(physics.mesh.membrane, cubic);
  const Panels elements = make_panels(Vector::LinSpaced(basis.size(), 0, std::numbers::pi), 5);
  Dynamics dynamics;
  dynamics.membrane =
      make_membrane(physics.capsule, physics.membrane, basis, elements.points, elements.weights);
  dynamics.start = start_position(dynamics.membrane, physics.capsule.start_x);
  const auto system = std::make_shared<const PaperSystem>(make_paper_system(physics));
  const Pore pore = make_pore(physics.pore);
  dynamics.flow = [system, pore](const Vector &position) {
    require_capsule(pore, position);
    return system->flow(position);
  };
  dynamics.forget = [] {};
  dynamics.report = [flow = dynamics.flow](const Vector &position, bool /*regular*/) {
    return flow(position); // the second route is the standard preset's
  };
  return dynamics;
}

} // namespace

Membrane standard_membrane(const Case &physics, const Resolution &resolution) {
  const MeridianBasis energy_rule = spectral_basis(resolution.energy_points);
  Membrane membrane =
      make_membrane(physics.capsule, physics.membrane, spectral_basis(resolution.membrane_nodes),
                    energy_rule.nodes, energy_rule.weights);
  membrane.node_angle = clustered_angles(membrane.basis.nodes, resolution.clustering);
  set_material(physics.capsule, physics.membrane, membrane);
  return membrane;
}

Dynamics make_dynamics(const Case &physics) {
  return physics.numerics == Numerics::paper ? paper_dynamics(physics) : standard_dynamics(physics);
}

} // namespace capsule
