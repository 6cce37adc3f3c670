#include "claims.hpp"
#include "base/csv.hpp"
#include "base/text.hpp"
#include "html.hpp"
#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <fmt/format.h>
#include <map>
#include <utility>
#include <vector>

namespace report {
namespace {

using Row = std::map<std::string, std::string>;

std::vector<Row> rows_of(const std::filesystem::path &csv) {
  const std::vector<capsule::CsvRow> lines = capsule::read_csv(csv);
  std::vector<Row> rows;
  for (std::size_t i = 1; i < lines.size(); ++i)
    for (std::size_t k = 0; k < lines[0].fields.size(); ++k)
      (k == 0 ? rows.emplace_back() : rows.back())[lines[0].fields[k]] = lines[i].fields.at(k);
  return rows;
}

// In the order in which one row decides about a claim of several.
struct Outcome {
  const char *style, *title;
};
constexpr std::array<Outcome, 4> outcomes{{{"agrees", "agree"},
                                           {"undecided", "cannot be decided"},
                                           {"mesh", "differ because the paper's mesh is too coarse"},
                                           {"differs", "are not reproduced"}}};

std::string outcome_of(const Row &row) {
  if (!row.at("cause").empty())
    return row.at("cause");
  const std::string style = verdict_style(row.at("verdict"));
  return style == "failed" ? "differs" : style;
}

// Of each claim, which is that of its worst row.
std::map<std::string, std::string> outcomes_of_claims(const std::vector<Row> &rows) {
  const auto rank = [](const std::string &style) {
    return std::ranges::find(outcomes, style, &Outcome::style);
  };
  std::map<std::string, std::string> claims;
  for (const Row &row : rows) {
    const std::string outcome = outcome_of(row);
    std::string &claim = claims.try_emplace(row.at("claim"), outcome).first->second;
    if (rank(outcome) > rank(claim))
      claim = outcome;
  }
  return claims;
}

// The rows of what a case or a study expects of itself, which come from no place in the paper.
std::vector<Row> own_checks(const std::string &id) {
  const std::filesystem::path csv = std::filesystem::path("tables") / (id + ".csv");
  std::vector<Row> rows = std::filesystem::exists(csv) ? rows_of(csv) : std::vector<Row>();
  std::erase_if(rows, [](const Row &row) { return !row.at("where").empty(); });
  return rows;
}

// A number with as many digits as its error leaves, and the error: "7.176355 ± 3e-6".
std::string with_error(const std::string &value, const std::string &error) {
  const auto number = capsule::to_number(value), width = capsule::to_number(error);
  if (!number || !width || *width <= 0)
    return value;
  const int last_place = static_cast<int>(std::floor(std::log10(*width)));
  const int first_place =
      *number == 0 ? last_place : static_cast<int>(std::floor(std::log10(std::abs(*number))));
  const int digits = std::max(first_place - last_place + 1, 1);
  return fmt::format("{} ± {}", capsule::number_text(std::stod(fmt::format("{:.{}e}", *number, digits - 1))),
                     capsule::number_text(*width));
}

// Greek letters that are spelled out in tables/published.csv.
std::string in_greek(std::string text) {
  for (const auto &[name, letter] :
       {std::pair("lambda", "λ"), {"delta", "δ"}, {"Delta P", "ΔP"}, {"dzeta", "Δζ"}})
    for (std::size_t at = 0; (at = text.find(name, at)) != std::string::npos;)
      text.replace(at, std::string(name).size(), letter);
  return text;
}

std::string cell(const char *label, const std::string &text, const std::string &style = "") {
  return fmt::format("<td data-label=\"{}\" class=\"{}\">{}</td>", label, style, prose(text));
}

std::string as_sentence(std::string text) {
  if (text.empty())
    return "";
  text[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(text[0])));
  return text + ".";
}

std::string two_lines(const Row &row, const std::string &outcome_of_claim) {
  const auto with_paper_numerics = capsule::to_number(row.at("with the paper's numerics"));
  return fmt::format("<tbody data-outcome=\"{}\"><tr>{}{}{}{}{}{}</tr>\n<tr><td class=\"reason\" "
                     "colspan=\"6\">{}{} <code>{}</code></td></tr></tbody>\n",
                     outcome_of_claim, cell("", row.at("where")), cell("", in_greek(row.at("statement"))),
                     cell("published", row.at("published"), "published"),
                     cell("ours", with_error(row.at("converged"), row.at("own error"))),
                     cell("distance", row.at("distance")),
                     cell("verdict", row.at("verdict"),
                          verdict_style(row.at("verdict")) == "failed" ? "failed" : outcome_of(row)),
                     with_paper_numerics
                         ? prose(fmt::format("With the paper's numerics {:.5g}. ", *with_paper_numerics))
                         : "",
                     prose(as_sentence(in_greek(row.at("reading and evidence")))), escaped(row.at("row")));
}

// A check that fails, with a way to its case.
std::string failed_check(const std::string &id, const Row &row) {
  return fmt::format(
      "<tbody data-outcome=\"failed\"><tr><td data-label=\"\"><a "
      "href=\"#{0}\">{0}</a></td>{1}{2}{3}{4}{5}</tr>\n<tr><td "
      "class=\"reason\" colspan=\"6\">Expected by the case itself; <code>capsule check</code> compares. "
      "<code>{6}</code></td></tr></tbody>\n",
      escaped(id), cell("", row.at("quantity") + (row.at("run").empty() ? "" : ", " + row.at("run"))),
      cell("expected", row.at("expected"), "published"),
      cell("ours", with_error(row.at("computed"), row.at("own error"))), cell("distance", row.at("distance")),
      cell("verdict", row.at("verdict"), "failed"), escaped(row.at("id")));
}

// What the cases expect of themselves: how many rows, and those that fail, in HTML.
struct Checks {
  std::size_t cases = 0, rows = 0, failed = 0;
  std::string failures;
};
Checks checks_of(const std::vector<std::filesystem::path> &directories) {
  Checks checks;
  for (const std::filesystem::path &directory : directories) {
    const std::string id = directory.filename();
    const std::vector<Row> rows = own_checks(id);
    checks.cases += rows.empty() ? 0 : 1;
    checks.rows += rows.size();
    for (const Row &row : rows)
      if (row.at("verdict") != "agrees") {
        ++checks.failed;
        checks.failures += failed_check(id, row);
      }
  }
  return checks;
}

std::string filter(const std::string &style, std::size_t sum, const std::string &title) {
  return fmt::format(
      "<button type=\"button\" class=\"{0}\" data-filter=\"{0}\" aria-pressed=\"false\"><b>{1}</b> "
      "{2}</button>\n",
      style, sum, title);
}

} // namespace

