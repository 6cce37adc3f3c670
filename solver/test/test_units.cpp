// Quantities as they are typed: many spellings of one number, and what is refused.
#include "case/units.hpp"
#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <utility>
#include <vector>

using namespace capsule;

namespace {

const std::vector<Dimension> named = {
    dimension::length,  dimension::viscosity,  dimension::flow_rate,         dimension::pressure,
    dimension::tension, dimension::energy,     dimension::surface_viscosity, dimension::velocity,
    dimension::time,    dimension::resistance, dimension::resistivity};

double si(const std::string &text, const Dimension &of) {
  const auto read = read_quantity(text, of);
  BOOST_REQUIRE_MESSAGE(std::holds_alternative<Quantity>(read), text);
  return std::get<Quantity>(read).si;
}

NoQuantity refused(const std::string &text, const Dimension &of) {
  const auto read = read_quantity(text, of);
  BOOST_REQUIRE_MESSAGE(std::holds_alternative<NoQuantity>(read), text);
  return std::get<NoQuantity>(read);
}

} // namespace

// Decimal prefixes are exact: what is read is the double that C++ reads, to the last bit.
BOOST_AUTO_TEST_CASE(lengths) {
  for (const char *text :
       {"5 um", "5um", "5   um", " 5 um ", "5e0 um", "5 \u00b5m", "5 \u03bcm", "5\u00a0\u00b5m", "5 micron",
        "5e-3 mm", "5000 nm", "5e-6 m", "0.0005 cm", "5 um^1", "5 um2/um"})
    BOOST_TEST(si(text, dimension::length) == 5e-6, text);
  BOOST_TEST(si("3.7 um", dimension::length) == 3.7e-6);
  BOOST_TEST(si("0.1 nm", dimension::length) == 1e-10);
}

BOOST_AUTO_TEST_CASE(viscosities) {
  for (const char *text :
       {"1.2 mPa.s", "1.2 mPa s", "1.2 mPa*s", "1.2 mPa\u00b7s", "1.2 mPa\u22c5s", "1.2 mPa . s", "1.2 cP",
        "0.012 P", "1.2e-3 kg.m-1.s-1", "1.2e-3 kg/(m s)", "1.2e-3 kg / ( m . s )", "1.2e-3 kg/m/s",
        "1.2e-3 kg/m.s", "1.2e-3 kg m\u207b\u00b9 s\u207b\u00b9", "1.2e-2 g/(cm.s)", "1.2e-3 N.s/m^2",
        "1.2 fN.s/um2"})
    BOOST_TEST(si(text, dimension::viscosity) == 1.2e-3, text);
}

BOOST_AUTO_TEST_CASE(flow_rates) {
  for (const char *text : {"0.1 nl/s", "0.1 nL/s", "100 pL/s", "1e5 fL/s", "6 nl/min", "6 nL min^-1",
                           "360 nl/h", "1e5 um^3/s", "1e5 um3/s", "1e5 \u00b5m\u00b3/s",
                           "1e5 \u00b5m\u00b3 s\u207b\u00b9", "1e-4 mm^3/s", "1e-13 m3/s", "1e5 um.um.um/s"})
    BOOST_TEST(si(text, dimension::flow_rate) == 1e-13, text);
}

BOOST_AUTO_TEST_CASE(resistances_and_resistivities) {
  for (const char *text :
       {"16.5 kohm", "16.5 kOhm", "16500 ohm", "0.0165 Mohm", "16.5 k\u03a9", "16.5 k\u2126"})
    BOOST_TEST(si(text, dimension::resistance) == 16500, text);
  for (const char *text : {"0.65 ohm.m", "65 ohm.cm", "65 ohm cm", "0.65 \u03a9\u00b7m", "6.5e-4 kohm.m"})
    BOOST_TEST(si(text, dimension::resistivity) == 0.65, text);
  BOOST_TEST(refused("0.65 ohm", dimension::resistivity).why ==
             "'0.65 ohm' is a resistance, not a resistivity");
  BOOST_TEST(refused("0.65 omh.m", dimension::resistivity).meant == "0.65 ohm.m");
  BOOST_TEST(refused("0.65 ohm2", dimension::resistivity).why ==
             "'0.65 ohm2' is a quantity in m4.kg2.s-6.A-4, not a resistivity");
}

BOOST_AUTO_TEST_CASE(pressures_tensions_energies) {
  for (const char *text :
       {"100 Pa", "0.1 kPa", "1 mbar", "1e-3 bar", "100 N/m2", "100 pN/um^2", "1000 dyn/cm2"})
    BOOST_TEST(si(text, dimension::pressure) == 100, text);
  for (const char *text : {"0.02 mN/m", "20 uN/m", "20 \u00b5N/m", "20 pN/um", "0.02 dyn/cm", "2e-5 N/m",
                           "0.02 mJ/m2", "0.02 g/s2", "0.02 g.s^-2", "20 Pa.um", "0.02 zJ/nm2"})
    BOOST_TEST(si(text, dimension::tension) == 2e-5, text);
  for (const char *text : {"0.5 aJ", "0.5 pN.um", "5e-19 N.m", "5e-19 N m", "500 pN.nm"})
    BOOST_TEST(si(text, dimension::energy) == 5e-19, text);
}

