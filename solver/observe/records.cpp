#include "observe/records.hpp"
#include <algorithm>

namespace capsule {

std::optional<Peak> entry_peak(const std::vector<SeriesRow> &series) {
  if (series.empty())
    return std::nullopt;
  const auto x = [&](std::size_t i) { return series[i].x_g; };
  const auto y = [&](std::size_t i) { return series[i].pressure_drop; };
  const double fall = 1e-3 * std::ranges::max(series, {}, &SeriesRow::pressure_drop).pressure_drop;
  std::size_t top = 0; // the highest row before the first fall
  for (std::size_t i = 1; i < series.size() && y(i) >= y(top) - fall; ++i)
    if (y(i) > y(top))
      top = i;
  if (top == 0 || top + 1 == series.size())
    return Peak{y(top), x(top)};
  const double slope_before = (y(top) - y(top - 1)) / (x(top) - x(top - 1));
  const double slope_after = (y(top + 1) - y(top)) / (x(top + 1) - x(top));
  const double curvature = (slope_after - slope_before) / (x(top + 1) - x(top - 1));
  const double at = (x(top - 1) + x(top)) / 2 - slope_before / (2 * curvature);
  return Peak{y(top) + (slope_before + curvature * (at - x(top - 1))) * (at - x(top)), at};
}

} // namespace capsule
