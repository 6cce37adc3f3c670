// Tables of expectations: what their rows mean, where they are found, mistakes in them.
#include "base/failure.hpp"
#include "compare/expectations.hpp"
#include "temporary_directory.hpp"
#include <boost/test/unit_test.hpp>

using namespace capsule;

namespace {

const std::string header = "id,where,case,run,quantity,published,allowed,reason,claim,kind,statement,"
                           "converged,verdict,cause,evidence\n";

// A row that is no claim of the paper and should agree, from its first eight fields.
std::string plain(const std::string &fields) {
  return fields + ",,,,,agrees,,\n";
}

std::string mistake_in(const std::string &table) {
  const TemporaryDirectory directory;
  try {
    read_expectations(directory.write("published.csv", table));
  } catch (const InputError &error) {
    return error.what();
  }
  return "no error";
}

void check_contains(const std::string &text, const std::string &part) {
  BOOST_CHECK_MESSAGE(text.find(part) != std::string::npos, "'" << part << "' is not in:\n" << text);
}

} // namespace

BOOST_AUTO_TEST_CASE(mistakes_of_the_table) {
  check_contains(mistake_in(""), "published.csv:1:1: error: the first line must be");
  check_contains(mistake_in("id,where\n"), "published.csv:1:1: error: the first line must be");
  check_contains(mistake_in(header + "a,T,fig,,v_g,1\n"), "published.csv:2:1: error: 6 fields instead of 15");
  const auto mistake = [](const std::string &fields) { return mistake_in(header + plain(fields)); };
  check_contains(mistake("a,T,x,,v_g,high,1 %,"), "the value 'high' is not a number");
  check_contains(mistake("a,T,x,,v_g,\"1,3\",1 %,"), "the value '1,3' is not a number; write 1.3");
  check_contains(mistake("a,T,x,,v_g,<high,,"), "the value '<high' is not a number");
  check_contains(mistake("a,T,x,,v_g,<1,0.1,"), "a bound allows no distance");
  check_contains(mistake("a,T,x,,status,done,,"), "the status 'done' is none of 'reached', 'steady'");
  check_contains(mistake_in(header + plain("a,T,x,,v_g,1,1 %,") + plain("a,T,x,,x_g,1,1 %,")),
                 "published.csv:3:1: error: the id 'a' is there already");
  check_contains(mistake("a,T,x,,v_g,1,,"), "allowed '' is not a positive number");
  check_contains(mistake("a,T,x,,v_g,1,-1 %,"), "allowed '-1 %' is not");
  check_contains(mistake("a,T,x,,v_g,0,1 %,"), "nothing can be relative");
  check_contains(mistake("a,T,x,size=1,v_g,1,1 %,"), "unknown key 'size'");
  check_contains(mistake("a,T,x,all,v_g,1,1 %,"), "the run 'all' is not of the form");
  check_contains(mistake("a,T,x,,v_g +,1,1 %,"), "a number or a name is missing");
  check_contains(mistake("a,T,x,,v_g{size=1},1,1 %,"), "unknown key 'size'");
  const std::string row = "a,T,x,,v_g,1,1 %,,";
  check_contains(mistake_in(header + row + "A,number,,,yes,,\n"),
                 "the verdict 'yes' is none of 'agrees', 'differs'");
  check_contains(mistake_in(header + row + "A,number,,,differs,,\n"), "evidence is missing");
  check_contains(mistake_in(header + row + "A,number,,,differs,reading,there\n"),
                 "the cause 'reading' is neither");
  check_contains(mistake_in(header + row + "A,number,,,agrees,mesh,\n"), "the verdict 'agrees' has no cause");
  check_contains(mistake_in(header + row + "A,size,,,agrees,,\n"), "the kind 'size' is none of");
  // All mistakes of a row, and of the rows around one with an open quote.
  const std::string row_of_mistakes = mistake("a,T,x,size=1,v_g [foo] + v_g{all},high,0,");
  for (const char *part : {"unknown key 'size'", "v_g [foo]", "the run 'all'", "the value 'high'"})
    check_contains(row_of_mistakes, part);
  const std::string quotes = mistake_in(header + plain("a,T,x,,v_g,low,1 %,") +
                                        plain("b,T,x,,v_g,1,1 %,\"why") + plain("c,T,x,,v_g,high,1 %,"));
  std::size_t at = 0;
  for (const char *part : // in this order
       {":2:1: error: the value 'low'", ":3:1: error: this quote is not", ":4:1: error: the value 'high'"}) {
    check_contains(quotes.substr(at), part);
    at = quotes.find(part);
  }
  const std::string all = mistake_in("id\nb\n" + plain("a,T,x,,v_g,high,1 %,") + plain("a,T,fig,,v_g,1,0,"));
  for (const char *place : {":1:1: error: ", ":2:1: error: ", ":3:1: error: ", ":4:1: error: "})
    check_contains(all, place);
}