// Units of the laboratory, by their definitions: the inch is 25.4 mm, the pound 0.45359237 kg, standard gravity
// 9.80665 m/s2, conventional mercury 13595.1 kg/m3, and k 1.380649e-23 J/K.
BOOST_AUTO_TEST_CASE(units_of_the_laboratory) {
  const auto is = [](const std::string &text, const Dimension &of, double value) {
    BOOST_TEST(si(text, of) == value, boost::test_tools::tolerance(1e-12));
  };
  is("1 hPa", dimension::pressure, 100);
  is("3 mmHg", dimension::pressure, 3e-3 * 13595.1 * 9.80665);
  is("2 cmH2O", dimension::pressure, 2 * 10 * 9.80665);
  is("2 mmH2O", dimension::pressure, 2 * 9.80665);
  is("2 psi", dimension::pressure, 2 * 0.45359237 * 9.80665 / (0.0254 * 0.0254));
  is("0.5 atm", dimension::pressure, 50662.5);
  is("760 Torr", dimension::pressure, 101325);
  is("50 kT", dimension::energy, 50 * 1.380649e-23 * 298.15);
  is("10 kT/nm2", dimension::tension, 10 * 1.380649e-23 * 298.15 * 1e18);
  BOOST_TEST(si("2e-12 erg", dimension::energy) == 2e-19);
  BOOST_TEST(si("200 zJ", dimension::energy) == 2e-19);
  BOOST_TEST(si("1 erg/cm2", dimension::tension) == 1e-3);
  BOOST_TEST(si("5 dm", dimension::length) == 0.5);
  for (const char *text :
       {"6 ul/min", "6 uL min^-1", "6 ul.min-1", "6 \u00b5L\u00b7min\u207b\u00b9", "6 \u00b5l min\u22121",
        "6 ul per min", "6 ul/minute", "6e-3 cc/min", "6e-3 cc per min", "6 mm3/min", "360 ul/h", "360 ul/hr",
        "360 ul per hour", "0.1 ul/sec"})
    BOOST_TEST(si(text, dimension::flow_rate) == 1e-10, text);
}

// A suggestion that is another magnitude would be taken by a user in a hurry: whatever is mistyped, it keeps the first
// letter, which may be the prefix.
BOOST_AUTO_TEST_CASE(a_suggestion_keeps_the_magnitude) {
  BOOST_TEST(refused("5 Gm3x/s", dimension::flow_rate).meant.empty());
  BOOST_TEST(refused("5 inHg", dimension::pressure).meant.empty());
  BOOST_TEST(refused("5 mmhg", dimension::pressure).meant == "5 mmHg");
  BOOST_TEST(refused("5 cmH20", dimension::pressure).meant == "5 cmH2O");
  BOOST_TEST(refused("5 qPa", dimension::pressure).meant.empty());
  BOOST_TEST(refused("5 TPa", dimension::pressure).meant.empty());
  BOOST_TEST(refused("5 El/s", dimension::flow_rate).meant.empty());
  BOOST_TEST(refused("5 kt", dimension::energy).meant == "5 kT");
  BOOST_TEST(refused("4 mum", dimension::length).meant == "4 um");
  BOOST_TEST(refused("6 mcl/min", dimension::flow_rate).meant == "6 ul/min");
  BOOST_TEST(refused("20 muN/m", dimension::tension).meant == "20 uN/m");
}

// "min" is no milli-inch, "mN" no metre-newton, "Pa" no peta-are.
BOOST_AUTO_TEST_CASE(times_and_velocities) {
  BOOST_TEST(si("2 min", dimension::time) == 120);
  BOOST_TEST(si("2 h", dimension::time) == 7200);
  BOOST_TEST(si("2 ms", dimension::time) == 2e-3);
  BOOST_TEST(si("6 mm/min", dimension::velocity) == 1e-4);
  BOOST_TEST(si("1 g/cm3", dimension::density) == 1000);
  BOOST_TEST(si("1.2 kg/l", dimension::density) == 1200);
}

