#include "compare/ledger.hpp"
#include <algorithm>
#include <fmt/format.h>
#include <map>

namespace capsule {
namespace {

// One comparison for each row of a claim: the one that fits worst.
std::vector<Comparison> worst_of_each_row(const std::vector<Comparison> &comparisons) {
  std::vector<Comparison> worst;
  for (const Comparison &candidate : comparisons) {
    if (candidate.expected.claim.empty())
      continue;
    const auto same = std::ranges::find_if(
        worst, [&](const Comparison &c) { return c.expected.id == candidate.expected.id; });
    if (same == worst.end())
      worst.push_back(candidate);
    else if (std::pair(!candidate.as_recorded(), candidate.excess) >
             std::pair(!same->as_recorded(), same->excess))
      *same = candidate;
  }
  return worst;
}

std::string joined(const std::string &a, const std::string &b) {
  return a.empty() || b.empty() ? a + b : a + "; " + b;
}

TextRow ledger_row(const Comparison &c) {
  const Expectation &row = c.expected;
  const bool has_converged = !row.converged.empty();
  return {row.claim,
          row.id,
          row.where,
          row.kind,
          row.statement,
          row.published,
          has_converged ? c.computed : "",
          has_converged ? c.converged : c.computed,
          c.estimate,
          c.distance,
          row.allowed,
          c.as_recorded() ? verdict_text(c.verdict) : "NOT AS RECORDED",
          c.as_recorded() ? row.cause : "",
          joined(row.reason, row.evidence),
          c.run.empty() ? c.case_name : c.case_name + ": " + c.run,
          row.quantity};
}

// A claim differs if one of its rows does.
std::map<std::string, Verdict> verdicts_of_claims(const std::vector<Comparison> &rows) {
  const auto rank = [](Verdict verdict) {
    return verdict == Verdict::differs ? 2 : verdict == Verdict::not_decidable ? 1 : 0;
  };
  std::map<std::string, Verdict> claims;
  for (const Comparison &c : rows) {
    const auto [claim, first] = claims.try_emplace(c.expected.claim, c.verdict);
    if (!first && rank(c.verdict) > rank(claim->second))
      claim->second = c.verdict;
  }
  return claims;
}

} // namespace

Ledger make_ledger(const std::vector<Comparison> &comparisons) {
  const std::vector<Comparison> rows = worst_of_each_row(comparisons);
  const auto claims = verdicts_of_claims(rows);
  const auto count = [&](Verdict verdict) {
    return std::ranges::count_if(claims, [&](const auto &claim) { return claim.second == verdict; });
  };
  Ledger ledger;
  ledger.not_as_recorded = std::ranges::count_if(rows, [](const Comparison &c) { return !c.as_recorded(); });
  ledger.summary = fmt::format("{} claims of the paper in {} rows: {} agree, {} differ, {} cannot be decided",
                               claims.size(), rows.size(), count(Verdict::agrees), count(Verdict::differs),
                               count(Verdict::not_decidable));
  std::vector<TextRow> table{{"claim", "row", "where", "kind", "statement", "published",
                              "with the paper's numerics", "converged", "own error", "distance", "allowed",
                              "verdict", "cause", "reading and evidence", "run", "quantity"}};
  std::ranges::transform(rows, std::back_inserter(table), ledger_row);
  ledger.csv = csv_table(table);
  ledger.markdown = fmt::format(
      "# Ledger of the paper's claims\n\n{}.\n\nDistances are from the published value to the one with the "
      "paper's numerics where there is one, otherwise to the converged one. A claim differs if one of its "
      "rows "
      "does; the cause \"mesh\" means that the paper's mesh is too coarse. Rows and readings: "
      "`tables/published.csv`.\n\n{}",
      ledger.summary, markdown_table(table));
  return ledger;
}

} // namespace capsule
