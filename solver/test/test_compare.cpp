// Computed against expected values: reading the table, choosing runs, distances, statuses, mistakes.
#include "compare.hpp"
#include "failure.hpp"
#include "temporary_directory.hpp"
#include <boost/test/unit_test.hpp>

using namespace capsule;

namespace {

const std::string header = "id,where,case,run,quantity,published,allowed,reason\n";

RunResult result_with(double viscosity_ratio, double v_g, const std::filesystem::path &directory = {}) {
  RunResult result;
  result.input.physics.flow.viscosity_ratio = viscosity_ratio;
  result.input.physics.membrane.law = LawName::skalak;
  result.input.name = "viscosity_ratio=" + std::to_string(static_cast<int>(viscosity_ratio));
  result.directory = directory;
  result.summary = Summary{"reached", "", "", {{"v_g", v_g}, {"volume_change", -2e-4}}, {{"v_g", 3e-5}}};
  return result;
}

std::vector<Comparison> compared(const std::string &rows, const std::vector<RunResult> &results) {
  const TemporaryDirectory directory;
  return compare(read_expectations(directory.write("published.csv", header + rows), "fig"), results);
}

std::string mistake_in(const std::string &table) {
  const TemporaryDirectory directory;
  try {
    read_expectations(directory.write("published.csv", table), "fig");
  } catch (const InputError &error) {
    return error.what();
  }
  return "no error";
}

void check_contains(const std::string &text, const std::string &part) {
  BOOST_CHECK_MESSAGE(text.find(part) != std::string::npos, "'" << part << "' is not in:\n" << text);
}

} // namespace

BOOST_AUTO_TEST_CASE(a_row_speaks_of_the_runs_it_selects) {
  const std::vector<RunResult> results{result_with(1, 1.2), result_with(5, 1.3)};
  const auto rows =
      compared("a,Table 2,fig,viscosity_ratio=5,v_g,1.3,0.1 %,why\n"
               "b,Table 2,fig,flow.viscosity_ratio=1.0; law=skalak,v_g,1.2,0.1 %,\"because, of \"\"it\"\"\"\n"
               "c,everywhere,fig,,volume_change,0,0.001,\n"
               "d,Table 9,another,viscosity_ratio=5,v_g,7,0.1 %,\n"
               "e,Table 2,fig,viscosity_ratio=10,v_g,1.3,0.1 %,\n"
               "f,Table 2,fig,membrane.law=neo-hookean,v_g,1.3,0.1 %,\n",
               results);
  BOOST_REQUIRE(rows.size() == 6u);
  BOOST_TEST(rows[0].run == "viscosity_ratio=5");
  BOOST_TEST(rows[0].agrees);
  BOOST_TEST(rows[0].estimate == "3e-05");
  BOOST_TEST(rows[1].run == "viscosity_ratio=1");
  BOOST_TEST(rows[1].agrees);
  BOOST_TEST(rows[1].expected.reason == "because, of \"it\"");
  BOOST_TEST((rows[2].agrees && rows[3].agrees));
  BOOST_TEST(rows[4].computed == "no such run");
  BOOST_TEST((!rows[4].agrees && !rows[5].agrees));
}

BOOST_AUTO_TEST_CASE(distances_relative_and_absolute) {
  const auto agrees = [](const std::string &published, const std::string &allowed) {
    return compared("a,T,fig,,"
                    "v_g," +
                        published + "," + allowed + ",\n",
                    {result_with(1, 2.0)})
        .at(0)
        .agrees;
  };
  BOOST_TEST(agrees("2.1", "5 %"));
  BOOST_TEST(!agrees("2.1", "4.7 %"));
  BOOST_TEST(agrees("1.9", "5.3%"));
  BOOST_TEST(!agrees("1.9", "5.2%"));
  BOOST_TEST(agrees("2.5", "0.5"));
  BOOST_TEST(!agrees("2.5", "0.49"));
  BOOST_TEST(!agrees("-2", "10 %"));
  const auto row = compared("a,\"T, U\",fig,,v_g,2.5,25 %,\n", {result_with(1, 2.0)}).at(0);
  BOOST_TEST(row.distance == "-20 %");
  const std::string table = comparison_table({row});
  check_contains(table, "-20 %");
  check_contains(table, "agrees\n");
  BOOST_TEST(comparison_csv({row}) ==
             "id,where,run,quantity,computed,own error,published,distance,allowed,verdict\n"
             "a,\"T, U\",viscosity_ratio=1,v_g,2,3e-05,2.5,-20 %,25 %,agrees\n");
  check_contains(
      comparison_markdown({row}),
      "| --- |\n| a | T, U | viscosity_ratio=1 | v_g | 2 | 3e-05 | 2.5 | -20 % | 25 % | agrees |\n");
}

