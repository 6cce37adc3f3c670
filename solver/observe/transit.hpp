#pragma once
// What the passage of a pore with two mouths amounts to, as a cell transit analyzer sees it: how long it takes, and the
// numbers of the pulse of the electric resistance. Times in pi R_t^3/Q, resistances in rho/(pi R_t). Throws nothing.
#include "case/case.hpp"
#include "observe/quantities.hpp"
#include "observe/records.hpp"
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace capsule {

// Not a number: not measured, or its places lie outside of the way.
struct Duration {
  double begin = std::numeric_limits<double>::quiet_NaN(), end = begin;
  double length() const { return end - begin; }
};
struct Transit {
  Duration time;
  double pulse_height = std::numeric_limits<double>::quiet_NaN();
  Duration pulse_width, pulse_rise, pulse_fall;
};
// Of a march; empty where the pore has no second mouth. A pulse has a height and a width if the march begins and ends
// with less than half of its largest resistance, because the largest may be to come before the capsule has left. It also has
// a rise if it begins, and a fall if it ends, with less than a tenth. What is unknown is NaN.
std::optional<Transit> transit_of(const Case &physics, const std::vector<SeriesRow> &series);

// One line about numbers of a transit that its march does not tell, and why; empty if it tells all.
std::string remark_on_transit(const Case &physics, const std::vector<SeriesRow> &series);

// In summary.json, as entries of `transit`; its errors are "transit_<name>".
struct TransitQuantity {
  const char *name;
  const char *meaning;
  Duration Transit::*duration; // or none, of the height
  PhysicalUnit unit;
  double of(const Transit &transit) const {
    return duration == nullptr ? transit.pulse_height : (transit.*duration).length();
  }
};
std::span<const TransitQuantity> transit_quantities();

} // namespace capsule
