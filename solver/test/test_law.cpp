// The laws of eqs. 4 and 5 against their textbook limits and against differences in many digits.
#include "law/law.hpp"
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <random>

using namespace capsule;
using boost::multiprecision::cpp_bin_float_50;
namespace tt = boost::test_tools;

namespace {

const MembraneLaw neo_hookean{LawName::neo_hookean, 1};
MembraneLaw skalak(double dilatation) {
  return {LawName::skalak, dilatation};
}

// The definitions of the header, digit for digit.
cpp_bin_float_50 defined_energy(const MembraneLaw &law, const cpp_bin_float_50 &a,
                                const cpp_bin_float_50 &b) {
  const cpp_bin_float_50 a2 = a * a, b2 = b * b;
  if (law.name == LawName::neo_hookean) {
    return (a2 + b2 + 1 / (a2 * b2) - 3) / 2;
  }
  return ((a2 - 1) * (a2 - 1) + (b2 - 1) * (b2 - 1) + law.dilatation * (a2 * b2 - 1) * (a2 * b2 - 1)) / 4;
}

// Eqs. 4 and 5 as printed.
double printed_tension(const MembraneLaw &law, double along, double across) {
  const double area = along * across;
  if (law.name == LawName::neo_hookean) {
    return (along * along - 1 / (area * area)) / area;
  }
  return (along * along * (along * along - 1) + law.dilatation * area * area * (area * area - 1)) / area;
}

double relative_error(double value, const cpp_bin_float_50 &exact) {
  return std::abs(static_cast<double>((value - exact) / exact));
}

} // namespace

BOOST_AUTO_TEST_CASE(isotropic_stretch) {
  for (const double s : {0.7, 0.99, 1.0, 1.3, 2.5}) {
    const Tensions rubber = tensions(neo_hookean, s, s);
    BOOST_TEST(rubber.meridional == 1 - std::pow(s, -6), tt::tolerance(1e-13));
    BOOST_TEST(rubber.azimuthal == rubber.meridional);
    for (const double c : {0.0, 1.0, 10.0}) {
      const Tensions cell = tensions(skalak(c), s, s);
      BOOST_TEST(cell.meridional == s * s - 1 + c * s * s * (s * s * s * s - 1), tt::tolerance(1e-13));
      BOOST_TEST(cell.azimuthal == cell.meridional);
    }
  }
}

BOOST_AUTO_TEST_CASE(tensions_are_those_printed) {
  for (const MembraneLaw &law : {neo_hookean, skalak(0), skalak(1.5)}) {
    const Tensions t = tensions(law, 1.4, 0.8);
    BOOST_TEST(t.meridional == printed_tension(law, 1.4, 0.8), tt::tolerance(1e-14));
    BOOST_TEST(t.azimuthal == printed_tension(law, 0.8, 1.4), tt::tolerance(1e-14));
  }
}

BOOST_AUTO_TEST_CASE(uniaxial_tension) {
  for (const double a : {0.8, 1.0, 1.2, 2.0}) {
    BOOST_TEST(std::abs(tensions(neo_hookean, a, 1 / std::sqrt(a)).azimuthal) < 1e-15);
    for (const double c : {0.0, 0.5, 3.0}) {
      const double b = std::sqrt((1 + c * a * a) / (1 + c * a * a * a * a));
      BOOST_TEST(std::abs(tensions(skalak(c), a, b).azimuthal) < 1e-14);
    }
  }
}

BOOST_AUTO_TEST_CASE(small_strains_follow_hooke) {
  struct Moduli {
    MembraneLaw law;
    double young, poisson, area;
  };
  for (const double c : {0.0, 1.0, 4.0}) {
    const double young = 2 * (1 + 2 * c) / (1 + c);
    for (const Moduli &m :
         {Moduli{neo_hookean, 3, 0.5, 3}, Moduli{skalak(c), young, c / (1 + c), 1 + 2 * c}}) {
      BOOST_TEST(m.law.poisson_ratio() == m.poisson, tt::tolerance(1e-15));
      // Hooke's law in the plane: T_s = E/(1 - nu^2) (e_s + nu e_phi), up to the strain's square.
      const double e_s = 1e-7, e_phi = -0.3e-7, factor = m.young / (1 - m.poisson * m.poisson);
      const Tensions t = tensions(m.law, 1 + e_s, 1 + e_phi);
      BOOST_TEST(t.meridional == factor * (e_s + m.poisson * e_phi), tt::tolerance(1e-5));
      BOOST_TEST(t.azimuthal == factor * (e_phi + m.poisson * e_s), tt::tolerance(1e-5));
      // The mean tension is K times the growth of the area, 2 e.
      BOOST_TEST(tensions(m.law, 1 + e_s, 1 + e_s).meridional == 2 * m.area * e_s, tt::tolerance(1e-5));
    }
  }
}

BOOST_AUTO_TEST_CASE(derivatives_are_those_of_the_energy) {
  std::mt19937_64 random(20020701);
  std::uniform_real_distribution<double> stretch(0.4, 2.5), small(-1e-6, 1e-6);
  const cpp_bin_float_50 h = 1e-12; // its square is the relative error of the differences
  for (int trial = 0; trial < 40; ++trial) {
    // Every other state is almost undeformed: w, w_a and w_b must keep their digits there.
    const double a = trial % 2 == 0 ? stretch(random) : 1 + small(random);
    const double b = trial % 2 == 0 ? stretch(random) : 1 + small(random);
    for (const MembraneLaw &law : {neo_hookean, skalak(0), skalak(2)}) {
      const auto w = [&](int i, int j) { return defined_energy(law, a + i * h, b + j * h); };
      const StrainEnergy e = strain_energy(law, a, b);
      BOOST_TEST(relative_error(e.w, w(0, 0)) < 1e-14);
      const double magnitude = std::abs(e.w_a) + std::abs(e.w_b); // one of them may be zero by chance
      BOOST_TEST(relative_error(e.w_a + magnitude, (w(1, 0) - w(-1, 0)) / (2 * h) + magnitude) < 1e-14);
      BOOST_TEST(relative_error(e.w_b + magnitude, (w(0, 1) - w(0, -1)) / (2 * h) + magnitude) < 1e-14);
      BOOST_TEST(relative_error(1 + e.w_aa, 1 + (w(1, 0) - 2 * w(0, 0) + w(-1, 0)) / (h * h)) < 1e-14);
      BOOST_TEST(relative_error(1 + e.w_bb, 1 + (w(0, 1) - 2 * w(0, 0) + w(0, -1)) / (h * h)) < 1e-14);
      BOOST_TEST(relative_error(1 + e.w_ab, 1 + (w(1, 1) - w(1, -1) - w(-1, 1) + w(-1, -1)) / (4 * h * h)) <
                 1e-14);
    }
  }
}
