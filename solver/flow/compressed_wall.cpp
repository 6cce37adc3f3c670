#include "flow/compressed_wall.hpp"
#include <algorithm>
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

Vector joined_panels(const Wall &wall, const std::vector<Surroundings> &membranes) {
  const Panels &panels = wall.panels();
  const Curve &curve = wall.curve();
  const Eigen::Index p = curve.panel_points;
  const double height = std::sinh(-std::log(wall.near_tolerance()) / static_cast<double>(p));
  const auto distance_to = [&](Eigen::Index panel) {
    double nearest = std::numeric_limits<double>::infinity();
    for (Eigen::Index k = panel * p; k < (panel + 1) * p; ++k)
      for (const Surroundings &membrane : membranes)
        nearest = std::min(nearest, distance(membrane, curve.x[k], curve.r[k]));
    return nearest;
  };
  // The wall itself has to be interpolated, too: a lip or a sharp bend is not.
  const auto interpolates = [&](Eigen::Index begin, Eigen::Index end, double tolerance) {
    const Panels joined = make_panels(Vector{{panels.edges[begin], panels.edges[end]}}, static_cast<int>(p));
    const Curve coarse = on_longer_panels(curve, panels, joined);
    const Eigen::Index n = (end - begin) * p;
    const Matrix interpolation = lagrange_matrix(joined.points, panels.points.segment(begin * p, n));
    return (interpolation * coarse.x - curve.x.segment(begin * p, n)).cwiseAbs().maxCoeff() < tolerance &&
           (interpolation * coarse.r - curve.r.segment(begin * p, n)).cwiseAbs().maxCoeff() < tolerance;
  };
  std::vector<double> edges{panels.edges[0]};
  for (Eigen::Index begin = 0, end = 0; begin < panels.count(); begin = end) {
    end = begin + 1;
    for (double nearest = distance_to(begin); end < panels.count(); ++end) {
      nearest = std::min(nearest, distance_to(end));
      const double half = (panels.edges[end + 1] - panels.edges[begin]) / 2;
      if (nearest < height * half || !interpolates(begin, end + 1, wall.near_tolerance() * nearest))
        break;
    }
    edges.push_back(panels.edges[end]);
  }
  return Eigen::Map<const Vector>(edges.data(), std::ssize(edges));
}

std::shared_ptr<const Wall> CompressedWall::felt_by(const MembraneMesh &mesh, const Vector &position) const {
  if (whole_->unknowns() == 0 || !position.allFinite())
    return whole_;
  std::vector<Surroundings> place;
  for (const MembraneMesh::Part &part : mesh.parts)
    place.push_back(surroundings(position.segment(part.first_node, part.nodes()),
                                 position.segment(mesh.nodes + part.first_node, part.nodes())));
  if (!compressed_ || place != place_) {
    compressed_ = std::make_shared<const Wall>(*whole_, joined_panels(*whole_, place));
    place_ = std::move(place);
  }
  return compressed_;
}

} // namespace capsule
