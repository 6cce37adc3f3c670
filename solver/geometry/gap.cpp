#include "geometry/gap.hpp"
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace capsule {
namespace {

// A line across the axis from a point outwards passes the chain an odd number of times.
bool inside(double x, double r, const Chain &chain) {
  bool odd = false;
  for (Eigen::Index k = 1; k < chain.x.size(); ++k) {
    const double x_0 = chain.x[k - 1], x_1 = chain.x[k];
    if ((x_0 > x) == (x_1 > x))
      continue;
    const double part = (x - x_0) / (x_1 - x_0);
    if (chain.r[k - 1] + part * (chain.r[k] - chain.r[k - 1]) > r)
      odd = !odd;
  }
  return odd;
}

bool any_inside(const Chain &a, const Chain &b) {
  for (Eigen::Index k = 0; k < a.x.size(); ++k)
    if (inside(a.x[k], a.r[k], b))
      return true;
  return false;
}

// The nearest place of a chain to a point, by the square of its distance.
struct Nearest {
  double square, x, r;
};
Nearest nearest_on(const Chain &chain, double x, double r) {
  Nearest found{std::numeric_limits<double>::infinity(), 0, 0};
  for (Eigen::Index k = 1; k < chain.x.size(); ++k) {
    const double along_x = chain.x[k] - chain.x[k - 1], along_r = chain.r[k] - chain.r[k - 1];
    const double to_x = x - chain.x[k - 1], to_r = r - chain.r[k - 1];
    const double part =
        std::clamp((to_x * along_x + to_r * along_r) / (along_x * along_x + along_r * along_r), 0.0, 1.0);
    const double away_x = to_x - part * along_x, away_r = to_r - part * along_r;
    const double square = away_x * away_x + away_r * away_r;
    if (square < found.square)
      found = {square, x - away_x, r - away_r};
  }
  return found;
}

// From points of a to chords of b where that is less than the gap that is known, with the place on a or, if `of_chords`,
// on b. From one point to the next the distance falls by no more than the points are apart: those that are surely
// farther are skipped.
Gap nearest(const Chain &a, const Chain &b, bool of_chords, Gap found) {
  double at_least = 0; // of the present point's distance
  for (Eigen::Index i = 0; i < a.x.size(); ++i) {
    if (i > 0)
      at_least -= std::hypot(a.x[i] - a.x[i - 1], a.r[i] - a.r[i - 1]);
    if (at_least > found.width)
      continue;
    const Nearest place = nearest_on(b, a.x[i], a.r[i]);
    at_least = std::sqrt(place.square);
    if (at_least < found.width)
      found = of_chords ? Gap{at_least, place.x, place.r} : Gap{at_least, a.x[i], a.r[i]};
  }
  return found;
}

// How far the meridian may reach from each node until the next one on either side, or the pole: twice the chords.
Eigen::ArrayXd reach_of_nodes(const Chain &nodes) {
  const Eigen::Index n = nodes.x.size();
  Eigen::ArrayXd chords(n + 1); // at the poles twice the distance to the axis
  chords[0] = 2 * nodes.r[0];
  chords[n] = 2 * nodes.r[n - 1];
  for (Eigen::Index k = 1; k < n; ++k)
    chords[k] = std::hypot(nodes.x[k] - nodes.x[k - 1], nodes.r[k] - nodes.r[k - 1]);
  return 2 * chords.head(n).max(chords.tail(n));
}

// The part of a chain from the node before the first one that may be nearest to the other membrane's nodes to the node
// behind the last one.
Chain near_part(const MeridianBasis &basis, const Vector &position, const Eigen::ArrayXd &surely_apart,
                double gap_at_nodes, int chords_per_node) {
  const Eigen::Index n = basis.size();
  Eigen::Index first = 0, last = n - 1;
  while (first < last && surely_apart[first] > gap_at_nodes)
    ++first;
  while (last > first && surely_apart[last] > gap_at_nodes)
    --last;
  const double from = first == 0 ? 0 : basis.nodes[first - 1];
  const double to = last == n - 1 ? std::numbers::pi : basis.nodes[last + 1];
  const Vector all = Vector::LinSpaced(chords_per_node * n + 1, 0, std::numbers::pi);
  const double *const begin = std::upper_bound(all.data() + 1, all.data() + all.size(), from) - 1;
  const double *const end = std::lower_bound(begin, all.data() + all.size() - 1, to) + 1;
  const Vector zeta = Eigen::Map<const Vector>(begin, end - begin);
  return {basis.even(zeta, 0, position.head(n)), basis.odd(zeta, 0, position.tail(n))};
}

} // namespace

Chain chain_of(const MeridianBasis &basis, const Vector &position, int chords_per_node) {
  const Eigen::Index n = basis.size();
  const Vector zeta = Vector::LinSpaced(chords_per_node * n + 1, 0, std::numbers::pi);
  return {basis.even(zeta, 0, position.head(n)), basis.odd(zeta, 0, position.tail(n))};
}

bool overlap(const Chain &a, const Chain &b) {
  return any_inside(a, b) || any_inside(b, a);
}

Gap gap_between(const Chain &a, const Chain &b) {
  const Gap from_a = nearest(a, b, false, {std::numeric_limits<double>::infinity(), 0, 0});
  return nearest(b, a, true, from_a);
}

Gap gap_between(const MeridianBasis &basis_a, const Vector &position_a, const MeridianBasis &basis_b,
                const Vector &position_b, int chords_per_node) {
  const Eigen::Index n_a = basis_a.size(), n_b = basis_b.size();
  const Chain a{position_a.head(n_a), position_a.tail(n_a)}, b{position_b.head(n_b), position_b.tail(n_b)};
  const Eigen::ArrayXd reach_a = reach_of_nodes(a), reach_b = reach_of_nodes(b);
  // Distances of the nodes, and what surely lies between a node's surroundings and the other membrane.
  Eigen::ArrayXXd distance(n_a, n_b);
  for (Eigen::Index j = 0; j < n_b; ++j)
    distance.col(j) = ((a.x.array() - b.x[j]).square() + (a.r.array() - b.r[j]).square()).sqrt();
  const double gap_at_nodes = distance.minCoeff();
  distance.rowwise() -= reach_b.transpose();
  distance.colwise() -= reach_a;
  return gap_between(
      near_part(basis_a, position_a, distance.rowwise().minCoeff(), gap_at_nodes, chords_per_node),
      near_part(basis_b, position_b, distance.colwise().minCoeff().transpose(), gap_at_nodes,
                chords_per_node));
}

} // namespace capsule
