#include "scene/scene.hpp"
#include "electric/conductor.hpp"
#include "flow/membrane_mesh.hpp"
#include "geometry/gap.hpp"
#include "geometry/quadrature.hpp"
#include "geometry/reference_shape.hpp"
#include <algorithm>
#include <cmath>
#include <iterator>
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

Membrane membrane_of(const Case &physics) {
  return physics.numerics == Numerics::paper
             ? paper_membrane(physics)
             : standard_membrane(physics.capsule, physics.membrane, choose_resolution(physics));
}

void require_apart(const MeridianBasis &ahead, const Vector &position_ahead, const MeridianBasis &behind,
                   const Vector &position_behind, std::size_t number) {
  constexpr double beyond_nodes = 0.05; // how far a pole may lie beyond the nodes
  const auto rear = position_ahead.head(ahead.size()).minCoeff();
  const auto front = position_behind.head(behind.size()).maxCoeff();
  if (front + beyond_nodes < rear - beyond_nodes)
    return;
  if (overlap(chain_of(ahead, position_ahead, 2), chain_of(behind, position_behind, 2)))
    throw NumericsFailure(failure_kind::touching,
                          fmt::format("capsules {} and {} touch, at x = {:.4g}", number, number + 1, front),
                          "try a stricter accuracy (a smaller number), or a larger distance of their starts");
}

} // namespace

Scene make_scene(const Case &physics) {
  Scene scene;
  scene.pore = make_pore(physics.pore);
  scene.membrane = membrane_of(physics);
  for (const Case &follower : physics.followers)
    scene.followers.push_back(membrane_of(follower));
  const std::vector<const Case *> capsules = capsules_of(physics);
  const std::vector<std::vector<Eigen::Index>> rows = rows_of_capsules(scene);
  Eigen::Index size = 0;
  for (const std::vector<Eigen::Index> &part : rows)
    size += std::ssize(part);
  scene.start.resize(size);
  for (std::size_t k = 0; k < capsules.size(); ++k) {
    Vector start = scene.membrane_of(k).initial;
    start.head(start.size() / 2).array() += capsules[k]->capsule.start_x;
    scene.start(rows[k]) = start;
  }
  return scene;
}

std::optional<double> empty_resistance(const Case &physics) {
  const auto pore = physics.output.resistance ? make_pore(physics.pore) : std::nullopt;
  return pore
             ? std::optional(
                   Conductor(*pore, conductor_resolution(choose_resolution(physics).flow)).empty_resistance())
             : std::nullopt;
}

std::vector<std::vector<Eigen::Index>> rows_of_capsules(const Scene &scene) {
  Eigen::Index nodes = 0;
  for (std::size_t k = 0; k < scene.capsules(); ++k)
    nodes += scene.membrane_of(k).basis.size();
  std::vector<std::vector<Eigen::Index>> rows;
  Eigen::Index first = 0;
  for (std::size_t k = 0; k < scene.capsules(); ++k) {
    const Eigen::Index n = scene.membrane_of(k).basis.size();
    rows.push_back(rows_of_part(first, n, nodes));
    first += n;
  }
  return rows;
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

double gap_without_interaction(double accuracy) {
  constexpr double decay = 4.466, amplitude = 4; // 2.3 was seen of spheres with a radius of 0.7
  return std::log(amplitude / accuracy) / decay;
}

void require_capsules(const Scene &scene, const Vector &position, const Advice &advice) {
  if (scene.capsules() == 1)
    return require_capsule(scene.pore, position, advice);
  const std::vector<std::vector<Eigen::Index>> rows = rows_of_capsules(scene);
  for_each_capsule(scene, [&](std::size_t k) { require_capsule(scene.pore, position(rows[k]), advice); });
  for (std::size_t k = 1; k < rows.size(); ++k)
    require_apart(scene.membrane_of(k - 1).basis, position(rows[k - 1]), scene.membrane_of(k).basis,
                  position(rows[k]), k);
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
