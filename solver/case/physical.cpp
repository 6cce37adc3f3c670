#include "case/physical.hpp"
#include "base/text.hpp"
#include "case/empty_pore.hpp"
#include "case/keys.hpp"
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <fmt/format.h>
#include <iterator>
#include <numbers>
#include <optional>
#include <string_view>

namespace capsule {
namespace {

using std::numbers::pi;

double shear_modulus(const Case &physics) {
  const auto &p = physics.physical;
  return p.shear_modulus.si > 0 ? p.shear_modulus.si
                                : p.young_modulus.si / physics.membrane.law.young_modulus();
}

// Whether the pore of the case is the one that the liquid is driven through. Otherwise it is a part of a longer one.
bool is_whole_pore(const Case &physics) {
  return physics.pore.shape == PoreShape::two_mouths || physics.flow.drive == DriveBy::pressure;
}

// Of the whole pore before its mouth.
double tube_before_mouth(const PoreSpec &pore) {
  return pore.shape == PoreShape::tube ? pore.entrance_distance : 0;
}

double flow_rate(const Case &physics) {
  const auto &p = physics.physical;
  return p.flow_rate.si > 0
             ? p.flow_rate.si
             : p.pressure.si * pi * std::pow(p.tube_radius.si, 3) /
                   (p.viscosity.si * empty_pressure_drop(physics.pore, driven_tube_length(physics)));
}

Quantity density(const Case &physics) {
  constexpr double of_water = 1000;
  const Quantity &given = physics.physical.density;
  return given.si > 0 ? given : Quantity{of_water};
}

Scales scales_at(const Case &physics, double flow_rate) {
  const double radius = physics.physical.tube_radius.si, viscosity = physics.physical.viscosity.si;
  return {.length = radius,
          .velocity = flow_rate / (pi * radius * radius),
          .time = pi * std::pow(radius, 3) / flow_rate,
          .pressure = viscosity * flow_rate / (pi * std::pow(radius, 3)),
          .tension = shear_modulus(physics),
          .flow_rate = flow_rate,
          .viscosity = viscosity,
          .rate = flow_rate / (pi * std::pow(radius, 3)),
          .per_length = 1 / radius,
          .resistance = physics.physical.resistivity.si / (pi * radius)};
}

double flow_rate_at(const Case &physics, double capillary_number) {
  const auto &p = physics.physical;
  return capillary_number * pi * p.tube_radius.si * p.tube_radius.si * shear_modulus(physics) /
         p.viscosity.si;
}

// The physical quantities behind dimensionless keys of steady states.
struct Counterpart {
  std::string_view key;
  const char *name;
  Quantity PhysicalSpec::*given;
  Dimension dimension;
  std::optional<double> (*si)(const Case &physics, double value); // none if the case has none
};
const std::array counterparts{
    Counterpart{
        flow_key, "physical.flow_rate", &PhysicalSpec::flow_rate, dimension::flow_rate,
        [](const Case &physics, double value) { return std::optional(flow_rate_at(physics, value)); }},
    Counterpart{flow_key, "physical.pressure", &PhysicalSpec::pressure, dimension::pressure,
                [](const Case &physics, double value) -> std::optional<double> {
                  const double given = physics.physical.pressure.si;
                  if (given == 0)
                    return std::nullopt;
                  return given * flow_rate_at(physics, value) / flow_rate(physics);
                }},
    Counterpart{"capsule.radius", "physical.capsule_radius", &PhysicalSpec::capsule_radius, dimension::length,
                [](const Case &physics, double value) {
                  return std::optional(value * physics.physical.tube_radius.si);
                }},
    Counterpart{bending_key, "physical.bending_modulus", &PhysicalSpec::bending_modulus, dimension::energy,
                [](const Case &physics, double value) {
                  const double radius = physics.physical.tube_radius.si;
                  return std::optional(value * shear_modulus(physics) * radius * radius);
                }},
};

// Without the digits in which decimal fractions differ from doubles: 4e-6/5e-6 is 0.8.
double rounded(double value) {
  return std::strtod(fmt::format("{:.15g}", value).c_str(), nullptr);
}

} // namespace

bool has_physical(const Case &physics) {
  const auto &p = physics.physical;
  return std::ranges::any_of(
      std::array{p.tube_radius, p.viscosity, p.flow_rate, p.pressure, p.pore_length, p.capsule_velocity,
                 p.shear_modulus, p.young_modulus, p.bending_modulus, p.capsule_radius, p.internal_viscosity,
                 p.shear_viscosity, p.dilatational_viscosity, p.resistivity, p.density},
      [](const Quantity &quantity) { return quantity.si > 0; });
}

std::vector<PhysicalComplaint> physical_complaints(const Case &physics, bool of_a_fit) {
  const auto &p = physics.physical;
  std::vector<PhysicalComplaint> complaints;
  const auto require = [&](const Quantity &quantity, const std::string &key) {
    if (quantity.si == 0)
      complaints.push_back({"missing key '" + key + "'", {}});
  };
  const auto require_one = [&](const Quantity &a, const std::string &key, const Quantity &b,
                               const std::string &instead) {
    if (a.si == 0 && b.si == 0)
      complaints.push_back({fmt::format("missing key '{}', or '{}'", key, instead), {}});
    else if (a.si > 0 && b.si > 0)
      complaints.push_back({fmt::format("{} and {} exclude each other", key, instead), {instead, key}});
  };
  require(p.tube_radius, "physical.tube_radius");
  require(p.viscosity, "physical.viscosity");
  if (of_a_fit) {
    const auto refuse = [&](const Quantity &quantity, const std::string &key) {
      if (quantity.si > 0)
        complaints.push_back({key + " means nothing to a fit", {key}});
    };
    refuse(p.pressure, "physical.pressure");
    refuse(p.pore_length, "physical.pore_length");
    refuse(p.resistivity, "physical.resistivity");
    refuse(p.shear_modulus, "physical.shear_modulus");
    refuse(p.young_modulus, "physical.young_modulus");
    refuse(p.bending_modulus, "physical.bending_modulus");
    return complaints;
  }
  require_one(p.flow_rate, "physical.flow_rate", p.pressure, "physical.pressure");
  require_one(p.shear_modulus, "physical.shear_modulus", p.young_modulus, "physical.young_modulus");
  if (p.pressure.si > 0 && p.pore_length.si == 0 && !is_whole_pore(physics))
    complaints.push_back({"physical.pressure needs physical.pore_length", {"physical.pressure"}});
  if (p.pressure.si == 0 && p.pore_length.si > 0 && !is_whole_pore(physics))
    complaints.push_back(
        {"physical.pore_length means nothing without physical.pressure", {"physical.pore_length"}});
  if (p.resistivity.si > 0 && !physics.output.resistance)
    complaints.push_back(
        {"physical.resistivity means nothing without output.resistance = true", {"physical.resistivity"}});
  return complaints;
}

std::vector<Derived> derived_values(const Case &physics, bool of_a_fit) {
  const auto &p = physics.physical;
  const double radius = p.tube_radius.si, shear = shear_modulus(physics);
  constexpr const char *tube_radii = " tube radii";
  std::vector<Derived> values;
  if (!of_a_fit)
    values.push_back({"flow.capillary_number",
                      p.viscosity.si * flow_rate(physics) / (pi * radius * radius * shear),
                      p.flow_rate.si > 0 ? "physical.flow_rate" : "physical.pressure"});
  if (p.pore_length.si > 0 && is_whole_pore(physics))
    values.push_back({"pore.exit_x", p.pore_length.si / radius - tube_before_mouth(physics.pore),
                      "physical.pore_length", tube_radii});
  if (p.capsule_radius.si > 0)
    values.push_back({"capsule.radius", p.capsule_radius.si / radius, "physical.capsule_radius", tube_radii});
  if (p.bending_modulus.si > 0)
    values.push_back({"membrane.bending_ratio", p.bending_modulus.si / (shear * radius * radius),
                      "physical.bending_modulus"});
  if (p.internal_viscosity.si > 0)
    values.push_back(
        {"flow.viscosity_ratio", p.internal_viscosity.si / p.viscosity.si, "physical.internal_viscosity"});
  if (p.shear_viscosity.si > 0)
    values.push_back({"membrane.shear_viscosity", p.shear_viscosity.si / (p.viscosity.si * radius),
                      "physical.membrane_shear_viscosity"});
  if (p.dilatational_viscosity.si > 0)
    values.push_back({"membrane.dilatational_viscosity",
                      p.dilatational_viscosity.si / (p.viscosity.si * radius),
                      "physical.membrane_dilatational_viscosity"});
  for (Derived &derived : values)
    derived.value = rounded(derived.value);
  return values;
}

double driven_tube_length(const Case &physics) {
  const double given = physics.physical.pore_length.si;
  return given > 0 ? given / physics.physical.tube_radius.si
                   : physics.pore.exit_x + tube_before_mouth(physics.pore);
}

TypedUnit own_unit(const Case &physics, const Dimension &of) {
  const auto &p = physics.physical;
  const auto along_the_tube = [&](const char *per) {
    const TypedUnit length = typed_unit(p.tube_radius, dimension::length);
    return TypedUnit{length.name + per, length.si};
  };
  if (of == dimension::length)
    return along_the_tube("");
  if (of == dimension::velocity)
    return along_the_tube("/s");
  if (of == dimension::flow_rate)
    return typed_unit(p.flow_rate, of);
  if (of == dimension::pressure)
    return typed_unit(p.pressure, of);
  if (of == dimension::tension)
    return typed_unit(p.shear_modulus.si > 0 ? p.shear_modulus : p.young_modulus, of);
  return {unit_text(of), 1};
}

std::vector<Physical> physical_of(const Case &physics, const std::string &key, double value) {
  std::vector<Physical> all;
  if (shear_modulus(physics) == 0)
    return all;
  for (const Counterpart &counterpart : counterparts)
    if (counterpart.key == key)
      if (const std::optional<double> si = counterpart.si(physics, value)) {
        const Dimension &of = counterpart.dimension;
        const Quantity &given = physics.physical.*counterpart.given;
        const TypedUnit unit = given.si > 0 ? typed_unit(given, of) : own_unit(physics, of);
        all.push_back({counterpart.name, *si, of, fmt::format("{:.4g} {}", *si / unit.si, unit.name)});
      }
  return all;
}

std::vector<std::string> physical_keys_of(const std::string &key) {
  std::vector<std::string> names;
  for (const Counterpart &counterpart : counterparts)
    if (counterpart.key == key)
      names.emplace_back(counterpart.name);
  return names;
}

std::vector<std::string> physical_keys() {
  std::vector<std::string> names;
  std::ranges::transform(counterparts, std::back_inserter(names), &Counterpart::name);
  return names;
}

std::string flow_rate_text(const Case &physics, double capillary_number) {
  const std::vector<Physical> all = physical_of(physics, flow_key, capillary_number);
  return all.empty() ? "" : all.front().text;
}

std::string with_physical_keys(std::string advice, const Case &physics) {
  if (!has_physical(physics))
    return advice;
  for (const Derived &derived : derived_values(physics))
    for (std::size_t at = advice.find(derived.key); at != std::string::npos;
         at = advice.find(derived.key, at + derived.from.size()))
      advice.replace(at, derived.key.size(), derived.from);
  return advice;
}

double reynolds_number(const Case &physics) {
  const auto &p = physics.physical;
  return density(physics).si * flow_rate(physics) / (pi * p.tube_radius.si * p.viscosity.si);
}

bool is_inertia_small(const Case &physics) {
  constexpr double small = 0.1;
  return reynolds_number(physics) <= small;
}

std::string density_text(const Case &physics) {
  return quantity_text(density(physics), dimension::density);
}

std::string reynolds_text(const Case &physics) {
  return fmt::format("the Reynolds number is {:.2g} (of a liquid of {}){}", reynolds_number(physics),
                     density_text(physics),
                     is_inertia_small(physics) ? "" : ": not small, but the model has no inertia");
}

Scales physical_scales(const Case &physics) {
  return scales_at(physics, flow_rate(physics));
}

Scales scales_by_capillary_number(const Case &physics) {
  return scales_at(physics, flow_rate_at(physics, physics.flow.capillary_number));
}

} // namespace capsule
