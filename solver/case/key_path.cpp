#include "case/key_path.hpp"
#include "base/text.hpp"
#include "case/keys.hpp"
#include "case/physical.hpp"
#include "case/value_lists.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <utility>

namespace capsule {
namespace {

constexpr double power = 8;

const Member<double> &real_member(const std::string &key) {
  return std::get<Member<double>>(find_key(key)->field);
}

} // namespace

std::optional<double> number(const Key &key, const Case &input) {
  const std::optional<Value> value = value_of(key, input);
  if (!value)
    return std::nullopt;
  if (const auto *whole = std::get_if<std::int64_t>(&*value))
    return static_cast<double>(*whole);
  const auto *real = std::get_if<double>(&*value);
  return real != nullptr ? std::optional(*real) : std::nullopt;
}

double number(const std::string &key, const Case &input) {
  return real_member(key).of(input);
}

Case with_number(Case input, const std::string &key, double value) {
  real_member(key).in(input) = value;
  return input;
}

double natural_size(const std::string &key, double value) {
  return key == "capsule.inflation" ? 1 + value : std::abs(value);
}

bool is_critical(const std::string &key, double from, double fold) {
  return key == flow_key && fold > from;
}

KeyPath::KeyPath(std::string key, const Case &from, double to)
    : key_(std::move(key)), start_(from), from_(number(key_, from)), to_(to) {}

double KeyPath::even(double value) const {
  return is_straight() ? value : std::pow(value, 1 / power);
}

double KeyPath::root(double part) const {
  return std::max((1 - part) * even(from_) + part * even(to_), 0.0);
}

double KeyPath::value(double part) const {
  if (part == 0 || part == 1)
    return part == 0 ? from_ : to_;
  return is_straight() ? from_ + part * (to_ - from_) : std::pow(root(part), power);
}

double KeyPath::part(double value) const {
  return (even(value) - even(from_)) / (even(to_) - even(from_));
}

double KeyPath::slope(double part) const {
  return is_straight() ? to_ - from_ : power * std::pow(root(part), power - 1) * (even(to_) - even(from_));
}

Case KeyPath::at(double part) const {
  return with_number(start_, key_, value(part));
}

std::string KeyPath::text(double part) const {
  return text(part, {});
}

std::string KeyPath::text(double part, std::optional<double> error) const {
  std::string units;
  for (const Physical &physical : physical_of(start_, key_, value(part)))
    units += (units.empty() ? "" : ", ") + physical.text;
  return fmt::format("{} = {}{}", key_, number_with_error(value(part), error),
                     units.empty() ? "" : " (" + units + ")");
}

std::string KeyPath::fold_text(double part, std::optional<double> error) const {
  if (!is_critical(key_, from_, value(part)))
    return text(part, error);
  const bool has_rate = !flow_rate_text(start_, value(part)).empty();
  return fmt::format("{}, the critical {}", text(part, error), has_rate ? "flow rate" : "capillary number");
}

} // namespace capsule
