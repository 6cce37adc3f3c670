#pragma once
// Computed against expected values. Expectations stand in tables/published.csv, one row each,
// with the columns:
// - id: "T2-1-vg".
// - where: "Table 2".
// - case: the case directory's name.
// - run: which runs of the case: "viscosity_ratio=1", several pairs with "; " between them, or empty for all.
// - quantity: of summary.json ("v_g", "status"); or of series.csv, interpolated: "x_g@time=18.7".
// - published: the value; for the status "reached" or "failed:wrinkled".
// - allowed: the distance, "0.02", or "0.1 %" of the published value; empty for the status.
// - reason: why this distance.
#include "run.hpp"
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace capsule {

struct Expectation {
  std::string id, where, case_name, run, quantity, published, allowed, reason; // as they stand in the table
  double published_value = 0;
  double allowed_distance = 0; // in units of the value or, if relative, of the published one
  bool relative = false;
};

// The table of the project that a case belongs to: tables/published.csv in a directory above the case's file.
std::optional<std::filesystem::path> find_expectations(const std::filesystem::path &case_file);

// The rows of one case. Throws InputError with all mistakes of the table, and FileError.
std::vector<Expectation> read_expectations(const std::filesystem::path &table, const std::string &case_name);

struct Comparison {
  Expectation expected;
  std::string run;      // empty with a case of one run
  std::string computed; // "no such run", "no value" where there is nothing to compare
  std::string distance; // empty for what is no number
  std::string estimate; // of the computed value's own error
  bool agrees = false;
  bool no_such_run = false;
};
// One comparison per expectation and run that it speaks of.
std::vector<Comparison> compare(const std::vector<Expectation> &expectations,
                                const std::vector<RunResult> &results);

// Whether a failure of this run is what the table expects.
bool failure_is_expected(const std::vector<Comparison> &comparisons, const RunResult &result);

// All rows: in columns, as CSV, as a Markdown table.
std::string comparison_table(const std::vector<Comparison> &comparisons);
std::string comparison_csv(const std::vector<Comparison> &comparisons);
std::string comparison_markdown(const std::vector<Comparison> &comparisons);

} // namespace capsule
