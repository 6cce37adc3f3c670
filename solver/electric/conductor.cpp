#include "electric/conductor.hpp"
#include "flow/recycled_solver.hpp"
#include "flow/wall.hpp"
#include "integrals/elliptic.hpp"
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

Targets joined(const Targets &first, const Targets &second) {
  Targets both{Vector(first.size() + second.size()), Vector(first.size() + second.size())};
  both.x << first.x, second.x;
  both.r << first.r, second.r;
  return both;
}

// In a row of kernels at a point from the rings of a curve that stays, for densities times area, those of near panels, whose
// own rule has the area.
template <class Row>
void replace_near(const RingKernel &kernel, double x, double r, const Curve &curve, const FixedNearRule &near,
                  Row &row) {
  near.at_near_panels(kernel, x, r, [&](Eigen::Index first, const KernelBlock &block) {
    row.segment(first, block.cols()) =
        block.cwiseQuotient(curve.area.segment(first, block.cols()).transpose());
  });
}

// The layer of 1 on a curve.
Vector layer(const RingKernel &kernel, const Targets &points, const Curve &curve, const FixedNearRule &near) {
  Vector layer(points.size());
  Eigen::RowVectorXd row(curve.size());
  for (Eigen::Index i = 0; i < points.size(); ++i) {
    kernel.plain(points.x[i], points.r[i], rings_of(curve, 0, curve.size()), {row.data()});
    replace_near(kernel, points.x[i], points.r[i], curve, near, row);
    layer[i] = row.dot(curve.area);
  }
  return layer;
}