// A case directory may say itself what it expects, in fewer columns; other files in it have none.
BOOST_AUTO_TEST_CASE(expectations_of_the_directory) {
  const TemporaryDirectory directory;
  const auto file = directory.write("fig/case.toml", "");
  BOOST_TEST(own_expectations(file, "fig").empty());
  directory.write("fig/expected.csv", "id,run,quantity,expected,allowed,reason\n"
                                      "a,viscosity_ratio=5,v_g,1.3,0.1 %,why\nb,,v_g,<1.25,,\n");
  const auto rows = own_expectations(file, "fig");
  BOOST_REQUIRE(rows.size() == 2u);
  BOOST_TEST((rows[0].case_name == "fig" && rows[0].run == "viscosity_ratio=5" && rows[0].reason == "why"));
  BOOST_TEST((rows[0].form == Expectation::Form::value && rows[0].relative));
  BOOST_TEST((rows[0].published_value == 1.3 && rows[0].allowed_distance == 1e-3));
  BOOST_TEST((rows[1].form == Expectation::Form::below && rows[1].published_value == 1.25));
  BOOST_TEST((rows[1].recorded == Verdict::agrees && rows[1].claim.empty()));
  BOOST_TEST(own_expectations(directory.write("fig/other.toml", ""), "fig-other").empty());
  directory.write("fig/expected.csv", header);
  try {
    own_expectations(file, "fig");
    BOOST_ERROR("accepted");
  } catch (const InputError &error) {
    check_contains(error.what(),
                   "expected.csv:1:1: error: the first line must be 'id,run,quantity,expected,");
  }
}

// A spreadsheet has saved it, in its own way.
BOOST_AUTO_TEST_CASE(expectations_from_a_spreadsheet) {
  const TemporaryDirectory directory;
  const auto file = directory.write("fig/case.toml", "");
  directory.write("fig/expected.csv",
                  "\xEF\xBB\xBF\"id\",\"run\",\"quantity\",\"expected\",\"allowed\",\"reason\",\r\n\r\n"
                  "\"a\",,\"v_g\",1.3,0.1 %,\"why, not\",\r\n,,,,,,\r\n\r\n");
  const auto rows = own_expectations(file, "fig");
  BOOST_REQUIRE(rows.size() == 1u);
  BOOST_TEST(rows[0].published_value == 1.3);
  BOOST_TEST(rows[0].reason == "why, not");
  directory.write("fig/expected.csv", "id;run;quantity;expected;allowed;reason\na;;v_g;1,3;0,1 %;\n");
  BOOST_CHECK_EXCEPTION(own_expectations(file, "fig"), InputError, [](const InputError &error) {
    check_contains(error.what(), "expected.csv:1:1: error: semicolons or tabs");
    return true;
  });
}

BOOST_AUTO_TEST_CASE(the_table_is_found_above_the_case) {
  const TemporaryDirectory directory;
  const auto file = directory.write("project/cases/fig/case.toml", "");
  BOOST_TEST(!find_expectations(file));
  const auto table = directory.write("project/tables/published.csv", header);
  BOOST_REQUIRE(find_expectations(file));
  BOOST_TEST(std::filesystem::equivalent(*find_expectations(file), table));
}

BOOST_AUTO_TEST_CASE(rows_of_a_case_and_the_cases_they_name) {
  const TemporaryDirectory directory;
  const auto all = read_expectations(directory.write(
      "published.csv", header + plain("a,T,fig,,v_g/v_g{other: },1,1 %,") + plain("b,T,*,,v_g,1,1 %,") +
                           plain("c,T,another,,v_g{third: radius=0.9},1,1 %,")));
  const auto rows = expectations_of(all, "fig");
  BOOST_REQUIRE(rows.size() == 2u);
  BOOST_TEST((rows[0].id == "a" && rows[1].id == "b"));
  BOOST_TEST(referenced_cases(rows) == std::vector<std::string>{"other"}, boost::test_tools::per_element());
  BOOST_TEST(expressions_of(rows[0]).size() == 1u);
}
