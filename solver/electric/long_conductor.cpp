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

constexpr double pi = std::numbers::pi;

// Next to each zeta, where dx/dzeta vanishes. Errors of it count by their square only.
Vector extremes_near(Vector zeta, const MeridianBasis &basis, const Vector &x_expansion) {
  constexpr int newton_steps = 3;
  for (int k = 0; k < newton_steps; ++k)
    zeta =
        (zeta -
         basis.even_expansion(zeta, 1, x_expansion).cwiseQuotient(basis.even_expansion(zeta, 2, x_expansion)))
            .cwiseMax(0)
            .cwiseMin(pi);
  return zeta;
}

// Where x passes a place of the pore between two zeta.
double crossing(double place, double low, double high, const MeridianBasis &basis,
                const Vector &x_expansion) {
  constexpr unsigned digits = 24; // binary: errors count by their third power
  std::uintmax_t most_places = 50;
  const auto [before, after] = boost::math::tools::toms748_solve(
      [&](double zeta) { return basis.even_expansion(Vector::Constant(1, zeta), 0, x_expansion)[0] - place; },
      low, high, boost::math::tools::eps_tolerance<double>(digits), most_places);
  return (before + after) / 2;
}

// Panels between places, as long as n nodes need them; at least two.
Panels panels_between(const std::vector<double> &ends, Eigen::Index n) {
  const double longest = (ends.back() - ends.front()) / static_cast<double>(n / 10 + 1);
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
  const Vector x = position.head(n), r = position.tail(n);
  const Vector x_expansion = basis.even_from_nodes * x;
  // The outer part of the meridian lies between the points farthest upstream and downstream: poles, or the rim of a
  // concave end.
  Eigen::Index rear = 0, front = 0;
  const double first_x = x.minCoeff(&rear), last_x = x.maxCoeff(&front);
  const Vector tips = extremes_near(Vector{{basis.nodes[rear], basis.nodes[front]}}, basis, x_expansion);
  const double first = tips[0], last = tips[1];
  std::vector<double> ends{first};
  for (const double lip : {0.0, pore.exit_x}) // where the wall's curvature may jump
    if (first_x < lip && last_x > lip)
      ends.push_back(crossing(lip, first, last, basis, x_expansion));
  ends.push_back(last);

  const Panels panels = panels_between(ends, n);
  const Vector place = basis.even_expansion(panels.points, 0, x_expansion);
  const Vector slope = basis.even_expansion(panels.points, 1, x_expansion);
  const Vector radius = basis.odd(panels.points, 0, r);
  double sum = 0;
  for (Eigen::Index i = 0; i < place.size(); ++i) {
    const double wall = wall_radius(pore, place[i]);
    const double square = radius[i] * radius[i];
    sum += panels.weights[i] * slope[i] * square / (wall * wall * (wall * wall - square));
  }
  return sum;
}

} // namespace capsule
