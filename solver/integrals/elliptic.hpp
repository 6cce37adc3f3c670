#pragma once
// Complete elliptic integrals that the azimuth of a ring leads to. With s = sin^2, c = cos^2 of theta over
// a quarter period, Delta^2 = 1 - m s and m1 = 1 - m:
//   B = int c/Delta,  C = int s c/Delta^3,  D = int s/Delta;  K = B + D,  E = B + m1 D
// for 0 < m1 <= 1. Each is smooth - ln(m1) logarithmic, both parts polynomials of m1.
// m and m1 are both asked for: the one that is small has no digits left if it is made from the other.
// Accuracy: relative error of B and D below 5e-16, of C below 3e-15.
// All functions are inline and free of branches: loops over them become vector code. Nothing is thrown.
#include "integrals/elliptic_coefficients.hpp"

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>
#include <utility>

namespace capsule {

// The integrals themselves or their smooth parts.
struct EllipticIntegrals {
  double b;
  double c;
  double d;
};

// The logarithmic parts. Those of B and of the integral of 3/Delta^5 have strong factors m1, taken out on
// paper.
struct EllipticLogarithms {
  double b_over_m1;
  double c;
  double d;
  double quintic_over_m1_squared; // ((2 + m1) B + m1 (1 + 2 m1) D)/m1^2
};

// Sum of coefficients[First + i] x^i: Horner's scheme, written out at compile time.
template <std::size_t First = 0, std::size_t Count>
[[gnu::always_inline]] inline double polynomial(const std::array<double, Count> &coefficients, double x) {
  double sum = coefficients[Count - 1];
  [&]<std::size_t... I>(std::index_sequence<I...>) __attribute__((always_inline)) {
    ((sum = sum * x + coefficients[Count - 2 - I]), ...);
  }
  (std::make_index_sequence<Count - 1 - First>{});
  return sum;
}

[[gnu::always_inline]] inline EllipticLogarithms elliptic_logarithmic(double m1) {
  using namespace elliptic_coefficients;
  // B = m1 (-1/4 + m1 b) and D = 1/2 + m1 d: the constants cancel in the integral of 1/Delta^5.
  const double b = polynomial<2>(b_logarithmic, m1);
  const double d = polynomial<1>(d_logarithmic, m1);
  return {.b_over_m1 = b_logarithmic[1] + m1 * b,
          .c = polynomial(c_logarithmic, m1),
          .d = d_logarithmic[0] + m1 * d,
          .quintic_over_m1_squared = 0.75 + (2 + m1) * b + (1 + 2 * m1) * d};
}

// What to subtract once the logarithmic parts are multiplied with `ln_m1`. For the smooth parts alone ln_m1 =
// 0.
[[gnu::always_inline]] inline EllipticIntegrals elliptic_integrals(double m, double m1, double ln_m1) {
  using namespace elliptic_coefficients;
  const EllipticLogarithms logarithmic = elliptic_logarithmic(m1);
  // C was fitted with the logarithm less the start of its series at m1 = 1, see tool/fit_elliptic.cpp.
  const double late_logarithm = ln_m1 + m * (1 + 0.5 * m);
  return {.b = polynomial(b_smooth, m1) - ln_m1 * (m1 * logarithmic.b_over_m1),
          .c = polynomial(c_smooth, m1) - late_logarithm * logarithmic.c,
          .d = polynomial(d_smooth, m1) - ln_m1 * logarithmic.d};
}

// A ratio, its logarithm and the reciprocals of its terms at the price of one division.
struct Ratio {
  double value; // numerator/denominator
  double natural_logarithm;
  double over_numerator; // infinite if the numerator is zero or denormal
  double over_denominator;
};

// For 0 <= numerator <= denominator, the denominator between 1e-100 and 1e100. `difference` is denominator -
// numerator with all its digits, on which those of the logarithm hang where the ratio is near 1.
[[gnu::always_inline]] inline Ratio ratio(double numerator, double denominator, double difference) {
  // Scaled with 2^-k the numerator lies between 2/3 and 3/2 of the denominator. The bits of a positive number
  // are a piecewise linear logarithm, and k is the rounded difference of two. The bias keeps it positive for
  // the shifts; to become a double, biased_k is set into the last bits of 2^52.
  constexpr std::uint64_t one = std::uint64_t{1} << 52U;
  constexpr std::uint64_t bias = 1024;
  constexpr std::uint64_t exponent_of_one = 1023;
  constexpr double two_52 = 0x1p52;
  const auto numerator_bits = std::bit_cast<std::uint64_t>(numerator);
  const auto denominator_bits = std::bit_cast<std::uint64_t>(denominator);
  const std::uint64_t biased_k = (numerator_bits - denominator_bits + bias * one + one / 2) >> 52U;
  const double k = std::bit_cast<double>(std::bit_cast<std::uint64_t>(two_52) | biased_k) - (two_52 + bias);
  const auto scaled = std::bit_cast<double>(numerator_bits - ((biased_k - bias) << 52U));
  const auto scale = std::bit_cast<double>((exponent_of_one + bias - biased_k) << 52U);

  const double product = scaled * denominator;
  const double sum = scaled + denominator;
  const double reciprocal = 1 / (product * sum);
  const double over_product = reciprocal * sum;
  const double over_denominator = over_product * scaled;
  const double s = (k == 0 ? -difference : scaled - denominator) * (product * reciprocal);
  return {.value = k == 0 ? 1 - difference * over_denominator : numerator * over_denominator,
          .natural_logarithm =
              k * std::numbers::ln2 + s * polynomial(elliptic_coefficients::natural_logarithm, s * s),
          .over_numerator = numerator < std::numeric_limits<double>::min()
                                ? std::numeric_limits<double>::infinity()
                                : over_product * denominator * scale,
          .over_denominator = over_denominator};
}

} // namespace capsule
