// The law of Evans and Skalak against its definition and its values elsewhere.
#include "law/evans_skalak.hpp"
#include "law_checks.hpp"

using namespace capsule;
namespace tt = boost::test_tools;

BOOST_AUTO_TEST_CASE(derivatives_and_digits) {
  for (const double modulus : {0.1, 3.0, 50.0})
    check_derivatives({evans_skalak, {modulus}}, [modulus](const auto &a, const auto &b) {
      return (a - b) * (a - b) / (2 * a * b) + modulus * (a * b - 1) * (a * b - 1) / 2;
    });
}

// Made with other programs.
BOOST_AUTO_TEST_CASE(values) {
  const MembraneLaw law(evans_skalak, {3});
  BOOST_TEST(tensions(law, 1.2, 0.9).meridional == 0.51006173, tt::tolerance(1e-7));
  BOOST_TEST(tensions(law, 1.2, 0.9).azimuthal == -0.030061728, tt::tolerance(1e-7));
  BOOST_TEST(tensions(law, 1.1, 1.1).meridional == 0.63, tt::tolerance(1e-12));
}

// T_s = (a^2 - b^2)/(2 a^2 b^2) + A (a b - 1), and T_phi with the sign of the first term changed.
BOOST_AUTO_TEST_CASE(tensions_as_published) {
  for (const double a : {0.6, 1.0, 1.7})
    for (const double b : {0.8, 1.3}) {
      const Tensions t = tensions({evans_skalak, {2}}, a, b);
      const double shear = (a * a - b * b) / (2 * a * a * b * b), area = 2 * (a * b - 1);
      BOOST_CHECK_SMALL(t.meridional - shear - area, 1e-14);
      BOOST_CHECK_SMALL(t.azimuthal + shear - area, 1e-14);
    }
}

BOOST_AUTO_TEST_CASE(small_strains_and_energy) {
  for (const double modulus : {0.2, 1.0, 3.0, 100.0}) {
    check_small_strains({evans_skalak, {modulus}}, modulus, (modulus - 1) / (modulus + 1));
    check_that_an_energy_exists({evans_skalak, {modulus}});
  }
}
