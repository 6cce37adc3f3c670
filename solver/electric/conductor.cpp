#include "electric/conductor.hpp"
#include "flow/recycled_solver.hpp"
#include "flow/wall.hpp"
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace capsule {
namespace {

// The wall as far as potentials vary along it. In a tube they settle like exp(-3.83 d). In a reservoir the cap knows u_0
// but for a share of R^-2.
Pore lengthened(const Pore &pore) {
  constexpr double more_tube = 5, reservoir = 30, times = 8;
  return with_ends(pore, pore.exit_x + (pore.shape == PoreShape::two_mouths ? 0 : more_tube),
                   pore.shape == PoreShape::tube ? pore.entrance_distance + more_tube
                                                 : times * std::max(reservoir, pore.entrance_distance));
}

// The cap that closes the first reservoir: the mirror image of that behind a second mouth, and with the normal into the
// liquid.
Curve cap_before_mouth(Pore pore) {
  pore.exit_arc = pore.exit_x - pore.entrance_arc;
  Curve cap = cap_behind_exit(pore);
  cap.x = pore.exit_x - cap.x.array();
  cap.x_zeta *= -1;
  complete(cap);
  return cap;
}

double distance_from(double centre_x, const Curve &cap) {
  return std::hypot(cap.x[0] - centre_x, cap.r[0]);
}

// The curve's points as targets on it; their gap to the nearest point, themselves, is that of the self rule.
Targets on_itself(const Curve &curve, const Panels &along, const SelfRule &self) {
  const Eigen::Index p = along.rule.size();
  const Matrix slopes = derivative_matrix(along.rule.nodes);
  Targets points{curve.x, curve.r, Vector(curve.size()), Vector(curve.size())};
  for (Eigen::Index k = 0; k < along.count(); ++k) {
    const double half = (along.edges[k + 1] - along.edges[k]) / 2;
    points.bend_x.segment(k * p, p) = slopes * curve.x_zeta.segment(k * p, p) / half;
    points.bend_r.segment(k * p, p) = slopes * curve.r_zeta.segment(k * p, p) / half;
  }
  for (Eigen::Index i = 0; i < curve.size(); ++i) {
    const double half_gap = self.sites[static_cast<std::size_t>(i)].gap / 2;
    points.bend_x[i] *= half_gap;
    points.bend_r[i] *= half_gap;
  }
  return points;
}

Targets joined(const Targets &first, const Targets &second) {
  Targets both{Vector(first.size() + second.size()), Vector(first.size() + second.size())};
  both.x << first.x, second.x;
  both.r << first.r, second.r;
  return both;
}

// The potential on the nodes -> at the quadrature points of all membranes.
Matrix at_panels(const MembraneMesh &mesh) {
  Matrix matrix = Matrix::Zero(mesh.points, mesh.nodes);
  for (const MembraneMesh::Part &part : mesh.parts)
    matrix.block(part.first_point, part.first_node, part.points(), part.nodes()) = part.at_panels.even[0];
  return matrix;
}

} // namespace

FlowResolution conductor_resolution(FlowResolution resolution) {
  resolution.membrane_panel_points -= 4;
  resolution.wall_panel_points -= 2;
  return resolution;
}

FlowResolution coarser_conductor(FlowResolution resolution) {
  resolution.membrane_panel_points -= 2;
  resolution.wall_panel_points -= 2;
  return resolution;
}

// Of the current pi through a part of a sphere.
Conductor::Electrode Conductor::cap_electrode(Curve cap, double centre_x) {
  const double field = 1 / (2 * cap.area.sum());
  const double potential = field * distance_from(centre_x, cap);
  return {std::move(cap), field, potential};
}

Conductor::Conductor(const Pore &pore, const FlowResolution &resolution)
    : tolerance_(resolution.near_tolerance) {
  const Pore far = lengthened(pore);
  const Panels along = wall_panels(far, resolution);
  wall_ = wall_curve(far, along);
  near_ = FixedNearRule(wall_, tolerance_);
  points_ = {wall_.x, wall_.r};
  if (pore.shape == PoreShape::two_mouths) {
    out_ = cap_electrode(cap_behind_exit(far), far.exit_x);
    circle_ = Circle{far.exit_x / 2, 1 + std::min(far.exit_x / 2, 2.0)};
  } else {
    out_.section = make_outlet(far, tolerance_).curve;
    points_ = joined(points_, {Vector::Constant(1, far.exit_x), Vector::Zero(1)});
  }
  section_near_ = NearRule(out_.section.panel_points, tolerance_);

  const Eigen::Index n = wall_.size();
  const Targets on_axis = {points_.x.tail(points_.size() - n), points_.r.tail(points_.size() - n)};
  const SelfRule self = make_self_rule(along, along.points, 0); // the curvature jumps at the lip
  RowMatrix on_wall;
  assemble_layer(ring_dipole, on_itself(wall_, along, self), wall_, &self,
                 NearRule(wall_.panel_points, tolerance_), on_wall);
  RowMatrix matrix(n + 1, n + 1);
  matrix.topRows(n) << on_wall, behind_section({wall_.x, wall_.r});
  if (circle_)
    matrix.row(n) << flux_of_dipoles(wall_).transpose(), -flux_of_dipoles(out_.section).sum();
  else
    matrix.row(n) = response(on_axis);
  matrix.diagonal().head(circle_ ? n : n + 1).array() += 0.5;
  inverse_ = matrix.partialPivLu().inverse();

  if (pore.shape == PoreShape::tube) {
    empty_resistance_ = pore.exit_x + pore.entrance_distance;
  } else {
    in_ = cap_electrode(cap_before_mouth(far), 0);
    base_ = inverse_ * source_in_equations();
    empty_resistance_ = base_[n] - (far.exit_x - pore.exit_x);
  }
}

// Potential at points off the wall from that of the wall's points and the one far away.
RowMatrix Conductor::response(const Targets &points) const {
  const Eigen::Index n = wall_.size();
  const Rings rings = rings_of(wall_, 0, n);
  RowMatrix response(points.size(), n + 1);
  for (Eigen::Index i = 0; i < points.size(); ++i) {
    auto row = response.row(i).head(n);
    ring_dipole.plain(points.x[i], points.r[i], rings, {row.data()});
    row.array() *= wall_.area.transpose().array();
    near_.at_near_panels(
        ring_dipole, points.x[i], points.r[i],
        [&](Eigen::Index first, const KernelBlock &block) { row.segment(first, block.cols()) = block; });
  }
  response.col(n) = behind_section(points);
  return response;
}

// The layer of 1 on a section.
Vector Conductor::layer(const RingKernel &kernel, const Targets &points, const Curve &section) const {
  RowMatrix matrix;
  assemble_layer(kernel, points, section, nullptr, section_near_, matrix);
  return matrix.rowwise().sum();
}

// The double layer of 1 on the wall without end: minus the solid angle of the section over 4 pi, none in its plane.
Vector Conductor::behind_section(const Targets &points) const {
  const Vector solid_angle = layer(ring_dipole, points, out_.section);
  if (circle_)
    return -solid_angle;
  return (points.x.array() == out_.section.x[0]).select(0, -solid_angle);
}

// What is known of u_0 where the current comes and leaves.
Vector Conductor::source_of_current(const Targets &points) const {
  Vector source = out_.field * layer(ring_source, points, out_.section) -
                  in_.field * layer(ring_source, points, in_.section);
  for (const Electrode *end : {&out_, &in_})
    if (end->potential > 0)
      source -= end->potential * layer(ring_dipole, points, end->section);
  return source;
}

// The double layer of a curve in the left sides of the equations, from potentials at its points.
RowMatrix Conductor::in_equations(const Curve &dipoles, const NearRule &near) const {
  RowMatrix layer;
  assemble_layer(ring_dipole, points_, dipoles, nullptr, near, layer);
  if (!circle_)
    return layer;
  RowMatrix with_flux(layer.rows() + 1, layer.cols());
  with_flux << layer, flux_of_dipoles(dipoles).transpose();
  return with_flux;
}

// What is known of u_0 in the right sides.
Vector Conductor::source_in_equations() const {
  Vector at_points = source_of_current(points_);
  if (!circle_)
    return at_points;
  constexpr double current = 0.5; // pi over the azimuth's 2 pi
  double flux = out_.field * flux_of_sources(out_.section) - in_.field * flux_of_sources(in_.section);
  for (const Electrode *end : {&out_, &in_})
    flux -= end->potential * flux_of_dipoles(end->section).sum();
  Vector source(at_points.size() + 1);
  source << at_points, flux - current;
  return source;
}

// The flux of each ring of dipoles through the circle, over 2 pi. With G = 1/(4 pi |e|) it is minus the derivative along
// the ring's normal of the flux of a source there; that is the circle's solid angle, whose gradient is the magnetic field of
// a current along the circle.
Vector Conductor::flux_of_dipoles(const Curve &dipoles) const {
  const double a = circle_->radius;
  Vector flux(dipoles.size());
  for (Eigen::Index i = 0; i < flux.size(); ++i) {
    const double x = dipoles.x[i] - circle_->x, r = dipoles.r[i];
    const double far2 = (a + r) * (a + r) + x * x, near2 = (a - r) * (a - r) + x * x;
    const double modulus = std::sqrt(4 * a * r / far2);
    const double k = std::comp_ellint_1(modulus), e = std::comp_ellint_2(modulus);
    const double factor = 1 / (2 * std::numbers::pi * std::sqrt(far2));
    const double field_x = factor * (k + (a * a - r * r - x * x) / near2 * e);
    const double field_r = factor * x / r * ((a * a + r * r + x * x) / near2 * e - k);
    flux[i] = dipoles.area[i] * (field_x * dipoles.normal_x[i] + field_r * dipoles.normal_r[i]);
  }
  return flux;
}

// The flux of sources of strength 1 on a curve, over 2 pi: the solid angle of the circle over 4 pi.
double Conductor::flux_of_sources(const Curve &sources) const {
  const Curve disc = disc_at(circle_->x, circle_->radius);
  return -sources.area.dot(layer(ring_dipole, {sources.x, sources.r}, disc));
}

double Conductor::change(const MembraneMesh &mesh, const Vector &position) const {
  const MembraneShape shape = shape_at(mesh, position);
  const RowMatrix from_wall = response(shape.targets);
  RowMatrix to_nodes;
  assemble_layer(ring_dipole, shape.targets, shape.panels, &mesh.parts[0].self, mesh.near, to_nodes);
  const RowMatrix to_wall = in_equations(shape.panels, mesh.near);
  const Matrix interpolation = at_panels(mesh);

  Vector base = shape.targets.x;
  if (base_.size() > 0)
    base = source_of_current(shape.targets) - from_wall * base_;
  for (const MembraneMesh::Part &part : mesh.parts) { // a constant on a membrane is no disturbance
    auto on_part = base.segment(part.first_node, part.nodes());
    on_part.array() -= on_part.mean();
  }
  // 1/2 is most of the operator: its inverse leaves few corrections.
  Recycled start{2 * Matrix::Identity(mesh.nodes, mesh.nodes), {}, {}};
  const auto apply = [&](const Vector &potential) -> Vector {
    const Vector on_panels = interpolation * potential;
    return 0.5 * potential + to_nodes * on_panels - from_wall * (inverse_ * (to_wall * on_panels));
  };
  const Vector potential = solve_recycled(
      position, tolerance_, start, [&](const Vector &guess) { return Vector(base - apply(guess)); }, apply,
      [&]() -> Matrix {
        Matrix system = (to_nodes - (from_wall * inverse_) * to_wall) * interpolation;
        system.diagonal().array() += 0.5;
        return system;
      });
  return -inverse_.row(wall_.size()).dot(to_wall * (interpolation * potential));
}

} // namespace capsule
