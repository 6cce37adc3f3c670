#pragma once
// What a run reports: a row of numbers for an instant, a profile along the meridian. Scales as in case/parameters.hpp.
// Throws nothing.
#include "base/linear_algebra.hpp"
#include <cstddef>
#include <fmt/format.h>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace capsule {

// Distance in x_g of two rows of a march.
constexpr double row_spacing = 0.05;

// The meaning of each value stands in quantities.cpp.
struct SeriesRow {
  double time = 0;
  double x_g = 0;
  double v_g = 0;
  double pressure_drop = 0;
  double pressure_drop_reciprocal = 0;
  double flow_rate = 1;
  double max_stretch = 0;
  double max_area_stretch = 0;
  double S_at_max_area_stretch = 0;
  double max_tension = 0;
  double S_at_max_tension = 0;
  double front_stretch = 0;
  double min_film = 0;
  double length = 0;
  double deformation = 0;
  double volume_change = 0;
  double area_change = 0;
  double max_axial_residual = 0;
  double max_radial_velocity = 0;
  double dents = 0;
  double roughness = 0;
  double resistance = std::numeric_limits<double>::quiet_NaN();
  double resistance_long_conductor = std::numeric_limits<double>::quiet_NaN();
  double pressure_share = std::numeric_limits<double>::quiet_NaN();
  double spacing = std::numeric_limits<double>::quiet_NaN();
  double min_gap = std::numeric_limits<double>::quiet_NaN();
};

struct Profile {
  double time = 0;
  double x_g = 0;
  Vector S; // reference arc length from the upstream pole
  Vector x, r;
  Vector stretch_meridional, stretch_azimuthal;
  Vector tension_meridional, tension_azimuthal;
  Vector moment_meridional, moment_azimuthal;
  Vector curvature_meridional, curvature_azimuthal;
  Vector velocity_x, velocity_r;
};

// What stands behind a quantity's name where it is that of a capsule behind the leading one: "v_g#2" of the second.
inline std::string capsule_mark(std::size_t capsule) {
  return capsule == 0 ? "" : fmt::format("#{}", capsule + 1);
}

// What one capsule has left.
struct CapsuleRecord {
  std::vector<SeriesRow> series;
  std::vector<Profile> profiles;
};

// The entry peak of the pressure drop: the first maximum after which it falls by more than a thousandth of
// the run's largest value, with a parabola through the three rows around it; without one, the run's largest
// value.
struct Peak {
  double pressure_drop = 0;
  double x_g = 0;
};
std::optional<Peak> entry_peak(const std::vector<SeriesRow> &series);

// The largest value of a column over the whole way, with a parabola in time through the three rows around it, and where:
// in the pore and, by another column, on the membrane at the largest row.
struct Largest {
  double value = 0;
  double x_g = 0;
  double S = 0;
};
std::optional<Largest> largest_on_the_way(const std::vector<SeriesRow> &series, double SeriesRow::*value,
                                          double SeriesRow::*S);

} // namespace capsule
