#include "compare/comparison.hpp"
#include "base/csv.hpp"
#include "base/failure.hpp"
#include "base/text.hpp"
#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <set>
#include <span>

namespace capsule {
namespace {

namespace fs = std::filesystem;

struct Column {
  const char *name;
  std::string Expectation::*entry;
};
constexpr std::array published_columns{Column{"id", &Expectation::id},
                                       Column{"where", &Expectation::where},
                                       Column{"case", &Expectation::case_name},
                                       Column{"run", &Expectation::run},
                                       Column{"quantity", &Expectation::quantity},
                                       Column{"published", &Expectation::published},
                                       Column{"allowed", &Expectation::allowed},
                                       Column{"reason", &Expectation::reason},
                                       Column{"claim", &Expectation::claim},
                                       Column{"kind", &Expectation::kind},
                                       Column{"statement", &Expectation::statement},
                                       Column{"converged", &Expectation::converged},
                                       Column{"verdict", &Expectation::verdict},
                                       Column{"evidence", &Expectation::evidence}};
constexpr std::array own_columns{Column{"id", &Expectation::id},
                                 Column{"run", &Expectation::run},
                                 Column{"quantity", &Expectation::quantity},
                                 Column{"expected", &Expectation::published},
                                 Column{"allowed", &Expectation::allowed},
                                 Column{"reason", &Expectation::reason}};
constexpr std::array kinds{"number", "bound", "ratio", "order", "behaviour", "picture"};
constexpr std::array statuses{"reached", "steady", "unbounded", "failed"};
constexpr std::array verdicts{"agrees", "differs", "not decidable"};

// What is wrong with the published value and the allowed distance, or nothing once they are taken.
std::string take_numbers(Expectation &row) {
  using Form = Expectation::Form;
  if (row.quantity == "status") {
    row.form = Form::status;
    const bool known =
        std::ranges::find(statuses, row.published) != statuses.end() || row.published.starts_with("failed:");
    return known ? ""
                 : fmt::format("the status '{}' is none of '{}', 'failed:...'", row.published,
                               fmt::join(statuses, "', '"));
  }
  if (row.recorded == Verdict::not_decidable)
    return "";
  const char first = row.published.empty() ? ' ' : row.published[0];
  row.form = first == '<' ? Form::below : first == '>' ? Form::above : Form::value;
  const auto value = to_number(row.form == Form::value ? row.published : trimmed(row.published.substr(1)));
  if (!value)
    return fmt::format("the value '{}' is not a number", row.published);
  row.published_value = *value;
  if (row.form != Form::value)
    return row.allowed.empty() ? "" : "a bound allows no distance";
  row.relative = row.allowed.ends_with("%");
  const auto allowed =
      to_number(trimmed(row.relative ? row.allowed.substr(0, row.allowed.size() - 1) : row.allowed));
  if (!allowed || !(*allowed > 0))
    return fmt::format("allowed '{}' is not a positive number, or one with %", row.allowed);
  if (row.relative && *value == 0)
    return "nothing can be relative to a value of 0";
  row.allowed_distance = *allowed * (row.relative ? 0.01 : 1);
  return "";
}

std::string take_verdict(Expectation &row) {
  const auto *const verdict = std::ranges::find(verdicts, row.verdict);
  if (verdict == verdicts.end())
    return fmt::format("the verdict '{}' is none of '{}'", row.verdict, fmt::join(verdicts, "', '"));
  row.recorded = static_cast<Verdict>(verdict - verdicts.begin());
  if (row.recorded != Verdict::agrees && row.evidence.empty())
    return fmt::format("evidence is missing for the verdict '{}'", row.verdict);
  if (!row.claim.empty() && std::ranges::find(kinds, row.kind) == kinds.end())
    return fmt::format("the kind '{}' is none of '{}'", row.kind, fmt::join(kinds, "', '"));
  return "";
}

// The expressions of a row.
std::vector<Expression> expressions_of(const Expectation &row) {
  std::vector<Expression> expressions;
  for (const std::string &text : {row.quantity, row.converged})
    if (!text.empty() && text != "status")
      expressions.emplace_back(text);
  return expressions;
}

// Throws InputError.
void check_words(const Expectation &row) {
  const Selector selector(row.run);
  for (const Expression &expression : expressions_of(row))
    for (const Reference &reference : expression.references())
      if (reference.runs)
        const Selector other(runs_of(reference));
}

std::string mistake_of(Expectation &row) {
  try {
    check_words(row);
  } catch (const InputError &error) {
    return error.what();
  }
  const std::string mistake = take_verdict(row);
  return mistake.empty() ? take_numbers(row) : mistake;
}

std::string status_of(const Summary &summary) {
  return summary.status + (summary.failure.empty() ? "" : ":" + summary.failure);
}

std::vector<std::string> trimmed_fields(const CsvRow &row) {
  std::vector<std::string> fields;
  std::ranges::transform(row.fields, std::back_inserter(fields), trimmed);
  return fields;
}

// The rows of a file with these columns; what has no column is taken from `blank`.
std::vector<Expectation> read_table(const fs::path &table, std::span<const Column> columns,
                                    const Expectation &blank) {
  const std::vector<CsvRow> lines = read_csv(table);
  std::string errors;
  const auto complain = [&](std::size_t line, const std::string &message) {
    errors += csv_error(table, line, message);
  };
  std::vector<std::string> names;
  std::ranges::transform(columns, std::back_inserter(names), &Column::name);
  if (lines.empty() || trimmed_fields(lines[0]) != names)
    complain(lines.empty() ? 1 : lines[0].line,
             fmt::format("the first line must be '{}'", fmt::join(names, ",")));
  std::vector<Expectation> rows;
  for (std::size_t i = 1; i < lines.size(); ++i) {
    const std::size_t line = lines[i].line;
    const std::vector<std::string> fields = trimmed_fields(lines[i]);
    if (fields.size() != columns.size()) {
      complain(line, fmt::format("{} instead of {}", counted(fields.size(), "field"), columns.size()));
      continue;
    }
    Expectation row = blank;
    for (std::size_t k = 0; k < columns.size(); ++k)
      row.*columns[k].entry = fields[k];
    if (const std::string mistake = mistake_of(row); !mistake.empty())
      complain(line, mistake);
    if (std::ranges::find(rows, row.id, &Expectation::id) != rows.end())
      complain(line, fmt::format("the id '{}' is there already", row.id));
    rows.push_back(std::move(row));
  }
  if (!errors.empty())
    throw InputError(errors);
  return rows;
}

// What one row compares in one run.
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
    comparison.distance =
        expected_.relative ? fmt::format("{:+.2g} %", 100 * off / unit) : fmt::format("{:+.2g}", off);
    comparison.excess = std::abs(off) - expected_.allowed_distance * unit;
    const bool agrees = comparison.excess <= 0;
    decide(comparison, agrees);
    if (!expected_.claim.empty() && (expected_.kind == "number" || expected_.kind == "ratio"))
      comparison.sharp = error && 5 * *error <= (agrees ? expected_.allowed_distance * unit : std::abs(off));
  }

