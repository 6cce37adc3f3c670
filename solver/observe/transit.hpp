#pragma once
// What the passage of a pore with two mouths amounts to, as a cell transit analyzer sees it: how long it takes, and the
// numbers of the pulse of the electric resistance. Times in pi R_t^3/Q, resistances in rho/(pi R_t). Throws nothing.
#include "case/case.hpp"
#include "observe/quantities.hpp"
#include "observe/records.hpp"
#include <limits>
#include <optional>
#include <span>
#include <vector>

namespace capsule {

// Not a number: not measured, or its places lie outside of the way.
struct Transit {
  static constexpr double none = std::numeric_limits<double>::quiet_NaN();
  double time = none;
  double pulse_height = none, pulse_width = none, pulse_rise = none, pulse_fall = none;
};
// Of a march; empty where the pore has no second mouth.
std::optional<Transit> transit_of(const Case &physics, const std::vector<SeriesRow> &series);

// In summary.json, as entries of `transit`; its errors are "transit_<name>".
struct TransitQuantity {
  const char *name;
  const char *meaning;
  double Transit::*value;
  PhysicalUnit unit;
};
std::span<const TransitQuantity> transit_quantities();

} // namespace capsule