BOOST_AUTO_TEST_CASE(quantities_along_the_way) {
  const TemporaryDirectory directory;
  directory.write("series.csv", "time,x_g,v_g\n0,-4,1\n10,-2,3\n20,6,2\n");
  const std::vector<RunResult> results{result_with(1, 1, directory.path)};
  const auto computed = [&](const std::string &quantity) {
    return compared("a,T,fig,," + quantity + ",1,1,\n", results).at(0).computed;
  };
  BOOST_TEST(computed("x_g@time=15") == "2");
  BOOST_TEST(computed("x_g@time=10") == "-2");
  BOOST_TEST(computed("v_g@x_g=-3") == "2");
  BOOST_TEST(computed("time@v_g=2.5") == "7.5"); // the first time it passes
  BOOST_TEST(computed("x_g@time=20.1") == "no value");
  BOOST_TEST(computed("x_g@tim=15") == "no value");
  BOOST_TEST(computed("x_g@time") == "no value");
  BOOST_TEST(computed("v_h") == "no value");
}

BOOST_AUTO_TEST_CASE(statuses_and_failures) {
  RunResult failed = result_with(1, 1);
  failed.summary->status = "failed";
  failed.summary->failure = "wrinkled";
  const auto rows = compared("a,T,fig,,status,failed:wrinkled,,\nb,T,fig,,status,failed,,\n", {failed});
  BOOST_TEST((rows.at(0).agrees && rows.at(1).agrees));
  BOOST_TEST(rows.at(0).computed == "failed:wrinkled");
  BOOST_TEST(failure_is_expected(rows, failed));
  const auto other = compared("a,T,fig,,status,failed:folded,,\nb,T,fig,,v_g,1,1 %,\n", {failed});
  BOOST_TEST(!other.at(0).agrees);
  BOOST_TEST(!failure_is_expected(other, failed));
}

BOOST_AUTO_TEST_CASE(mistakes_of_the_table) {
  check_contains(mistake_in(""), "published.csv:1:1: error: the first line must be");
  check_contains(mistake_in("id,where\n"), "published.csv:1:1: error: the first line must be");
  check_contains(mistake_in(header + "a,T,fig,,v_g,1\n"), "published.csv:2:1: error: 6 fields instead of 8");
  check_contains(mistake_in(header + "\n"), "published.csv:2:1: error: 1 fields");
  check_contains(mistake_in(header + "a,T,x,,v_g,high,1 %,\n"), "published 'high' is not a number");
  check_contains(mistake_in(header + "a,T,x,,v_g,1,,\n"), "allowed '' is not a positive number");
  check_contains(mistake_in(header + "a,T,x,,v_g,1,-1 %,\n"), "allowed '-1 %' is not");
  check_contains(mistake_in(header + "a,T,x,,v_g,0,1 %,\n"), "nothing can be relative");
  check_contains(mistake_in(header + "a,T,x,viscosity=1,v_g,1,1 %,\n"), "unknown key 'viscosity'");
  check_contains(mistake_in(header + "a,T,x,all,v_g,1,1 %,\n"), "the run 'all' is not of the form");
  const std::string all = mistake_in("id\n\na,T,x,,v_g,high,1 %,\na,T,fig,,v_g,1,0,\n");
  for (const char *place : {":1:1: error: ", ":2:1: error: ", ":3:1: error: ", ":4:1: error: "})
    check_contains(all, place);
  BOOST_TEST(mistake_in(header + "a,T,fig,,v_g,1,1 %,\r\n") == "no error");
}

BOOST_AUTO_TEST_CASE(the_table_is_found_above_the_case) {
  const TemporaryDirectory directory;
  const auto file = directory.write("project/cases/fig/case.toml", "");
  BOOST_TEST(!find_expectations(file));
  const auto table = directory.write("project/tables/published.csv", header);
  BOOST_REQUIRE(find_expectations(file));
  BOOST_TEST(std::filesystem::equivalent(*find_expectations(file), table));
}
