#include "base/csv.hpp"
#include "base/atomic_file.hpp"
#include "base/failure.hpp"
#include "base/text.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <string_view>
#include <utility>

namespace capsule {
namespace {

namespace fs = std::filesystem;

constexpr const char *how_to_save = "save it as CSV in UTF-8 with commas between the fields";

struct Parsed {
  std::vector<CsvRow> rows; // blank ones, too
  // Of the first quote that is not closed, or not where its field ends: what is wrong; empty: none. Its line, and its place
  // in the text.
  std::string mistake = {};
  std::size_t quote_line = 0, quote_at = 0;
};

// `comment`: what a line begins with that is one field; 0: none.
Parsed parse(std::string_view text, char comment = '\0') {
  Parsed parsed{{{1, {""}}}};
  std::size_t line = 1;
  bool in_quote = false, behind_quote = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i], next = i + 1 < text.size() ? text[i + 1] : '\0';
    if (c == '\r' && next == '\n')
      continue;
    const bool line_end = c == '\n' || c == '\r';
    line += line_end ? 1 : 0;
    std::vector<std::string> &fields = parsed.rows.back().fields;
    const bool in_comment =
        comment != '\0' && !in_quote && fields.size() == 1 && trimmed(fields[0] + c).starts_with(comment);
    if (in_comment && !line_end) {
      fields[0] += c;
      continue;
    }
    if (in_quote) {
      if (c != '"')
        fields.back() += c;
      else if (next == '"')
        fields.back() += text[++i];
      else {
        in_quote = false;
        behind_quote = true;
      }
    } else if (line_end || c == ',') {
      behind_quote = false;
      if (c == ',')
        fields.emplace_back();
      else
        parsed.rows.push_back({line, {""}});
    } else if (behind_quote && c != ' ' && c != '\t' && c != ';') { // another separator is told as such
      parsed.mistake = "text stands behind the end of this quote";
      return parsed;
    } else if (!behind_quote && c == '"' && trimmed(fields.back()).empty()) {
      fields.back().clear();
      in_quote = true;
      parsed.quote_line = line;
      parsed.quote_at = i;
    } else {
      fields.back() += c;
      behind_quote = behind_quote && c != ';';
    }
  }
  if (in_quote)
    parsed.mistake = "this quote is not closed";
  return parsed;
}

bool is_blank(const CsvRow &row) {
  return std::ranges::all_of(row.fields, [](const std::string &field) { return trimmed(field).empty(); });
}

// Whether the one field of the first row has semicolons or tabs in it, which are not part of a column's name.
bool has_other_separators(const CsvRow &names) {
  return names.fields.size() == 1 && names.fields[0].find_first_of(";\t") != std::string::npos;
}

// Drops the empty fields behind the last column.
void drop_empty_end(CsvRow &row, std::size_t columns) {
  while (row.fields.size() > columns && trimmed(row.fields.back()).empty())
    row.fields.pop_back();
}

std::string csv_field(const std::string &text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos)
    return text;
  std::string quoted(1, '"');
  for (const char c : text)
    quoted.append(c == '"' ? 2 : 1, c);
  quoted.push_back('"');
  return quoted;
}

} // namespace

std::string csv_error(const fs::path &file, std::size_t line, const std::string &message) {
  return fmt::format("{}:{}:1: error: {}\n", file.string(), line, printable(message));
}

std::vector<CsvRow> read_csv(const fs::path &file) {
  return read_csv(file, '\0');
}

std::vector<CsvRow> read_csv(const fs::path &file, char comment) {
  LineMistakes mistakes;
  std::vector<CsvRow> rows = read_csv(file, comment, mistakes);
  if (!mistakes.empty())
    throw InputError(in_order(mistakes));
  return rows;
}

std::string in_order(const LineMistakes &mistakes) {
  std::string text;
  for (const auto &[line, message] : mistakes)
    text += message;
  return text;
}

std::vector<CsvRow> read_csv(const fs::path &file, char comment, LineMistakes &mistakes) {
  std::string text = read_file(file);
  const auto mistake = [&](std::size_t line, const std::string &message) {
    return csv_error(file, line, message) + how_to_save + '\n';
  };
  if (const auto error = encoding_error(text)) {
    const std::string_view before = std::string_view(text).substr(0, error->byte);
    throw InputError(mistake(1 + static_cast<std::size_t>(std::ranges::count(before, '\n')), error->message));
  }
  if (constexpr std::string_view byte_order_mark = "\xef\xbb\xbf"; text.starts_with(byte_order_mark))
    text.erase(0, byte_order_mark.size());
  Parsed parsed = parse(text, comment);
  for (; !parsed.mistake.empty(); parsed = parse(text, comment)) {
    mistakes.emplace(parsed.quote_line, mistake(parsed.quote_line, parsed.mistake));
    constexpr const char *line_ends = "\r\n";
    const std::size_t before = text.find_last_of(line_ends, parsed.quote_at);
    const std::size_t begin = before == std::string::npos ? 0 : before + 1;
    text.erase(begin, std::min(text.find_first_of(line_ends, begin), text.size()) - begin);
  }
  std::vector<CsvRow> rows = std::move(parsed.rows);
  std::erase_if(rows, is_blank);
  const auto names = std::ranges::find_if(rows, [&](const CsvRow &row) {
    return comment == '\0' || !trimmed(row.fields[0]).starts_with(comment);
  });
  if (names == rows.end())
    return rows;
  if (has_other_separators(*names)) {
    mistakes.emplace(names->line, mistake(names->line, "semicolons or tabs stand between the fields"));
    throw InputError(in_order(mistakes));
  }
  drop_empty_end(*names, 1);
  for (CsvRow &row : rows)
    drop_empty_end(row, names->fields.size());
  return rows;
}

Columns read_columns(const fs::path &file, Numbers allowed) {
  const std::vector<CsvRow> rows = read_csv(file);
  if (rows.empty())
    return {};
  const auto refuse = [&](const CsvRow &row, const std::string &message) {
    throw InputError(csv_error(file, row.line, message));
  };
  const std::vector<std::string> &names = rows[0].fields;
  std::vector<std::vector<double>> values(names.size());
  for (std::size_t i = 1; i < rows.size(); ++i) {
    const std::vector<std::string> &fields = rows[i].fields;
    if (fields.size() != names.size())
      refuse(rows[i], fmt::format("{} instead of {}", counted(fields.size(), "field"), names.size()));
    for (std::size_t k = 0; k < names.size(); ++k) {
      const auto number = to_number(trimmed(fields[k]));
      if (!number)
        refuse(rows[i], not_a_number(trimmed(fields[k]), fmt::format(" in the column '{}'", names[k])));
      if (allowed == Numbers::finite && !std::isfinite(*number))
        refuse(rows[i], fmt::format("'{}' in the column '{}' is not finite", trimmed(fields[k]), names[k]));
      values[k].push_back(*number);
    }
  }
  Columns columns;
  for (std::size_t k = 0; k < names.size(); ++k)
    if (!columns.emplace(trimmed(names[k]), std::move(values[k])).second)
      refuse(rows[0], fmt::format("there are two columns '{}'", names[k]));
  return columns;
}

std::vector<std::string> split_csv(const std::string &line) {
  return parse(line).rows[0].fields;
}

std::string csv_row(const std::vector<std::string> &fields) {
  std::vector<std::string> written;
  std::ranges::transform(fields, std::back_inserter(written), csv_field);
  return fmt::format("{}\n", fmt::join(written, ","));
}

} // namespace capsule
