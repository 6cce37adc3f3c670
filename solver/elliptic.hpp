#pragma once
// Complete elliptic integrals that the azimuth of a ring leads to. With s = sin^2, c = cos^2 of theta over a
// quarter period, m1 = 1 - m, Delta^2 = 1 - m s:
//   B = int c/Delta,  C = int s c/Delta^3,  D = int s/Delta;  K = B + D,  E = B + m1 D
// Each is smooth - ln(m1) logarithmic, polynomials of m1 both, for 0 < m1 <= 1. Make m1 from coordinate
// differences: 1 - m has no digits left where the kernels need them. Accuracy: relative error below 5e-16 (B,
// D) and 3e-15 (C, where it is small beside B and D). All functions are inline and free of branches: loops
// over them become vector code.
#include "elliptic_coefficients.hpp"

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

namespace capsule {

// Values of B, C, D themselves or of their smooth parts.
struct EllipticIntegrals {
  double b;
  double c;
  double d;
};

// Logarithmic parts, and the two combinations whose strong factors m1 are taken out on paper.
struct EllipticLogarithms {
  double b_over_m1;
  double c;
  double d;
  // ((2 + m1) B + m1 (1 + 2 m1) D)/m1^2, the logarithmic part of the integral of 3/Delta^5
  double cube_over_m1_squared;
};

// Sum of coefficients[First + i] x^i, Horner's scheme written out at compile time.
template <std::size_t First = 0, std::size_t Count>
[[gnu::always_inline]] inline double polynomial(const std::array<double, Count> &coefficients, double x) {
  double sum = coefficients[Count - 1];
  [&]<std::size_t... I>(std::index_sequence<I...>) __attribute__((always_inline)) {
    ((sum = sum * x + coefficients[Count - 2 - I]), ...);
  }
  (std::make_index_sequence<Count - 1 - First>{});
  return sum;
}

[[gnu::always_inline]] inline EllipticIntegrals elliptic_smooth(double m1) {
  using namespace elliptic_coefficients;
  return {polynomial(b_smooth, m1), polynomial(c_smooth, m1), polynomial(d_smooth, m1)};
}

[[gnu::always_inline]] inline EllipticLogarithms elliptic_logarithmic(double m1) {
  using namespace elliptic_coefficients;
  // B = m1 (-1/4 + m1 b), D = 1/2 + m1 d
  const double b = polynomial<2>(b_logarithmic, m1);
  const double d = polynomial<1>(d_logarithmic, m1);
  return {.b_over_m1 = b_logarithmic[1] + m1 * b,
          .c = polynomial(c_logarithmic, m1),
          .d = d_logarithmic[0] + m1 * d,
          .cube_over_m1_squared = 0.75 + (2 + m1) * b + (1 + 2 * m1) * d};
}

[[gnu::always_inline]] inline EllipticIntegrals elliptic_sum(const EllipticIntegrals &smooth,
                                                             const EllipticLogarithms &logarithmic, double m1,
                                                             double ln_m1) {
  return {smooth.b - ln_m1 * (m1 * logarithmic.b_over_m1), smooth.c - ln_m1 * logarithmic.c,
          smooth.d - ln_m1 * logarithmic.d};
}

// A ratio, its reciprocals and its natural logarithm at the price of one division.
struct Ratio {
  double value;             // numerator/denominator
  double over_numerator;    // 1/numerator, infinite if that is zero or denormal
  double over_denominator;  // 1/denominator
  double natural_logarithm; // of the value
};

// For 0 <= numerator <= denominator, denominator between 1e-100 and 1e100.
[[gnu::always_inline]] inline Ratio ratio_with_logarithm(double numerator, double denominator) {
  // The numerator is scaled with 2^-k, which brings it to between 2/3 and 3/2 of the denominator. The
  // difference of the bits of two positive numbers is a piecewise linear logarithm; k is that, rounded.
  // `bias` keeps it positive, so that shifts without sign do; 2^52 is added in the bits and subtracted in the
  // number to convert k to a double.
  constexpr std::uint64_t one = std::uint64_t{1} << 52U;
  constexpr std::uint64_t bias = 1024;
  const auto numerator_bits = std::bit_cast<std::uint64_t>(numerator);
  const std::uint64_t biased_k =
      (numerator_bits - std::bit_cast<std::uint64_t>(denominator) + bias * one + one / 2) >> 52U;
  const double k = std::bit_cast<double>(std::bit_cast<std::uint64_t>(0x1p52) | biased_k) - (0x1p52 + bias);
  const auto scaled = std::bit_cast<double>(numerator_bits - ((biased_k - bias) << 52U));
  const auto scale = std::bit_cast<double>(((1023 + bias) - biased_k) << 52U);

  const double product = scaled * denominator;
  const double sum = scaled + denominator;
  const double reciprocal = 1 / (product * sum);
  const double over_product = reciprocal * sum;
  const double over_numerator = over_product * denominator * scale;
  const double over_denominator = over_product * scaled;
  const double s = (scaled - denominator) * (product * reciprocal);
  return {.value = numerator * over_denominator,
          .over_numerator = numerator < 0x1p-1022 ? HUGE_VAL : over_numerator,
          .over_denominator = over_denominator,
          .natural_logarithm =
              k * 0x1.62e42fefa39efp-1 + s * polynomial(elliptic_coefficients::natural_logarithm, s * s)};
}

} // namespace capsule
