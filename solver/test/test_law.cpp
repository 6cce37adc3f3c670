// The table of laws, and the laws of eqs. 4 and 5 against their textbook limits and against differences in many digits.
#include "law/law.hpp"
#include "law/neo_hookean.hpp"
#include "law/skalak.hpp"
#include "law_checks.hpp"
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <set>
#include <string>

using namespace capsule;
namespace tt = boost::test_tools;

namespace {

// The definitions of the headers.
template <class T>
T neo_hookean_energy(const T &a, const T &b) {
  const T a2 = a * a, b2 = b * b;
  return (a2 + b2 + 1 / (a2 * b2) - 3) / 2;
}
template <class T>
T skalak_energy(double c, const T &a, const T &b) {
  const T a2 = a * a, b2 = b * b;
  return ((a2 - 1) * (a2 - 1) + (b2 - 1) * (b2 - 1) + c * (a2 * b2 - 1) * (a2 * b2 - 1)) / 4;
}

// Eqs. 4 and 5 as printed.
double printed_neo_hookean(double along, double across) {
  const double area = along * across;
  return (along * along - 1 / (area * area)) / area;
}
double printed_skalak(double c, double along, double across) {
  const double area = along * across;
  return (along * along * (along * along - 1) + c * area * area * (area * area - 1)) / area;
}

} // namespace

BOOST_AUTO_TEST_SUITE(table)

// What the keys and the choices of a case file are made of.
BOOST_AUTO_TEST_CASE(names_and_initial_values) {
  std::set<std::string> names, parameters;
  for (const Law *law : laws()) {
    BOOST_TEST(names.insert(law->name).second, law->name);
    for (const LawParameter &parameter : law->parameters) {
      BOOST_TEST(parameters.insert(parameter.name).second, parameter.name);
      BOOST_TEST(inside(parameter.range, parameter.initial), parameter.name);
      BOOST_TEST(std::string(law->formula).find(parameter.symbol) != std::string::npos, law->formula);
    }
  }
}

BOOST_AUTO_TEST_CASE(law_and_values_in_any_order) {
  MembraneLaw law(skalak, {0.25});
  law.choose(neo_hookean);
  BOOST_TEST(law.is(neo_hookean));
  BOOST_TEST(law.values().empty());
  law.choose(skalak);
  BOOST_TEST(law.values()[0] == 0.25);
  BOOST_TEST(MembraneLaw(skalak).values()[0] == skalak.parameters[0].initial);
}

BOOST_AUTO_TEST_CASE(no_law_is_another) {
  std::set<double> seen;
  for (const Law *law : laws())
    BOOST_TEST(seen.insert(tensions(*law, 1.4, 0.8).meridional).second, law->name);
}

// At rest no law pulls, and none knows which direction is which.
BOOST_AUTO_TEST_CASE(rest_and_symmetry) {
  for (const Law *law : laws()) {
    const StrainEnergy rest = strain_energy(*law, 1, 1);
    BOOST_TEST(rest.w == 0);
    BOOST_TEST(rest.w_a == 0);
    BOOST_TEST(rest.w_b == 0);
    const StrainEnergy one = strain_energy(*law, 1.4, 0.8), other = strain_energy(*law, 0.8, 1.4);
    BOOST_TEST(one.w == other.w, tt::tolerance(1e-15));
    BOOST_TEST(one.w_a == other.w_b, tt::tolerance(1e-15));
    BOOST_TEST(one.w_aa == other.w_bb, tt::tolerance(1e-15));
    BOOST_TEST(one.w_ab == other.w_ab, tt::tolerance(1e-15));
    check_that_an_energy_exists(*law);
  }
}

BOOST_AUTO_TEST_SUITE_END()

BOOST_AUTO_TEST_SUITE(neo_hookean_and_skalak)

BOOST_AUTO_TEST_CASE(isotropic_stretch) {
  for (const double s : {0.7, 0.99, 1.0, 1.3, 2.5}) {
    const Tensions rubber = tensions(neo_hookean, s, s);
    BOOST_TEST(rubber.meridional == 1 - std::pow(s, -6), tt::tolerance(1e-13));
    BOOST_TEST(rubber.azimuthal == rubber.meridional);
    for (const double c : {0.0, 1.0, 10.0}) {
      const Tensions cell = tensions({skalak, {c}}, s, s);
      BOOST_TEST(cell.meridional == s * s - 1 + c * s * s * (s * s * s * s - 1), tt::tolerance(1e-13));
      BOOST_TEST(cell.azimuthal == cell.meridional);
    }
  }
}

BOOST_AUTO_TEST_CASE(tensions_are_those_printed) {
  const Tensions rubber = tensions(neo_hookean, 1.4, 0.8);
  BOOST_TEST(rubber.meridional == printed_neo_hookean(1.4, 0.8), tt::tolerance(1e-14));
  BOOST_TEST(rubber.azimuthal == printed_neo_hookean(0.8, 1.4), tt::tolerance(1e-14));
  for (const double c : {0.0, 1.5}) {
    const Tensions cell = tensions({skalak, {c}}, 1.4, 0.8);
    BOOST_TEST(cell.meridional == printed_skalak(c, 1.4, 0.8), tt::tolerance(1e-14));
    BOOST_TEST(cell.azimuthal == printed_skalak(c, 0.8, 1.4), tt::tolerance(1e-14));
  }
}

BOOST_AUTO_TEST_CASE(uniaxial_tension) {
  for (const double a : {0.8, 1.0, 1.2, 2.0}) {
    BOOST_TEST(std::abs(tensions(neo_hookean, a, 1 / std::sqrt(a)).azimuthal) < 1e-15);
    for (const double c : {0.0, 0.5, 3.0}) {
      const double b = std::sqrt((1 + c * a * a) / (1 + c * a * a * a * a));
      BOOST_TEST(std::abs(tensions({skalak, {c}}, a, b).azimuthal) < 1e-14);
    }
  }
}

BOOST_AUTO_TEST_CASE(small_strains_follow_hooke) {
  check_small_strains(neo_hookean, 3, 0.5);
  for (const double c : {0.0, 1.0, 4.0})
    check_small_strains({skalak, {c}}, 1 + 2 * c, c / (1 + c));
}

BOOST_AUTO_TEST_CASE(derivatives_are_those_of_the_energy) {
  check_derivatives(neo_hookean, [](const auto &a, const auto &b) { return neo_hookean_energy(a, b); });
  for (const double c : {0.0, 2.0})
    check_derivatives({skalak, {c}}, [c](const auto &a, const auto &b) { return skalak_energy(c, a, b); });
}

BOOST_AUTO_TEST_SUITE_END()
