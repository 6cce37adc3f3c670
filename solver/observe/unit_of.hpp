#pragma once
// Which numbers of a run have a unit. Throws nothing.
#include "observe/quantities.hpp"
#include <optional>
#include <string_view>

namespace capsule {

// Of a number of summary.json, those of steady states too, a column of series.csv or one of profiles.csv, by the name that it has in comparisons:
// "pressure_drop", "largest_tension", "transit_time", "r". Empty if it has no unit, or if there is no such number.
std::optional<PhysicalUnit> unit_of(std::string_view name);

} // namespace capsule
