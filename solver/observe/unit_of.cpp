#include "observe/unit_of.hpp"
#include "observe/transit.hpp"
#include <algorithm>
#include <array>

namespace capsule {
namespace {

struct SteadyQuantity {
  const char *name;
  PhysicalUnit unit;
};
constexpr PhysicalUnit per_second{&Scales::rate, dimension::rate};
constexpr std::array of_steady_states{
    SteadyQuantity{"growth_rate", per_second}, SteadyQuantity{"oscillation_rate", per_second},
    SteadyQuantity{"pairing_growth_rate", per_second},
    SteadyQuantity{"growth_per_length", {&Scales::per_length, dimension::per_length}},
    SteadyQuantity{"apparent_viscosity", {&Scales::viscosity, dimension::viscosity}}};

// The entry of a table with this name, or nothing.
template <class Table>
auto entry(const Table &table, std::string_view name) {
  const auto found = std::ranges::find(table, name, [](const auto &of) { return std::string_view(of.name); });
  return found == table.end() ? nullptr : &*found;
}

} // namespace

std::optional<PhysicalUnit> unit_of(std::string_view name) {
  constexpr std::string_view of_the_transit = "transit_", largest = "largest_";
  if (const auto *reported = entry(reported_quantities(), name))
    return reported->unit;
  if (const auto *peak = entry(peak_quantities(), name))
    return peak->unit;
  if (const auto *steady = entry(of_steady_states, name))
    return steady->unit;
  if (const auto *of_profiles = entry(profile_quantities(), name))
    return of_profiles->unit;
  if (name == "empty_resistance")
    return unit_of("resistance");
  if (name.starts_with(of_the_transit)) {
    const auto *transit = entry(transit_quantities(), name.substr(of_the_transit.size()));
    return transit == nullptr ? std::nullopt : std::optional(transit->unit);
  }
  // "largest_tension" is of "max_tension"; "x_g_at_largest_tension" and "S_at_largest_tension" are places.
  const std::size_t at = name.find(largest);
  if (at == std::string_view::npos ||
      entry(largest_quantities(), name.substr(at + largest.size())) == nullptr)
    return std::nullopt;
  return unit_of(at == 0 ? "max_" + std::string(name.substr(largest.size())) : "x_g");
}

} // namespace capsule
