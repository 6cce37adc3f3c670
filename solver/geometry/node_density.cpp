#include "geometry/node_density.hpp"
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

namespace capsule {
namespace {

using std::numbers::pi;

// Midpoints of equal parts of [0, pi].
Vector midpoints(Eigen::Index parts) {
  return (Eigen::ArrayXd::LinSpaced(parts, 0, static_cast<double>(parts - 1)) + 0.5) * pi /
         static_cast<double>(parts);
}

// The angle as a function of zeta: zeta plus a series of sines, whose coefficients are `rest`.
struct AngleMap {
  AngleMap(const MeridianBasis &basis, const Vector &node_angle)
      : rest(basis.odd_from_nodes * (node_angle - basis.nodes)) {}
  Eigen::ArrayXd value(const Eigen::ArrayXd &zeta) const { return zeta + sine_series(rest, zeta).array(); }
  Eigen::ArrayXd slope(const Eigen::ArrayXd &zeta) const {
    Vector slopes(rest.size() + 1);
    slopes << 0, waves().cwiseProduct(rest);
    return 1 + cosine_series(slopes, zeta).array();
  }
  Eigen::ArrayXd bend(const Eigen::ArrayXd &zeta) const {
    return -sine_series(waves().array().square() * rest.array(), zeta).array();
  }
  // k of the series.
  Vector waves() const { return Vector::LinSpaced(rest.size(), 1, static_cast<double>(rest.size())); }
  Vector rest;
};

// Inverse of a function that grows from 0 to pi on [0, pi], at given values: from a table, then by Newton's method.
template <class Value, class Slope>
Eigen::ArrayXd inverted(const Value &value, const Slope &slope, const Eigen::ArrayXd &at) {
  constexpr int newton_steps = 4;
  const Eigen::ArrayXd table_at = Eigen::ArrayXd::LinSpaced(1001, 0, pi);
  const Eigen::ArrayXd table = value(table_at);
  Eigen::ArrayXd result(at.size());
  for (Eigen::Index k = 0; k < at.size(); ++k) {
    const Eigen::Index above = std::clamp<Eigen::Index>(
        std::upper_bound(table.begin(), table.end(), at[k]) - table.begin(), 1, 1000);
    const double part = (at[k] - table[above - 1]) / (table[above] - table[above - 1]);
    result[k] = table_at[above - 1] + part * (table_at[above] - table_at[above - 1]);
  }
  for (int step = 0; step < newton_steps; ++step)
    result += (at - value(result)) / slope(result);
  return result;
}

// The logarithm of a smooth density of nodes per angle, as coefficients of cosines of the angle.
Vector density_logarithm(const MeridianBasis &basis, const Vector &node_angle, const Vector &position) {
  constexpr double shortest_wave = 24; // about
  constexpr Eigen::Index waves = 64, points = 1024;
  const Eigen::Index n = basis.size();
  const AngleMap map(basis, node_angle);
  const Vector zeta = midpoints(points);
  const Eigen::ArrayXd slope = map.slope(zeta), bend = map.bend(zeta);
  const auto by_angle = [&](const Eigen::ArrayXd &first, const Eigen::ArrayXd &second) -> Eigen::ArrayXd {
    const Eigen::ArrayXd once = first / slope;
    return once.square() + ((second - once * bend) / slope.square()).square();
  };
  const Eigen::ArrayXd squares =
      by_angle(basis.even(zeta, 1, position.head(n)), basis.even(zeta, 2, position.head(n))) +
      by_angle(basis.odd(zeta, 1, position.tail(n)), basis.odd(zeta, 2, position.tail(n)));
  const Eigen::ArrayXd density = 0.5 * (1 + squares / squares.minCoeff()).log();
  Vector coefficients = cosine_moments(density * slope * 2 / points, map.value(zeta), waves);
  coefficients[0] /= 2;
  for (Eigen::Index k = 0; k < waves; ++k)
    coefficients[k] *= std::exp(-std::pow(static_cast<double>(k) / shortest_wave, 2));
  return coefficients;
}

// Angles of nodes zeta with this density: its integral over the angle grows evenly with zeta.
Vector angles_of_density(const Vector &logarithm, const Vector &zeta) {
  constexpr Eigen::Index waves = 256, points = 1024;
  const Vector angle = midpoints(points);
  const Vector density = cosine_series(logarithm, angle).array().exp();
  Vector parts = cosine_moments(density, angle, waves);
  parts *= 2 / parts[0];
  parts[0] = 1;
  const Vector integrals = parts.tail(waves - 1).array() / Eigen::ArrayXd::LinSpaced(waves - 1, 1, waves - 1);
  return inverted(
      [&](const Eigen::ArrayXd &a) -> Eigen::ArrayXd { return a + sine_series(integrals, a).array(); },
      [&](const Eigen::ArrayXd &a) -> Eigen::ArrayXd { return cosine_series(parts, a); }, zeta.array());
}

} // namespace

Vector suitable_angles(const MeridianBasis &new_basis, const MeridianBasis &basis, const Vector &node_angle,
                       const Vector &position) {
  const Vector logarithm = density_logarithm(basis, node_angle, position);
  // The shape has no more waves than its own nodes carry: on as many nodes every density would do. Fewer tell which
  // one resolves it best.
  const MeridianBasis fewer =
      spectral_basis(std::max(3, static_cast<int>(0.6 * static_cast<double>(basis.size()))));
  double best = 0, least = std::numeric_limits<double>::infinity();
  for (const double strength : {0.0, 0.25, 0.5, 0.75, 1.0}) {
    const Vector angles = angles_of_density(strength * logarithm, fewer.nodes);
    const double unresolved = unresolved_part(fewer, at_angles(angles, basis, node_angle, position));
    if (unresolved < least) {
      least = unresolved;
      best = strength;
    }
  }
  return angles_of_density(best * logarithm, new_basis.nodes);
}

Vector at_angles(const Vector &angles, const MeridianBasis &basis, const Vector &node_angle,
                 const Vector &position) {
  const Eigen::Index n = basis.size();
  const AngleMap map(basis, node_angle);
  const Vector zeta = inverted([&](const Eigen::ArrayXd &a) { return map.value(a); },
                               [&](const Eigen::ArrayXd &a) { return map.slope(a); }, angles.array());
  Vector moved(2 * zeta.size());
  moved << basis.even(zeta, 0, position.head(n)), basis.odd(zeta, 0, position.tail(n));
  return moved;
}

double unresolved_part(const MeridianBasis &basis, const Vector &position) {
  const Eigen::Index n = basis.size(), last = n / 10 + 1;
  return std::hypot((basis.even_from_nodes.bottomRows(last) * position.head(n)).norm(),
                    (basis.odd_from_nodes.bottomRows(last) * position.tail(n)).norm());
}

} // namespace capsule
