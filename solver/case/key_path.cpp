#include "case/key_path.hpp"
#include "case/keys.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <utility>

namespace capsule {
namespace {

const Member<double> &real_member(const std::string &key) {
  return std::get<Member<double>>(find_key(key)->field);
}

} // namespace

std::optional<double> number(const Key &key, const Case &input) {
  const std::optional<Value> value = get_value(key, input);
  if (!value)
    return std::nullopt;
  if (const auto *whole = std::get_if<std::int64_t>(&*value))
    return static_cast<double>(*whole);
  const auto *real = std::get_if<double>(&*value);
  return real != nullptr ? std::optional(*real) : std::nullopt;
}

KeyPath::KeyPath(std::string key, const Case &from, double to)
    : key_(std::move(key)), start_(from), from_(real_member(key_).of(from)), to_(to) {}

double KeyPath::value(double part) const {
  if (part == 0 || part == 1)
    return part == 0 ? from_ : to_;
  if (from_ < 0 || to_ < 0)
    return from_ + part * (to_ - from_);
  constexpr double power = 8;
  const double root = (1 - part) * std::pow(from_, 1 / power) + part * std::pow(to_, 1 / power);
  return std::pow(std::max(root, 0.0), power);
}

Case KeyPath::at(double part) const {
  Case input = start_;
  real_member(key_).in(input) = value(part);
  return input;
}

std::string KeyPath::text(double part) const {
  return fmt::format("{} = {:.6g}", key_, value(part));
}

} // namespace capsule
