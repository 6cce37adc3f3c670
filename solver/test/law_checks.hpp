#pragma once
// What every law must do, given its definition for any kind of number.
#include "law/law.hpp"
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <random>

namespace capsule {

inline double relative_error(double value, const boost::multiprecision::cpp_bin_float_50 &exact) {
  return std::abs(static_cast<double>((value - exact) / exact));
}

// All digits of the energy and its derivatives, also where a membrane is almost undeformed. `energy` is the law as it is
// defined, w(a, b).
template <class Energy>
void check_derivatives(const MembraneLaw &law, Energy energy) {
  using Real = boost::multiprecision::cpp_bin_float_50;
  std::mt19937_64 random(20020701);
  std::uniform_real_distribution<double> stretch(0.4, 2.5), small(-1e-6, 1e-6);
  const Real h = 1e-12; // its square is the relative error of the differences
  for (int trial = 0; trial < 40; ++trial) {
    const double a = trial % 2 == 0 ? stretch(random) : 1 + small(random);
    const double b = trial % 2 == 0 ? stretch(random) : 1 + small(random);
    const auto w = [&](int i, int j) { return Real(energy(Real(a + i * h), Real(b + j * h))); };
    const StrainEnergy e = strain_energy(law, a, b);
    BOOST_TEST(relative_error(e.w, w(0, 0)) < 1e-14);
    const double magnitude = std::abs(e.w_a) + std::abs(e.w_b); // one of them may be zero by chance
    BOOST_TEST(relative_error(e.w_a + magnitude, (w(1, 0) - w(-1, 0)) / (2 * h) + magnitude) < 1e-14);
    BOOST_TEST(relative_error(e.w_b + magnitude, (w(0, 1) - w(0, -1)) / (2 * h) + magnitude) < 1e-14);
    const double stiffness = 1 + std::abs(e.w_aa) + std::abs(e.w_bb) + std::abs(e.w_ab);
    const auto close = [&](double value, const Real &exact) {
      return std::abs(static_cast<double>(value - exact)) < 1e-14 * stiffness;
    };
    BOOST_TEST(close(e.w_aa, (w(1, 0) - 2 * w(0, 0) + w(-1, 0)) / (h * h)));
    BOOST_TEST(close(e.w_bb, (w(0, 1) - 2 * w(0, 0) + w(0, -1)) / (h * h)));
    BOOST_TEST(close(e.w_ab, (w(1, 1) - w(1, -1) - w(-1, 1) + w(-1, -1)) / (4 * h * h)));
  }
}

// Hooke's law in the plane for small strains, from the area modulus K and the Poisson ratio, with G = 1.
inline void check_small_strains(const MembraneLaw &law, double area_modulus, double poisson_ratio) {
  BOOST_CHECK_CLOSE(law.poisson_ratio() + 2, poisson_ratio + 2, 1e-12);
  BOOST_CHECK_CLOSE(law.young_modulus(), 4 * area_modulus / (area_modulus + 1), 1e-12);
  BOOST_CHECK_CLOSE(law.young_modulus(), 2 * (1 + poisson_ratio), 1e-12);
  const double e_s = 1e-7, e_phi = -0.3e-7;
  const double factor = 2 / (1 - poisson_ratio);
  const Tensions t = tensions(law, 1 + e_s, 1 + e_phi);
  BOOST_CHECK_CLOSE(t.meridional, factor * (e_s + poisson_ratio * e_phi), 1e-3);
  BOOST_CHECK_CLOSE(t.azimuthal, factor * (e_phi + poisson_ratio * e_s), 1e-3);
  // The mean tension is K times the growth of the area, 2 e.
  BOOST_CHECK_CLOSE(tensions(law, 1 + e_s, 1 + e_s).meridional, 2 * area_modulus * e_s, 1e-3);
}

// The work of the tensions round a closed way of stretches vanishes: d(b T_s)/db = d(a T_phi)/da.
inline void check_that_an_energy_exists(const MembraneLaw &law) {
  const double h = 1e-4;
  for (const double a : {0.7, 1.0, 1.2, 1.9})
    for (const double b : {0.6, 0.9, 1.0, 1.6}) {
      const auto along = [&](double y) { return y * tensions(law, a, y).meridional; };
      const auto across = [&](double x) { return x * tensions(law, x, b).azimuthal; };
      const auto slope = [h](const auto &f, double x) {
        return (8 * (f(x + h) - f(x - h)) - (f(x + 2 * h) - f(x - 2 * h))) / (12 * h);
      };
      const double one = slope(along, b), other = slope(across, a);
      BOOST_CHECK_SMALL(one - other, 1e-9 * (1 + std::abs(one)));
    }
}

} // namespace capsule
