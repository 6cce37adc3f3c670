#include "base/range.hpp"
#include "base/text.hpp"

namespace capsule {

bool inside(const Range &range, double value) {
  return (value > range.low || (range.low_allowed && value == range.low)) &&
         (value < range.high || (range.high_allowed && value == range.high));
}

std::string range_text(const Range &range) {
  const std::string low = number_text(range.low) + (range.low_allowed ? " <= " : " < ");
  const std::string high = (range.high_allowed ? " <= " : " < ") + number_text(range.high);
  if (range.low == -std::numeric_limits<double>::infinity() &&
      range.high == std::numeric_limits<double>::infinity())
    return "any number";
  if (range.high == std::numeric_limits<double>::infinity())
    return std::string("value ") + (range.low_allowed ? ">= " : "> ") + number_text(range.low);
  return low + "value" + high;
}

} // namespace capsule
