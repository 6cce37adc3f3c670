// Computed against expected values: choosing runs, distances, bounds, statuses, verdicts and their record; the ledger.
#include "base/failure.hpp"
#include "compare/comparison.hpp"
#include "compare/ledger.hpp"
#include "law/skalak.hpp"
#include "temporary_directory.hpp"
#include <boost/test/unit_test.hpp>

using namespace capsule;

namespace {

const std::string header = "id,where,case,run,quantity,published,allowed,reason,claim,kind,statement,"
                           "converged,verdict,cause,evidence\n";

RunResult result_with(double viscosity_ratio, double v_g) {
  RunResult result;
  result.input.physics.flow.viscosity_ratio = viscosity_ratio;
  result.input.physics.membrane.law = skalak;
  result.input.name = "viscosity_ratio=" + std::to_string(static_cast<int>(viscosity_ratio));
  result.summary = Summary{"reached", "", "", {{"v_g", v_g}, {"volume_change", -2e-4}}, {{"v_g", 3e-5}}};
  return result;
}

// A row that is no claim of the paper and should agree, from its first eight fields.
std::string plain(const std::string &fields) {
  return fields + ",,,,,agrees,,\n";
}

std::vector<Comparison> compared(const std::string &rows, const std::vector<RunResult> &results) {
  const TemporaryDirectory directory;
  RunTable table;
  table.add("fig", results);
  const auto all = read_expectations(directory.write("published.csv", header + rows));
  return compare(expectations_of(all, "fig"), "fig", table);
}

void check_contains(const std::string &text, const std::string &part) {
  BOOST_CHECK_MESSAGE(text.find(part) != std::string::npos, "'" << part << "' is not in:\n" << text);
}

Verdict verdict(const std::string &published, const std::string &allowed) {
  return compared(plain("a,T,fig,,v_g," + published + "," + allowed + ","), {result_with(1, 2.0)})
      .at(0)
      .verdict;
}

} // namespace

BOOST_AUTO_TEST_CASE(a_row_speaks_of_the_runs_it_selects) {
  const std::vector<RunResult> results{result_with(1, 1.2), result_with(5, 1.3)};
  const auto rows = compared(
      plain("a,Table 2,fig,viscosity_ratio=5,v_g,1.3,0.1 %,why") +
          plain(
              "b,Table 2,fig,flow.viscosity_ratio=1.0; law=skalak,v_g,1.2,0.1 %,\"because, of \"\"it\"\"\"") +
          plain("c,everywhere,*,,volume_change,0,0.001,") +
          plain("d,Table 9,another,viscosity_ratio=5,v_g,7,0.1 %,") +
          plain("e,Table 2,fig,viscosity_ratio=10,v_g,1.3,0.1 %,") +
          plain("f,Table 2,fig,membrane.law=neo-hookean,v_g,1.3,0.1 %,") +
          plain("g,Table 2,fig,,v_g{viscosity_ratio=5}/v_g{viscosity_ratio=1},1.08,0.01,"), // once
      results);
  BOOST_REQUIRE(rows.size() == 7u);
  BOOST_TEST(rows[0].run == "viscosity_ratio=5");
  BOOST_TEST((rows[0].verdict == Verdict::agrees && rows[0].as_recorded()));
  BOOST_TEST(rows[0].estimate == "3e-05");
  BOOST_TEST(rows[1].run == "viscosity_ratio=1");
  BOOST_TEST(rows[1].as_recorded());
  BOOST_TEST(rows[1].expected.reason == "because, of \"it\"");
  BOOST_TEST((rows[2].as_recorded() && rows[3].as_recorded()));
  BOOST_TEST(rows[4].computed == "no such run");
  BOOST_TEST((!rows[4].as_recorded() && !rows[5].as_recorded()));
  BOOST_TEST(rows[6].computed == "1.083333");
  BOOST_TEST(rows[6].run == "");
  BOOST_TEST(rows[6].as_recorded());
}

BOOST_AUTO_TEST_CASE(distances_relative_and_absolute) {
  BOOST_TEST((verdict("2.1", "5 %") == Verdict::agrees));
  BOOST_TEST((verdict("2.1", "4.7 %") == Verdict::differs));
  BOOST_TEST((verdict("1.9", "5.3%") == Verdict::agrees));
  BOOST_TEST((verdict("1.9", "5.2%") == Verdict::differs));
  BOOST_TEST((verdict("2.5", "0.5") == Verdict::agrees));
  BOOST_TEST((verdict("2.5", "0.49") == Verdict::differs));
  BOOST_TEST((verdict("-2", "10 %") == Verdict::differs));
  const auto distance = [](const std::string &published) {
    return compared(plain("a,T,fig,,v_g," + published + ",1 %,"), {result_with(1, 2)}).at(0).distance;
  };
  BOOST_TEST(distance("1.95") == "+2.6 %");
  BOOST_TEST(distance("0.75") == "+167 %");
  const auto row = compared(plain("a,\"T, U\",fig,,v_g,2.5,25 %,"), {result_with(1, 2.0)});
  BOOST_TEST(row.at(0).distance == "-20 %");
  const auto rows = comparison_rows(row);
  BOOST_TEST(csv_table(rows) ==
             "id,where,run,quantity,computed,converged,own error,expected,distance,allowed,verdict\n"
             "a,\"T, U\",viscosity_ratio=1,v_g,2,,3e-05,2.5,-20 %,25 %,agrees\n");
}

