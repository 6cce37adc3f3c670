#include "motion/error_estimate.hpp"
#include "case/case.hpp"
#include "observe/quantities.hpp"
#include "observe/transit.hpp"
#include <algorithm>
#include <cmath>

namespace capsule {
namespace {

// The error along the way is at most this many times the largest difference of the two marches; at the end, where few
// rows may agree by accident, twice as many times. With Euler's scheme, of order 1, the difference is a ninth of the error.
constexpr double most_above_difference = 3;
double safety_of(const std::string &quantity, Scheme scheme) {
  const bool of_the_way = quantity.find('@') != std::string::npos;
  return most_above_difference * (of_the_way ? 1 : 2) * (scheme == Scheme::euler ? 9 : 1);
}

// Rows this near to a peak have its error, too.
constexpr double around_peak = 0.5;

// Rows of both marches at the same x_g, or at the same time where time tells the end.
struct RowPair {
  const SeriesRow *fine, *coarse;
};
std::vector<RowPair> pair_rows(const std::vector<SeriesRow> &fine, const std::vector<SeriesRow> &coarse,
                               double SeriesRow::*place) {
  constexpr double same = 1e-9;
  std::vector<RowPair> pairs;
  auto other = coarse.begin();
  for (const SeriesRow &row : fine) {
    other = std::find_if(other, coarse.end(),
                         [&](const SeriesRow &candidate) { return candidate.*place > row.*place - same; });
    if (other == coarse.end())
      break;
    if ((*other).*place < row.*place + same)
      pairs.push_back({&row, &*other});
  }
  return pairs;
}

// The rows of two followers where those of their leading capsules are paired.
std::vector<RowPair> pair_followers(const std::vector<RowPair> &leading, const Checkpoint &fine,
                                    const Checkpoint &coarse, std::size_t follower) {
  std::vector<RowPair> pairs;
  for (const RowPair &pair : leading)
    pairs.push_back(
        {&fine.followers[follower].series[static_cast<std::size_t>(pair.fine - fine.series.data())],
         &coarse.followers[follower].series[static_cast<std::size_t>(pair.coarse - coarse.series.data())]});
  return pairs;
}

// The deformation is of length and diameter, whose errors may cancel in it by accident: they are added.
double deformation_difference(const SeriesRow &row, const SeriesRow &other) {
  const auto diameter = [](const SeriesRow &of) {
    return of.length * (1 - of.deformation) / (1 + of.deformation);
  };
  const double sum = row.length + diameter(row);
  return 2 *
         (diameter(row) * std::abs(row.length - other.length) +
          row.length * std::abs(diameter(row) - diameter(other))) /
         (sum * sum);
}

// A peak is where the slope vanishes: it moves by the slope's difference over the curvature.
double shift_of_peak(const std::vector<RowPair> &pairs, double SeriesRow::*value, double x_g) {
  double shift = 0;
  for (std::size_t k = 2; k < pairs.size(); ++k) {
    const double before = pairs[k - 1].fine->x_g - pairs[k - 2].fine->x_g;
    const double after = pairs[k].fine->x_g - pairs[k - 1].fine->x_g;
    const auto rise = [&](std::size_t i, const SeriesRow *RowPair::*march) {
      return (*(pairs[i].*march)).*value - (*(pairs[i - 1].*march)).*value;
    };
    const double curvature =
        2 * (rise(k, &RowPair::fine) / after - rise(k - 1, &RowPair::fine) / before) / (before + after);
    if (std::abs(pairs[k - 1].fine->x_g - x_g) <= row_spacing && curvature < 0)
      shift = std::max(shift,
                       std::abs((rise(k, &RowPair::fine) - rise(k, &RowPair::coarse)) / (after * curvature)));
  }
  return shift;
}

// Of a value that has its peak at x_g.
double difference_around(double x_g, const std::vector<RowPair> &pairs, double SeriesRow::*value) {
  double largest = 0;
  for (const auto &[row, other] : pairs)
    if (std::abs(row->x_g - x_g) < around_peak)
      largest = std::max(largest, std::abs(row->*value - other->*value));
  return largest;
}

// Of a value that is the largest on the way; of one pair at least.
double difference_around_largest(const std::vector<RowPair> &pairs, double SeriesRow::*value) {
  const SeriesRow &top = *std::ranges::max_element(pairs, {}, [value](const RowPair &pair) {
                            return (*pair.fine).*value;
                          })->fine;
  return difference_around(top.x_g, pairs, value);
}

// The largest differences of each quantity along the way, "v_g@x_g", and over its last part, "v_g", both by the leading
// capsule's rows, whose last one is `end`; a mark of the capsule stands behind the quantity.
std::map<std::string, double> differences(const std::vector<RowPair> &leading, const SeriesRow &end,
                                          const std::vector<RowPair> &pairs, bool by_x_g,
                                          const std::string &mark) {
  constexpr double last_part = 2; // x_g, or a tenth of the time
  std::map<std::string, double> largest;
  double SeriesRow::*const place = by_x_g ? &SeriesRow::x_g : &SeriesRow::time;
  const char *const suffix = by_x_g ? "@x_g" : "@time";
  const double last = end.*place - (by_x_g ? last_part : 0.1 * end.time);
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const auto &[row, other] = pairs[i];
    for (const ReportedQuantity &quantity : reported_quantities()) {
      if ((quantity.error != ErrorEstimate::of_marches && quantity.error != ErrorEstimate::of_all) ||
          !is_reported(quantity, *row))
        continue;
      const double difference =
          std::abs(quantity.value == &SeriesRow::deformation ? deformation_difference(*row, *other)
                                                             : row->*quantity.value - other->*quantity.value);
      const auto add = [&](const std::string &name) { largest[name] = std::max(largest[name], difference); };
      add(quantity.name + mark + suffix);
      // The time adds up along the way.
      if ((*leading[i].fine).*place >= last || quantity.value == &SeriesRow::time)
        add(quantity.name + mark);
    }
  }
  return largest;
}

} // namespace

