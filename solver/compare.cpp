#include "compare.hpp"
#include "case_keys.hpp"
#include "failure.hpp"
#include "text.hpp"
#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <fstream>
#include <sstream>

namespace capsule {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> read_lines(const fs::path &file) {
  errno = 0;
  std::ifstream stream(file);
  if (!stream)
    throw FileError(fmt::format("cannot read '{}': {}", file.string(), std::strerror(errno)));
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);)
    lines.push_back(line);
  return lines;
}

// Fields between commas; a field may stand in double quotes, doubled inside.
std::vector<std::string> split_csv(const std::string &line) {
  std::vector<std::string> fields(1);
  bool quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (line[i] == '"' && quoted && i + 1 < line.size() && line[i + 1] == '"')
      fields.back() += line[++i];
    else if (line[i] == '"')
      quoted = !quoted;
    else if (line[i] == ',' && !quoted)
      fields.emplace_back();
    else if (line[i] != '\r')
      fields.back() += line[i];
  }
  return fields;
}

std::string csv_field(const std::string &text) {
  return text.find(',') == std::string::npos ? text : '"' + text + '"';
}

std::string trimmed(const std::string &text) {
  const std::size_t first = text.find_first_not_of(' ');
  return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(' ') - first + 1);
}

std::optional<double> to_number(const std::string &text) {
  std::size_t used = 0;
  try {
    const double value = std::stod(text, &used);
    return used == text.size() ? std::optional(value) : std::nullopt;
  } catch (const std::exception &) {
    return std::nullopt;
  }
}

using Pair = std::pair<std::string, std::string>;

std::optional<Pair> split_pair(const std::string &text) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos)
    return std::nullopt;
  return Pair{trimmed(text.substr(0, equals)), trimmed(text.substr(equals + 1))};
}

// "viscosity_ratio=1; law=skalak"; nothing if it is not of this form.
std::optional<std::vector<Pair>> split_selector(const std::string &text) {
  std::vector<Pair> pairs;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, ';');) {
    auto pair = split_pair(part);
    if (!pair)
      return std::nullopt;
    pairs.push_back(std::move(*pair));
  }
  return pairs;
}

const Key *key_named(const std::string &name) {
  const auto named = [&](const Key &key) { return key.name == name || last_component(key.name) == name; };
  const auto found = std::ranges::find_if(keys(), named);
  return found == keys().end() ? nullptr : &*found;
}

bool has_value(const Case &physics, const Pair &pair) {
  const auto value = get_value(*key_named(pair.first), physics);
  if (!value)
    return false;
  if (const auto *word = std::get_if<std::string>(&*value))
    return *word == pair.second;
  return to_number(value_text(*value)) == to_number(pair.second);
}

bool is_selected(const Case &physics, const std::string &selector) {
  const std::vector<Pair> pairs = split_selector(selector).value();
  return std::ranges::all_of(pairs, [&](const Pair &pair) { return has_value(physics, pair); });
}

constexpr std::array columns{&Expectation::id,      &Expectation::where,    &Expectation::case_name,
                             &Expectation::run,     &Expectation::quantity, &Expectation::published,
                             &Expectation::allowed, &Expectation::reason};
constexpr const char *header = "id,where,case,run,quantity,published,allowed,reason";

// What is wrong with a row, or nothing once its numbers are taken.
std::string take_numbers(Expectation &row) {
  const auto pairs = split_selector(row.run);
  if (!pairs)
    return fmt::format("the run '{}' is not of the form key=value", row.run);
  for (const Pair &pair : *pairs)
    if (key_named(pair.first) == nullptr)
      return fmt::format("unknown key '{}'", pair.first);
  if (row.quantity == "status")
    return "";
  const auto value = to_number(row.published);
  if (!value)
    return fmt::format("published '{}' is not a number", row.published);
  row.relative = row.allowed.ends_with("%");
  const auto allowed =
      to_number(trimmed(row.relative ? row.allowed.substr(0, row.allowed.size() - 1) : row.allowed));
  if (!allowed || !(*allowed > 0))
    return fmt::format("allowed '{}' is not a positive number, or one with %", row.allowed);
  if (row.relative && *value == 0)
    return "nothing can be relative to a published value of 0";
  row.published_value = *value;
  row.allowed_distance = *allowed * (row.relative ? 0.01 : 1);
  return "";
}

