#pragma once
// From contours of a steady capsule to its membrane: the unknown keys of a case (its table [fit]) by least squares, for each
// candidate law; what the contours say about them, and what they cannot tell.
//   standard errors, correlations   from the linearised equations at the minimum
//   90 % intervals                  profile likelihood: where the sum of squares, minimised over all other parameters, is
//                                   by 2.706 variances above the minimum; open where it ends at a bound or a fold, or does
//                                   not grow so far
//   ranking of laws                 AIC = n ln(sum/n) + 2k, or sum + 2k if the noise is given; evidence exp(-dAIC/2)
// The search begins from steady states that the program makes itself at the contour's own volume, in flows of several
// strengths, or from the fit of a contour beside this one. Only where states exist: nothing is extrapolated beyond a fold.
#include "fit/fit_result.hpp"
#include "observe/outcome.hpp"
#include <map>
#include <string>

namespace capsule {

// Where fits of the same case may begin: the states of one before, by law.
using FitStarts = std::map<std::string, std::pair<SteadyState, Vector>>;

// All contours together, as one capsule. `starts`: of a contour beside this one; afterwards those of this fit.
// Throws NumericsFailure if no law can be fitted, or no capsule has the outline, Interrupted.
FitResult fit_contours(const Case &input, std::span<const Contour> contours, FitStarts &starts,
                       const Control &control);

} // namespace capsule
