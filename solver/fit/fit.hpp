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
#include "fit/fitted_states.hpp"
#include "observe/outcome.hpp"
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace capsule {

// A fitted value, or one that follows from it.
struct FittedValue {
  std::string name; // "capsule.radius", "physical.shear_modulus"
  double value = 0, standard_error = 0;
  double low = 0, high = 0; // of the 90 % interval
  bool low_is_open = false, high_is_open = false;
};

// Of one law.
struct Candidate {
  std::string law;
  std::vector<std::string> names; // of the parameters
  Vector parameters;
  double residual = 0;    // root mean square of the distances, in R_t
  double chi_squared = 0; // 0 if there is no noise to compare with
  Eigen::Index rows = 0;
  double aic = 0, evidence_ratio = 0; // to the best candidate
  std::string failure;                // why there is no fit
};

struct FittedContour {
  double place = 0; // of the origin of the model on the axis
  double capillary_number = 0;
  SteadyState state;
  std::vector<Foot> feet;
};

struct FitResult {
  std::string law;
  std::vector<FittedValue> values;
  Matrix correlations; // of the first of these
  double noise = 0;    // standard deviation of a point, given or estimated
  bool noise_is_given = false;
  double residual = 0, chi_squared = 0;
  Eigen::Index degrees_of_freedom = 0;
  std::vector<Candidate> candidates; // the best first
  std::vector<std::string> warnings;
  std::vector<FittedContour> contours;
};

// Where fits of the same case may begin: the states of one before, by law.
using FitStarts = std::map<std::string, std::pair<SteadyState, Vector>>;

// All contours together, as one capsule. `starts`: of a contour beside this one; afterwards those of this fit.
// Throws NumericsFailure if no law can be fitted, Interrupted.
FitResult fit_contours(const Case &input, std::span<const Contour> contours, FitStarts &starts,
                       const Control &control);

} // namespace capsule
