#pragma once
// A case in physical units: quantities such as "5 um" and "1 mPa.s", the dimensionless groups that follow from them
// (section 2.2 of the paper), and the scales that turn results back.
//   length R_t, velocity Q/(pi R_t^2), time pi R_t^3/Q, pressure mu Q/(pi R_t^3), tension G
// Everything is held in SI units. Throws nothing.
#include <array>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace capsule {

struct Case;

// Powers of metre, kilogram and second.
struct Dimension {
  int length = 0, mass = 0, time = 0;
  bool operator==(const Dimension &) const = default;
};

namespace dimension {
constexpr Dimension length{1, 0, 0}, viscosity{-1, 1, -1}, flow_rate{3, 0, -1}, pressure{-1, 1, -2},
    tension{0, 1, -2}, moment{2, 1, -2}, velocity{1, 0, -1}, time{0, 0, 1};
} // namespace dimension

struct Quantity {
  double si = 0; // 0: not given
};

// "2.5 nl/s": a number, a space, and units joined by "." and at most one "/", each with a prefix from a to G and an
// exponent ("m3", "s-1"). The quantity, or why it is none of this dimension.
std::variant<Quantity, std::string> read_quantity(const std::string &text, const Dimension &wanted);

// "1e-12 m3/s", which reads back as the same quantity.
std::string quantity_text(const Quantity &quantity, const Dimension &of);
// "m3/s"
std::string unit_text(const Dimension &of);

// A dimensionless key that physical ones determine, and what its value is called by.
struct Derived {
  std::string key; // "flow.capillary_number"
  double value = 0;
  std::string from; // "physical.capsule_radius"
};

// Whether the case speaks of physical units at all.
bool has_physical(const Case &physics);
// Keys that are missing or exclude each other, in words; empty if all is well.
std::optional<std::string> physical_complaint(const Case &physics);
// What follows from the physical keys of a case without complaint. With a given pressure the flow rate is that of the
// empty pore: 8 L/R_t of Poiseuille's flow over physical.pore_length, and for the mouth half of what the whole
// hyperboloid of eq. 1 costs (exact for the hyperboloid; the pore's own mouth is within a few percent of it).
std::vector<Derived> derived_values(const Case &physics);

struct Scales {
  double length = 1, velocity = 1, time = 1, pressure = 1, tension = 1;
};
Scales physical_scales(const Case &physics);

} // namespace capsule
