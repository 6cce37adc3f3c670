#include "compare/text_table.hpp"
#include "base/csv.hpp"
#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace capsule {

std::string text_table(const std::vector<TextRow> &rows) {
  constexpr std::size_t widest = 40; // a longer entry widens its own row alone
  std::string text;
  for (const TextRow &row : rows) {
    for (std::size_t k = 0; k + 1 < row.size(); ++k) {
      std::size_t width = 0;
      for (const TextRow &other : rows)
        if (other.at(k).size() <= widest)
          width = std::max(width, other.at(k).size());
      text += fmt::format("{:<{}}  ", row.at(k), width);
    }
    text += row.back() + '\n';
  }
  return text;
}

std::string csv_table(const std::vector<TextRow> &rows) {
  std::string text;
  for (const TextRow &row : rows)
    text += csv_row(row);
  return text;
}

std::string markdown_table(const std::vector<TextRow> &rows) {
  std::string text;
  for (const TextRow &row : rows) {
    const bool is_header = text.empty();
    TextRow escaped = row;
    for (std::string &field : escaped)
      for (std::size_t at = field.find('|'); at != std::string::npos; at = field.find('|', at + 2))
        field.insert(at, 1, '\\');
    text += fmt::format("| {} |\n", fmt::join(escaped, " | "));
    if (is_header)
      for (std::size_t k = 0; k < row.size(); ++k)
        text += k + 1 < row.size() ? "| --- " : "| --- |\n";
  }
  return text;
}

} // namespace capsule
