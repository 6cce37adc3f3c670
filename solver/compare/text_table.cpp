#include "compare/text_table.hpp"
#include "base/atomic_file.hpp"
#include "base/csv.hpp"
#include "base/failure.hpp"
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

void write_table(const std::filesystem::path &file, const std::string &text) {
  const auto first_line = [](const std::string &of) { return of.substr(0, of.find('\n')); };
  if (std::error_code ignored;
      std::filesystem::exists(file, ignored) && first_line(read_file(file)) != first_line(text))
    throw InputError(fmt::format(
        "error: '{}' is no such table; give --table another name, or move the file away\n", file.string()));
  write_atomically(file, text);
}

} // namespace capsule
