#include "case/empty_pore.hpp"
#include <algorithm>
#include <array>
#include <boost/math/special_functions/chebyshev.hpp>
#include <cmath>
#include <numbers>

namespace capsule {
namespace {

using std::numbers::pi;

// Of the loss over the half hyperboloid's, less 1, in 2 sqrt(cos alpha) - 1; the first one counts by half. Written by
// tool/fit_mouth.cpp.
constexpr std::array coefficients{-1.17627e-02, 8.31570e-03,  -2.07721e-03, -1.01385e-03,
                                  7.54577e-04,  -1.73575e-05, -1.13242e-04, 3.32518e-05,
                                  2.81597e-06,  -4.36478e-06, 1.21433e-06};

} // namespace

double half_hyperboloid_loss(double opening_angle_deg) {
  const double alpha = opening_angle_deg * pi / 180;
  const double one_minus_cosine = 2 * std::pow(std::sin(alpha / 2), 2);
  return 1.5 * pi * std::pow(std::sin(alpha), 3) /
         (std::pow(one_minus_cosine, 2) * (3 - 2 * one_minus_cosine));
}

double mouth_loss(double opening_angle_deg) {
  const double cosine = std::max(0.0, std::cos(opening_angle_deg * pi / 180));
  const double place = 2 * std::sqrt(cosine) - 1;
  return half_hyperboloid_loss(opening_angle_deg) *
         (1 + boost::math::chebyshev_clenshaw_recurrence(coefficients.data(), coefficients.size(), place));
}

double empty_pressure_drop(const PoreSpec &pore, double tube_length) {
  const int mouths = pore.shape == PoreShape::two_mouths ? 2 : pore.shape == PoreShape::hyperbolic ? 1 : 0;
  return 8 * tube_length + (mouths > 0 ? mouths * mouth_loss(pore.opening_angle_deg) : 0);
}

} // namespace capsule
