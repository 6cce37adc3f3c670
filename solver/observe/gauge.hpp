#pragma once
// What a run reports: one row of numbers at a time, and profiles along the meridian.
#include "geometry/pore.hpp"
#include "membrane/membrane.hpp"
#include <optional>

namespace capsule {

// A concave stretch counts as a dent when the meridian turns back in it by more than this (radians). A smooth
// parachute has one, at its rear; three or more are wrinkles.
constexpr double dent_angle = 0.15;

// Of x_g, between the rows of a march.
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
  double dents = 0;     // concave stretches in which the meridian turns back by more than dent_angle
  double roughness = 0; // share of the shape's bending in the mesh's shortest third of waves
};

// The entry peak of the pressure drop: the first maximum after which it falls by more than a thousandth of
// the run's largest value, with a parabola through the three rows around it; without one, the run's largest
// value.
struct Peak {
  double pressure_drop = 0;
  double x_g = 0;
};
std::optional<Peak> entry_peak(const std::vector<SeriesRow> &series);

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

// Measures the shapes that one membrane takes in one pore. Integrals are taken on Gauss panels, extremes on
// points four times as dense as the nodes with a quartic through the best five.
class Gauge {
public:
  Gauge(const Case &physics, const Membrane &membrane);

  double centre(const Vector &position) const; // x_g
  // Smallest distance to the wall, negative beyond it; infinite without a wall.
  double film(const Vector &position) const;
  // Whether the meridian crosses itself.
  bool crosses_itself(const Vector &position) const;
  // All but the pressure drops.
  SeriesRow row(double time, const Vector &position, const Vector &velocity) const;
  Profile profile(double time, const Vector &position, const Vector &velocity) const;

private:
  struct Integrals {
    double volume, first_moment, area;
  };
  Integrals integrals(const Vector &position) const;

  Membrane membrane_;
  std::optional<Pore> pore_;
  Sampling panels_;
  Sampling fine_;        // from pole to pole
  Vector arc_from_pole_; // S at the points of fine_
  Matrix waves_;         // nodal values of x -> amplitudes of cos(k zeta)
  Integrals initial_{};
};

} // namespace capsule
