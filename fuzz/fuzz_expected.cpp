// libFuzzer: any bytes as a case's expected.csv. What is read as a table is the same table when it is written again.
#include "base/csv.hpp"
#include "compare/expectations.hpp"
#include "reading.hpp"
#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace {

using namespace capsule;

void check_round_trip(const std::filesystem::path &table) {
  const std::vector<CsvRow> rows = read_csv(table);
  std::string text;
  for (const CsvRow &row : rows)
    text += csv_row(row.fields);
  const std::filesystem::path again = scratch_directory() / "again.csv";
  write_scratch(again, text);
  if (!std::ranges::equal(read_csv(again), rows, {}, &CsvRow::fields, &CsvRow::fields))
    finding("a table that is written again is another one:\n" + text);
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t size) {
  const std::filesystem::path table = scratch_directory() / "expected.csv";
  write_scratch(table, {reinterpret_cast<const char *>(data), size});
  check_refusal([&] { check_round_trip(table); });
  check_refusal([] { own_expectations(scratch_directory() / "case.toml", "name"); });
  return 0;
}
