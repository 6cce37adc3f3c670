#include "html.hpp"
#include "base/atomic_file.hpp"
#include "base/csv.hpp"
#include "base/text.hpp"
#include <algorithm>
#include <array>
#include <cctype>
#include <fmt/format.h>
#include <iterator>
#include <optional>
#include <sstream>
#include <utility>

namespace report {
namespace {

namespace fs = std::filesystem;

bool is_ascii_word(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
}
bool is_beyond_ascii(char c) {
  return static_cast<unsigned char>(c) >= 0x80;
}

// Whether a symbol of one letter ends before `end`: the v of v_g, the P of ΔP_ss, the α of α_p.
bool ends_in_symbol(std::string_view text, std::size_t end) {
  if (end == 0)
    return false;
  if (is_beyond_ascii(text[end - 1]))
    return true;
  return std::isalpha(static_cast<unsigned char>(text[end - 1])) != 0 &&
         (end == 1 || !is_ascii_word(text[end - 2]));
}

// The end of a subscript that begins at `from`: up to four letters or digits and no more; `from` if there is none.
std::size_t end_of_subscript(std::string_view text, std::size_t from) {
  constexpr std::size_t longest = 4;
  std::size_t end = from;
  while (end < text.size() && is_ascii_word(text[end]))
    ++end;
  const bool is_name =
      end - from > longest || text.substr(from, end - from).find('_') != std::string_view::npos;
  return is_name ? from : end;
}

// The end of a number that begins at `from`: "-1.05"; a full stop behind it is none of it.
std::size_t end_of_power(std::string_view text, std::size_t from) {
  std::size_t end = from < text.size() && text[from] == '-' ? from + 1 : from;
  const std::size_t first_digit = end;
  const auto is_digit = [&](std::size_t at) {
    return at < text.size() && std::isdigit(static_cast<unsigned char>(text[at])) != 0;
  };
  while (is_digit(end) || (end > first_digit && end < text.size() && text[end] == '.' && is_digit(end + 1)))
    ++end;
  return end == first_digit ? from : end;
}

// The end of a number with an exponent that begins at `from`, "1.5e-06", and where its e is; nothing else begins with it.
struct Exponential {
  std::size_t e, end;
};
std::optional<Exponential> exponential(std::string_view text, std::size_t from) {
  if (from > 0 && (is_ascii_word(text[from - 1]) || text[from - 1] == '.' || text[from - 1] == '='))
    return {};
  const std::size_t e = text.find_first_not_of("0123456789.", from);
  if (e == from || e == std::string_view::npos || text[e] != 'e')
    return {};
  const std::size_t sign = e + 1 < text.size() && (text[e + 1] == '-' || text[e + 1] == '+') ? 1 : 0;
  const std::size_t end = std::min(text.find_first_not_of("0123456789", e + 1 + sign), text.size());
  if (end == e + 1 + sign || (end < text.size() && is_ascii_word(text[end])))
    return {};
  return Exponential{e, end};
}

std::string with_subscripts(std::string_view text) {
  std::string html;
  for (std::size_t i = 0; i < text.size();) {
    if (const auto number = exponential(text, i)) {
      const std::string power =
          std::to_string(std::stoi(std::string(text.substr(number->e + 1, number->end - number->e - 1))));
      html +=
          fmt::format("{}·10<sup>{}</sup>", text.substr(i, number->e - i), capsule::with_minus_signs(power));
      i = number->end;
      continue;
    }
    const bool lower = text[i] == '_' && ends_in_symbol(text, i);
    const std::size_t end = lower            ? end_of_subscript(text, i + 1)
                            : text[i] == '^' ? end_of_power(text, i + 1)
                                             : i + 1;
    if (end > i + 1)
      html += fmt::format("<{0}>{1}</{0}>", lower ? "sub" : "sup",
                          capsule::with_minus_signs(text.substr(i + 1, end - i - 1)));
    else
      html += text[i];
    i = std::max(end, i + 1);
  }
  return html;
}

// The parts of a text that stand between two marks, and the others, each made HTML by a function of its own.
template <class Inside, class Outside>
std::string between_marks(const std::string &text, const std::string &mark, Inside inside, Outside outside) {
  std::string html;
  std::size_t from = 0;
  for (std::size_t open = 0; (open = text.find(mark, from)) != std::string::npos;) {
    const std::size_t close = text.find(mark, open + mark.size());
    if (close == std::string::npos)
      break;
    html += outside(text.substr(from, open - from)) +
            inside(text.substr(open + mark.size(), close - open - mark.size()));
    from = close + mark.size();
  }
  return html + outside(text.substr(from));
}

std::string table_cell(const std::string &column, const std::string &text) {
  std::string style = verdict_style(text);
  if (style.empty() && (column.starts_with("published") || column == "expected"))
    style = "published";
  return style.empty() ? fmt::format("<td>{}</td>", prose(text))
                       : fmt::format("<td class=\"{}\">{}</td>", style, prose(text));
}

} // namespace

std::string verdict_style(std::string_view text) {
  constexpr std::array<std::pair<std::string_view, const char *>, 3> styles{
      {{"agrees", "agrees"}, {"differs", "differs"}, {"not decidable", "undecided"}}};
  for (const std::string_view failure : {"NOT AS RECORDED", "ERROR TOO LARGE"})
    if (text.find(failure) != std::string_view::npos)
      return "failed";
  for (const auto &[verdict, style] : styles)
    if (text.starts_with(verdict))
      return style;
  return "";
}

std::string escaped(std::string_view text) {
  std::string html;
  for (const char c : text)
    html += c == '&'   ? "&amp;"
            : c == '<' ? "&lt;"
            : c == '>' ? "&gt;"
            : c == '"' ? "&quot;"
                       : std::string(1, c);
  return html;
}

std::string prose(const std::string &text) {
  const auto element = [](const char *name) {
    return [name](const std::string &part) { return fmt::format("<{0}>{1}</{0}>", name, part); };
  };
  const auto words = [&](const std::string &part) {
    return between_marks(part, "**", element("strong"), [](const std::string &plain) { return plain; });
  };
  return between_marks(escaped(text), "`", element("code"), [&](const std::string &part) {
    return words(with_subscripts(capsule::with_minus_signs(part)));
  });
}

std::string caption(const fs::path &markdown) {
  std::istringstream lines(capsule::read_file(markdown));
  std::string text;
  for (std::string line; std::getline(lines, line);)
    if (!line.starts_with("!["))
      text += line + "\n";
  return prose(text);
}

std::string base64(const std::string &bytes) {
  constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    unsigned three = 0;
    for (std::size_t k = i; k < i + 3; ++k)
      three = three << 8U | (k < bytes.size() ? static_cast<unsigned char>(bytes[k]) : 0U);
    for (std::size_t k = 0; k < 4; ++k)
      text += i + k > bytes.size() ? '=' : digits[three >> (18 - 6 * k) & 63U];
  }
  return text;
}

std::string table(const std::vector<std::vector<std::string>> &rows) {
  if (rows.empty())
    return "";
  std::string html = "<div class=\"table\" tabindex=\"0\"><table>\n<thead><tr>";
  for (const std::string &name : rows[0])
    html += fmt::format("<th scope=\"col\">{}</th>", prose(name));
  html += "</tr></thead>\n<tbody>\n";
  for (std::size_t i = 1; i < rows.size(); ++i) {
    html += "<tr>";
    for (std::size_t k = 0; k < rows[i].size(); ++k)
      html += table_cell(rows[0].at(k), rows[i][k]);
    html += "</tr>\n";
  }
  return html + "</tbody></table></div>\n";
}

std::string table(const fs::path &csv) {
  std::vector<std::vector<std::string>> rows;
  std::ranges::transform(capsule::read_csv(csv), std::back_inserter(rows), &capsule::CsvRow::fields);
  return table(rows);
}

} // namespace report
