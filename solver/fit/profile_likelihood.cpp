#include "fit/profile_likelihood.hpp"
#include "base/failure.hpp"
#include <algorithm>
#include <cmath>
#include <limits>

namespace capsule {

// The root of the growth is close to linear in the way: the secant of the last two tries leads to the next. Each try begins
// with the last one that has not gone too far.
Reach reach(const LeastSquares &problem, const Minimum &minimum, const Matrix &covariance,
            Eigen::Index parameter, int sense, double growth) {
  constexpr int most_tries = 15;
  constexpr double close = 0.02; // of the growth: a hundredth of the way
  constexpr double boldest = 3;  // a way over the last one, where the sum hardly grows
  const double here = minimum.parameters[parameter];
  const double bound = sense > 0 ? problem.high[parameter] : problem.low[parameter];
  const double room = std::abs(bound - here);
  const Vector along = sense * covariance.col(parameter) / covariance(parameter, parameter);
  const double wanted = std::sqrt(growth);
  double way = wanted * std::sqrt(covariance(parameter, parameter));
  double inside = 0,
         outside = std::numeric_limits<double>::infinity(); // ways known to be too short, too long
  Vector from = minimum.parameters;                         // the minimum at the first of them
  double last_way = 0, last_root = 0;
  bool ends = false;
  for (int k = 0; k < most_tries && inside < (1 - close / 2) * outside; ++k) {
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
      const double root = std::sqrt(std::max(grown, 0.0)), slope = (root - last_root) / (way - last_way);
      next = slope > 0 ? way + (wanted - root) / slope : outside;
      last_way = way;
      last_root = root;
      if (grown < growth) {
        if (way >= room)
          return {bound, true, true};
        inside = way;
        from = there.parameters;
      } else {
        outside = way;
        ends = false;
      }
    } catch (const NumericsFailure &) { // too far at once, or beyond the last state
      outside = way;
      ends = true;
    }
    const double longest = std::min(boldest * way, room);
    if (!(next > inside && next < outside))
      next = outside <= room ? (inside + outside) / 2 : longest;
    way = std::min(next, longest);
  }
  if (outside <= room && !ends) // a jump, or too many tries: not too short
    return {here + sense * outside};
  return {here + sense * inside, true, false, ends};
}

} // namespace capsule