BOOST_AUTO_TEST_CASE(bounds) {
  BOOST_TEST((verdict("<2.1", "") == Verdict::agrees));
  BOOST_TEST((verdict("<2", "") == Verdict::differs));
  BOOST_TEST((verdict(">1.9", "") == Verdict::agrees));
  BOOST_TEST((verdict("> 2", "") == Verdict::differs));
}

BOOST_AUTO_TEST_CASE(statuses_and_failures) {
  RunResult failed = result_with(1, 1);
  failed.summary->status = "failed";
  failed.summary->failure = "wrinkled";
  const auto rows =
      compared(plain("a,T,fig,,status,failed:wrinkled,,") + plain("b,T,fig,,status,failed,,"), {failed});
  BOOST_TEST((rows.at(0).as_recorded() && rows.at(1).as_recorded()));
  BOOST_TEST(rows.at(0).computed == "failed:wrinkled");
  BOOST_TEST(failure_is_expected(rows, failed));
  const auto other =
      compared(plain("a,T,fig,,status,failed:folded,,") + plain("b,T,fig,,v_g,1,1 %,"), {failed});
  BOOST_TEST(!other.at(0).as_recorded());
  BOOST_TEST(!failure_is_expected(other, failed));
}

// Neither a disagreement nor an agreement may come unrecorded.
BOOST_AUTO_TEST_CASE(the_record_of_verdicts) {
  const auto row = [](const std::string &published, const std::string &recorded) {
    return compared("a,T,fig,,v_g," + published + ",0.1,,A,behaviour,,," + recorded + ",,here\n",
                    {result_with(1, 2)})
        .at(0);
  };
  BOOST_TEST(row("2", "agrees").as_recorded());
  BOOST_TEST(!row("3", "agrees").as_recorded());
  BOOST_TEST(row("3", "differs").as_recorded());
  BOOST_TEST(!row("2", "differs").as_recorded());
  const Comparison open = row("high", "not decidable");
  BOOST_TEST(open.as_recorded());
  BOOST_TEST(open.computed == "2");
  BOOST_TEST(open.distance == "");
}

// The error estimate of a published number must be at most a fifth of the distance that the verdict speaks of.
BOOST_AUTO_TEST_CASE(a_verdict_needs_a_small_error) {
  const auto row = [](const std::string &quantity, const std::string &published, const std::string &allowed,
                      const std::string &kind, const std::string &recorded) {
    return compared("a,T,fig,," + quantity + "," + published + "," + allowed + ",,A," + kind + ",,," +
                        recorded + ",,here\n",
                    {result_with(1, 2)})
        .at(0);
  };
  BOOST_TEST(row("v_g", "2", "1.6e-4", "number", "agrees").as_recorded());
  BOOST_TEST(!row("v_g", "2", "1.4e-4", "number", "agrees").as_recorded());
  BOOST_TEST(row("v_g", "2", "1.4e-4", "behaviour", "agrees").as_recorded());
  BOOST_TEST(row("v_g", "2.00016", "1e-5", "number", "differs").as_recorded());
  BOOST_TEST(!row("v_g", "2.00014", "1e-5", "number", "differs").as_recorded());
  BOOST_TEST(!row("volume_change", "0", "0.1", "number", "agrees").as_recorded()); // no estimate
  // The converged value's error counts, where the quantity is one of the paper's numerics.
  const auto both =
      compared("a,T,fig,,volume_change,0,0.1,,A,number,,v_g,agrees,,\n", {result_with(1, 2)}).at(0);
  BOOST_TEST(both.as_recorded());
  BOOST_TEST(both.converged == "2");
  BOOST_TEST(both.estimate == "3e-05");
}

// One line per row, with its worst run; a claim differs if one of its rows does.
BOOST_AUTO_TEST_CASE(ledger_of_claims) {
  const auto comparisons =
      compared("a-1,T,fig,,v_g,<2,,,A,bound,says,,agrees,,\n"
               "a-2,T,fig,viscosity_ratio=5,v_g,1,0.1,,A,number,says,,differs,mesh,there\n"
               "b,T,fig,viscosity_ratio=5,v_g,much,,,B,number,says,,not decidable,,there\n"
               "c,T,fig,viscosity_ratio=5,v_g,1.3,0.1,why,C,number,says,,agrees,,\n" +
                   plain("d,T,fig,,v_g,7,0.1 %,"),
               {result_with(1, 1.2), result_with(5, 1.3)});
  const Ledger ledger = make_ledger(comparisons);
  BOOST_TEST(ledger.summary == "3 claims of the paper in 4 rows: 1 agree, 1 differ, 1 cannot be decided");
  BOOST_TEST(ledger.not_as_recorded == 0);
  check_contains(ledger.csv, "A,a-1,T,bound,says,<2,,1.3,3e-05,-0.7,,agrees,,,fig: viscosity_ratio=5,v_g\n");
  check_contains(ledger.csv,
                 "A,a-2,T,number,says,1,,1.3,3e-05,+0.3,0.1,differs,mesh,there,fig: viscosity_ratio=5,v_g\n");
  check_contains(ledger.markdown, "| C | c | T | number | says | 1.3 |  | 1.3 |");
  BOOST_TEST(std::ranges::count(ledger.csv, '\n') == 5);
  const auto wrong =
      compared("a,T,fig,,v_g,<1.25,,,A,bound,says,,agrees,,\n", {result_with(1, 1.2), result_with(5, 1.3)});
  BOOST_TEST(make_ledger(wrong).not_as_recorded == 1);
  check_contains(make_ledger(wrong).csv, ",NOT AS RECORDED,");
}
