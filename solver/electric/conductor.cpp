#include "electric/conductor.hpp"
#include "flow/recycled_solver.hpp"
#include "flow/wall.hpp"
#include <algorithm>
#include <cmath>

namespace capsule {
namespace {

// The wall as far as potentials vary along it. In a tube they settle like exp(-3.83 d). In the reservoir the cap knows u_0
// but for a share of R^-2.
Pore lengthened(const Pore &pore) {
  constexpr double more_tube = 5, reservoir = 30, times = 8;
  return with_ends(pore, pore.exit_x + more_tube,
                   pore.shape == PoreShape::tube ? pore.entrance_distance + more_tube
                                                 : times * std::max(reservoir, pore.entrance_distance));
}

// The part of a sphere around the mouth that closes the reservoir, from the wall to the axis, with the normal into the
// liquid.
Curve spherical_cap(const Pore &pore) {
  constexpr int points = 12;
  const WallPoint rim = wall_point(pore, pore.entrance_arc);
  const double radius = std::hypot(rim.x, rim.r), half_angle = std::atan2(rim.r, -rim.x);
  const Panels across = make_panels(Vector::LinSpaced(2, 0, half_angle), points);
  const Eigen::ArrayXd angle = half_angle - across.points.array();
  Curve cap;
  cap.panel_points = points;
  cap.weights = across.weights;
  cap.x = -radius * angle.cos();
  cap.r = radius * angle.sin();
  cap.x_zeta = -cap.r;
  cap.r_zeta = cap.x;
  complete(cap);
  return cap;
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

Conductor::Conductor(const Pore &pore, const FlowResolution &resolution)
    : tolerance_(resolution.near_tolerance) {
  const Pore far = lengthened(pore);
  const Panels along = wall_panels(far, resolution);
  wall_ = wall_curve(far, along);
  near_ = FixedNearRule(wall_, tolerance_);
  section_ = plane_outlet(far.exit_x, tolerance_);
  points_ = joined({wall_.x, wall_.r}, section_.row_points);

  const Eigen::Index n = wall_.size();
  const SelfRule self = make_self_rule(along, along.points, 0); // the curvature jumps at the lip
  RowMatrix on_wall;
  assemble_layer(ring_dipole, on_itself(wall_, along, self), wall_, &self,
                 NearRule(wall_.panel_points, tolerance_), on_wall);
  RowMatrix matrix(n + 1, n + 1);
  matrix << on_wall, behind_section({wall_.x, wall_.r}), response(section_.row_points);
  matrix.diagonal().array() += 0.5;
  inverse_ = matrix.partialPivLu().inverse();

  if (pore.shape == PoreShape::tube) {
    empty_resistance_ = pore.exit_x + pore.entrance_distance;
  } else {
    cap_ = spherical_cap(far);
    base_ = inverse_ * source_of_current(points_);
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

// The double layer of 1 on the wall without end: minus the solid angle of the section over 4 pi, none in its plane.
Vector Conductor::behind_section(const Targets &points) const {
  RowMatrix section;
  assemble_layer(ring_dipole, points, section_.curve, nullptr, section_.near, section);
  return (points.x.array() == section_.curve.x[0]).select(0, -section.rowwise().sum());
}

// What is known of u_0: the current leaves through the section, where the field is 1, and comes through the cap evenly.
Vector Conductor::source_of_current(const Targets &points) const {
  const double cap_field = 1 / (2 * cap_.area.sum());
  const double cap_potential = cap_field * std::hypot(cap_.x[0], cap_.r[0]);
  const auto layer = [&](const RingKernel &kernel, const Curve &curve) -> Vector {
    RowMatrix matrix;
    assemble_layer(kernel, points, curve, nullptr, section_.near, matrix);
    return matrix.rowwise().sum();
  };
  return layer(ring_source, section_.curve) - cap_field * layer(ring_source, cap_) -
         cap_potential * layer(ring_dipole, cap_);
}

double Conductor::change(const MembraneMesh &mesh, const Vector &position) const {
  const MembraneShape shape = shape_at(mesh, position);
  const RowMatrix from_wall = response(shape.targets);
  RowMatrix to_nodes, to_wall;
  assemble_layer(ring_dipole, shape.targets, shape.panels, &mesh.self, mesh.near, to_nodes);
  assemble_layer(ring_dipole, points_, shape.panels, nullptr, mesh.near, to_wall);
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