std::map<std::string, double> estimate_errors(const std::vector<SeriesRow> &fine,
                                              const std::vector<SeriesRow> &coarse, bool by_x_g,
                                              Scheme scheme) {
  const std::vector<RowPair> pairs = pair_rows(fine, coarse, by_x_g ? &SeriesRow::x_g : &SeriesRow::time);
  if (pairs.empty())
    return {};
  const std::optional<Peak> peak = entry_peak(fine);
  const std::optional<Peak> coarse_peak = entry_peak(coarse);
  std::map<std::string, double> error = differences(pairs, fine.back(), pairs, by_x_g, "");
  const auto add = [&](const std::string &name, double difference) {
    error[name] = std::max(error[name], std::abs(difference));
  };
  if (by_x_g)
    for (const auto &[row, other] : pairs)
      add("x_g@time", (row->time - other->time) * row->v_g);
  if (peak && coarse_peak) {
    add("peak_pressure_drop", difference_around(peak->x_g, pairs, &SeriesRow::pressure_drop));
    add("x_g_at_peak", std::max(std::abs(peak->x_g - coarse_peak->x_g),
                                shift_of_peak(pairs, &SeriesRow::pressure_drop, peak->x_g)));
  }
  for (const LargestQuantity &quantity : largest_quantities()) {
    const std::string name = std::string("largest_") + quantity.name;
    const auto largest = largest_on_the_way(fine, quantity.value, quantity.S),
               other = largest_on_the_way(coarse, quantity.value, quantity.S);
    add(name,
        std::max(std::abs(largest->value - other->value), difference_around_largest(pairs, quantity.value)));
    // A value that still grows at the end has no turning point: the end is its place. Where it has become steady its place
    // may be anywhere on the way.
    const bool has_turned = largest->x_g < fine.back().x_g;
    const double shift = has_turned ? shift_of_peak(pairs, quantity.value, largest->x_g) : 0;
    add("x_g_at_" + name, std::max(std::abs(largest->x_g - other->x_g),
                                   std::min(shift, std::abs(fine.back().x_g - fine.front().x_g))));
  }
  for (auto &[quantity, difference] : error)
    difference *= safety_of(quantity, scheme);
  for (const ReportedQuantity &quantity : reported_quantities())
    if (quantity.error == ErrorEstimate::by_value_itself)
      error[quantity.name] = std::abs(fine.back().*quantity.value);
  return error;
}

void add_errors_of_followers(const Checkpoint &fine, const Checkpoint &coarse, bool by_x_g, Scheme scheme,
                             std::map<std::string, double> &errors) {
  const std::vector<RowPair> leading =
      pair_rows(fine.series, coarse.series, by_x_g ? &SeriesRow::x_g : &SeriesRow::time);
  for (std::size_t k = 0; k < fine.followers.size(); ++k) {
    const std::string mark = capsule_mark(k + 1);
    for (const auto &[quantity, difference] :
         differences(leading, fine.series.back(), pair_followers(leading, fine, coarse, k), by_x_g, mark))
      errors[quantity] = safety_of(quantity, scheme) * difference;
    for (const ReportedQuantity &quantity : reported_quantities())
      if (quantity.error == ErrorEstimate::by_value_itself)
        errors[quantity.name + mark] = std::abs(fine.followers[k].series.back().*quantity.value);
  }
}

void add_errors_of_transit(const Case &physics, const std::vector<SeriesRow> &fine,
                           const std::vector<SeriesRow> &coarse, std::map<std::string, double> &errors) {
  const auto transit = transit_of(physics, fine), other = transit_of(physics, coarse);
  if (!transit || !other)
    return;
  const std::vector<RowPair> pairs = pair_rows(fine, coarse, &SeriesRow::x_g);
  for (const TransitQuantity &quantity : transit_quantities()) {
    const std::string name = std::string("transit_") + quantity.name;
    double difference = std::abs(quantity.of(*transit) - quantity.of(*other));
    if (const auto duration =
            quantity.duration) // the errors of its ends may cancel by accident: they are added
      difference = std::abs(((*transit).*duration).begin - ((*other).*duration).begin) +
                   std::abs(((*transit).*duration).end - ((*other).*duration).end);
    else if (pairs.empty()) // the tops alone may agree by accident
      continue;
    else if (std::isfinite(difference))
      difference = std::max(difference, difference_around_largest(pairs, &SeriesRow::resistance));
    if (std::isfinite(difference))
      errors[name] = safety_of(name, physics.time.scheme) * difference;
  }
}

void add_errors_of_the_end(const Checkpoint &fine, const Checkpoint &coarse, Scheme scheme,
                           std::map<std::string, double> &errors) {
  const auto add = [&](const std::vector<SeriesRow> &one, const std::vector<SeriesRow> &other,
                       const std::string &mark) {
    for (const auto &[name, value] : {std::pair("time", &SeriesRow::time), std::pair("x_g", &SeriesRow::x_g)})
      errors[name + mark] = safety_of(name, scheme) * std::abs(one.back().*value - other.back().*value);
  };
  add(fine.series, coarse.series, "");
  for (std::size_t k = 0; k < fine.followers.size(); ++k)
    add(fine.followers[k].series, coarse.followers[k].series, capsule_mark(k + 1));
}

} // namespace capsule