// The potential on the nodes -> at the quadrature points of all membranes.
Vector at_panels(const MembraneMesh &mesh, const Vector &potential) {
  Vector values(mesh.points);
  for (const MembraneMesh::Part &part : mesh.parts)
    values.segment(part.first_point, part.points()).noalias() =
        part.at_panels.even[0] * potential.segment(part.first_node, part.nodes());
  return values;
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

// Of the current pi through a part of a sphere; the pore is around the middle.
Conductor::Electrode Conductor::cap_electrode(Curve cap, double centre_x, double middle) const {
  const double field = 1 / (2 * cap.area.sum());
  const double potential = field * distance_from(centre_x, cap);
  const FixedNearRule near(cap, tolerance_);
  const SolidHarmonics sources(ring_source, cap, middle), dipoles(ring_dipole, cap, middle);
  return {std::move(cap), near, field, potential, sources, dipoles};
}

Vector Conductor::Electrode::layer(const RingKernel &kernel, const Targets &points) const {
  const SolidHarmonics &harmonics = &kernel == &ring_source ? sources : dipoles;
  return harmonics.hold(points) ? harmonics.at(points) : capsule::layer(kernel, points, section, near);
}

Conductor::Conductor(const Pore &pore, const FlowResolution &resolution)
    : tolerance_(resolution.near_tolerance) {
  const Pore far = lengthened(pore);
  Panels &along = whole_.along = wall_panels(far, resolution);
  const Curve &wall = whole_.wall = wall_curve(far, along);
  whole_.points = {wall.x, wall.r};
  if (pore.shape == PoreShape::two_mouths) {
    out_ = cap_electrode(cap_behind_exit(far), far.exit_x, pore.exit_x / 2);
    circle_ = Circle{far.exit_x / 2, 1 + std::min(far.exit_x / 2, 2.0)};
  } else {
    out_.section = disc_at(far.exit_x, 1);
    out_.near = {out_.section, tolerance_};
    whole_.points = joined(whole_.points, {Vector::Constant(1, far.exit_x), Vector::Zero(1)});
  }

  const Eigen::Index n = wall.size();
  const NearRule near(wall.panel_points, tolerance_);
  const SelfRule self = self_rule_of_wall(along);
  RowMatrix on_wall;
  assemble_layer(ring_dipole, on_itself(wall, along, self), wall, &self, near, on_wall);
  RowMatrix matrix(n + 1, n + 1);
  matrix.topRows(n) << on_wall, behind_section({wall.x, wall.r});
  if (circle_) {
    matrix.row(n) << flux_of_dipoles(wall).transpose(), -flux_of_dipoles(out_.section).sum();
  } else {
    const Targets on_axis{whole_.points.x.tail(1), whole_.points.r.tail(1)};
    RowMatrix at_point;
    assemble_layer(ring_dipole, on_axis, wall, nullptr, near, at_point);
    matrix.row(n) << at_point, behind_section(on_axis);
  }
  matrix.diagonal().head(circle_ ? n : n + 1).array() += 0.5;
  Vector weights(n + 1);
  weights << wall.area, 1;
  whole_.inverse = weights.asDiagonal() * lu_inverse(matrix);

  if (pore.shape == PoreShape::tube) {
    empty_resistance_ = pore.exit_x + pore.entrance_distance;
  } else {
    in_ = cap_electrode(cap_before_mouth(far), 0, pore.exit_x / 2);
    whole_.base = whole_.inverse * source_in_equations();
    empty_resistance_ = whole_.base[n] - (far.exit_x - pore.exit_x);
  }
}

const Conductor::Surface &Conductor::felt_by(const MembraneMesh &mesh, const Vector &position) const {
  std::vector<Surroundings> place = place_of(mesh, position);
  if (place != place_) {
    Surface felt;
    felt.along = make_panels(joined_panels(whole_.along, whole_.wall, tolerance_, place),
                             static_cast<int>(whole_.along.rule.size()));
    felt.wall = on_longer_panels(whole_.wall, whole_.along, felt.along);
    felt.near = FixedNearRule(felt.wall, tolerance_);
    const Eigen::Index others = whole_.points.size() - whole_.wall.size();
    felt.points =
        joined({felt.wall.x, felt.wall.r}, {whole_.points.x.tail(others), whole_.points.r.tail(others)});
    const Joining joining(whole_.along, felt.along, 1);
    felt.inverse = joining.both_sides(whole_.inverse);
    if (whole_.base.size() > 0)
      felt.base = joining(whole_.base);
    felt_ = std::move(felt);
    place_ = std::move(place);
  }
  return felt_;
}

// The double layer of 1 on the wall without end: minus the solid angle of the section over 4 pi, none in its plane.
Vector Conductor::behind_section(const Targets &points) const {
  const Vector solid_angle = out_.layer(ring_dipole, points);
  if (circle_)
    return -solid_angle;
  return (points.x.array() == out_.section.x[0]).select(0, -solid_angle);
}

// What is known of u_0 where the current comes and leaves.
Vector Conductor::source_of_current(const Targets &points, const Vector &behind_section) const {
  Vector source = out_.field * out_.layer(ring_source, points) - in_.field * in_.layer(ring_source, points);
  if (out_.potential > 0)
    source += out_.potential * behind_section; // in no plane
  return source - in_.potential * in_.layer(ring_dipole, points);
}

Vector Conductor::Coupling::at_wall(const Vector &potential, const Vector &on_panels) const {
  Vector result = from_nodes.transpose() * area.cwiseProduct(potential);
  if (!near.empty())
    result(near) = from_panels * on_panels;
  return result;
}

// The wall's points and the nodes are rings and targets at once. The other equations, a point or a circle, are rows of
// their own.
Conductor::Coupling Conductor::couple(const Surface &surface, const MembraneMesh &mesh,
                                      const MembraneShape &shape) const {
  const Curve &wall = surface.wall, &nodes = shape.nodes;
  const Targets &points = surface.points;
  const Eigen::Index n = wall.size();
  const Rings wall_rings = rings_of(wall, 0, n), node_rings = rings_of(nodes, 0, mesh.nodes);
  Coupling result{
      RowMatrix(mesh.nodes, n + 1), RowMatrix(mesh.nodes, surface.inverse.cols()), nodes.area, {}, {}};
  for (Eigen::Index i = 0; i < mesh.nodes; ++i) {
    auto to_node = result.to_nodes.row(i);
    ring_mutual_dipoles(nodes.x[i], nodes.r[i], nodes.normal_x[i], nodes.normal_r[i], wall_rings,
                        to_node.data(), result.from_nodes.row(i).data());
    replace_near(ring_dipole, nodes.x[i], nodes.r[i], wall, surface.near, to_node);
  }
  result.to_nodes.col(n) = behind_section(shape.targets);
  for (Eigen::Index i = n; i < points.size(); ++i) {
    Vector from_nodes(mesh.nodes);
    ring_dipole.plain(points.x[i], points.r[i], node_rings, {from_nodes.data()});
    result.from_nodes.col(i) = from_nodes;
  }

  std::vector<NodesNearby> membranes;
  for (std::size_t k = 0; k < mesh.parts.size(); ++k)
    membranes.emplace_back(mesh, shape, k);
  const auto near = [&](double x, double r) {
    return std::ranges::any_of(membranes, [&](const NodesNearby &membrane) { return membrane.hold(x, r); });
  };
  for (Eigen::Index i = 0; i < points.size(); ++i)
    if (near(points.x[i], points.r[i]))
      result.near.push_back(i);
  assemble_layer(ring_dipole, {points.x(result.near), points.r(result.near)}, shape.panels, nullptr,
                 mesh.near, result.from_panels);
  if (!circle_)
    return result;
  result.from_nodes.rightCols(1) = flux_of_dipoles(nodes).cwiseQuotient(nodes.area);
  if (near(circle_->x, circle_->radius)) {
    result.near.push_back(points.size());
    result.from_panels.conservativeResize(result.from_panels.rows() + 1, shape.panels.size());
    result.from_panels.bottomRows(1) = flux_of_dipoles(shape.panels).transpose();
  }
  return result;
}

// What is known of u_0 in the right sides.
Vector Conductor::source_in_equations() const {
  Vector at_points = source_of_current(whole_.points, behind_section(whole_.points));
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
    const Ratio m1 = ratio(near2, far2, 4 * a * r);
    const double m = 4 * a * r * m1.over_denominator;
    const EllipticIntegrals integrals = elliptic_integrals(m, m1.value, m1.natural_logarithm);
    const double k = integrals.b + integrals.d, e = integrals.b + m1.value * integrals.d;
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
  return -sources.area.dot(layer(ring_dipole, {sources.x, sources.r}, disc, {disc, tolerance_}));
}

double Conductor::change(const MembraneMesh &mesh, const Vector &position) const {
  const MembraneShape shape = shape_at(mesh, position);
  const Surface &wall = felt_by(mesh, position);
  RowMatrix to_nodes;
  assemble_layer(ring_dipole, shape.targets, shape.panels, &mesh.parts[0].self, mesh.near, to_nodes);
  const Coupling coupling = couple(wall, mesh, shape);
  const RowMatrix &from_wall = coupling.to_nodes;

  Vector base = shape.targets.x;
  if (wall.base.size() > 0)
    base = source_of_current(shape.targets, from_wall.col(wall.wall.size())) - from_wall * wall.base;
  for (const MembraneMesh::Part &part : mesh.parts) { // a constant on a membrane is no disturbance
    auto on_part = base.segment(part.first_node, part.nodes());
    on_part.array() -= on_part.mean();
  }
  const auto apply = [&](const Vector &potential) -> Vector {
    const Vector on_panels = at_panels(mesh, potential);
    return 0.5 * potential + to_nodes * on_panels -
           from_wall * (wall.inverse * coupling.at_wall(potential, on_panels));
  };
  const auto system = [&]() -> Matrix {
    Matrix columns(mesh.nodes, mesh.nodes);
    for (Eigen::Index k = 0; k < mesh.nodes; ++k)
      columns.col(k) = apply(Vector::Unit(mesh.nodes, k));
    return columns;
  };
  Vector potential = Vector::Zero(mesh.nodes);
  // 1/2 is most of the operator: its inverse leaves few corrections.
  if (!conjugate_residuals(
          tolerance_, base, potential, [](const Vector &residual) { return Vector(2 * residual); }, apply)) {
    Recycled nothing;
    potential = solve_recycled(
        position, tolerance_, nothing, [&](const Vector &guess) { return Vector(base - apply(guess)); },
        apply, system);
  }
  return -wall.inverse.row(wall.wall.size()).dot(coupling.at_wall(potential, at_panels(mesh, potential)));
}

} // namespace capsule
