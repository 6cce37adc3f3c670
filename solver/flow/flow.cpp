#include "flow/flow.hpp"
#include "base/failure.hpp"
#include "flow/reciprocal.hpp"
#include <utility>

namespace capsule {
namespace {

Matrix single_with_wall(const Interaction &interaction, const RowMatrix &answer_of_wall, double factor) {
  Matrix layer = interaction.single_layer();
  layer -= answer_of_wall * interaction.single_at_wall();
  return factor * layer;
}

Matrix double_with_wall(const Interaction &interaction, const RowMatrix &answer_of_wall) {
  Matrix layer = interaction.double_layer();
  layer -= answer_of_wall * interaction.double_at_wall();
  return layer;
}

} // namespace

NodalLayers nodal_layers(const Interaction &interaction) {
  const RowMatrix answer = interaction.answer_of_wall();
  return {single_with_wall(interaction, answer, stokeslet_factor), double_with_wall(interaction, answer)};
}

Flow::Flow(Wall wall, MembraneMesh mesh, const FlowParameters &parameters, double solver_tolerance)
    : wall_(std::move(wall)), mesh_(std::move(mesh)), parameters_(parameters),
      solver_tolerance_(solver_tolerance) {}

Interaction Flow::interact(const Vector &position) const {
  return interact(position, has_inner_flow() ? Layers::both : Layers::single);
}

Interaction Flow::interact(const Vector &position, Layers layers) const {
  return {wall_, mesh_, position, layers, parameters_.image_shifts, parameters_.drive};
}

// beta - (lambda - 1) (D_MM - C A^(-1) D_BM) on nodal velocities.
Matrix Flow::membrane_operator(const Matrix &double_layer) const {
  const double lambda = parameters_.viscosity_ratio;
  return (1 + lambda) / 2 * Matrix::Identity(double_layer.rows(), double_layer.cols()) -
         (lambda - 1) * double_layer;
}

Vector Flow::apply_membrane_operator(const Interaction &interaction, const Vector &velocity) const {
  const double lambda = parameters_.viscosity_ratio;
  Vector layer = interaction.double_layer(velocity);
  layer -= interaction.answer_of_wall(interaction.double_at_wall(velocity));
  return (1 + lambda) / 2 * velocity - (lambda - 1) * layer;
}

// right is the velocity without what v does and without the wall, at_wall what is on the wall without v: the
// wall's answer to both is found at once.
Vector Flow::membrane_velocity(const Interaction &interaction, const Vector &right, const Vector &at_wall,
                               Recycled &recycled) const {
  const double lambda = parameters_.viscosity_ratio;
  const double excess = lambda - 1;
  return solve_recycled(
      interaction.shape().position, solver_tolerance_, recycled,
      [&](const Vector &velocity) {
        Vector residual = right + excess * interaction.double_layer(velocity) - (1 + lambda) / 2 * velocity;
        residual -= interaction.answer_of_wall(at_wall + excess * interaction.double_at_wall(velocity));
        return residual;
      },
      [&](const Vector &velocity) { return apply_membrane_operator(interaction, velocity); },
      [&] { return membrane_operator(double_with_wall(interaction, interaction.answer_of_wall())); });
}

FlowState Flow::solve(const Interaction &interaction, const Vector &load, Recycled &recycled) const {
  const double factor = stokeslet_factor / parameters_.capillary_number;
  const Vector strength = factor * mesh_.at_panels(load);
  FlowState state;
  state.velocity = interaction.base_velocity() + interaction.single_from_panels() * strength;
  Vector at_wall = factor * interaction.single_at_wall(load); // b of the head comment
  if (has_inner_flow()) {
    state.velocity = membrane_velocity(interaction, state.velocity, at_wall, recycled);
    at_wall += (parameters_.viscosity_ratio - 1) * interaction.double_at_wall(state.velocity);
  } else {
    state.velocity -= interaction.answer_of_wall(at_wall);
  }
  if (!state.velocity.allFinite())
    throw NumericsFailure("not-a-number", "the membrane's velocity is not a number",
                          "try a finer mesh.membrane");
  state.pressure_drop = wall_.pressure_drop(at_wall);
  state.flow_rate = 1 - state.pressure_drop / parameters_.drive.resistance;
  return state;
}

double Flow::reciprocal_pressure_drop(const Interaction &interaction, const Vector &load,
                                      const FlowState &state, Recycled &traction) const {
  return capsule::reciprocal_pressure_drop(interaction, load, state.velocity, parameters_.capillary_number,
                                           parameters_.viscosity_ratio, solver_tolerance_, traction);
}

Vector Flow::outer_velocity(const Targets &points, const Interaction &interaction, const Vector &load,
                            const FlowState &state) const {
  const Vector single = stokeslet_factor / parameters_.capillary_number * load;
  const Vector dbl = (parameters_.viscosity_ratio - 1) * state.velocity;
  return state.flow_rate * wall_.base_velocity(points) +
         interaction.velocity_at(points, single, has_inner_flow() ? dbl : Vector());
}

Matrix Flow::mobility(const Interaction &interaction, Recycled &recycled) const {
  const RowMatrix answer = interaction.answer_of_wall();
  Matrix single = single_with_wall(interaction, answer, stokeslet_factor / parameters_.capillary_number);
  if (!has_inner_flow())
    return single;
  recycled.inverse = inverse_of(membrane_operator(double_with_wall(interaction, answer)));
  return recycled.inverse * single;
}

} // namespace capsule
