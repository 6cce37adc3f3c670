#pragma once
// The ledger of the paper's claims: one line for each row of tables/published.csv that belongs to a claim. Of a row that
// is compared with several runs it shows the run that fits worst. Throws nothing.
#include "compare/comparison.hpp"

namespace capsule {

struct Ledger {
  std::string csv;
  std::string markdown;
  std::string summary;      // one line: numbers of claims that agree, differ, cannot be decided
  long not_as_recorded = 0; // rows
};
// From the comparisons of all cases, in the order of the table.
Ledger make_ledger(const std::vector<Comparison> &comparisons);

} // namespace capsule
