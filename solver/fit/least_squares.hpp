#pragma once
// Least squares with bounds: Gauss-Newton in a trust region (Levenberg and Marquardt, scaled by the columns' lengths) for
// functions that cannot be evaluated everywhere. GSL's multifit_nlinear has the same method, but knows neither bounds nor a
// point where there is no value: here such a step is rejected and the region shrinks.
#include "base/linear_algebra.hpp"
#include <functional>
#include <string>

namespace capsule {

struct Residuals {
  Vector values;
  Matrix slopes; // values x parameters
};

struct LeastSquares {
  std::function<Residuals(const Vector &)> evaluate; // may throw NumericsFailure
  Vector low, high;                                  // bounds; a parameter whose bounds are equal is fixed
  Vector longest;                                    // step of each parameter
  // The next step is not worth while: it would lower the sum of squares by less than this.
  double tolerance = 1e-8;
  int most_steps = 40;
};

struct Minimum {
  Vector parameters;
  Residuals at;
  bool converged = false;
  std::string failure = {}; // what the last rejected step ran into, if it has ended there
  double sum() const { return at.values.squaredNorm(); }
};

// From a start within the bounds. Throws NumericsFailure if there is no value at the start, and what `evaluate` throws else.
Minimum minimise(const LeastSquares &problem, const Vector &start);

// Parameters at a bound beyond which the sum would be lower.
Eigen::Array<bool, Eigen::Dynamic, 1> held(const LeastSquares &problem, const Minimum &minimum);

// (J^T J)^-1 of the parameters that are not fixed; zero for the others. Not finite where two columns are parallel.
Matrix covariance(const LeastSquares &problem, const Residuals &at);

} // namespace capsule
