#include "flow/flow.hpp"
#include "base/failure.hpp"
#include "flow/reciprocal.hpp"
#include <algorithm>
#include <numbers>
#include <stdexcept>
#include <utility>

namespace capsule {
namespace {

// A layer without the wall, with what the wall answers to it.
template <class Answer>
Matrix with_wall(Matrix layer, const Answer &answer_of_wall, const Matrix &at_wall) {
  using Scalar = typename Answer::Scalar;
  const Answer answer = answer_of_wall * at_wall.cast<Scalar>();
  layer -= answer.template cast<double>();
  return layer;
}

template <class Answer>
Matrix single_with_wall(const Interaction &interaction, const Answer &answer_of_wall) {
  return stokeslet_factor *
         with_wall(interaction.single_layer(), answer_of_wall, interaction.single_at_wall());
}

template <class Answer>
Matrix double_with_wall(const Interaction &interaction, const Answer &answer_of_wall) {
  return with_wall(interaction.double_layer(), answer_of_wall, interaction.double_at_wall());
}

} // namespace

NodalLayers nodal_layers(const Interaction &interaction) {
  return {stokeslet_factor * interaction.single_layer(), interaction.answer_of_wall(),
          stokeslet_factor * interaction.single_at_wall(), interaction.double_at_wall()};
}

Vector NodalLayers::velocity_of(const Vector &load) const {
  Vector velocity = single * load;
  if (answer.cols() > 0) // BLAS takes no matrix without columns
    velocity -= answer * (single_at_wall * load);
  return velocity;
}

Matrix NodalLayers::single_with_wall() const {
  return single - answer * single_at_wall;
}

Matrix NodalLayers::double_with_wall(const Matrix &double_layer) const {
  return double_layer - answer * double_at_wall;
}

Flow::Flow(Wall wall, MembraneMesh mesh, const FlowParameters &parameters, double solver_tolerance)
    : wall_(std::move(wall)), mesh_(std::move(mesh)), drive_(parameters.drive), images_(parameters.images),
      beta_(Vector::Ones(2 * mesh_.nodes)), excess_viscosity_(Vector::Zero(2 * mesh_.nodes)),
      solver_tolerance_(solver_tolerance) {
  const std::vector<double> &ratios = parameters.viscosity_ratios;
  if (!ratios.empty() && ratios.size() != mesh_.parts.size())
    throw std::invalid_argument("each membrane has a viscosity ratio");
  for (std::size_t k = 0; k < ratios.size(); ++k) {
    const std::vector<Eigen::Index> rows = mesh_.rows(k);
    beta_(rows).setConstant((1 + ratios[k]) / 2);
    excess_viscosity_(rows).setConstant(ratios[k] - 1);
    equal_viscosities_ = equal_viscosities_ && ratios[k] == 1;
  }
  const std::vector<SurfaceViscosity> &surfaces = parameters.surface_viscosities;
  if (!surfaces.empty() && surfaces.size() != mesh_.parts.size())
    throw std::invalid_argument("each membrane has a surface viscosity");
  if (std::ranges::any_of(surfaces, is_viscous))
    surface_viscosities_ = surfaces;
}

Interaction Flow::interact(const Vector &position) const {
  return interact(position, equal_viscosities_ ? Layers::single : Layers::both);
}

Interaction Flow::interact(const Vector &position, Layers layers) const {
  return interact(position, layers, images_);
}

Interaction Flow::interact(const Vector &position, Layers layers, std::span<const Image> images) const {
  // Images are felt wherever they are: a train has the whole wall.
  return {images.empty() ? wall_.felt_by(mesh_, position) : wall_.shared_whole(),
          mesh_,
          position,
          layers,
          images,
          drive_};
}

Vector Flow::at_nodes(const Interaction &interaction, const Densities &densities) {
  Vector velocity = Vector::Zero(2 * interaction.mesh().nodes);
  if (densities.single.size() > 0)
    velocity += interaction.single_layer(densities.single);
  if (densities.dbl.size() > 0)
    velocity += interaction.double_layer(densities.dbl);
  return velocity;
}

Vector Flow::at_wall(const Interaction &interaction, const Densities &densities) {
  Vector velocity = Vector::Zero(interaction.wall().unknowns());
  if (densities.single.size() > 0)
    velocity += interaction.single_at_wall(densities.single);
  if (densities.dbl.size() > 0)
    velocity += interaction.double_at_wall(densities.dbl);
  return velocity;
}

// Of the double layer; empty if there is none.
Vector Flow::double_density(const Vector &velocity) const {
  return equal_viscosities_ ? Vector() : excess_viscosity_.cwiseProduct(velocity);
}

// Of each membrane; empty where none is viscous.
std::vector<SurfaceFriction> Flow::frictions(const Interaction &interaction) const {
  std::vector<SurfaceFriction> frictions;
  const Vector nodal_area = 2 * std::numbers::pi * interaction.shape().nodes.area;
  for (std::size_t k = 0; k < surface_viscosities_.size(); ++k) {
    const MembraneMesh::Part &part = mesh_.parts[k];
    frictions.emplace_back(part.at_panels, nodal_area.segment(part.first_node, part.nodes()),
                           interaction.shape().position(mesh_.rows(k)), surface_viscosities_[k]);
  }
  return frictions;
}

// R of all membranes.
Matrix Flow::friction_matrix(const std::vector<SurfaceFriction> &frictions) const {
  Matrix matrix = Matrix::Zero(2 * mesh_.nodes, 2 * mesh_.nodes);
  for (std::size_t k = 0; k < frictions.size(); ++k) {
    const std::vector<Eigen::Index> rows = mesh_.rows(k);
    matrix(rows, rows) = frictions[k].matrix();
  }
  return matrix;
}

// R v.
Vector Flow::friction_load(const std::vector<SurfaceFriction> &frictions, const Vector &velocity) const {
  Vector load = Vector::Zero(velocity.size());
  for (std::size_t k = 0; k < frictions.size(); ++k) {
    const std::vector<Eigen::Index> rows = mesh_.rows(k);
    load(rows) = frictions[k].load(velocity(rows));
  }
  return load;
}

Matrix Flow::friction_jacobian(const Interaction &interaction, const Vector &velocity) const {
  Matrix jacobian = Matrix::Zero(2 * mesh_.nodes, 2 * mesh_.nodes);
  const Vector nodal_area = 2 * std::numbers::pi * interaction.shape().nodes.area;
  for (std::size_t k = 0; k < surface_viscosities_.size(); ++k) {
    const MembraneMesh::Part &part = mesh_.parts[k];
    const std::vector<Eigen::Index> rows = mesh_.rows(k);
    jacobian(rows, rows) = capsule::friction_jacobian(
        part.at_panels, nodal_area.segment(part.first_node, part.nodes()), interaction.shape().position(rows),
        surface_viscosities_[k], velocity(rows));
  }
  return jacobian;
}

Vector Flow::load_with_friction(const Interaction &interaction, const Vector &f,
                                const Vector &velocity) const {
  return surface_viscosities_.empty() ? f : Vector(f - friction_load(frictions(interaction), velocity));
}

// beta + (S_MM - C A^(-1) S_BM) R/(8 pi) - (D_MM - C A^(-1) D_BM) (lambda - 1) on nodal velocities.
template <class Answer>
Matrix Flow::membrane_operator(const Interaction &interaction, const LayerIdentities &identities,
                               const Answer &answer_of_wall,
                               const std::vector<SurfaceFriction> &frictions) const {
  const Eigen::Index n2 = 2 * mesh_.nodes;
  Matrix matrix = equal_viscosities_
                      ? Matrix(Matrix::Zero(n2, n2))
                      : Matrix(-identities.double_layer(double_with_wall(interaction, answer_of_wall)) *
                               excess_viscosity_.asDiagonal());
  if (!frictions.empty())
    matrix +=
        identities.without_flux(single_with_wall(interaction, answer_of_wall)) * friction_matrix(frictions);
  matrix.diagonal() += beta_;
  return matrix;
}

// right is the velocity without what v does and without the wall, at_wall what is on the wall without v: the
// wall's answer to both is found at once. What v does is added to at_wall.
Vector Flow::membrane_velocity(const Interaction &interaction, const Vector &right, Vector &at_wall,
                               Recycled &recycled) const {
  const LayerIdentities identities = layer_identities(mesh_, interaction.shape());
  const std::vector<SurfaceFriction> frictions = this->frictions(interaction);
  const auto own_densities = [&](const Vector &velocity) { // but for motions as a whole
    Densities own{.single = {}, .dbl = double_density(velocity)};
    if (!frictions.empty())
      own.single = -stokeslet_factor * friction_load(frictions, velocity);
    if (!equal_viscosities_)
      own.dbl -= identities.whole_motion(own.dbl);
    return own;
  };
  const auto residual = [&](const Vector &known, const Vector &known_at_wall, const Vector &velocity) {
    const Vector density = excess_viscosity_.cwiseProduct(velocity);
    const Densities own = own_densities(velocity);
    Vector made = known;
    if (!equal_viscosities_)
      made += 0.5 * (density - own.dbl);
    made += at_nodes(interaction, own);
    made -= interaction.answer_of_wall(known_at_wall + Flow::at_wall(interaction, own));
    return Vector(identities.with_flux(made, density) - beta_.cwiseProduct(velocity));
  };
  const Vector nothing = Vector::Zero(right.size()), nothing_at_wall = Vector::Zero(at_wall.size());
  Vector velocity = identities.without_flux(solve_recycled(
      interaction.shape().position, solver_tolerance_, recycled,
      [&](const Vector &guess) { return residual(right, at_wall, guess); },
      [&](const Vector &direction) { return Vector(-residual(nothing, nothing_at_wall, direction)); },
      [&] { return membrane_operator(interaction, identities, interaction.answer_of_wall(), frictions); }));
  at_wall += Flow::at_wall(interaction, own_densities(velocity));
  return velocity;
}

FlowState Flow::solve(const Interaction &interaction, const Vector &f, Recycled &recycled) const {
  const Vector density = stokeslet_factor * f;
  FlowState state;
  state.velocity = interaction.base_velocity() + interaction.single_layer(density);
  Vector at_wall = interaction.single_at_wall(density); // b of the head comment
  if (equal_viscosities_ && surface_viscosities_.empty()) {
    state.velocity -= interaction.answer_of_wall(at_wall);
  } else {
    state.velocity = membrane_velocity(interaction, state.velocity, at_wall, recycled);
  }
  if (!state.velocity.allFinite())
    throw NumericsFailure(failure_kind::not_a_number, "the membrane's velocity is not a number",
                          "try a finer mesh.membrane");
  state.pressure_drop = interaction.wall().pressure_drop(at_wall);
  state.flow_rate = 1 - state.pressure_drop / drive_.resistance;
  return state;
}

Vector Flow::reciprocal_pressure_drops(const Interaction &interaction, const Vector &f,
                                       const FlowState &state, Recycled &traction) const {
  return capsule::reciprocal_pressure_drops(interaction, load_with_friction(interaction, f, state.velocity),
                                            double_density(state.velocity), solver_tolerance_, traction);
}

Vector Flow::outer_velocity(const Targets &points, const Interaction &interaction, const Vector &f,
                            const FlowState &state) const {
  Vector density = double_density(state.velocity);
  if (density.size() > 0) // a membrane's motion as a whole has no layer outside
    density -= layer_identities(mesh_, interaction.shape()).whole_motion(density);
  // The points may lie where the membranes do not feel the wall.
  const Interaction anywhere{wall_.shared_whole(),
                             mesh_,
                             interaction.shape().position,
                             density.size() > 0 ? Layers::both : Layers::single,
                             images_,
                             drive_};
  return state.flow_rate * wall().base_velocity(points) +
         anywhere.velocity_at(points, stokeslet_factor * load_with_friction(interaction, f, state.velocity),
                              density);
}

template <class Answer>
Matrix Flow::mobility(const Interaction &interaction, const Answer &answer_of_wall,
                      Recycled &recycled) const {
  Matrix single = single_with_wall(interaction, answer_of_wall);
  if (equal_viscosities_ && surface_viscosities_.empty())
    return single;
  const LayerIdentities identities = layer_identities(mesh_, interaction.shape());
  recycled.inverse =
      inverse_of(membrane_operator(interaction, identities, answer_of_wall, frictions(interaction)));
  return recycled.inverse * identities.without_flux(single);
}

Matrix Flow::mobility(const Interaction &interaction, Recycled &recycled) const {
  return mobility(interaction, interaction.answer_of_wall(), recycled);
}

Matrix Flow::rough_mobility(const Interaction &interaction, Recycled &recycled) const {
  return mobility(interaction, interaction.answer_of_wall<RoughMatrix>(), recycled);
}

} // namespace capsule