BOOST_AUTO_TEST_CASE(what_is_no_quantity_is_refused) {
  const std::vector<std::pair<const char *, const char *>> refusals = {
      {"", "'' is no number with a unit"},
      {"um", "'um' is no number with a unit"},
      {"5", "'5' has no unit"},
      {"5 feet", "unknown unit 'feet' in '5 feet'"},
      {"5 um/", "a unit is missing in '5 um/'"},
      {"5 um.", "a unit is missing in '5 um.'"},
      {"5 .um", "a unit is missing in '5 .um'"},
      {"5 um..um", "a unit is missing in '5 um..um'"},
      {"5 um/(s", "a unit is missing in '5 um/(s'"},
      {"5 um)", "a unit is missing in '5 um)'"},
      {"5 um2x", "unknown unit 'um2x' in '5 um2x'"},
      {"5 um^", "unknown unit 'um^' in '5 um^'"},
      {"5 um^10", "unknown unit 'um^10' in '5 um^10'"},
      {"5 um99999999999", "unknown unit 'um99999999999' in '5 um99999999999'"},
      {"5 m-2147483648", "unknown unit 'm-2147483648' in '5 m-2147483648'"},
      {"5 \u00b7 10 um", "'5 \u00b7 10 um': a power of ten is written as in 5e-6"},
      {"5 10 um", "'5 10 um': a power of ten is written as in 5e-6"},
      {"5\u00d710\u207b\u2076 m", "'5\u00d710\u207b\u2076 m': a power of ten is written as in 5e-6"},
      {"5 x 10^-6 m", "'5 x 10^-6 m': a power of ten is written as in 5e-6"},
      {"5 \u2127", "unknown unit '\u2127' in '5 \u2127'"},
      {"-5 um", "'-5 um' is not above 0"},
      {"0 um", "'0 um' is not above 0"},
      {"nan um", "'nan um' is not above 0"},
      {"inf um", "'inf um' is beyond what numbers can hold"},
      {"1e-300 pm9.m-8", "'1e-300 pm9.m-8' is beyond what numbers can hold"},
      {"1e400 um", "'1e400 um' is no number with a unit"},
      {"5 s", "'5 s' is a time, not a length"},
      {"5 um/s", "'5 um/s' is a velocity, not a length"},
      {"5 um^3", "'5 um^3' is a quantity in m3, not a length"},
      {"5 um/um", "'5 um/um' is a number without dimension, not a length"},
      {"5 g", "'5 g' is a quantity in kg, not a length"}};
  for (const auto &[text, why] : refusals)
    BOOST_TEST(refused(text, dimension::length).why == why);
}

// A number in another program's notation is named and written anew where it can mean one thing only.
BOOST_AUTO_TEST_CASE(numbers_of_quantities_in_other_notations) {
  for (const auto &[text, meant] : {std::pair{"0,5 um", "0.5 um"},
                                    {"5d-6 m", "5e-6 m"},
                                    {"5.0D-6m", "5.0e-6m"},
                                    {"+5 um", "5 um"},
                                    {"1,000 um", ""},
                                    {"1,0005 um", "1.0005 um"}})
    BOOST_TEST(refused(text, dimension::length).meant == meant);
  BOOST_TEST(refused("5d-6 m", dimension::length).why == "'5d-6 m' has a d in its number");
  BOOST_TEST(si("5 dm", dimension::length) == 0.5);
  BOOST_TEST(si("5dm", dimension::length) == 0.5);
}

BOOST_AUTO_TEST_CASE(what_was_meant) {
  BOOST_TEST(refused("5 ym", dimension::length).meant == "5 um");
  BOOST_TEST(refused("5 umm", dimension::length).meant == "5 um");
  BOOST_TEST(refused("5 microns", dimension::length).meant == "5 micron");
  BOOST_TEST(refused("1,5 um", dimension::length).meant == "1.5 um");
  BOOST_TEST(refused("5 feet", dimension::length).meant.empty());
  BOOST_TEST(refused("5 s", dimension::length).meant.empty());
  BOOST_TEST(refused("1 mPas", dimension::viscosity).meant == "1 mPa.s");
  BOOST_TEST(refused("1 mpa.s", dimension::viscosity).meant == "1 mPa.s");
  BOOST_TEST(refused("2.5e1 fl/sek", dimension::flow_rate).meant == "2.5e1 fl/sec");
  BOOST_TEST(refused("2 pN/ym", dimension::tension).meant == "2 pN/um");
  BOOST_TEST(refused("2 \u00b5n/m", dimension::tension).meant == "2 uN/m");
  BOOST_TEST(refused("2 " + std::string(10000, 'x'), dimension::length).meant.empty());
}

BOOST_AUTO_TEST_CASE(a_quantity_reads_back) {
  std::vector<Dimension> dimensions = named;
  dimensions.push_back({1, 1, 1});
  for (const Dimension &of : dimensions)
    for (const double value : {1.0, 2.5e-12, 1.0 / 3})
      BOOST_TEST(si(quantity_text({value}, of), of) == value);
  BOOST_TEST(quantity_text({1e-12}, dimension::flow_rate) == "1e-12 m3/s");
  BOOST_TEST(quantity_text(std::get<Quantity>(read_quantity("0.1 \u00b5l/s", dimension::flow_rate)),
                           dimension::flow_rate) == "0.1 \u00b5l/s");
}

// Whatever is suggested is understood, and is what it is said to be.
BOOST_AUTO_TEST_CASE(examples_are_read) {
  for (const Dimension &of : named) {
    const std::string text = examples_text(of);
    const std::size_t quote = text.find('\''), open = text.find(" (or ");
    BOOST_TEST(si(text.substr(quote + 1, text.find('\'', quote + 1) - quote - 1), of) > 0);
    for (std::size_t at = open + 5; at < text.size(); at = text.find(", ", at) + 2) {
      const std::size_t end = std::min(text.find(", ", at), text.size() - 1);
      BOOST_TEST(si("1 " + text.substr(at, end - at), of) > 0);
      if (end == text.size() - 1)
        break;
    }
  }
}
