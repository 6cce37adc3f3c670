#include "flow/membrane_mesh.hpp"
#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <numeric>
#include <stdexcept>

namespace capsule {

namespace {

using std::numbers::pi;

Curve blank_curve(Eigen::Index size, Eigen::Index panel_points) {
  Curve curve;
  curve.panel_points = panel_points;
  for (Vector *field : {&curve.x, &curve.r, &curve.x_zeta, &curve.r_zeta, &curve.weights})
    field->resize(size);
  return curve;
}

// So many points of a curve from one on.
Curve part_of(const Curve &curve, Eigen::Index first, Eigen::Index count) {
  Curve part = curve;
  for (Vector *field : {&part.x, &part.r, &part.x_zeta, &part.r_zeta, &part.weights, &part.arc,
                        &part.normal_x, &part.normal_r, &part.area})
    *field = Vector(field->segment(first, count));
  part.panel_points = std::min(curve.panel_points, count);
  return part;
}

} // namespace

Vector even_membrane_edges(const MeridianBasis &basis, double largest_panel) {
  return graded_edges(0, pi, 0.75 * basis.nodes[0], largest_panel, Graded::both);
}

Vector halved_edges(const MeridianBasis &basis, const Vector &position, const Vector &edges,
                    double most_turning) {
  constexpr Eigen::Index points = 2048;
  constexpr double width = pi / points;
  constexpr double shortest = 8 * width; // even at a cusp
  const Eigen::Index n = basis.size();
  const Vector zeta = Vector::LinSpaced(points, width / 2, pi - width / 2);
  const Eigen::ArrayXd x_1 = basis.even(zeta, 1, position.head(n)),
                       x_2 = basis.even(zeta, 2, position.head(n));
  const Eigen::ArrayXd r_1 = basis.odd(zeta, 1, position.tail(n)), r_2 = basis.odd(zeta, 2, position.tail(n));
  const Eigen::ArrayXd turning = (x_1 * r_2 - r_1 * x_2).abs() / (x_1.square() + r_1.square()) * width;
  const auto turning_between = [&](double from, double to) {
    const auto place = [&](double at) {
      return std::clamp<Eigen::Index>(std::lround(at / pi * points), 0, points);
    };
    return turning.segment(place(from), place(to) - place(from)).sum();
  };
  std::vector<double> result{edges[0]};
  const std::function<void(double, double)> add = [&](double from, double to) {
    if (to - from > shortest && turning_between(from, to) > most_turning) {
      add(from, (from + to) / 2);
      add((from + to) / 2, to);
    } else
      result.push_back(to);
  };
  for (Eigen::Index k = 1; k < edges.size(); ++k)
    add(edges[k - 1], edges[k]);
  return Eigen::Map<Vector>(result.data(), std::ssize(result));
}

MembraneMesh make_membrane_mesh(const MeridianBasis &basis, const FlowResolution &resolution) {
  const Panels panels = make_panels(resolution.membrane_edges.size() > 0
                                        ? resolution.membrane_edges
                                        : even_membrane_edges(basis, resolution.membrane_panel),
                                    resolution.membrane_panel_points);
  MembraneMesh mesh;
  mesh.nodes = basis.size();
  mesh.points = panels.points.size();
  mesh.panel_points = resolution.membrane_panel_points;
  SelfRule self = make_self_rule(panels, basis.nodes);
  mesh.near_tolerance = resolution.near_tolerance;
  mesh.near = NearRule(mesh.panel_points, mesh.near_tolerance);
  Matrix even_bend = bend(self, [&](const Vector &zeta) { return basis.even(zeta, 2); });
  Matrix odd_bend = bend(self, [&](const Vector &zeta) { return basis.odd(zeta, 2); });
  mesh.parts.push_back({.basis = basis,
                        .at_nodes = sample(basis, basis.nodes, basis.weights),
                        .at_panels = sample(basis, panels.points, panels.weights),
                        .self = std::move(self),
                        .even_bend = std::move(even_bend),
                        .odd_bend = std::move(odd_bend)});
  return mesh;
}

MembraneMesh join(std::span<const MembraneMesh> meshes) {
  MembraneMesh joined = meshes[0];
  for (const MembraneMesh &mesh : meshes.subspan(1)) {
    if (mesh.panel_points != joined.panel_points || mesh.near_tolerance != joined.near_tolerance)
      throw std::invalid_argument("membranes of one flow have panels of one kind");
    for (MembraneMesh::Part part : mesh.parts) {
      part.first_node += joined.nodes;
      part.first_point += joined.points;
      joined.parts.push_back(std::move(part));
    }
    joined.nodes += mesh.nodes;
    joined.points += mesh.points;
  }
  return joined;
}

std::vector<Eigen::Index> rows_of_part(Eigen::Index first_node, Eigen::Index n, Eigen::Index nodes) {
  std::vector<Eigen::Index> rows(static_cast<std::size_t>(2 * n));
  std::iota(rows.begin(), rows.begin() + n, first_node);
  std::iota(rows.begin() + n, rows.end(), nodes + first_node);
  return rows;
}

std::vector<Eigen::Index> MembraneMesh::rows(std::size_t part) const {
  return rows_of_part(parts[part].first_node, parts[part].nodes(), nodes);
}

Vector MembraneMesh::Part::values_at_panels(const Vector &nodal) const {
  Vector values(2 * points());
  values << at_panels.even[0] * nodal.head(nodes()), at_panels.odd[0] * nodal.tail(nodes());
  return values;
}

Matrix MembraneMesh::Part::on_nodes(const RowMatrix &on_panels, int derivative) const {
  Matrix result(on_panels.rows(), 2 * nodes());
  result.leftCols(nodes()) = on_panels.leftCols(points()) * at_panels.even[derivative];
  result.rightCols(nodes()) = on_panels.rightCols(points()) * at_panels.odd[derivative];
  return result;
}

Vector MembraneMesh::at_panels(const Vector &nodal) const {
  Vector values(2 * points);
  for (std::size_t k = 0; k < parts.size(); ++k)
    values(rows_of_part(parts[k].first_point, parts[k].points(), points)) =
        parts[k].values_at_panels(nodal(rows(k)));
  return values;
}

MembraneShape shape_at(const MembraneMesh &mesh, const Vector &position) {
  const Eigen::Index n = mesh.nodes;
  MembraneShape shape;
  shape.position = position;
  shape.targets = {position.head(n), position.tail(n), Vector(n), Vector(n)};
  Curve &nodes = shape.nodes = blank_curve(n, n);
  Curve &panels = shape.panels = blank_curve(mesh.points, mesh.panel_points);
  nodes.x = shape.targets.x;
  nodes.r = shape.targets.r;
  for (const MembraneMesh::Part &p : mesh.parts) {
    const auto x = nodes.x.segment(p.first_node, p.nodes());
    const auto r = nodes.r.segment(p.first_node, p.nodes());
    shape.targets.bend_x.segment(p.first_node, p.nodes()).noalias() = p.even_bend * x;
    shape.targets.bend_r.segment(p.first_node, p.nodes()).noalias() = p.odd_bend * r;
    nodes.x_zeta.segment(p.first_node, p.nodes()) = p.at_nodes.even[1] * x;
    nodes.r_zeta.segment(p.first_node, p.nodes()) = p.at_nodes.odd[1] * r;
    nodes.weights.segment(p.first_node, p.nodes()) = p.at_nodes.weights;
    panels.x.segment(p.first_point, p.points()) = p.at_panels.even[0] * x;
    panels.r.segment(p.first_point, p.points()) = p.at_panels.odd[0] * r;
    panels.x_zeta.segment(p.first_point, p.points()) = p.at_panels.even[1] * x;
    panels.r_zeta.segment(p.first_point, p.points()) = p.at_panels.odd[1] * r;
    panels.weights.segment(p.first_point, p.points()) = p.at_panels.weights;
  }
  complete(nodes);
  complete(panels);
  return shape;
}

Targets targets_of(const MembraneMesh &mesh, const MembraneShape &shape, std::size_t membrane) {
  const MembraneMesh::Part &part = mesh.parts[membrane];
  const auto of_part = [&](const Vector &field) { return field.segment(part.first_node, part.nodes()); };
  return {of_part(shape.targets.x), of_part(shape.targets.r), of_part(shape.targets.bend_x),
          of_part(shape.targets.bend_r)};
}

Curve nodes_of(const MembraneMesh &mesh, const MembraneShape &shape, std::size_t membrane) {
  const MembraneMesh::Part &part = mesh.parts[membrane];
  return part_of(shape.nodes, part.first_node, part.nodes());
}

Curve panels_of(const MembraneMesh &mesh, const MembraneShape &shape, std::size_t membrane) {
  const MembraneMesh::Part &part = mesh.parts[membrane];
  return part_of(shape.panels, part.first_point, part.points());
}

NodesNearby::NodesNearby(const MembraneMesh &mesh, const MembraneShape &shape, std::size_t membrane) {
  const Curve nodes = nodes_of(mesh, shape, membrane);
  const double spacings = 1.1 * -std::log(mesh.near_tolerance) / (2 * pi);
  const Eigen::ArrayXd reach = spacings * pi / static_cast<double>(nodes.size()) * nodes.arc.array();
  x_ = nodes.x;
  r_ = nodes.r;
  reach_squared_ = reach.square();
  low_ = x_.minCoeff() - reach.maxCoeff();
  high_ = x_.maxCoeff() + reach.maxCoeff();
}

bool NodesNearby::hold(double x, double r) const {
  return x > low_ && x < high_ && ((x_ - x).square() + (r_ - r).square() < reach_squared_).any();
}

} // namespace capsule
