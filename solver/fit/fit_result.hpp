#pragma once
// What a fit says: values with their errors, laws in the order of their evidence, fitted shapes; lengths in R_t. Throws nothing.
#include "fit/fitted_states.hpp"
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
  double chi_squared = 0; // with an estimated noise: the degrees of freedom
  Eigen::Index rows = 0;
  // To the best candidate; from before the mesh of that one was refined further.
  double aic = 0, evidence_ratio = 0;
  std::string failure; // why there is no fit
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

} // namespace capsule
