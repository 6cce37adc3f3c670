#pragma once
// Quantities as an experimenter types them: "5 um", "1 mPa s", "0.1 µL/min", "3e-4 dyn/cm", "2 um^3.s^-1".
//   quantity   a number, spaces or none, units
//   units      powers joined by "." "*" "·" "×" or spaces; what stands behind a slash divides, in parentheses or not
//   power      a unit with or without a prefix, and an exponent: "m3", "m^3", "m³", "s-1"; "per" is a slash
// Which of two readings of "a/b.c" was meant need not be asked: at most one has the dimension that is wanted.
// Throws nothing. Decimal prefixes are exact: "5 um" is the double nearest to 5e-6. kT is meant at 25 C, mmHg and cmH2O are
// the conventional ones.
#include <string>
#include <variant>

namespace capsule {

// Powers of metre, kilogram, second and ampere.
struct Dimension {
  int length = 0, mass = 0, time = 0, current = 0;
  bool operator==(const Dimension &) const = default;
};

namespace dimension {
constexpr Dimension length{1, 0, 0}, viscosity{-1, 1, -1}, flow_rate{3, 0, -1}, pressure{-1, 1, -2},
    density{-3, 1, 0}, tension{0, 1, -2}, surface_viscosity{0, 1, -1}, energy{2, 1, -2}, velocity{1, 0, -1},
    time{0, 0, 1}, rate{0, 0, -1}, per_length{-1, 0, 0}, resistance{2, 1, -3, -2}, resistivity{3, 1, -3, -2};
} // namespace dimension

struct Quantity {
  double si = 0;            // 0: not given
  std::string written = {}; // as it was typed; empty: computed
};

// Why a text is no quantity of a dimension, and what was probably meant, if anything of the same magnitude is near.
struct NoQuantity {
  std::string why;
  std::string meant;
};
std::variant<Quantity, NoQuantity> read_quantity(const std::string &typed, const Dimension &wanted);

// The unit in which a quantity was typed, or the SI unit, and its size in SI units.
struct TypedUnit {
  std::string name;
  double si = 1;
};
TypedUnit typed_unit(const Quantity &quantity, const Dimension &of);

// As it was typed, or in SI units: "1e-12 m3/s". Reads back as the same quantity.
std::string quantity_text(const Quantity &quantity, const Dimension &of);
// The SI unit: "m3/s".
std::string unit_text(const Dimension &of);
// What may be typed, for those of the namespace above: "a length such as '5 um' (or nm, mm, m)".
std::string examples_text(const Dimension &of);

} // namespace capsule
