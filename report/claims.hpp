#pragma once
// The ledger of the paper's claims, as a part of the page.
#include <filesystem>
#include <string>
#include <vector>

namespace report {

// Sums of claims by verdict, which are filters, too, and two lines for each row of tables/ledger.csv: its numbers and its
// reason. Says so if the ledger has not been written yet. Above the paper's rows stand those of the cases' own checks,
// tables/<id>.csv of each directory, that fail.
std::string claims(const std::filesystem::path &ledger_csv,
                   const std::vector<std::filesystem::path> &directories);

} // namespace report
