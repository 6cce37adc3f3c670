#pragma once
// Computed against expected values (expectations.hpp). A comparison is as recorded if
// - it finds the recorded verdict: an agreement where a difference is recorded is a mistake, too;
// - of a number or ratio of the paper, the estimated error of the computed value is at most a fifth of the distance on
//   which the verdict depends: the allowed one if it agrees, the one that was found if it differs.
// Throws InputError and FileError where the files of a run cannot be read (run_values.hpp).
#include "compare/expectations.hpp"
#include "compare/run_values.hpp"
#include "compare/text_table.hpp"
#include <string>
#include <vector>

namespace capsule {

struct Comparison {
  Expectation expected;
  std::string case_name;
  std::string run;       // its name; empty if the case has one run only, or if the row is compared once
  std::string computed;  // "no such run", "no value" if there is nothing to compare
  std::string distance;  // from the published value or bound; empty if there is none
  std::string converged; // if the row asks for it
  std::string estimate;  // of the computed, or the converged, value's error; empty if unknown
  Verdict verdict = Verdict::differs;
  double excess = 0; // distance beyond the allowed one, negative within
  bool no_such_run = false;
  bool certain = true; // the estimated error is small enough for the verdict
  bool as_recorded() const { return certain && verdict == expected.recorded; }
};
// One comparison for each expectation and run that it speaks of.
std::vector<Comparison> compare(const std::vector<Expectation> &expectations, const std::string &case_name,
                                const RunTable &table);

// Whether a failure of this run is what the table expects.
bool failure_is_expected(const std::vector<Comparison> &comparisons, const RunResult &result);

// The header, then one row per comparison.
std::vector<TextRow> comparison_rows(const std::vector<Comparison> &comparisons);

} // namespace capsule
