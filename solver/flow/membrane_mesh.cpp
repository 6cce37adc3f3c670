#include "flow/membrane_mesh.hpp"
#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <numeric>
#include <stdexcept>

namespace capsule {

namespace {

constexpr double pi = std::numbers::pi;

Curve blank_curve(Eigen::Index size, Eigen::Index panel_points) {
  Curve curve;
  curve.panel_points = panel_points;
  for (Vector *field : {&curve.x, &curve.r, &curve.x_zeta, &curve.r_zeta, &curve.weights})
    field->resize(size);
  return curve;
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
  mesh.self = make_self_rule(panels, basis.nodes);
  mesh.near_tolerance = resolution.near_tolerance;
  mesh.near = NearRule(mesh.panel_points, mesh.near_tolerance);
  mesh.parts.push_back({.basis = basis,
                        .at_nodes = sample(basis, basis.nodes, basis.weights),
                        .at_panels = sample(basis, panels.points, panels.weights),
                        .even_bend = bend(mesh.self, [&](const Vector &zeta) { return basis.even(zeta, 2); }),
                        .odd_bend = bend(mesh.self, [&](const Vector &zeta) { return basis.odd(zeta, 2); })});
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
    for (SelfRule::Site site : mesh.self.sites) {
      site.first_point += joined.points;
      joined.self.sites.push_back(std::move(site));
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

Vector MembraneMesh::at_panels(const Vector &nodal) const {
  Vector values(2 * points);
  for (const Part &p : parts) {
    values.segment(p.first_point, p.points()).noalias() =
        p.at_panels.even[0] * nodal.segment(p.first_node, p.nodes());
    values.segment(points + p.first_point, p.points()).noalias() =
        p.at_panels.odd[0] * nodal.segment(nodes + p.first_node, p.nodes());
  }
  return values;
}

Matrix MembraneMesh::on_nodes(const RowMatrix &on_panels) const {
  Matrix result(on_panels.rows(), 2 * nodes);
  for (const Part &p : parts) {
    result.middleCols(p.first_node, p.nodes()).noalias() =
        on_panels.middleCols(p.first_point, p.points()) * p.at_panels.even[0];
    result.middleCols(nodes + p.first_node, p.nodes()).noalias() =
        on_panels.middleCols(points + p.first_point, p.points()) * p.at_panels.odd[0];
  }
  return result;
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
    nodes.x_zeta.segment(p.first_node, p.nodes()).noalias() = p.at_nodes.even[1] * x;
    nodes.r_zeta.segment(p.first_node, p.nodes()).noalias() = p.at_nodes.odd[1] * r;
    nodes.weights.segment(p.first_node, p.nodes()) = p.at_nodes.weights;
    panels.x.segment(p.first_point, p.points()).noalias() = p.at_panels.even[0] * x;
    panels.r.segment(p.first_point, p.points()).noalias() = p.at_panels.odd[0] * r;
    panels.x_zeta.segment(p.first_point, p.points()).noalias() = p.at_panels.even[1] * x;
    panels.r_zeta.segment(p.first_point, p.points()).noalias() = p.at_panels.odd[1] * r;
    panels.weights.segment(p.first_point, p.points()) = p.at_panels.weights;
  }
  complete(nodes);
  complete(panels);
  return shape;
}

} // namespace capsule
