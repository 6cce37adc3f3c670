#pragma once
// What is expected of the runs of cases. Expectations stand in tables/published.csv, one row each, with the columns:
// - id: "T2-1-vg".
// - where: the place in the paper, "Table 2".
// - case: the case directory's name; "*" for every case that has such runs.
// - run: which runs of the case: "viscosity_ratio=1", several pairs with "; " between them, several values with "|",
//   or empty for all.
// - quantity: "status", or an expression (expression.hpp, run_values.hpp). It is evaluated for each of these runs, or
//   once if it names all its runs itself.
// - published: a value; a bound, "<0.001" or ">0"; the status "reached" or "failed:wrinkled".
// - allowed: the distance from a value, "0.02", or "0.1 %" of it; empty for a bound or a status.
// - reason: why this distance; how the paper's words were read.
// - claim: the claim of the paper to which the row belongs; empty if it belongs to none.
// - kind: number, bound, ratio, order, behaviour or picture.
// - statement: what the paper says, in words.
// - converged: an expression for the converged value, where `quantity` is one of the paper's own numerics.
// - verdict: what the comparison must find: "agrees", "differs", or "not decidable" (then nothing is compared).
// - cause: "mesh" where it differs because the paper's mesh is too coarse, otherwise empty.
// - evidence: why it differs or cannot be decided, and where this is shown.
// A case directory has its own expectations in expected.csv beside its case.toml, with the columns id, run, quantity,
// expected (as `published`), allowed and reason; all of them must agree.
#include "compare/expression.hpp"
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace capsule {

enum class Verdict { agrees, differs, not_decidable };
std::string verdict_text(Verdict verdict);

struct Expectation {
  // Columns of the table.
  std::string id, where, case_name, run, quantity, published, allowed, reason;
  std::string claim, kind, statement, converged, verdict, cause, evidence;
  Verdict recorded = Verdict::agrees;
  enum class Form { status, value, below, above } form = Form::value; // what `published` is
  double published_value = 0;
  double allowed_distance = 0; // in units of the value or, if relative, of the published one
  bool relative = false;
};

// The table of the project that a case belongs to: tables/published.csv in a directory above the case's file.
std::optional<std::filesystem::path> find_expectations(const std::filesystem::path &case_file);

// All rows. Throws InputError with all mistakes of the table, and FileError.
std::vector<Expectation> read_expectations(const std::filesystem::path &table);

// The rows of expected.csv beside a case.toml; none if there is no such file. Throws as above.
std::vector<Expectation> own_expectations(const std::filesystem::path &case_file,
                                          const std::string &case_name);

// The rows of one case, including those of every case ("*").
std::vector<Expectation> expectations_of(const std::vector<Expectation> &all, const std::string &case_name);

// The other cases that the rows' expressions name.
std::vector<std::string> referenced_cases(const std::vector<Expectation> &expectations);

// The expressions of a row: that of the quantity and that of the converged value, where it has them.
std::vector<Expression> expressions_of(const Expectation &row);

} // namespace capsule
