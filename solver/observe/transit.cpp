#include "observe/transit.hpp"
#include <algorithm>
#include <array>
#include <boost/math/tools/roots.hpp>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <string>

namespace capsule {
namespace {

constexpr PhysicalUnit seconds{&Scales::time, dimension::time};
constexpr PhysicalUnit ohms{&Scales::resistance, dimension::resistance};

constexpr std::array of_transits{
    TransitQuantity{"time", "from `output.transit_from` to `output.transit_to`", &Transit::time, seconds},
    TransitQuantity{"pulse_height", "the largest resistance that the capsule adds", nullptr, ohms},
    TransitQuantity{"pulse_width", "time for which it exceeds half of that", &Transit::pulse_width, seconds},
    TransitQuantity{"pulse_rise", "time in which it rises from 10 to 90 %", &Transit::pulse_rise, seconds},
    TransitQuantity{"pulse_fall", "time in which it falls from 90 to 10 %", &Transit::pulse_fall, seconds}};

using Series = std::vector<SeriesRow>;

constexpr double never = std::numeric_limits<double>::quiet_NaN();

// Where the time of a transit begins and ends.
struct Places {
  double from, to;
};
Places places_of(const Case &physics) {
  constexpr double outside = 1;
  return {physics.output.transit_from.value_or(-outside),
          physics.output.transit_to.value_or(physics.pore.exit_x + outside)};
}

double largest_resistance(const Series &series) {
  return largest_on_the_way(series, &SeriesRow::resistance, &SeriesRow::x_g)->value;
}

constexpr double half = 0.5, low = 0.1, high = 0.9; // of the height

// When the capsule comes to x: the cubic through two rows with the slopes 1/v_g.
double time_at(const Series &series, double x) {
  const auto after = std::ranges::find_if(series, [x](const SeriesRow &row) { return row.x_g >= x; });
  if (after == series.end() || (after == series.begin() && after->x_g > x))
    return never;
  if (after->x_g == x)
    return after->time;
  const auto before = after - 1;
  const double step = after->x_g - before->x_g, s = (x - before->x_g) / step;
  const double rise = after->time - before->time;
  const double first = step / before->v_g - rise, last = rise - step / after->v_g;
  return before->time + s * rise + s * (1 - s) * ((1 - s) * first + s * last);
}

constexpr std::size_t fewest_rows = 4; // for a cubic

// When the resistance passes a level between rows k and k + 1: along the way it is the cubic through four rows.
double time_of_level(const Series &series, std::size_t k, double level) {
  const std::size_t first = std::min(k - std::min<std::size_t>(k, 1), series.size() - 4);
  const auto resistance = [&](double x) {
    double sum = 0;
    for (std::size_t i = first; i < first + 4; ++i) {
      double weight = 1;
      for (std::size_t j = first; j < first + 4; ++j)
        if (j != i)
          weight *= (x - series[j].x_g) / (series[i].x_g - series[j].x_g);
      sum += weight * series[i].resistance;
    }
    return sum;
  };
  constexpr unsigned digits = 40; // binary
  const auto [before, after] =
      boost::math::tools::bisect([&](double x) { return resistance(x) - level; }, series[k].x_g,
                                 series[k + 1].x_g, boost::math::tools::eps_tolerance<double>(digits));
  return time_at(series, (before + after) / 2);
}

double first_above(const Series &series, double level) {
  const auto row = std::ranges::find_if(series, [&](const SeriesRow &r) { return r.resistance >= level; });
  if (row == series.begin() || row == series.end())
    return never;
  return time_of_level(series, static_cast<std::size_t>(row - series.begin()) - 1, level);
}

double last_above(const Series &series, double level) {
  std::size_t k = series.size() - 1;
  while (k > 0 && series[k].resistance < level)
    --k;
  return k + 1 == series.size() || k == 0 ? never : time_of_level(series, k, level);
}

} // namespace

std::optional<Transit> transit_of(const Case &physics, const Series &series) {
  if (physics.pore.shape != PoreShape::two_mouths)
    return std::nullopt;
  Transit transit;
  if (series.size() < fewest_rows)
    return transit;
  const auto [from, to] = places_of(physics);
  transit.time = {time_at(series, from), time_at(series, to)};
  if (!physics.output.resistance)
    return transit;
  const double height = largest_resistance(series);
  // What is still high at an end of the march may be higher beyond it.
  if (std::max(series.front().resistance, series.back().resistance) >= half * height)
    return transit;
  transit.pulse_height = height;
  transit.pulse_width = {first_above(series, half * height), last_above(series, half * height)};
  transit.pulse_rise = {first_above(series, low * height), first_above(series, high * height)};
  transit.pulse_fall = {last_above(series, high * height), last_above(series, low * height)};
  return transit;
}

std::string remark_on_transit(const Case &physics, const Series &series) {
  const auto transit = transit_of(physics, series);
  if (!transit || series.size() < fewest_rows)
    return "";
  const SeriesRow &first = series.front(), &last = series.back();
  std::vector<std::string> remarks;
  if (std::isnan(transit->time.length())) {
    const auto [from, to] = places_of(physics);
    remarks.push_back(
        fmt::format("no transit time: the way from x_g = {:.4g} to {:.4g} does not include that "
                    "from {:.4g} to {:.4g}",
                    first.x_g, last.x_g, from, to));
  }
  std::vector<std::string> unknown;
  for (const TransitQuantity &quantity : transit_quantities())
    if (quantity.duration != &Transit::time && std::isnan(quantity.of(*transit)))
      unknown.emplace_back(quantity.name);
  if (physics.output.resistance && !unknown.empty()) {
    const double height = largest_resistance(series);
    std::vector<std::string> cuts;
    for (const auto &[row, word] : {std::pair(&first, "begins"), std::pair(&last, "ends")})
      if (row->resistance >= low * height)
        cuts.push_back(
            fmt::format("{} at x_g = {:.4g} with {:.0f} %", word, row->x_g, 100 * row->resistance / height));
    remarks.push_back(fmt::format("no {}: the march {} of its largest resistance", fmt::join(unknown, ", "),
                                  fmt::join(cuts, " and ")));
  }
  return fmt::format("{}", fmt::join(remarks, "; "));
}

std::span<const TransitQuantity> transit_quantities() {
  return of_transits;
}

} // namespace capsule