  const Expectation &expected_;
  const std::string &case_name_;
  const RunTable &table_;
};

// Whether a row speaks of each run, not of those alone that it names.
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
  if (!c.sharp)
    return "ERROR TOO LARGE";
  return fmt::format("{}, NOT AS RECORDED", verdict_text(c.verdict));
}

} // namespace

std::string verdict_text(Verdict verdict) {
  return verdicts.at(static_cast<std::size_t>(verdict));
}

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

std::vector<Expectation> read_expectations(const fs::path &table) {
  return read_table(table, published_columns, {});
}

std::vector<Expectation> own_expectations(const fs::path &case_file, const std::string &case_name) {
  const fs::path table = case_file.parent_path() / "expected.csv";
  if (case_file.filename() != "case.toml" || !fs::exists(table))
    return {};
  Expectation row;
  row.case_name = case_name;
  row.verdict = verdict_text(Verdict::agrees);
  return read_table(table, own_columns, row);
}

std::vector<Expectation> expectations_of(const std::vector<Expectation> &all, const std::string &case_name) {
  std::vector<Expectation> rows;
  std::ranges::copy_if(all, std::back_inserter(rows), [&](const Expectation &row) {
    return row.case_name == case_name || row.case_name == "*";
  });
  return rows;
}

std::vector<std::string> referenced_cases(const std::vector<Expectation> &expectations) {
  std::set<std::string> names;
  for (const Expectation &row : expectations)
    for (const Expression &expression : expressions_of(row))
      for (const Reference &reference : expression.references())
        if (const auto name = case_of(reference))
          names.insert(*name);
  return {names.begin(), names.end()};
}

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
                             "published", "distance", "allowed", "verdict"}};
  for (const Comparison &c : comparisons)
    rows.push_back({c.expected.id, c.expected.where, c.run, c.expected.quantity, c.computed, c.converged,
                    c.estimate, c.expected.published, c.distance, c.expected.allowed,
                    verdict_against_record(c)});
  return rows;
}

std::string text_table(const std::vector<TextRow> &rows) {
  constexpr std::size_t widest = 40; // a longer entry moves its own row only
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
