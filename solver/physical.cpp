#include "physical.hpp"
#include "case.hpp"
#include "text.hpp"
#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <fmt/format.h>
#include <numbers>
#include <string_view>

namespace capsule {
namespace {

constexpr double pi = std::numbers::pi;

struct Unit {
  std::string_view symbol;
  double si;
  Dimension of;
};
constexpr std::array<Unit, 10> units = {{{"m", 1, {1, 0, 0}},
                                         {"g", 1e-3, {0, 1, 0}},
                                         {"s", 1, {0, 0, 1}},
                                         {"min", 60, {0, 0, 1}},
                                         {"h", 3600, {0, 0, 1}},
                                         {"l", 1e-3, {3, 0, 0}},
                                         {"N", 1, {1, 1, -2}},
                                         {"Pa", 1, {-1, 1, -2}},
                                         {"P", 0.1, {-1, 1, -1}},
                                         {"J", 1, {2, 1, -2}}}};

struct Prefix {
  std::string_view symbol;
  double factor;
};
constexpr std::array<Prefix, 12> prefixes = {{{"", 1},
                                              {"a", 1e-18},
                                              {"f", 1e-15},
                                              {"p", 1e-12},
                                              {"n", 1e-9},
                                              {"u", 1e-6},
                                              {"\u00b5", 1e-6},
                                              {"m", 1e-3},
                                              {"c", 1e-2},
                                              {"k", 1e3},
                                              {"M", 1e6},
                                              {"G", 1e9}}};

// A unit with its prefix: "um" is 1e-6 m. The bare unit comes first: "min" is a minute, "m" a metre.
std::optional<Unit> find_unit(std::string_view name) {
  for (const Prefix &prefix : prefixes)
    for (const Unit &unit : units)
      if (name.starts_with(prefix.symbol) && name.substr(prefix.symbol.size()) == unit.symbol)
        return Unit{name, prefix.factor * unit.si, unit.of};
  return std::nullopt;
}

// The product of units such as "mPa.s" or "m3.s-1"; a word that is no unit otherwise.
std::variant<Unit, std::string> read_units(std::string_view text) {
  Unit product{"", 1, {}};
  int side = 1; // -1 behind the slash
  while (!text.empty()) {
    const std::size_t end = std::min(text.find_first_of("./"), text.size());
    const std::string_view factor = text.substr(0, end);
    const std::size_t letters = std::min(factor.find_first_of("-0123456789"), factor.size());
    const std::optional<Unit> unit = find_unit(factor.substr(0, letters));
    int exponent = 1;
    if (letters < factor.size()) {
      const auto [last, error] =
          std::from_chars(factor.data() + letters, factor.data() + factor.size(), exponent);
      if (error != std::errc() || last != factor.data() + factor.size())
        return std::string(factor);
    }
    if (!unit)
      return std::string(factor);
    exponent *= side;
    product.si *= std::pow(unit->si, exponent);
    product.of.length += exponent * unit->of.length;
    product.of.mass += exponent * unit->of.mass;
    product.of.time += exponent * unit->of.time;
    if (end < text.size() && text[end] == '/') {
      if (side < 0)
        return std::string("/");
      side = -1;
    }
    if (end + 1 == text.size())
      return std::string(text.substr(end)); // nothing follows
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return product;
}

std::string power_text(const char *symbol, int exponent) {
  return exponent == 0 ? "" : fmt::format(".{}{}", symbol, exponent == 1 ? "" : std::to_string(exponent));
}

// The surface Young modulus over G, for small strain.
double young_over_shear(const Case &physics) {
  const double c = physics.membrane.dilatation;
  return physics.membrane.law == LawName::neo_hookean ? 3 : 2 * (1 + 2 * c) / (1 + c);
}

double shear_modulus(const Case &physics) {
  const auto &p = physics.physical;
  return p.shear_modulus.si > 0 ? p.shear_modulus.si : p.young_modulus.si / young_over_shear(physics);
}

// Pressure drop of the empty pore, scaled with mu Q/(pi R_t^3).
double empty_pressure_drop(const Case &physics) {
  const double alpha = physics.pore.opening_angle_deg * pi / 180;
  const double whole_hyperboloid =
      3 * pi * std::pow(std::sin(alpha), 3) / (std::pow(1 - std::cos(alpha), 2) * (1 + 2 * std::cos(alpha)));
  const double mouth = physics.pore.shape == PoreShape::hyperbolic ? whole_hyperboloid / 2 : 0;
  return mouth + 8 * physics.physical.pore_length.si / physics.physical.tube_radius.si;
}

double flow_rate(const Case &physics) {
  const auto &p = physics.physical;
  return p.flow_rate.si > 0 ? p.flow_rate.si
                            : p.pressure.si * pi * std::pow(p.tube_radius.si, 3) /
                                  (p.viscosity.si * empty_pressure_drop(physics));
}

} // namespace

std::variant<Quantity, std::string> read_quantity(const std::string &text, const Dimension &wanted) {
  double number = 0;
  const auto [rest, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  std::string_view unit_part(rest, static_cast<std::size_t>(text.data() + text.size() - rest));
  unit_part.remove_prefix(std::min(unit_part.find_first_not_of(' '), unit_part.size()));
  if (error != std::errc() || unit_part.empty())
    return fmt::format("'{}' is no number with a unit", text);
  const auto read = read_units(unit_part);
  if (const auto *wrong = std::get_if<std::string>(&read))
    return fmt::format("unknown unit '{}' in '{}'", *wrong, text);
  const Unit &unit = std::get<Unit>(read);
  if (unit.of != wanted)
    return fmt::format("'{}' has the wrong dimension, {}", text, unit_text(unit.of));
  if (!(number > 0) || !std::isfinite(number * unit.si))
    return fmt::format("'{}' is not positive", text);
  return Quantity{number * unit.si};
}

std::string unit_text(const Dimension &of) {
  constexpr std::array<std::pair<Dimension, const char *>, 6> usual = {{{dimension::velocity, "m/s"},
                                                                        {dimension::flow_rate, "m3/s"},
                                                                        {dimension::viscosity, "Pa.s"},
                                                                        {dimension::pressure, "Pa"},
                                                                        {dimension::tension, "N/m"},
                                                                        {dimension::moment, "J"}}};
  for (const auto &[known, name] : usual)
    if (known == of)
      return name;
  // The kilogram is a gram with a prefix.
  const std::string text = power_text("m", of.length) + power_text("kg", of.mass) + power_text("s", of.time);
  return text.empty() ? "1" : text.substr(1);
}

std::string quantity_text(const Quantity &quantity, const Dimension &of) {
  return number_text(quantity.si) + " " + unit_text(of);
}

bool has_physical(const Case &physics) {
  const auto &p = physics.physical;
  return std::ranges::any_of(std::array{p.tube_radius, p.viscosity, p.flow_rate, p.pressure, p.pore_length,
                                        p.shear_modulus, p.young_modulus, p.bending_modulus, p.capsule_radius,
                                        p.internal_viscosity},
                             [](const Quantity &quantity) { return quantity.si > 0; });
}

std::optional<std::string> physical_complaint(const Case &physics) {
  const auto &p = physics.physical;
  if (physics.flow.type != FlowType::pore)
    return "physical units go with a pore: flow.type must be \"pore\"";
  if (p.tube_radius.si == 0)
    return "physical.tube_radius is missing";
  if (p.viscosity.si == 0)
    return "physical.viscosity is missing";
  if ((p.flow_rate.si > 0) == (p.pressure.si > 0))
    return "give one of physical.flow_rate and physical.pressure";
  if ((p.pressure.si > 0) != (p.pore_length.si > 0))
    return "physical.pressure and physical.pore_length go together";
  if ((p.shear_modulus.si > 0) == (p.young_modulus.si > 0))
    return "give one of physical.shear_modulus and physical.young_modulus";
  return std::nullopt;
}

std::vector<Derived> derived_values(const Case &physics) {
  const auto &p = physics.physical;
  const double radius = p.tube_radius.si, shear = shear_modulus(physics);
  std::vector<Derived> values = {{"flow.capillary_number",
                                  p.viscosity.si * flow_rate(physics) / (pi * radius * radius * shear),
                                  p.flow_rate.si > 0 ? "physical.flow_rate" : "physical.pressure"}};
  if (p.capsule_radius.si > 0)
    values.push_back({"capsule.radius", p.capsule_radius.si / radius, "physical.capsule_radius"});
  if (p.bending_modulus.si > 0)
    values.push_back({"membrane.bending_ratio", p.bending_modulus.si / (shear * radius * radius),
                      "physical.bending_modulus"});
  if (p.internal_viscosity.si > 0)
    values.push_back(
        {"flow.viscosity_ratio", p.internal_viscosity.si / p.viscosity.si, "physical.internal_viscosity"});
  return values;
}

Scales physical_scales(const Case &physics) {
  const double radius = physics.physical.tube_radius.si, rate = flow_rate(physics);
  return {.length = radius,
          .velocity = rate / (pi * radius * radius),
          .time = pi * std::pow(radius, 3) / rate,
          .pressure = physics.physical.viscosity.si * rate / (pi * std::pow(radius, 3)),
          .tension = shear_modulus(physics)};
}

} // namespace capsule