// A column of series.csv where another one passes a value for the first time; linear between the rows.
std::optional<double> interpolated(const fs::path &series, const std::string &quantity,
                                   const std::string &column, double at) {
  const std::vector<std::string> lines = read_lines(series);
  const std::vector<std::string> names = split_csv(lines.empty() ? "" : lines[0]);
  const auto index_of = [&](const std::string &name) {
    return static_cast<std::size_t>(std::ranges::find(names, name) - names.begin());
  };
  const std::size_t wanted = index_of(quantity), along = index_of(column);
  if (std::max(wanted, along) >= names.size())
    return std::nullopt;
  double y_before = 0, x_before = 0;
  for (std::size_t i = 1; i < lines.size(); ++i) {
    const std::vector<std::string> fields = split_csv(lines[i]);
    const double y = std::stod(fields.at(wanted)), x = std::stod(fields.at(along));
    if (x == at)
      return y;
    if (i > 1 && (x_before < at) != (x < at))
      return y_before + (y - y_before) * (at - x_before) / (x - x_before);
    y_before = y;
    x_before = x;
  }
  return std::nullopt;
}

std::optional<double> computed_value(const RunResult &result, const std::string &quantity) {
  const std::size_t at = quantity.find('@');
  if (at == std::string::npos) {
    const auto found = result.summary->quantities.find(quantity);
    return found == result.summary->quantities.end() ? std::nullopt : std::optional(found->second);
  }
  const auto place = split_pair(quantity.substr(at + 1));
  const auto value = place ? to_number(place->second) : std::nullopt;
  return value ? interpolated(result.directory / "series.csv", quantity.substr(0, at), place->first, *value)
               : std::nullopt;
}

std::string status_of(const Summary &summary) {
  return summary.status + (summary.failure.empty() ? "" : ":" + summary.failure);
}

Comparison compare_one(const Expectation &expected, const RunResult &result) {
  Comparison comparison{expected, result.input.name, "", "", "", false, false};
  if (expected.quantity == "status") {
    comparison.computed = status_of(*result.summary);
    comparison.agrees =
        comparison.computed == expected.published || result.summary->status == expected.published;
    return comparison;
  }
  const auto value = computed_value(result, expected.quantity);
  if (!value) {
    comparison.computed = "no value";
    return comparison;
  }
  const double unit = expected.relative ? std::abs(expected.published_value) : 1;
  const double distance = (*value - expected.published_value) / unit;
  comparison.computed = fmt::format("{:.7g}", *value);
  comparison.distance =
      expected.relative ? fmt::format("{:+.2g} %", 100 * distance) : fmt::format("{:+.2g}", distance);
  if (const auto error = result.summary->error_estimate.find(expected.quantity);
      error != result.summary->error_estimate.end())
    comparison.estimate = fmt::format("{:.1g}", error->second);
  comparison.agrees = std::abs(distance) <= expected.allowed_distance;
  return comparison;
}

using ComparisonRow = std::array<std::string, 10>;

// The header, then one row per comparison.
std::vector<ComparisonRow> comparison_rows(const std::vector<Comparison> &comparisons) {
  std::vector<ComparisonRow> rows{{"id", "where", "run", "quantity", "computed", "own error", "published",
                                   "distance", "allowed", "verdict"}};
  for (const Comparison &c : comparisons)
    rows.push_back({c.expected.id, c.expected.where, c.run, c.expected.quantity, c.computed, c.estimate,
                    c.expected.published, c.distance, c.expected.allowed, c.agrees ? "agrees" : "DIFFERS"});
  return rows;
}

} // namespace

