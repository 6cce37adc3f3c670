// The tables of reported quantities, beside the note on files.
#include "observe/quantities.hpp"
#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <fstream>
#include <set>
#include <sstream>
#include <string>

using namespace capsule;

BOOST_AUTO_TEST_SUITE(quantities)

BOOST_AUTO_TEST_CASE(the_note_on_files_says_what_each_means) {
  std::stringstream note;
  note << std::ifstream(FILES_NOTE).rdbuf();
  for (const ReportedQuantity &quantity : reported_quantities()) {
    const std::string line = std::string("| `") + quantity.name + "` | " + quantity.meaning + " |\n";
    BOOST_TEST((note.str().find(line) != std::string::npos), "paper-notes/files.md does not say: " << line);
  }
}

// Each value of a row has a name and a column of its own.
BOOST_AUTO_TEST_CASE(nothing_is_reported_twice) {
  std::set<std::string> names;
  std::set<const double *> values;
  const SeriesRow row;
  for (const ReportedQuantity &quantity : reported_quantities()) {
    names.insert(quantity.name);
    values.insert(&(row.*quantity.value));
  }
  for (const PeakQuantity &quantity : peak_quantities())
    names.insert(quantity.name);
  BOOST_TEST(values.size() == sizeof(SeriesRow) / sizeof(double));
  BOOST_TEST(names.size() == reported_quantities().size() + peak_quantities().size());
}

BOOST_AUTO_TEST_CASE(columns_of_a_branch_are_numbered_without_gaps) {
  const std::vector<ReportedQuantity> columns = branch_quantities();
  for (std::size_t k = 0; k < columns.size(); ++k)
    BOOST_TEST(columns[k].branch_column == static_cast<int>(k) + 1);
  BOOST_TEST(columns.size() == 16u);
}

// A quantity on which the meshes of a steady state have to agree is one whose error is estimated there.
BOOST_AUTO_TEST_CASE(what_has_to_agree_has_an_error_estimate) {
  for (const ReportedQuantity &quantity : reported_quantities())
    BOOST_TEST((quantity.agreement.share == 0 || quantity.error == ErrorEstimate::of_all), quantity.name);
}

BOOST_AUTO_TEST_SUITE_END()
