#include "motion/stations.hpp"
#include <algorithm>
#include <cmath>

namespace capsule {

std::vector<Station> stations(double from, double spacing, std::optional<double> end,
                              const std::vector<double> &profiles, std::optional<double> profiles_every) {
  std::vector<Station> list;
  const auto add_multiples = [&](double distance, bool profile) {
    const auto first = static_cast<long>(std::floor(from / distance + 1e-9)) + 1;
    for (long k = first; static_cast<double>(k) * distance < *end; ++k)
      list.push_back({static_cast<double>(k) * distance, profile, !profile, false});
  };
  for (const double value : profiles)
    if (value > from && (!end || value <= *end))
      list.push_back({value, true, false, false});
  if (end) {
    add_multiples(spacing, false);
    if (profiles_every)
      add_multiples(*profiles_every, true);
    list.push_back({*end, true, true, true});
  }
  std::sort(list.begin(), list.end(), [](const Station &a, const Station &b) { return a.value < b.value; });
  const double same = end ? 1e-6 * spacing : 0;
  std::vector<Station> merged;
  for (const Station &station : list) {
    if (merged.empty() || station.value - merged.back().value > same)
      merged.push_back(station);
    else // the value of the profile, as it was asked for, not the multiple of the spacing
      merged.back() = {station.profile ? station.value : merged.back().value,
                       merged.back().profile || station.profile, merged.back().regular || station.regular,
                       merged.back().end || station.end};
  }
  return merged;
}

} // namespace capsule
