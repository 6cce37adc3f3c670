#pragma once
// What a run reports, a line a quantity. From these tables follow the columns of series.csv, branch.csv,
// series_physical.csv and profiles.csv, the end of a run in summary.json, checkpoints, and what error estimates speak of.
//   A new quantity of an instant is a member of SeriesRow (records.hpp), a line of its table (quantities.cpp) with the
// same words in paper-notes/files.md, and its computation (gauge.hpp). Throws nothing.
#include "case/physical.hpp"
#include "observe/records.hpp"
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace capsule {

// The scale that turns a dimensionless value into SI units, and their dimension.
struct PhysicalUnit {
  double Scales::*scale;
  Dimension dimension;
};
// "length [m]".
std::string name_with_unit(const std::string &name, const PhysicalUnit &unit);

// Whether a case knows it: a quantity without a unit, or one whose scale no key tells, is not in the tables of SI units.
bool has_scale(const std::optional<PhysicalUnit> &unit, const Scales &scales);

// How the error of a quantity is estimated.
enum class ErrorEstimate {
  none,
  of_marches,     // by the difference of two marches; in a steady state it has none
  of_all,         // by the difference of two marches, or of a steady state on several meshes
  by_value_itself // it is zero in the exact motion: its value is its error
};

// To what share of the accuracy asked for two meshes have to agree in a steady state; 0: whatever they differ by.
struct Agreement {
  double share = 0;
  bool relative = false; // to the value; otherwise to one
};

// Of an instant, or a steady state: a column of series.csv.
struct ReportedQuantity {
  const char *name;
  const char *meaning;
  double SeriesRow::*value;
  std::optional<PhysicalUnit> unit = {}; // none: not in the tables of physical units
  ErrorEstimate error = ErrorEstimate::none;
  Agreement agreement = {};
  bool of_the_pore = false; // means nothing in an unbounded liquid
  int branch_column = 0;    // its place in branch.csv, from 1 on; 0: not there
  bool if_asked = false;    // only where the case asks for it; not a number otherwise
};
// Whether a row has the quantity: one that was not asked for has no column.
bool is_reported(const ReportedQuantity &quantity, const SeriesRow &row);
// In the order of series.csv.
std::span<const ReportedQuantity> reported_quantities();
// Those of branch.csv, and of folds, in their order.
std::vector<ReportedQuantity> branch_quantities();

// Of the entry peak of a march in the pore, in summary.json.
struct PeakQuantity {
  const char *name;
  double Peak::*value;
  PhysicalUnit unit;
};
std::span<const PeakQuantity> peak_quantities();

// Of a march in summary.json: the largest value over the whole way as "largest_<name>", and where, "x_g_at_largest_<name>"
// and "S_at_largest_<name>".
struct LargestQuantity {
  const char *name;
  double SeriesRow::*value;
  double SeriesRow::*S;
};
std::span<const LargestQuantity> largest_quantities();

// A column of profiles.csv.
struct ProfileQuantity {
  const char *name;
  Vector Profile::*values;
  std::optional<PhysicalUnit> unit = {};
};
std::span<const ProfileQuantity> profile_quantities();

} // namespace capsule
