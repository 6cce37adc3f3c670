// Expressions: arithmetic with known results, references, lists, mistakes.
#include "base/failure.hpp"
#include "compare/expression.hpp"
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <fmt/format.h>

using namespace capsule;

namespace {

// "one" is 1, "list" is 3, 1, 2; "none" is nothing.
Values look_up(const Reference &reference) {
  if (reference.name == "one")
    return {1};
  if (reference.name == "list")
    return {3, 1, 2};
  if (reference.name == "empty")
    return {};
  throw NoValue("no value");
}

double value(const std::string &text) {
  return Expression(text).value(look_up);
}

void check_no_value(const std::string &text, const std::string &why) {
  BOOST_CHECK_EXCEPTION(value(text), NoValue, [&](const NoValue &e) { return e.what() == why; });
}

void check_mistake(const std::string &text, const std::string &message) {
  BOOST_CHECK_EXCEPTION(Expression{text}, InputError, [&](const InputError &e) {
    BOOST_TEST(e.what() == message);
    return true;
  });
}

} // namespace

BOOST_AUTO_TEST_CASE(arithmetic_in_its_usual_order) {
  BOOST_TEST(value("1 + 2*3 - 4/8") == 6.5);
  BOOST_TEST(value("8 - 2 - 1") == 5);
  BOOST_TEST(value("(1 + 2)*3") == 9);
  BOOST_TEST(value("-2^2") == -4);
  BOOST_TEST(value("2^3^2") == 512);
  BOOST_TEST(value("2^-1") == 0.5);
  BOOST_TEST(value("1e-5*1E+5 + .5 + 2.") == 3.5);
  BOOST_TEST(value("log(8)/log(2)") == 3, boost::test_tools::tolerance(1e-14));
  BOOST_TEST(value("one - -one") == 2);
}

BOOST_AUTO_TEST_CASE(lists) {
  BOOST_TEST(value("max(list) - min(list)") == 2);
  BOOST_TEST(value("max(list, 7*one)") == 7);
  BOOST_TEST(value("min(empty, list)") == 1);
  BOOST_TEST(value("max(abs(list - 2.5))") == 1.5); // a number and a list
  BOOST_TEST(value("max(list*list)") == 9);
  BOOST_TEST(value("mean(list)") == 2);
  check_no_value("mean(empty)", "no value");
  check_no_value("list", "several values");
  check_no_value("empty", "no value");
  check_no_value("max(empty)", "no value");
  check_no_value("max(list*empty)", "lists of different length");
  check_no_value("one + none", "no value");
}

// A half circle of radius 1.2 around one of radius 1, both finely drawn.
BOOST_AUTO_TEST_CASE(distance_of_lines) {
  const auto arcs = [](const Reference &reference) {
    const double radius = reference.name.ends_with('0') ? 1 : 1.2;
    Values values;
    for (int k = 0; k <= 400; ++k) {
      const double angle = M_PI * k / 400;
      values.push_back(radius * (reference.name.starts_with('x') ? std::cos(angle) : std::sin(angle)));
    }
    return values;
  };
  BOOST_TEST(Expression("distance(x, r, x0, r0)").value(arcs) == 0.2, boost::test_tools::tolerance(1e-4));
  BOOST_TEST(Expression("distance(x0, r0, x0, r0)").value(arcs) == 0);
  BOOST_TEST(Expression("distance(x0 + 5, r0, x0, r0)").value(arcs) == 5,
             boost::test_tools::tolerance(1e-12));
}

BOOST_AUTO_TEST_CASE(references) {
  const auto all =
      Expression("a.b_1{case-x: k=1|2; l=neo-hookean}@x_g=-2..3.5@S=0 - max(c@time=1e1-d, e@x=-4)")
          .references();
  BOOST_REQUIRE(all.size() == 4u);
  BOOST_TEST(all[0].name == "a.b_1");
  BOOST_TEST(all[0].runs.value() == "case-x: k=1|2; l=neo-hookean");
  BOOST_REQUIRE(all[0].places.size() == 2u);
  BOOST_TEST(all[0].places[0].column == "x_g");
  BOOST_TEST(all[0].places[0].from == -2);
  BOOST_TEST(all[0].places[0].to == 3.5);
  BOOST_TEST(all[0].places[1].from == 0);
  BOOST_TEST(all[0].places[1].to == 0);
  BOOST_TEST(all[1].places.at(0).from == 10);
  BOOST_TEST(!all[1].runs);
  BOOST_TEST(all[2].name == "d");
  BOOST_TEST(all[3].places.at(0).from == -4);
  const Reference in_units = Expression("v#2 [ mm/s ]{k=1}@x_g [um]=1..2@S[m]=0").references().at(0);
  BOOST_TEST(in_units.name == "v#2");
  BOOST_TEST(in_units.unit == "mm/s");
  BOOST_TEST(in_units.runs.value() == "k=1");
  BOOST_TEST(in_units.places.at(0).column == "x_g");
  BOOST_TEST(in_units.places.at(0).unit == "um");
  BOOST_TEST(in_units.places.at(0).to == 2);
  BOOST_TEST(in_units.places.at(1).unit == "m");
  BOOST_TEST(all[0].unit == "");
}

BOOST_AUTO_TEST_CASE(mistakes) {
  check_mistake("", "a number or a name is missing at character 1 of ''");
  check_mistake("1 +", "a number or a name is missing at character 4 of '1 +'");
  check_mistake("1 2", "unexpected '2' at character 3 of '1 2'");
  check_mistake("1 + .", "'.' is not a number at character 5 of '1 + .'");
  check_mistake("2*1e999", "'1e999' is not a number at character 3 of '2*1e999'");
  check_mistake("(1", "')' is missing at character 3 of '(1'");
  check_mistake("sin(1)", "unknown function 'sin' at character 7 of 'sin(1)'");
  check_mistake("abs(1, 2)", "wrong number of arguments of 'abs' at character 10 of 'abs(1, 2)'");
  check_mistake("a{k=1", "'}' is missing at character 3 of 'a{k=1'");
  check_mistake("a [m", "']' is missing at character 4 of 'a [m'");
  check_mistake("a [ ]", "a unit is missing at character 6 of 'a [ ]'");
  check_mistake("max [m](a)", "unexpected '(' at character 8 of 'max [m](a)'");
  check_mistake("a@x_g", "'=' is missing at character 6 of 'a@x_g'");
  check_mistake("a@x_g=3..2", "the second end is not beyond the first at character 11 of 'a@x_g=3..2'");
  for (const char *text : {"a#1", "a#0", "a#", "a#99999999999999999999"})
    check_mistake(text,
                  fmt::format("behind '#' the number of a capsule behind the leading one, 2 or more, is "
                              "missing at character 3 of '{}'",
                              text));
  check_mistake("a@=3", "a name is missing at character 3 of 'a@=3'");
}
