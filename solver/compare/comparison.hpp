#pragma once
// Computed against expected values. Expectations stand in tables/published.csv, one row each, with the columns:
// - id: "T2-1-vg".
// - where: "Table 2".
// - case: the case directory's name; "*" for every case that has such runs.
// - run: which runs of the case: "viscosity_ratio=1", several pairs with "; " between them, several values with "|",
//   or empty for all.
// - quantity: "status", or an expression (expression.hpp, run_values.hpp) for each of these runs, or once if it
//   names its runs itself.
// - published: a value; a bound, "<0.001" or ">0"; the status "reached" or "failed:wrinkled".
// - allowed: the distance from a value, "0.02", or "0.1 %" of it; empty for a bound or a status.
// - reason: why this distance; how words were read.
// - claim: the claim of the paper to which the row belongs. Empty: the row is no claim of the paper.
// - kind: number, bound, ratio, order, behaviour or picture.
// - statement: what the paper says, in words.
// - converged: an expression for the converged value, where `quantity` is one of the paper's own numerics.
// - verdict: what the comparison must find: "agrees", "differs", or "not decidable", where nothing is compared.
// - evidence: why it differs or cannot be decided, and where this is shown.
// What a case directory expects of its own case stands beside its case.toml, in expected.csv, with the columns id, run,
// quantity, expected (a published value), allowed and reason; its rows must agree.
// A row whose comparison finds another verdict than the recorded one is an error, whichever of the two it is. So is a
// number or ratio of the paper whose own error estimate is more than a fifth of the distance that its verdict
// speaks of: the allowed one if it agrees, the one that was found if it differs.
#include "compare/run_values.hpp"
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace capsule {

enum class Verdict { agrees, differs, not_decidable };
std::string verdict_text(Verdict verdict);

struct Expectation {
  // As they stand in the table.
  std::string id, where, case_name, run, quantity, published, allowed, reason;
  std::string claim, kind, statement, converged, verdict, evidence;
  Verdict recorded = Verdict::agrees;
  enum class Form { status, value, below, above } form = Form::value; // of `published`
  double published_value = 0;
  double allowed_distance = 0; // in units of the value or, if relative, of the published one
  bool relative = false;
};

// The table of the project that a case belongs to: tables/published.csv in a directory above the case's file.
std::optional<std::filesystem::path> find_expectations(const std::filesystem::path &case_file);

// All rows. Throws InputError with all mistakes of the table, and FileError.
std::vector<Expectation> read_expectations(const std::filesystem::path &table);

// The rows of expected.csv beside a case.toml; none without the file. Throws as above.
std::vector<Expectation> own_expectations(const std::filesystem::path &case_file,
                                          const std::string &case_name);

// The rows of one case, those of every case too.
std::vector<Expectation> expectations_of(const std::vector<Expectation> &all, const std::string &case_name);

// The other cases that rows speak of.
std::vector<std::string> referenced_cases(const std::vector<Expectation> &expectations);

struct Comparison {
  Expectation expected;
  std::string case_name; // of the row, or one of all
  std::string run;       // empty with a case of one run, or for what is compared once
  std::string computed;  // "no such run", "no value" where there is nothing to compare
  std::string distance;  // empty for what is no number
  std::string converged; // where the row asks for it
  std::string estimate;  // of the converged value's own error; empty: unknown
  Verdict verdict = Verdict::differs;
  double excess = 0; // how far beyond what is allowed; negative: within
  bool no_such_run = false;
  bool sharp = true; // whether the error estimate bears the verdict
  bool as_recorded() const { return sharp && verdict == expected.recorded; }
};
// One comparison per expectation and run that it speaks of.
std::vector<Comparison> compare(const std::vector<Expectation> &expectations, const std::string &case_name,
                                const RunTable &table);

// Whether a failure of this run is what the table expects.
bool failure_is_expected(const std::vector<Comparison> &comparisons, const RunResult &result);

// All rows: in columns, as CSV, as a Markdown table.
using TextRow = std::vector<std::string>;
std::string text_table(const std::vector<TextRow> &rows);
std::string csv_table(const std::vector<TextRow> &rows);
std::string markdown_table(const std::vector<TextRow> &rows);
// The header, then one row per comparison.
std::vector<TextRow> comparison_rows(const std::vector<Comparison> &comparisons);

} // namespace capsule
