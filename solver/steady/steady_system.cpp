#include "steady/steady_system.hpp"
#include "base/failure.hpp"
#include "case/empty_pore.hpp"
#include "case/physical.hpp"
#include "geometry/gap.hpp"
#include "geometry/node_density.hpp"
#include "membrane/load.hpp"
#include "membrane/surface_viscosity.hpp"
#include "scene/make_flow.hpp"
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

namespace capsule {
namespace {

using std::numbers::pi;
// Beyond the tips: the disturbance has fallen to 1e-9 there.
constexpr double wall_beyond = 4.7;
// A capsule fills the tube in a weak flow, and grows without bound in too strong a one.
constexpr Advice advice{.at_the_wall = "try a larger flow.capillary_number",
                        .at_the_end = "try a smaller flow.capillary_number"};

constexpr double room = 1.25; // for the membrane to grow
constexpr double largest_slack = 5e-7;

} // namespace

SteadySystem::SteadySystem(const Case &input, const Resolution &resolution, const Vector &node_angle,
                           double tip)
    : resolution_(resolution), membrane_(standard_membrane(input.capsule, input.membrane, resolution)) {
  membrane_.node_angle = node_angle;
  set_parameters(input);
  tip_ = room * tip;
  build_flow();
}

// Those nearer than wall_beyond.
int SteadySystem::images_on_each_side() const {
  const double period = input_.flow.period;
  return period > 0 ? static_cast<int>(std::ceil((2 * tip_ + wall_beyond) / period)) - 1 : 0;
}

// The last image lies within 2 tip_ + wall_beyond, whatever the period: a branch along it keeps its tube.
double SteadySystem::needed_half_length() const {
  const double alone = tip_ + wall_beyond;
  return input_.flow.period > 0 ? alone + 2 * tip_ + wall_beyond : alone;
}

std::vector<Image> SteadySystem::images(Neighbours neighbours) const {
  std::vector<Image> images;
  for (int k = 1; k <= images_on_each_side(); ++k)
    for (const double side : {-1, 1})
      images.push_back({.shift = side * k * input_.flow.period,
                        .amplitude = neighbours == Neighbours::opposed && k % 2 != 0 ? -1.0 : 1.0});
  return images;
}

void SteadySystem::build_flow() {
  half_length_ = needed_half_length();
  resolution_.flow.fine_half_length = half_length_ - wall_beyond;
  if (input_.pore.shape != PoreShape::none)
    pore_ = make_pore({.shape = PoreShape::tube, .exit_x = half_length_, .entrance_distance = half_length_});
  flow_ =
      make_flow(pore_, {.type = input_.flow.type, .capillary_number = 1}, membrane_.basis, resolution_.flow);
  if (input_.flow.drive == DriveBy::pressure)
    flow_->drive_by({empty_pressure_drop(input_.pore, driven_tube_length(input_))});
  flow_->place_images(images(Neighbours::alike));
}

void SteadySystem::set_parameters(const Case &input) {
  input_ = input;
  set_material(input.capsule, input.membrane, membrane_);
  centre_weights_ = nodal_area(membrane_, membrane_.initial);
  centre_weights_ /= centre_weights_.sum();
  volume_ = 4 * pi / 3 * std::pow(input.capsule.radius, 3);
  if (!flow_)
    return;
  if (needed_half_length() > half_length_)
    build_flow();
  else
    flow_->place_images(images(Neighbours::alike));
}

Vector SteadySystem::initial() const {
  Vector unknowns = Vector::Zero(2 * nodes() + 2);
  unknowns.head(2 * nodes()) = membrane_.initial;
  if (pore_)
    unknowns[2 * nodes()] = 2 - 4.0 / 3 * std::pow(std::min(input_.capsule.radius, 0.8), 2);
  return unknowns;
}

double SteadySystem::largest_stretch(const Vector &unknowns) const {
  return membrane_state(membrane_, membrane_.at_nodes, unknowns.head(2 * nodes()))
      .stretch_meridional.maxCoeff();
}

SoftestPoint SteadySystem::softest(const Vector &unknowns) const {
  return softest_point(membrane_, unknowns.head(2 * nodes()));
}

void SteadySystem::require_stiffness(const Vector &unknowns) const {
  const SoftestPoint point = softest(unknowns);
  if (softens(point))
    throw NumericsFailure(failure_kind::softening, softening_text(point), softening_advice);
}

void SteadySystem::fit_tube(const Vector &unknowns) {
  if (!pore_)
    return;
  const double tip = unknowns.head(nodes()).cwiseAbs().maxCoeff();
  if (tip < tip_)
    return;
  tip_ = room * tip;
  build_flow();
}

double SteadySystem::admissible_step(const Vector &unknowns, const Vector &change) const {
  constexpr double keep = 0.3; // share of the distance
  const Eigen::Index n = nodes();
  const auto x = unknowns.head(n);
  const double length = x.maxCoeff() - x.minCoeff();
  double step = std::min(1.0, length / change.head(n).cwiseAbs().maxCoeff());
  for (Eigen::Index k = n; k < 2 * n; ++k) {
    const double r = unknowns[k];
    if (change[k] < 0)
      step = std::min(step, (1 - keep) * r / -change[k]);
    else if (pore_)
      step = std::min(step, (1 - keep) * (1 - r) / change[k]);
  }
  return step;
}

Vector SteadySystem::load(const Vector &position) const {
  return membrane_load(membrane_, position) / input_.flow.capillary_number;
}

Vector SteadySystem::load_and_constraints(const Vector &unknowns) const {
  const Vector position = unknowns.head(2 * nodes());
  Vector part(2 * nodes() + 2);
  part << load(position), constraints(position);
  return part;
}

// Centre and volume, less what they should be.
Eigen::Vector2d SteadySystem::constraints(const Vector &position) const {
  const Eigen::Index n = nodes();
  const auto weights = membrane_.basis.weights.array();
  const auto r = position.tail(n).array();
  const Vector x_zeta = membrane_.at_nodes.even[1] * position.head(n);
  return {centre_weights_.dot(position.head(n)),
          pi * (weights * r.square() * x_zeta.array()).sum() - volume_};
}

// Rows: centre and volume; columns: nodal positions.
Eigen::Matrix<double, 2, Eigen::Dynamic> SteadySystem::constraint_slopes(const Vector &position) const {
  const Eigen::Index n = nodes();
  const auto weights = membrane_.basis.weights.array();
  const auto r = position.tail(n).array();
  const Vector x_zeta = membrane_.at_nodes.even[1] * position.head(n);
  Eigen::Matrix<double, 2, Eigen::Dynamic> slopes(2, 2 * n);
  slopes.setZero();
  slopes.row(0).head(n) = centre_weights_;
  slopes.row(1).head(n) = pi * membrane_.at_nodes.even[1].transposed_times(weights * r.square()).transpose();
  slopes.row(1).tail(n) = 2 * pi * weights * r * x_zeta.array();
  return slopes;
}

Vector SteadySystem::equations(const Vector &unknowns, const Vector &velocity) const {
  const Eigen::Index n = nodes();
  const Vector position = unknowns.head(2 * n);
  const Vector x_zeta = membrane_.at_nodes.even[1] * position.head(n);
  const Vector r_zeta = membrane_.at_nodes.odd[1] * position.tail(n);
  const Eigen::ArrayXd arc = (x_zeta.array().square() + r_zeta.array().square()).sqrt();
  Vector rows(2 * n + 2);
  rows.head(2 * n) = velocity;
  rows.head(n).array() -= unknowns[2 * n];
  rows.head(n).array() -= unknowns[2 * n + 1] * r_zeta.array() / arc;
  rows.segment(n, n).array() += unknowns[2 * n + 1] * x_zeta.array() / arc;
  rows.tail(2) = constraints(position);
  return rows;
}

void SteadySystem::require_shape(const Vector &position) const {
  require_capsule(pore_, position, advice);
  if (input_.flow.period == 0)
    return;
  const Chain here = chain_of(membrane_.basis, position, 1);
  Chain next = here;
  next.x.array() += input_.flow.period;
  if (overlap(here, next))
    throw NumericsFailure(failure_kind::touching, "neighbouring capsules of the train touch",
                          "try a larger flow.period");
}

double SteadySystem::gap_to_next(const Vector &position) const {
  constexpr int chords = 8;
  Vector next = position;
  next.head(nodes()).array() += input_.flow.period;
  return gap_between(membrane_.basis, position, membrane_.basis, next, chords).width;
}

Vector SteadySystem::residual(const Vector &unknowns) const {
  const Vector position = unknowns.head(2 * nodes());
  require_shape(position);
  Recycled unused;
  return equations(unknowns, flow_->solve(flow_->interact(position), load(position), unused).velocity);
}

SteadySystem::Linearisation SteadySystem::linearise(const Vector &unknowns, Neighbours neighbours) const {
  const Eigen::Index n = nodes();
  const Vector position = unknowns.head(2 * n);
  require_shape(position);
  Recycled unused;
  const Interaction interaction = flow_->interact(position, Layers::both);
  const Vector velocity = flow_->solve(interaction, load(position), unused).velocity;
  Linearisation result;
  result.residual = equations(unknowns, velocity);
  const auto motion_in = [&](const Interaction &disturbed) {
    result.layers = nodal_layers(disturbed);
    if (input_.flow.viscosity_ratio != 1)
      result.double_layer = disturbed.double_layer();
    return linear_motion(disturbed, result.layers, membrane_, position, velocity,
                         input_.flow.capillary_number);
  };
  const Matrix motion = neighbours == Neighbours::alike
                            ? motion_in(interaction)
                            : motion_in(flow_->interact(position, Layers::both, images(neighbours)));
  if (is_viscous(input_.membrane.viscosity))
    result.friction = SurfaceFriction(interaction.mesh().parts[0].at_panels, nodal_area(membrane_, position),
                                      position, input_.membrane.viscosity)
                          .matrix();
  Matrix &jacobian = result.jacobian;
  jacobian = Matrix::Zero(2 * n + 2, 2 * n + 2);
  jacobian.topLeftCorner(2 * n, 2 * n) = motion;
  jacobian.bottomLeftCorner(2, 2 * n) = constraint_slopes(position);
  Vector unit = unknowns; // equations are linear in V and the slack
  unit[2 * n + 1] = 1;
  Vector none = unknowns;
  none[2 * n + 1] = 0;
  jacobian.col(2 * n + 1) = equations(unit, Vector::Zero(2 * n)) - equations(none, Vector::Zero(2 * n));
  jacobian.col(2 * n).head(n).setConstant(-1);
  return result;
}

FlowState SteadySystem::flow(const Vector &position) const {
  Recycled unused;
  const Interaction interaction = flow_->interact(position);
  const Vector nodal_load = load(position);
  FlowState state = flow_->solve(interaction, nodal_load, unused);
  state.pressure_drop /= 2 * images_on_each_side() + 1; // a part for each, as all loads are equal
  state.pressure_drop_reciprocal =
      flow_->reciprocal_pressure_drops(interaction, nodal_load, state, unused).sum();
  return state;
}

bool poorly_resolved(const SteadySystem &system, const Vector &unknowns, double largest_unresolved_part) {
  return std::abs(unknowns[unknowns.size() - 1]) > largest_slack ||
         unresolved_part(system.membrane().basis, unknowns.head(2 * system.nodes())) >
             largest_unresolved_part;
}

} // namespace capsule
