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

struct Outcome {
  const char *style, *title;
};
constexpr std::array<Outcome, 4> outcomes{{{"agrees", "agree"},
                                           {"mesh", "differ because the paper's mesh is too coarse"},
                                           {"differs", "are not reproduced"},
                                           {"undecided", "cannot be decided"}}};

std::string outcome_of(const Row &row) {
  if (!row.at("cause").empty())
    return row.at("cause");
  const std::string style = verdict_style(row.at("verdict"));
  return style.empty() ? "differs" : style; // not as recorded
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

std::string two_lines(const Row &row) {
  const std::string outcome = outcome_of(row);
  const auto with_paper_numerics = capsule::to_number(row.at("with the paper's numerics"));
  return fmt::format("<tbody data-outcome=\"{}\"><tr>{}{}{}{}{}{}</tr>\n<tr><td class=\"reason\" "
                     "colspan=\"6\">{}{} <code>{}</code></td></tr></tbody>\n",
                     outcome, cell("", row.at("where")), cell("", in_greek(row.at("statement"))),
                     cell("published", row.at("published"), "published"),
                     cell("ours", with_error(row.at("converged"), row.at("own error"))),
                     cell("distance", row.at("distance")), cell("verdict", row.at("verdict"), outcome),
                     with_paper_numerics
                         ? prose(fmt::format("With the paper's numerics {:.5g}. ", *with_paper_numerics))
                         : "",
                     prose(as_sentence(in_greek(row.at("reading and evidence")))), escaped(row.at("row")));
}

} // namespace

std::string claims(const std::filesystem::path &ledger_csv) {
  if (!std::filesystem::exists(ledger_csv))
    return "<p>Not computed yet: <code>make figures</code> writes the ledger.</p>";
  const std::vector<Row> rows = rows_of(ledger_csv);
  const auto filter = [](const char *style, std::size_t sum, const std::string &title) {
    return fmt::format(
        "<button type=\"button\" class=\"{0}\" data-filter=\"{0}\" aria-pressed=\"false\"><b>{1}</b> "
        "{2}</button>\n",
        style, sum, title);
  };
  std::string html =
      "<div class=\"row\" id=\"sums\" role=\"group\" aria-label=\"Rows of the ledger by their verdict\">\n" +
      filter("", rows.size(), "rows");
  for (const Outcome &outcome : outcomes)
    html += filter(outcome.style,
                   static_cast<std::size_t>(std::ranges::count_if(
                       rows, [&](const Row &row) { return outcome_of(row) == outcome.style; })),
                   outcome.title);
  html += "<label>Find <input id=\"find\" type=\"search\" placeholder=\"Table 3, volume, λ "
          "10\"></label>\n</div>\n"
          "<table id=\"claims\">\n<thead><tr><th scope=\"col\">where</th><th scope=\"col\">what</th>"
          "<th scope=\"col\">published</th><th scope=\"col\">ours</th><th scope=\"col\">distance</th>"
          "<th scope=\"col\">verdict</th></tr></thead>\n";
  for (const Row &row : rows)
    html += two_lines(row);
  return html + "</table>\n";
}

} // namespace report
