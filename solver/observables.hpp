#pragma once
// What a run reports: one row of numbers at a time, and profiles along the meridian.
#include "linear_algebra.hpp"
#include <vector>

namespace capsule {

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
  double max_axial_residual = 0;       // max |v_x - v_g|
  double max_radial_velocity = 0;      // max |v_r|
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

} // namespace capsule
