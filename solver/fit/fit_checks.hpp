#pragma once
// Whether a fit is one: what its residuals and its rivals say about it, as warnings of the result; lengths in R_t.
// Throws what is said below.
#include "fit/fit_result.hpp"

namespace capsule {

// Throws NumericsFailure for a contour from which the best outline is more than a tenth of its radius away.
void refuse_other_shapes(const FittedStates &states, const Minimum &minimum);

void warn_of_noise(FitResult &result); // larger than it was given
// Of residuals to one side over long parts of the outline.
void warn_of_runs(FitResult &result, std::span<const Contour> contours);
// Of velocities that the fitted capsule does not have, by three of their standard deviations.
void warn_of_velocities(FitResult &result, const FittedStates &states, const Minimum &minimum);
void warn_of_rivals(FitResult &result); // of laws that fit as well

} // namespace capsule
