#include "electric/long_conductor.hpp"
#include "geometry/quadrature.hpp"
#include <algorithm>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

namespace capsule {
namespace {

using std::numbers::pi;

// Next to each zeta, where dx/dzeta vanishes. Errors of it count by their square only.
Vector extremes_near(Vector zeta, const Meridian &meridian) {
  constexpr int newton_steps = 3;
  for (int k = 0; k < newton_steps; ++k) {
    const Meridian::Points here = meridian.at(zeta);
    zeta = (zeta - here.x_1.cwiseQuotient(here.x_2)).cwiseMax(0).cwiseMin(pi);
  }
  return zeta;
}

// Where x passes a place of the pore between two zeta.
double crossing(double place, double low, double high, const Meridian &meridian) {
  constexpr unsigned digits = 24; // binary: errors count by their third power
  std::uintmax_t most_places = 50;
  const auto [before, after] = boost::math::tools::toms748_solve(
      [&](double zeta) { return meridian.at(Vector::Constant(1, zeta)).x[0] - place; }, low, high,
      boost::math::tools::eps_tolerance<double>(digits), most_places);
  return (before + after) / 2;
}

// Panels between places, as long as n nodes need them; at least two.
Panels panels_between(const std::vector<double> &ends, Eigen::Index n) {
  const Eigen::Index fewest = n / 10 + 1;
  const double longest = (ends.back() - ends.front()) / static_cast<double>(fewest);
  std::vector<double> edges{ends.front()};
  for (std::size_t k = 0; k + 1 < ends.size(); ++k) {
    const double length = ends[k + 1] - ends[k];
    const int count = std::max(2, static_cast<int>(std::ceil(length / longest)));
    for (int j = 1; j < count; ++j)
      edges.push_back(ends[k] + length * j / count);
    edges.push_back(ends[k + 1]);
  }
  return make_panels(Eigen::Map<const Vector>(edges.data(), std::ssize(edges)), 12);
}

} // namespace

double long_conductor_change(const Pore &pore, const MeridianBasis &basis, const Vector &position) {
  const Eigen::Index n = basis.size();
  const Vector x = position.head(n);
  const Meridian meridian(basis, position);
  // The outer part of the meridian lies between the points farthest upstream and downstream: poles, or the rim of a
  // concave end.
  Eigen::Index rear = 0, front = 0;
  const double first_x = x.minCoeff(&rear), last_x = x.maxCoeff(&front);
  const Vector tips = extremes_near(Vector{{basis.nodes[rear], basis.nodes[front]}}, meridian);
  const double first = tips[0], last = tips[1];
  std::vector<double> ends{first};
  for (const double lip : {0.0, pore.exit_x}) // where the wall's curvature may jump
    if (first_x < lip && last_x > lip)
      ends.push_back(crossing(lip, first, last, meridian));
  ends.push_back(last);

  const Panels panels = panels_between(ends, n);
  const Meridian::Points points = meridian.at(panels.points);
  double sum = 0;
  for (Eigen::Index i = 0; i < panels.points.size(); ++i) {
    const double wall = wall_radius(pore, points.x[i]);
    const double square = points.r[i] * points.r[i];
    sum += panels.weights[i] * points.x_1[i] * square / (wall * wall * (wall * wall - square));
  }
  return sum;
}

} // namespace capsule
