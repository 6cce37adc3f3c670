#include "compare/text_table.hpp"
#include "base/atomic_file.hpp"
#include "base/csv.hpp"
#include "base/failure.hpp"
#include "base/text.hpp"
#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <utility>

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
    for (std::string &field : escaped) {
      field = with_minus_signs(field);
      for (std::size_t at = field.find('|'); at != std::string::npos; at = field.find('|', at + 2))
        field.insert(at, 1, '\\');
    }
    text += fmt::format("| {} |\n", fmt::join(escaped, " | "));
    if (is_header)
      for (std::size_t k = 0; k < row.size(); ++k)
        text += k + 1 < row.size() ? "| --- " : "| --- |\n";
  }
  return text;
}

void write_table(const std::filesystem::path &file, const std::string &text) {
  // The first column's name, and how many there are: the others' may be those of an earlier version.
  const auto columns = [](const std::string &of) {
    const std::string line = of.substr(0, of.find('\n'));
    const auto is_end = [](char c) { return c == ',' || c == '|'; };
    return std::pair(line.substr(0, line.find_first_of(",|", 1)), std::ranges::count_if(line, is_end));
  };
  if (std::error_code ignored;
      std::filesystem::exists(file, ignored) && columns(read_file(file)) != columns(text))
    throw InputError(fmt::format(
        "error: '{}' is no such table; give --table another name, or move the file away\n", file.string()));
  write_atomically(file, text);
}

} // namespace capsule