std::string claims(const std::filesystem::path &ledger_csv,
                   const std::vector<std::filesystem::path> &directories) {
  const bool is_written = std::filesystem::exists(ledger_csv);
  const Checks checks = checks_of(directories);
  const std::vector<Row> rows = is_written ? rows_of(ledger_csv) : std::vector<Row>();
  const auto of_claims = outcomes_of_claims(rows);
  std::string html =
      is_written ? "" : "<p>Not computed yet: <code>make figures</code> writes the ledger.</p>\n";
  if (rows.empty() && checks.rows == 0)
    return html;
  html +=
      "<div class=\"row\" id=\"sums\" role=\"group\" aria-label=\"Rows of the ledger by their verdict\">\n" +
      filter("", of_claims.size(), fmt::format("claims in {}", capsule::counted(rows.size(), "row")));
  for (const Outcome &outcome : outcomes)
    html += filter(outcome.style,
                   static_cast<std::size_t>(std::ranges::count_if(
                       of_claims, [&](const auto &claim) { return claim.second == outcome.style; })),
                   outcome.title);
  if (checks.failed > 0)
    html += filter("failed", checks.failed,
                   checks.failed == 1 ? "check of a case fails" : "checks of cases fail");
  html +=
      fmt::format("<label>Find <input id=\"find\" type=\"search\" placeholder=\"Table 3, volume, λ "
                  "10\"></label>\n</div>\n"
                  "<p class=\"note\" id=\"counted\">Claims are counted. One with several numbers has a row "
                  "for each, and differs if "
                  "one of them does. Cases and studies have checks of their own, too: {} of {} agree{}.</p>\n"
                  "<table id=\"claims\">\n<thead><tr><th scope=\"col\">where</th><th scope=\"col\">what</th>"
                  "<th scope=\"col\">published</th><th scope=\"col\">ours</th><th scope=\"col\">distance</th>"
                  "<th scope=\"col\">verdict</th></tr></thead>\n{}",
                  checks.rows - checks.failed, checks.rows,
                  checks.failed == 0 ? "" : fmt::format(", <b class=\"failed\">{} fail</b>", checks.failed),
                  checks.failures);
  for (const Row &row : rows)
    html += two_lines(row, of_claims.at(row.at("claim")));
  return html + "</table>\n";
}

} // namespace report
