#include "fit/fit_checks.hpp"
#include "base/failure.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numeric>

namespace capsule {
namespace {

constexpr const char *odd_shape = "is x reversed, is r = 0 the axis, is the law or a fixed value wrong?";

} // namespace

void refuse_other_shapes(const FittedStates &states, const Minimum &minimum) {
  constexpr double largest = 0.1; // of the radius
  for (std::size_t k = 0; k < states.contours().size(); ++k) {
    const Contour &contour = states.contours()[k];
    double sum = 0;
    for (const Foot &foot : states.feet(minimum.parameters, k))
      sum += foot.distance * foot.distance;
    const double residual = std::sqrt(sum / static_cast<double>(contour.x.size()));
    if (residual > largest * size_of(contour).radius)
      throw NumericsFailure(
          failure_kind::unresolved,
          fmt::format("{}: no capsule has this outline: the points are {:.2g} R_t from the best one",
                      contour.file.string(), residual),
          odd_shape);
  }
}

// Independent noise changes its sign between half of all neighbours along the outline, whatever its distribution is. Fewer
// changes than by 3.3 standard deviations of the binomial distribution have a probability below 1e-3; fitted parameters
// only add changes. Residuals that no image shows are errors of rounding and of the mesh.
void warn_of_runs(FitResult &result, std::span<const Contour> contours) {
  constexpr double deviations = 3.3, smallest_seen = 1e-4;
  std::size_t pairs = 0, changes = 0;
  for (std::size_t k = 0; k < contours.size(); ++k) {
    const std::vector<Foot> &feet = result.contours[k].feet;
    std::vector<std::size_t> order(feet.size()); // along the lower half to the rear, back along the upper one
    std::iota(order.begin(), order.end(), 0);
    std::ranges::stable_sort(order, {}, [&](std::size_t i) {
      return !contours[k].lower.empty() && contours[k].lower[i] ? -feet[i].at : feet[i].at;
    });
    for (std::size_t i = 1; i < order.size(); ++i)
      changes += (feet[order[i]].distance > 0) != (feet[order[i - 1]].distance > 0) ? 1 : 0;
    pairs += order.size() - 1;
  }
  const auto count = static_cast<double>(pairs);
  if (result.residual > smallest_seen &&
      static_cast<double>(changes) < (count - deviations * std::sqrt(count)) / 2)
    result.warnings.push_back(fmt::format(
        "the points deviate from the fit to one side over long parts of the outline: {} changes of "
        "side, independent noise would have about {}; {}",
        changes, pairs / 2, odd_shape));
}

void warn_of_noise(FitResult &result) {
  if (result.noise_is_given && result.degrees_of_freedom > 0) {
    const double ratio = result.chi_squared / static_cast<double>(result.degrees_of_freedom);
    const double spread = 3 * std::sqrt(2 / static_cast<double>(result.degrees_of_freedom));
    if (ratio > 1 + spread)
      result.warnings.push_back(
          fmt::format("chi^2 is {:.3g} per degree of freedom: the noise is larger than fit.noise, or no "
                      "law here makes this shape",
                      ratio));
  }
}

void warn_of_velocities(FitResult &result, const FittedStates &states, const Minimum &minimum) {
  constexpr double most = 3;
  Eigen::Index row = states.points();
  for (std::size_t k = 0; states.has_velocities() && k < states.contours().size(); ++k) {
    if (!states.velocity(k))
      continue;
    if (const double deviation = std::abs(minimum.at.values[row++]); deviation > most)
      result.warnings.push_back(fmt::format(
          "{}the velocity is {:.3g} of its standard deviations from that of the fitted capsule; "
          "is it, a flow rate or fit.velocity_noise wrong?",
          states.contours().size() > 1 ? states.contours()[k].file.filename().string() + ": " : "",
          deviation));
  }
}

void warn_of_rivals(FitResult &result) {
  const Candidate &best = result.candidates.front();
  constexpr double decisive = 20;
  for (const Candidate &other : result.candidates)
    if (other.law != best.law && other.failure.empty() && other.evidence_ratio > 1 / decisive)
      result.warnings.push_back(
          fmt::format("{} is as good as {} within a factor of {:.3g} of evidence: this shape "
                      "does not tell them apart",
                      other.law, best.law, 1 / other.evidence_ratio));
}

} // namespace capsule
