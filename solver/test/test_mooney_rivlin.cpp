// The Mooney-Rivlin law against its definition, its values elsewhere and the neo-Hookean law.
#include "law/mooney_rivlin.hpp"
#include "law/neo_hookean.hpp"
#include "law_checks.hpp"

using namespace capsule;
namespace tt = boost::test_tools;

BOOST_AUTO_TEST_CASE(derivatives_and_digits) {
  for (const double psi : {0.0, 0.3, 1.0})
    check_derivatives({mooney_rivlin, {psi}}, [psi](const auto &a, const auto &b) {
      const auto a2 = a * a, b2 = b * b;
      return (psi * (a2 + b2 + 1 / (a2 * b2) - 3) + (1 - psi) * (a2 * b2 + 1 / a2 + 1 / b2 - 3)) / 2;
    });
}

// Made with other programs.
BOOST_AUTO_TEST_CASE(values) {
  const MembraneLaw law(mooney_rivlin, {0.5});
  BOOST_TEST(tensions(law, 1.2, 0.9).meridional == 0.48824849, tt::tolerance(1e-7));
  BOOST_TEST(tensions(law, 1.2, 0.9).azimuthal == -0.053475334, tt::tolerance(1e-7));
  BOOST_TEST(tensions(law, 1.1, 1.1).meridional == 0.48125631, tt::tolerance(1e-7));
}

// Its tensions are the neo-Hookean ones times Psi + (1 - Psi) b^2, b the stretch across.
BOOST_AUTO_TEST_CASE(the_neo_hookean_law_times_a_factor) {
  for (const double psi : {0.0, 0.4, 1.0})
    for (const double a : {0.6, 1.0, 1.7})
      for (const double b : {0.8, 1.3}) {
        const Tensions rubber = tensions(neo_hookean, a, b), t = tensions({mooney_rivlin, {psi}}, a, b);
        BOOST_TEST(t.meridional == rubber.meridional * (psi + (1 - psi) * b * b), tt::tolerance(1e-14));
        BOOST_TEST(t.azimuthal == rubber.azimuthal * (psi + (1 - psi) * a * a), tt::tolerance(1e-14));
      }
}

BOOST_AUTO_TEST_CASE(small_strains_and_energy) {
  for (const double psi : {0.0, 0.5, 1.0}) {
    check_small_strains({mooney_rivlin, {psi}}, 3, 0.5);
    check_that_an_energy_exists({mooney_rivlin, {psi}});
  }
}
