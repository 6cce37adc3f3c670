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

// From points of a to chords of b, with the place on a or, if `of_chords`, on b.
Gap nearest(const Chain &a, const Chain &b, bool of_chords) {
  Gap found{std::numeric_limits<double>::infinity(), 0, 0};
  for (Eigen::Index i = 0; i < a.x.size(); ++i)
    for (Eigen::Index k = 1; k < b.x.size(); ++k) {
      const double along_x = b.x[k] - b.x[k - 1], along_r = b.r[k] - b.r[k - 1];
      const double to_x = a.x[i] - b.x[k - 1], to_r = a.r[i] - b.r[k - 1];
      const double part =
          std::clamp((to_x * along_x + to_r * along_r) / (along_x * along_x + along_r * along_r), 0.0, 1.0);
      const double distance = std::hypot(to_x - part * along_x, to_r - part * along_r);
      if (distance < found.width)
        found = of_chords ? Gap{distance, b.x[k - 1] + part * along_x, b.r[k - 1] + part * along_r}
                          : Gap{distance, a.x[i], a.r[i]};
    }
  return found;
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
  const Gap from_a = nearest(a, b, false), from_b = nearest(b, a, true);
  return from_a.width <= from_b.width ? from_a : from_b;
}

} // namespace capsule