std::optional<fs::path> find_expectations(const fs::path &case_file) {
  std::error_code ignored;
  for (fs::path directory = fs::weakly_canonical(case_file, ignored).parent_path();;
       directory = directory.parent_path()) {
    if (fs::exists(directory / "tables" / "published.csv", ignored))
      return directory / "tables" / "published.csv";
    if (!directory.has_relative_path())
      return std::nullopt;
  }
}

std::vector<Expectation> read_expectations(const fs::path &table, const std::string &case_name) {
  const std::vector<std::string> lines = read_lines(table);
  std::string errors;
  const auto complain = [&](std::size_t line, const std::string &message) {
    errors += fmt::format("{}:{}:1: error: {}\n", table.string(), line + 1, message);
  };
  if (lines.empty() || trimmed(lines[0]) != header)
    complain(0, fmt::format("the first line must be '{}'", header));
  std::vector<Expectation> rows;
  for (std::size_t i = 1; i < lines.size(); ++i) {
    const std::vector<std::string> fields = split_csv(lines[i]);
    if (fields.size() != columns.size()) {
      complain(i, fmt::format("{} fields instead of {}", fields.size(), columns.size()));
      continue;
    }
    Expectation row;
    for (std::size_t k = 0; k < columns.size(); ++k)
      row.*columns.at(k) = trimmed(fields[k]);
    if (const std::string mistake = take_numbers(row); !mistake.empty())
      complain(i, mistake);
    if (row.case_name == case_name)
      rows.push_back(std::move(row));
  }
  if (!errors.empty())
    throw InputError(errors);
  return rows;
}

std::vector<Comparison> compare(const std::vector<Expectation> &expectations,
                                const std::vector<RunResult> &results) {
  std::vector<Comparison> comparisons;
  for (const Expectation &expected : expectations) {
    const std::size_t before = comparisons.size();
    for (const RunResult &result : results)
      if (is_selected(result.input.physics, expected.run))
        comparisons.push_back(compare_one(expected, result));
    if (comparisons.size() == before)
      comparisons.push_back({expected, expected.run, "no such run", "", "", false, true});
  }
  return comparisons;
}

bool failure_is_expected(const std::vector<Comparison> &comparisons, const RunResult &result) {
  return std::ranges::any_of(comparisons, [&](const Comparison &comparison) {
    return comparison.agrees && comparison.expected.quantity == "status" &&
           comparison.run == result.input.name;
  });
}

std::string comparison_table(const std::vector<Comparison> &comparisons) {
  const std::vector<ComparisonRow> rows = comparison_rows(comparisons);
  std::string text;
  for (const ComparisonRow &row : rows) {
    for (std::size_t k = 0; k + 1 < row.size(); ++k) {
      const auto wider = [k](const auto &a, const auto &b) { return a.at(k).size() < b.at(k).size(); };
      text += fmt::format("{:<{}}  ", row.at(k), std::ranges::max_element(rows, wider)->at(k).size());
    }
    text += row.back() + '\n';
  }
  return text;
}

std::string comparison_csv(const std::vector<Comparison> &comparisons) {
  std::string text;
  for (ComparisonRow row : comparison_rows(comparisons)) {
    std::ranges::transform(row, row.begin(), csv_field);
    text += fmt::format("{}\n", fmt::join(row, ","));
  }
  return text;
}

std::string comparison_markdown(const std::vector<Comparison> &comparisons) {
  std::string text;
  for (const ComparisonRow &row : comparison_rows(comparisons)) {
    const bool is_header = text.empty();
    text += fmt::format("| {} |\n", fmt::join(row, " | "));
    if (is_header)
      for (std::size_t k = 0; k < row.size(); ++k)
        text += k + 1 < row.size() ? "| --- " : "| --- |\n";
  }
  return text;
}

} // namespace capsule
