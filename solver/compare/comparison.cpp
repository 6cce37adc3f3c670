#include "compare/comparison.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace capsule {
namespace {

std::string status_of(const Summary &summary) {
  const std::string reason = summary.reason();
  return summary.status + (reason.empty() ? "" : ":" + reason);
}

// Compares what one row says with runs.
class Comparer {
public:
  Comparer(const Expectation &expected, const std::string &case_name, const RunTable &table)
      : expected_(expected), case_name_(case_name), table_(table) {}

  Comparison status(const RunResult &result) const {
    Comparison comparison = start(&result);
    comparison.computed = status_of(*result.summary);
    decide(comparison,
           comparison.computed == expected_.published || result.summary->status == expected_.published);
    return comparison;
  }

  Comparison value(const RunResult *result) const {
    Comparison comparison = start(result);
    try {
      const double value = value_of(expected_.quantity, result);
      comparison.computed = fmt::format("{:.7g}", value);
      const std::string &best = expected_.converged.empty() ? expected_.quantity : expected_.converged;
      if (!expected_.converged.empty())
        comparison.converged = fmt::format("{:.7g}", value_of(best, result));
      const auto error = table_.error_estimate(Expression(best), case_name_, result);
      if (error)
        comparison.estimate = fmt::format("{:.1g}", *error);
      if (expected_.recorded == Verdict::not_decidable)
        comparison.verdict = Verdict::not_decidable;
      else
        judge(comparison, value, error);
    } catch (const NoValue &reason) {
      comparison.computed = reason.what();
      comparison.no_such_run = comparison.computed == "no such run";
    }
    return comparison;
  }

private:
  Comparison start(const RunResult *result) const {
    Comparison comparison;
    comparison.expected = expected_;
    comparison.case_name = case_name_;
    comparison.run = result != nullptr ? result->input.name : "";
    return comparison;
  }

  static std::string percent_text(double percent) {
    return std::abs(percent) < 99.5 ? fmt::format("{:+.2g} %", percent) : fmt::format("{:+.0f} %", percent);
  }

  static void decide(Comparison &comparison, bool agrees) {
    comparison.verdict = agrees ? Verdict::agrees : Verdict::differs;
  }

  double value_of(const std::string &expression, const RunResult *result) const {
    return Expression(expression).value([&](const Reference &reference) {
      return table_.values(reference, case_name_, result);
    });
  }

  void judge(Comparison &comparison, double value, const std::optional<double> &error) const {
    const double off = value - expected_.published_value;
    if (expected_.form != Expectation::Form::value) {
      comparison.distance = fmt::format("{:+.2g}", off);
      comparison.excess = expected_.form == Expectation::Form::below ? off : -off;
      decide(comparison, comparison.excess < 0);
      return;
    }
    const double unit = expected_.relative ? std::abs(expected_.published_value) : 1;
    comparison.distance = expected_.relative ? percent_text(100 * off / unit) : fmt::format("{:+.2g}", off);
    comparison.excess = std::abs(off) - expected_.allowed_distance * unit;
    const bool agrees = comparison.excess <= 0;
    decide(comparison, agrees);
    if (!expected_.claim.empty() && (expected_.kind == "number" || expected_.kind == "ratio"))
      comparison.certain =
          error && 5 * *error <= (agrees ? expected_.allowed_distance * unit : std::abs(off));
  }

  const Expectation &expected_;
  const std::string &case_name_;
  const RunTable &table_;
};

// Whether a row is compared with each run, not once because it names all its runs itself.
bool is_of_each_run(const Expectation &row) {
  for (const Expression &expression : expressions_of(row))
    for (const Reference &reference : expression.references())
      if (!reference.runs)
        return true;
  return row.quantity == "status";
}

std::string verdict_against_record(const Comparison &c) {
  if (c.as_recorded())
    return verdict_text(c.verdict);
  if (!c.certain)
    return "ERROR TOO LARGE";
  return fmt::format("{}, NOT AS RECORDED", verdict_text(c.verdict));
}

} // namespace

std::vector<Comparison> compare(const std::vector<Expectation> &expectations, const std::string &case_name,
                                const RunTable &table) {
  std::vector<Comparison> comparisons;
  for (const Expectation &expected : expectations) {
    const Comparer comparer(expected, case_name, table);
    if (!is_of_each_run(expected)) {
      comparisons.push_back(comparer.value(nullptr));
      continue;
    }
    const std::size_t before = comparisons.size();
    const Selector selector(expected.run);
    for (const RunResult &result : table.runs_of(case_name))
      if (selector.selects(result.input.physics))
        comparisons.push_back(expected.form == Expectation::Form::status ? comparer.status(result)
                                                                         : comparer.value(&result));
    if (comparisons.size() == before && expected.case_name != "*") {
      comparisons.emplace_back();
      comparisons.back().expected = expected;
      comparisons.back().case_name = case_name;
      comparisons.back().run = expected.run;
      comparisons.back().computed = "no such run";
      comparisons.back().no_such_run = true;
    }
  }
  return comparisons;
}

bool failure_is_expected(const std::vector<Comparison> &comparisons, const RunResult &result) {
  return std::ranges::any_of(comparisons, [&](const Comparison &comparison) {
    return comparison.verdict == Verdict::agrees && comparison.expected.form == Expectation::Form::status &&
           comparison.run == result.input.name;
  });
}

std::vector<TextRow> comparison_rows(const std::vector<Comparison> &comparisons) {
  std::vector<TextRow> rows{{"id", "where", "run", "quantity", "computed", "converged", "own error",
                             "expected", "distance", "allowed", "verdict"}};
  for (const Comparison &c : comparisons)
    rows.push_back({c.expected.id, c.expected.where, c.run, c.expected.quantity, c.computed, c.converged,
                    c.estimate, c.expected.published, c.distance, c.expected.allowed,
                    verdict_against_record(c)});
  return rows;
}

} // namespace capsule
