#include "compare/reference_units.hpp"
#include "base/failure.hpp"
#include "case/physical.hpp"
#include "case/symbols.hpp"
#include "observe/unit_of.hpp"
#include <fmt/format.h>
#include <variant>

namespace capsule {
namespace {

// A name without the number of a capsule and without what says that its error is meant.
std::string quantity_of(const std::string &name) {
  const std::string quantity = name.substr(0, name.find('#'));
  return quantity.starts_with(of_errors) ? quantity.substr(of_errors.size()) : quantity;
}

// What a unit is in SI units. Throws InputError as check_units.
double read_unit(const std::string &name, const std::string &unit, const Dimension &wanted) {
  const std::string one = "1 ";
  const auto read = read_quantity(one + unit, wanted);
  if (const auto *quantity = std::get_if<Quantity>(&read))
    return quantity->si;
  const auto &[why, meant] = std::get<NoQuantity>(read);
  throw InputError(
      fmt::format("{} [{}]: {}{}", name, unit, why,
                  meant.empty() ? "" : fmt::format(", did you mean '[{}]'?", meant.substr(one.size()))));
}

const Measured *measured_key(const std::string &name) {
  const Key *key = key_named(name);
  return key != nullptr ? std::get_if<Measured>(&key->field) : nullptr;
}

void check_unit(const std::string &name, const std::string &unit) {
  if (unit.empty())
    return;
  const auto physical = unit_of(quantity_of(name));
  const Measured *measured = measured_key(name);
  if (!physical && measured == nullptr)
    throw InputError(fmt::format("'{}' has no unit", name));
  read_unit(name, unit, physical ? physical->dimension : measured->dimension);
}

} // namespace

double in_unit(const RunResult &run, const std::string &name, const std::string &unit) {
  if (unit.empty())
    return 1;
  const auto physical = unit_of(quantity_of(name));
  if (!physical)
    return 1 / read_unit(name, unit, measured_key(name)->dimension);
  const std::size_t mark = name.find('#');
  const Case &physics = *capsules_of(run.input.physics)
                             .at(mark == std::string::npos ? 0 : std::stoul(name.substr(mark + 1)) - 1);
  if (!has_physical(physics) || !run.summary->along.empty())
    throw NoValue(has_physical(physics) ? "no units along a branch" : "not in physical units");
  const Scales scales = physical_scales(physics);
  if (!has_scale(physical, scales))
    throw NoValue("no resistivity");
  return scales.*physical->scale / read_unit(name, unit, physical->dimension);
}

void check_units(const Reference &reference) {
  check_unit(reference.name, reference.unit);
  for (const Place &place : reference.places)
    check_unit(place.column, place.unit);
}

} // namespace capsule
