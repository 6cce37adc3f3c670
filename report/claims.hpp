#pragma once
// The ledger of the paper's claims, as a part of the page.
#include <filesystem>
#include <string>

namespace report {

// Sums by verdict, which are filters, too, and two lines for each row of tables/ledger.csv: its numbers and its reason.
// Says so if the ledger has not been written yet.
std::string claims(const std::filesystem::path &ledger_csv);

} // namespace report
