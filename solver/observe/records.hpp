#pragma once
// What a run reports: a row of numbers for an instant, a profile along the meridian. Scales as in case/parameters.hpp.
#include "base/linear_algebra.hpp"
#include <optional>
#include <vector>

namespace capsule {

// Distance in x_g of two rows of a march.
constexpr double row_spacing = 0.05;

struct SeriesRow {
  double time = 0;
  double x_g = 0;                      // centre of mass
  double v_g = 0;                      // its velocity
  double pressure_drop = 0;            // extra pressure drop Delta P > 0, from the exit unknown
  double pressure_drop_reciprocal = 0; // the same by the reciprocal theorem
  double max_stretch = 0;              // largest lambda_s
  double front_stretch = 0;            // lambda_s at the downstream pole
  double min_film = 0;                 // smallest distance between membrane and wall
  double length = 0;                   // axial extent
  double deformation = 0;              // (length - diameter)/(length + diameter)
  double volume_change = 0;            // (V - V_ini)/V_ini
  double area_change = 0;
  double max_axial_residual = 0;  // max |v_x - v_g|
  double max_radial_velocity = 0; // max |v_r|
  double dents = 0; // concave stretches in which the meridian turns back by more than dent_angle, gauge.hpp
  double roughness = 0; // share of the shape's bending in the mesh's shortest third of waves
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

// The entry peak of the pressure drop: the first maximum after which it falls by more than a thousandth of
// the run's largest value, with a parabola through the three rows around it; without one, the run's largest
// value.
struct Peak {
  double pressure_drop = 0;
  double x_g = 0;
};
std::optional<Peak> entry_peak(const std::vector<SeriesRow> &series);

} // namespace capsule
