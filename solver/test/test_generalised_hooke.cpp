// The generalised law of Hooke against its definition, its values elsewhere and Skalak's law.
#include "law/generalised_hooke.hpp"
#include "law/skalak.hpp"
#include "law_checks.hpp"

using namespace capsule;
namespace tt = boost::test_tools;

BOOST_AUTO_TEST_CASE(derivatives_and_digits) {
  for (const double nu : {-0.9, 0.0, 0.4, 0.95})
    check_derivatives({generalised_hooke, {nu}}, [nu](const auto &a, const auto &b) {
      const auto e = a * a - 1, f = b * b - 1;
      return (e * e + f * f + 2 * nu * e * f) / (4 * (1 - nu));
    });
}

// Made with other programs.
BOOST_AUTO_TEST_CASE(values) {
  const MembraneLaw law(generalised_hooke, {0.4});
  BOOST_TEST(tensions(law, 1.2, 0.9).meridional == 0.80888889, tt::tolerance(1e-7));
  BOOST_TEST(tensions(law, 1.2, 0.9).azimuthal == -0.0175, tt::tolerance(1e-12));
  BOOST_TEST(tensions(law, 1.1, 1.1).meridional == 0.49, tt::tolerance(1e-12));
}

BOOST_AUTO_TEST_CASE(without_lateral_effect_it_is_skalaks_with_c_0) {
  for (const double a : {0.6, 1.0, 1.7})
    for (const double b : {0.8, 1.3}) {
      const StrainEnergy one = strain_energy({generalised_hooke, {0}}, a, b);
      const StrainEnergy other = strain_energy({skalak, {0}}, a, b);
      BOOST_TEST(one.w == other.w, tt::tolerance(1e-14));
      BOOST_TEST(one.w_a == other.w_a, tt::tolerance(1e-14));
      BOOST_TEST(one.w_b == other.w_b, tt::tolerance(1e-14));
      BOOST_TEST(one.w_aa == other.w_aa, tt::tolerance(1e-14));
      BOOST_TEST(one.w_ab == other.w_ab, tt::tolerance(1e-14));
      BOOST_TEST(one.w_bb == other.w_bb, tt::tolerance(1e-14));
    }
}

BOOST_AUTO_TEST_CASE(small_strains_and_energy) {
  for (const double nu : {-0.5, 0.0, 0.4, 0.9}) {
    check_small_strains({generalised_hooke, {nu}}, (1 + nu) / (1 - nu), nu);
    check_that_an_energy_exists({generalised_hooke, {nu}});
  }
}
