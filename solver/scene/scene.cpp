#include "scene/scene.hpp"
#include "base/failure.hpp"
#include "geometry/quadrature.hpp"
#include "geometry/reference_shape.hpp"
#include <numbers>

namespace capsule {
namespace {

constexpr double section_margin = 0.1;

// Cubic splines; the energy is sampled as the paper's load is, at five Gauss points of each element.
Membrane paper_membrane(const Case &physics) {
  const MeridianBasis basis = spline_basis(physics.mesh.membrane);
  const Panels elements = make_panels(Vector::LinSpaced(basis.size(), 0, std::numbers::pi), 5);
  return make_membrane(physics.capsule, physics.membrane, basis, elements.points, elements.weights);
}

Vector start_position(const Membrane &membrane, double start_x) {
  Vector start = membrane.initial;
  start.head(membrane.basis.size()).array() += start_x;
  return start;
}

} // namespace

Scene make_scene(const Case &physics) {
  Scene scene;
  scene.pore = make_pore(physics.pore);
  scene.membrane = physics.numerics == Numerics::paper
                       ? paper_membrane(physics)
                       : standard_membrane(physics.capsule, physics.membrane, choose_resolution(physics));
  scene.start = start_position(scene.membrane, physics.capsule.start_x);
  return scene;
}

Membrane standard_membrane(const CapsuleSpec &capsule, const MembraneSpec &material,
                           const Resolution &resolution) {
  const MeridianBasis energy_rule = spectral_basis(resolution.energy_points);
  Membrane membrane = make_membrane(capsule, material, spectral_basis(resolution.membrane_nodes),
                                    energy_rule.nodes, energy_rule.weights);
  membrane.node_angle = clustered_angles(membrane.basis.nodes, resolution.clustering);
  set_material(capsule, material, membrane);
  return membrane;
}

Vector place_in_flow(FlowType flow, Vector position) {
  if (flow == FlowType::extension) {
    auto x = position.head(position.size() / 2);
    x.array() -= x.mean();
  }
  return position;
}

void require_capsule(const std::optional<Pore> &pore, const Vector &position, const Advice &advice) {
  const Eigen::Index n = position.size() / 2;
  if (!position.allFinite())
    throw NumericsFailure(failure_kind::not_a_number, "the membrane's position is not a number",
                          "try a finer mesh.membrane");
  if (position.tail(n).minCoeff() < 0)
    throw NumericsFailure(failure_kind::folded, "the membrane crosses the axis",
                          "try a larger membrane.bending_ratio");
  if (!pore)
    return;
  if (position.head(n).maxCoeff() > pore->end_of_way - section_margin ||
      (pore->shape == PoreShape::tube &&
       position.head(n).minCoeff() < section_margin - pore->entrance_distance))
    throw NumericsFailure(failure_kind::exit, "the membrane reaches the end of the pore", advice.at_the_end);
  for (Eigen::Index k = 0; k < n; ++k)
    if (position[n + k] >= wall_radius(*pore, position[k]))
      throw NumericsFailure(failure_kind::touching, "the membrane touches the wall", advice.at_the_wall);
}

} // namespace capsule
