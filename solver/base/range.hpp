#pragma once
// An interval of numbers, and how it is told: "0 < value <= 90". Throws nothing.
#include <limits>
#include <string>

namespace capsule {

struct Range {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool low_allowed = false;
  bool high_allowed = false;
};

constexpr Range any_number{};
constexpr Range above(double low) {
  return {.low = low};
}
constexpr Range at_least(double low) {
  return {.low = low, .low_allowed = true};
}
constexpr Range above_up_to(double low, double high) {
  return {.low = low, .high = high, .high_allowed = true};
}
constexpr Range from_to(double low, double high) {
  return {low, high, true, true};
}

bool inside(const Range &range, double value);
std::string range_text(const Range &range);

} // namespace capsule
