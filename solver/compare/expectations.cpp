#include "compare/expectations.hpp"
#include "base/csv.hpp"
#include "base/failure.hpp"
#include "base/text.hpp"
#include "compare/reference_units.hpp"
#include "compare/run_values.hpp"
#include "observe/outcome.hpp"
#include <algorithm>
#include <array>
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
                                       Column{"cause", &Expectation::cause},
                                       Column{"evidence", &Expectation::evidence}};
constexpr std::array own_columns{Column{"id", &Expectation::id},
                                 Column{"run", &Expectation::run},
                                 Column{"quantity", &Expectation::quantity},
                                 Column{"expected", &Expectation::published},
                                 Column{"allowed", &Expectation::allowed},
                                 Column{"reason", &Expectation::reason}};
constexpr std::array kinds{"number", "bound", "ratio", "order", "behaviour", "picture"};
constexpr std::array verdicts{"agrees", "differs", "not decidable"};
constexpr std::array causes{"", "mesh"};

std::vector<std::string> texts_of_expressions(const Expectation &row) {
  std::vector<std::string> texts;
  for (const std::string &text : {row.quantity, row.converged})
    if (!text.empty() && text != "status")
      texts.push_back(text);
  return texts;
}

// Reads the published value and the allowed distance. Returns what is wrong with them, or nothing.
std::string read_numbers(Expectation &row) {
  using Form = Expectation::Form;
  if (row.quantity == "status") {
    row.form = Form::status;
    const bool known = std::ranges::find(status_words, row.published) != status_words.end() ||
                       row.published.starts_with("failed:");
    return known ? ""
                 : fmt::format("the status '{}' is none of '{}', 'failed:...'", row.published,
                               fmt::join(status_words, "', '"));
  }
  if (row.recorded == Verdict::not_decidable)
    return "";
  const char first = row.published.empty() ? ' ' : row.published[0];
  row.form = first == '<' ? Form::below : first == '>' ? Form::above : Form::value;
  const auto value = to_number(row.form == Form::value ? row.published : trimmed(row.published.substr(1)));
  if (!value)
    return "the value " + not_a_number(row.published);
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

// Reads the recorded verdict. Returns what is wrong with it, its cause, its evidence or the kind, or nothing.
std::string read_verdict(Expectation &row) {
  const auto *const verdict = std::ranges::find(verdicts, row.verdict);
  if (verdict == verdicts.end())
    return fmt::format("the verdict '{}' is none of '{}'", row.verdict, fmt::join(verdicts, "', '"));
  row.recorded = static_cast<Verdict>(verdict - verdicts.begin());
  if (row.recorded != Verdict::agrees && row.evidence.empty())
    return fmt::format("evidence is missing for the verdict '{}'", row.verdict);
  if (std::ranges::find(causes, row.cause) == causes.end())
    return fmt::format("the cause '{}' is neither 'mesh' nor empty", row.cause);
  if (row.recorded != Verdict::differs && !row.cause.empty())
    return fmt::format("the verdict '{}' has no cause", row.verdict);
  if (!row.claim.empty() && std::ranges::find(kinds, row.kind) == kinds.end())
    return fmt::format("the kind '{}' is none of '{}'", row.kind, fmt::join(kinds, "', '"));
  return "";
}

// What is wrong with the row's selector and each of its expressions.
std::vector<std::string> mistakes_of_expressions(const Expectation &row) {
  std::vector<std::string> mistakes;
  const auto check = [&](const auto &read) {
    try {
      read();
    } catch (const InputError &error) {
      mistakes.emplace_back(error.what());
    }
  };
  check([&] { const Selector selector(row.run); });
  for (const std::string &text : texts_of_expressions(row))
    check([&] {
      for (const Reference &reference : Expression(text).references()) {
        check([&] { check_units(reference); });
        if (reference.runs)
          check([&] { const Selector other(runs_of(reference)); });
      }
    });
  return mistakes;
}

// Completes a row from its columns. Returns all mistakes in it.
std::vector<std::string> complete(Expectation &row) {
  std::vector<std::string> mistakes = mistakes_of_expressions(row);
  for (std::string (*read)(Expectation &) : {read_verdict, read_numbers})
    if (std::string mistake = read(row); !mistake.empty())
      mistakes.push_back(std::move(mistake));
  return mistakes;
}

std::vector<std::string> trimmed_fields(const CsvRow &row) {
  std::vector<std::string> fields;
  std::ranges::transform(row.fields, std::back_inserter(fields), trimmed);
  return fields;
}

// The rows of a file with these columns. What has no column is as in `blank`.
std::vector<Expectation> read_table(const fs::path &table, std::span<const Column> columns,
                                    const Expectation &blank) {
  LineMistakes errors;
  std::vector<CsvRow> lines = read_csv(table, '#', errors);
  std::erase_if(lines, [](const CsvRow &row) { return trimmed(row.fields.at(0)).starts_with("#"); });
  const auto complain = [&](std::size_t line, const std::string &message) {
    errors.emplace(line, csv_error(table, line, message));
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
    for (const std::string &mistake : complete(row))
      complain(line, mistake);
    if (std::ranges::find(rows, row.id, &Expectation::id) != rows.end())
      complain(line, fmt::format("the id '{}' is there already", row.id));
    rows.push_back(std::move(row));
  }
  if (!errors.empty())
    throw InputError(in_order(errors));
  return rows;
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

std::vector<Expression> expressions_of(const Expectation &row) {
  std::vector<Expression> expressions;
  for (const std::string &text : texts_of_expressions(row))
    expressions.emplace_back(text);
  return expressions;
}

} // namespace capsule
