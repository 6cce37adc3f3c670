#include "electric/long_conductor.hpp"
#include "geometry/quadrature.hpp"
#include <algorithm>
#include <boost/math/tools/roots.hpp>
#include <numbers>
#include <vector>

namespace capsule {
namespace {

constexpr double pi = std::numbers::pi;

// Next to zeta, where dx/dzeta vanishes. Errors of it count by their square only.
double extreme_near(double zeta, const MeridianBasis &basis, const Vector &x) {
  constexpr int newton_steps = 3;
  for (int k = 0; k < newton_steps; ++k) {
    const Vector at = Vector::Constant(1, zeta);
    zeta = std::clamp(zeta - basis.even(at, 1, x)[0] / basis.even(at, 2, x)[0], 0.0, pi);
  }
  return zeta;
}

// Where x changes its sign between two places.
double crossing(double low, double high, const MeridianBasis &basis, const Vector &x) {
  constexpr unsigned digits = 24; // binary: errors count by their third power
  const auto [before, after] =
      boost::math::tools::bisect([&](double zeta) { return basis.even(Vector::Constant(1, zeta), 0, x)[0]; },
                                 low, high, boost::math::tools::eps_tolerance<double>(digits));
  return (before + after) / 2;
}

} // namespace

double long_conductor_change(const Pore &pore, const MeridianBasis &basis, const Vector &position) {
  const Eigen::Index n = basis.size();
  const Vector x = position.head(n), r = position.tail(n);
  // The outer part of the meridian lies between the points farthest upstream and downstream: poles, or the rim of a
  // concave end.
  Eigen::Index rear = 0, front = 0;
  const double first_x = x.minCoeff(&rear), last_x = x.maxCoeff(&front);
  const double first = extreme_near(basis.nodes[rear], basis, x);
  const double last = extreme_near(basis.nodes[front], basis, x);
  std::vector<double> ends{first};
  for (const double lip : {0.0, pore.exit_x}) // where the wall's curvature may jump
    if (first_x < lip && last_x > lip)
      ends.push_back(crossing(first, last, basis, x.array() - lip));
  ends.push_back(last);

  double sum = 0;
  for (std::size_t k = 0; k + 1 < ends.size(); ++k) {
    const Panels panels = make_panels(Vector::LinSpaced(n / 10 + 2, ends[k], ends[k + 1]), 12);
    const Vector place = basis.even(panels.points, 0, x);
    const Vector slope = basis.even(panels.points, 1, x);
    const Vector radius = basis.odd(panels.points, 0, r);
    for (Eigen::Index i = 0; i < place.size(); ++i) {
      const double wall = wall_radius(pore, place[i]);
      const double square = radius[i] * radius[i];
      sum += panels.weights[i] * slope[i] * square / (wall * wall * (wall * wall - square));
    }
  }
  return sum;
}

} // namespace capsule
