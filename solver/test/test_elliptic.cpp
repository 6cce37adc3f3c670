// Elliptic integrals against Carlson's forms in 50 digits, and against their definition.
#include "integrals/elliptic.hpp"

#include <boost/math/special_functions/ellint_rd.hpp>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

using namespace capsule;

namespace {

using Wide = boost::multiprecision::cpp_bin_float_50;

struct WideIntegrals {
  Wide b;
  Wide c;
  Wide d;
};

WideIntegrals carlson(const Wide &m1) {
  const Wide b = m1 * boost::math::ellint_rd(Wide(0), Wide(1), m1) / 3;
  const Wide d = boost::math::ellint_rd(Wide(0), m1, Wide(1)) / 3;
  return {b, (d - b) / (1 - m1), d};
}

double relative_error(double value, const Wide &exact) {
  return std::abs(static_cast<double>((value - exact) / exact));
}

// From 1e-300 to 1, dense at both ends.
std::vector<double> complementary_parameters() {
  std::mt19937 random(20020701);
  std::uniform_real_distribution<double> uniform(0, 1);
  std::vector<double> m1{1e-300, 1e-200, 1e-100, 1e-30, 0.25, 0.5, 1 - 0x1p-53};
  for (int i = 0; i < 300; ++i) {
    m1.push_back(uniform(random));
    m1.push_back(std::pow(10, -20 * uniform(random)));
    m1.push_back(1 - std::pow(10, -12 * uniform(random)));
  }
  return m1;
}

} // namespace

BOOST_AUTO_TEST_CASE(integrals_equal_carlsons_forms) {
  EllipticIntegrals error{0, 0, 0};
  for (const double m1 : complementary_parameters()) {
    const WideIntegrals exact = carlson(m1);
    const EllipticIntegrals value = elliptic_integrals(1 - m1, m1, std::log(m1));
    error.b = std::max(error.b, relative_error(value.b, exact.b));
    error.c = std::max(error.c, relative_error(value.c, exact.c));
    error.d = std::max(error.d, relative_error(value.d, exact.d));
  }
  BOOST_TEST(error.b < 5e-16);
  BOOST_TEST(error.c < 3e-15);
  BOOST_TEST(error.d < 5e-16);
}

// The integrands have period pi and are even, so the trapezoid rule over a quarter converges exponentially.
BOOST_AUTO_TEST_CASE(integrals_equal_their_definition) {
  for (const double m1 : {0.3, 0.6, 0.9, 1.0}) {
    const int intervals = 64;
    EllipticIntegrals sum{0, 0, 0};
    for (int i = 0; i <= intervals; ++i) {
      const double theta = std::numbers::pi / 2 * i / intervals;
      const double s = std::sin(theta) * std::sin(theta);
      const double delta = std::sqrt(1 - (1 - m1) * s);
      const double weight = std::numbers::pi / 2 / intervals * (i == 0 || i == intervals ? 0.5 : 1);
      sum.b += weight * (1 - s) / delta;
      sum.c += weight * s * (1 - s) / (delta * delta * delta);
      sum.d += weight * s / delta;
    }
    const EllipticIntegrals value = elliptic_integrals(1 - m1, m1, std::log(m1));
    BOOST_TEST(std::abs(value.b - sum.b) < 2e-15);
    BOOST_TEST(std::abs(value.c - sum.c) < 2e-15);
    BOOST_TEST(std::abs(value.d - sum.d) < 2e-15);
    const double m = 1 - m1;
    BOOST_TEST(std::abs(value.b + value.d - std::comp_ellint_1(std::sqrt(m))) < 4e-15);
    BOOST_TEST(std::abs(value.b + m1 * value.d - std::comp_ellint_2(std::sqrt(m))) < 4e-15);
  }
}

BOOST_AUTO_TEST_CASE(parts_add_up) {
  for (const double m1 : complementary_parameters()) {
    const double m = 1 - m1;
    const double ln_m1 = std::log(m1);
    const EllipticIntegrals whole = elliptic_integrals(m, m1, ln_m1);
    const EllipticIntegrals smooth = elliptic_integrals(m, m1, 0);
    const EllipticLogarithms logarithmic = elliptic_logarithmic(m1);
    BOOST_TEST(std::abs(smooth.b - ln_m1 * m1 * logarithmic.b_over_m1 - whole.b) < 1e-15 * whole.b);
    BOOST_TEST(std::abs(smooth.c - ln_m1 * logarithmic.c - whole.c) < 5e-15 * whole.c);
    BOOST_TEST(std::abs(smooth.d - ln_m1 * logarithmic.d - whole.d) < 1e-15 * whole.d);
    const double quintic = (2 + m1) * m1 * logarithmic.b_over_m1 + m1 * (1 + 2 * m1) * logarithmic.d;
    BOOST_TEST(std::abs(m1 * m1 * logarithmic.quintic_over_m1_squared - quintic) < 5e-15 * m1);
  }
}

// The logarithm multiplies the analytic continuation of the integral with the complementary parameter: for K
// it is K(m1)/pi. Product quadrature rests on this part's being right near 0, not only the sum.
BOOST_AUTO_TEST_CASE(logarithmic_part_is_the_analytic_one) {
  for (const double m1 : {1e-12, 1e-6, 1e-3, 0.01}) {
    const EllipticLogarithms logarithmic = elliptic_logarithmic(m1);
    const double k = m1 * logarithmic.b_over_m1 + logarithmic.d;
    BOOST_TEST(std::abs(k - std::comp_ellint_1(std::sqrt(m1)) / std::numbers::pi) < 1e-11);
  }
}

BOOST_AUTO_TEST_CASE(ratio_with_logarithm_and_reciprocals) {
  std::mt19937 random(18);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (const double m1 : complementary_parameters()) {
    const double denominator = std::pow(10, 12 * uniform(random) - 6);
    const double difference = (1 - m1) * denominator;
    const Wide numerator = Wide(denominator) - difference;
    if (m1 > 0.5) { // an exact difference is known
      const Ratio near_one = ratio(static_cast<double>(numerator), denominator, difference);
      BOOST_TEST(relative_error(near_one.value, numerator / denominator) < 5e-16);
      BOOST_TEST(relative_error(near_one.natural_logarithm, log(Wide(numerator / denominator))) < 1e-15);
    }
    const double small = m1 * denominator;
    if (small > std::numeric_limits<double>::min()) {
      const Ratio any = ratio(small, denominator, denominator - small);
      BOOST_TEST(relative_error(any.value, Wide(small) / denominator) < 8e-16);
      BOOST_TEST(relative_error(any.over_numerator, 1 / Wide(small)) < 8e-16);
      BOOST_TEST(relative_error(any.over_denominator, 1 / Wide(denominator)) < 8e-16);
      BOOST_TEST(std::abs(static_cast<double>(any.natural_logarithm - log(Wide(small) / denominator))) <
                 3e-16 - 1e-15 * std::log(m1));
    }
  }
  BOOST_TEST(ratio(2, 2, 0).value == 1);
  BOOST_TEST(ratio(2, 2, 0).natural_logarithm == 0);
  BOOST_TEST(ratio(0, 2, 2).value == 0);
  BOOST_TEST(std::isinf(ratio(0, 2, 2).over_numerator));
  BOOST_TEST(std::abs(ratio(0, 2, 2).over_denominator - 0.5) < 1e-15);
}
