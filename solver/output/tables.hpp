#pragma once
// The tables that a run leaves, as comma-separated values under a head of names (quantities.hpp): one row per recorded
// instant, per point of a branch, per point of each profile. Numbers have the fewest digits that read back as the
// same double.
#include "observe/records.hpp"
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace capsule {

struct Case;
struct BranchRow;
struct Outcome;

std::string series_csv(const std::vector<SeriesRow> &series);
// Whether there is series_physical.csv: of a case in physical units, but not along a branch, whose scales change.
bool in_physical_units(const Case &physics, const Outcome &outcome);
// In SI units, the unit in each column's head.
std::string physical_series_csv(const Case &physics, const std::vector<SeriesRow> &series);
// Its first column is the key that varies, its last the growth rate.
std::string branch_csv(const Outcome &outcome);
// The second key, then as in branch.csv.
std::string fold_curve_csv(const Outcome &outcome);
// The same in SI units. Along the capillary number its second column is the flow rate without a capsule.
std::string physical_branch_csv(const Case &physics, const Outcome &outcome);
// The numbers of a point of a branch in SI units, by their names with units.
std::vector<std::pair<std::string, double>> physical_values(const Case &physics, const std::string &along,
                                                            const BranchRow &point);
std::string profiles_csv(const std::vector<Profile> &profiles);

// The last profile of a run's profiles.csv. Throws as read_columns (csv.hpp), and InputError if there is none, or
// where its numbers are not finite or its S does not grow.
Profile read_last_profile(const std::filesystem::path &directory);

} // namespace capsule
