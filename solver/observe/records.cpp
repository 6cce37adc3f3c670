#include "observe/records.hpp"
#include <algorithm>

namespace capsule {

namespace {

struct Point {
  double x, y;
};

// Of the parabola through three points.
Point vertex(const Point &before, const Point &at, const Point &after) {
  const double slope_before = (at.y - before.y) / (at.x - before.x);
  const double slope_after = (after.y - at.y) / (after.x - at.x);
  const double curvature = (slope_after - slope_before) / (after.x - before.x);
  const double x = (before.x + at.x) / 2 - slope_before / (2 * curvature);
  return {x, at.y + (slope_before + curvature * (x - before.x)) * (x - at.x)};
}

} // namespace

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
  const auto point = [&](std::size_t i) { return Point{x(i), y(i)}; };
  const Point peak = vertex(point(top - 1), point(top), point(top + 1));
  return Peak{peak.y, peak.x};
}

std::optional<Largest> largest_on_the_way(const std::vector<SeriesRow> &series, double SeriesRow::*value,
                                          double SeriesRow::*S) {
  if (series.empty())
    return std::nullopt;
  const auto top = std::ranges::max_element(series, {}, value);
  Largest largest{(*top).*value, top->x_g, (*top).*S};
  if (top == series.begin() || top + 1 == series.end())
    return largest;
  const auto point = [&](auto row) { return Point{row->time, (*row).*value}; };
  const Point peak = vertex(point(top - 1), point(top), point(top + 1));
  const auto other = peak.x < top->time ? top - 1 : top + 1;
  largest.value = peak.y;
  largest.x_g += (peak.x - top->time) * (other->x_g - top->x_g) / (other->time - top->time);
  return largest;
}

} // namespace capsule
