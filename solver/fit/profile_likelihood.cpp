#include "fit/profile_likelihood.hpp"
#include "base/failure.hpp"
#include <algorithm>
#include <cmath>
#include <limits>

namespace capsule {

// The minimum over the others is close to a parabola in the way: its root is a first guess, and the ratio of the growth
// there to the one wanted corrects it. Each try begins with the last one that has not gone too far.
Reach reach(const LeastSquares &problem, const Minimum &minimum, const Matrix &covariance,
            Eigen::Index parameter, int sense, double growth) {
  constexpr int most_tries = 12;
  constexpr double close = 0.02; // of the growth: a hundredth of the way
  const double here = minimum.parameters[parameter];
  const double bound = sense > 0 ? problem.high[parameter] : problem.low[parameter];
  const double room = std::abs(bound - here);
  const Vector along = sense * covariance.col(parameter) / covariance(parameter, parameter);
  double way = std::sqrt(growth * covariance(parameter, parameter));
  double inside = 0,
         outside = std::numeric_limits<double>::infinity(); // ways known to be too short, too long
  Vector from = minimum.parameters;                         // the minimum at the first of them
  for (int k = 0; k < most_tries; ++k) {
    way = std::min(way, room);
    if (way <= 0)
      return {bound, true, true};
    LeastSquares others = problem;
    others.low[parameter] = others.high[parameter] = here + sense * way;
    others.tolerance = close / 4 * growth;
    const Vector start = (from + (way - inside) * along).cwiseMax(others.low).cwiseMin(others.high);
    double next = 0;
    try {
      const Minimum there = minimise(others, start);
      const double grown = there.sum() - minimum.sum();
      if (std::abs(grown / growth - 1) < close)
        return {here + sense * way};
      if (grown < growth) {
        if (way >= room)
          return {bound, true, true};
        inside = way;
        from = there.parameters;
      } else
        outside = way;
      next = way * std::sqrt(growth / std::clamp(grown, 0.1 * growth, 10 * growth));
    } catch (const NumericsFailure &) { // too far at once, or beyond the last state
      outside = way;
    }
    way = next > inside && next < outside ? next : (inside + std::min(outside, room)) / 2;
  }
  return {here + sense * inside, true};
}

} // namespace capsule
