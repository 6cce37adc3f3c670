#include "flow/joined_panels.hpp"
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace capsule {
namespace {

double distance(const Surroundings &membrane, double x, double r) {
  return std::hypot(std::max(std::abs(x - membrane.centre) - membrane.half_length, 0.0),
                    std::max(r - membrane.radius, 0.0));
}

// Places are told apart in steps of these lengths, so that the capsule stays in one for a while.
constexpr double step_of_centre = 1;
constexpr double step_of_size = 0.25;

Surroundings surroundings(const Vector &x, const Vector &r) {
  const double low = x.minCoeff(), high = x.maxCoeff();
  const auto raised = [](double length) { return step_of_size * std::ceil(length / step_of_size); };
  return {.centre = step_of_centre * std::round((low + high) / 2 / step_of_centre),
          .half_length = raised((high - low) / 2) + step_of_centre / 2,
          .radius = raised(r.maxCoeff())};
}

} // namespace

std::vector<Surroundings> place_of(const MembraneMesh &mesh, const Vector &position) {
  std::vector<Surroundings> place;
  for (const MembraneMesh::Part &part : mesh.parts)
    place.push_back(surroundings(position.segment(part.first_node, part.nodes()),
                                 position.segment(mesh.nodes + part.first_node, part.nodes())));
  return place;
}

Vector joined_panels(const Panels &panels, const Curve &wall, double near_tolerance,
                     const std::vector<Surroundings> &membranes) {
  const Eigen::Index p = wall.panel_points;
  const double height = std::sinh(-std::log(near_tolerance) / static_cast<double>(p));
  const auto distance_to = [&](Eigen::Index panel) {
    double nearest = std::numeric_limits<double>::infinity();
    for (Eigen::Index k = panel * p; k < (panel + 1) * p; ++k)
      for (const Surroundings &membrane : membranes)
        nearest = std::min(nearest, distance(membrane, wall.x[k], wall.r[k]));
    return nearest;
  };
  // The wall itself has to be interpolated, too: a lip or a sharp bend is not.
  const auto interpolates = [&](Eigen::Index begin, Eigen::Index end, double tolerance) {
    const Panels joined = make_panels(Vector{{panels.edges[begin], panels.edges[end]}}, static_cast<int>(p));
    const Curve coarse = on_longer_panels(wall, panels, joined);
    const Eigen::Index n = (end - begin) * p;
    const Matrix interpolation = lagrange_matrix(joined.points, panels.points.segment(begin * p, n));
    return (interpolation * coarse.x - wall.x.segment(begin * p, n)).cwiseAbs().maxCoeff() < tolerance &&
           (interpolation * coarse.r - wall.r.segment(begin * p, n)).cwiseAbs().maxCoeff() < tolerance;
  };
  std::vector<double> edges{panels.edges[0]};
  for (Eigen::Index begin = 0, end = 0; begin < panels.count(); begin = end) {
    end = begin + 1;
    for (double nearest = distance_to(begin); end < panels.count(); ++end) {
      nearest = std::min(nearest, distance_to(end));
      const double half = (panels.edges[end + 1] - panels.edges[begin]) / 2;
      if (nearest < height * half || !interpolates(begin, end + 1, near_tolerance * nearest))
        break;
    }
    edges.push_back(panels.edges[end]);
  }
  return Eigen::Map<const Vector>(edges.data(), std::ssize(edges));
}

Curve on_longer_panels(const Curve &curve, const Panels &whole, const Panels &longer) {
  const Eigen::Index p = whole.rule.size();
  Curve result;
  result.panel_points = p;
  result.weights = longer.weights;
  const std::array fields{&Curve::x, &Curve::r, &Curve::x_zeta, &Curve::r_zeta};
  for (const auto field : fields)
    (result.*field).resize(longer.points.size());
  for (Eigen::Index k = 0; k < longer.points.size(); ++k) {
    const double *const begin = whole.edges.data();
    const Eigen::Index panel =
        std::upper_bound(begin + 1, begin + whole.count(), longer.points[k]) - begin - 1;
    const Matrix share = lagrange_matrix(whole.points.segment(panel * p, p), longer.points.segment(k, 1));
    for (const auto field : fields)
      (result.*field)[k] = share.row(0) * (curve.*field).segment(panel * p, p);
  }
  complete(result);
  return result;
}

Joining::Joining(const Panels &whole, const Panels &longer, int components)
    : components_(components), fine_(whole.points.size()), coarse_(longer.points.size()) {
  const Eigen::Index p = longer.rule.size();
  Eigen::Index begin = 0;
  for (Eigen::Index k = 0; k < longer.count(); ++k) {
    Eigen::Index end = begin + 1;
    while (whole.edges[end] < longer.edges[k + 1])
      ++end;
    const Eigen::Index count = (end - begin) * p;
    joined_.push_back({begin * p, count, k * p, p, {}});
    if (count > p)
      joined_.back().interpolation =
          lagrange_matrix(longer.points.segment(k * p, p), whole.points.segment(begin * p, count));
    begin = end;
  }
}

Vector Joining::operator()(const Vector &values) const {
  return columns(values.transpose()).transpose();
}

RowMatrix Joining::columns(const Eigen::Ref<const RowMatrix> &matrix) const {
  RowMatrix result(matrix.rows(), unknowns());
  result.col(coarse_) = matrix.col(fine_);
  for_each_component([&](const Joined &panel, Eigen::Index from, Eigen::Index to) {
    const auto values = matrix.middleCols(from, panel.count);
    if (panel.interpolation.size() == 0)
      result.middleCols(to, panel.points) = values;
    else
      result.middleCols(to, panel.points).noalias() = values * panel.interpolation;
  });
  return result;
}

// By rows of a panel, which stay in the cache.
RowMatrix Joining::both_sides(const RowMatrix &matrix) const {
  RowMatrix result(unknowns(), unknowns());
  result.row(coarse_) = columns(matrix.row(fine_));
  for_each_component([&](const Joined &panel, Eigen::Index from, Eigen::Index to) {
    const RowMatrix values = columns(matrix.middleRows(from, panel.count));
    if (panel.interpolation.size() == 0)
      result.middleRows(to, panel.points) = values;
    else
      result.middleRows(to, panel.points).noalias() = panel.interpolation.transpose() * values;
  });
  return result;
}

} // namespace capsule
