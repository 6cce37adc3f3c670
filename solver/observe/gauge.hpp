#pragma once
// Measures what a run reports (records.hpp) on the shapes of a membrane.
#include "electric/conductor.hpp"
#include "geometry/pore.hpp"
#include "membrane/membrane.hpp"
#include "observe/records.hpp"
#include <optional>

namespace capsule {

// A concave stretch counts as a dent when the meridian turns back in it by more than this (radians). A smooth
// parachute has one, at its rear; three or more are wrinkles.
constexpr double dent_angle = 0.15;

// Where a membrane is strained most: area stretch lambda_s lambda_phi and the larger principal tension, and the S of each.
struct LargestStrain {
  double area_stretch, area_stretch_S, tension, tension_S;
};

// Measures the shapes that one membrane takes in one pore. Integrals are taken on Gauss panels, extremes on
// points four times as dense as the nodes with a quartic through the best five.
class Gauge {
public:
  // No pore: unbounded liquid. Resistances in a pore are measured with the digits of this flow, if one is given.
  Gauge(const std::optional<Pore> &pore, const Membrane &membrane,
        const std::optional<FlowResolution> &conductor = std::nullopt);

  double centre(const Vector &position) const; // x_g
  // Smallest distance to the wall, negative beyond it; infinite without a wall.
  double film(const Vector &position) const;
  // Whether the meridian crosses itself.
  bool crosses_itself(const Vector &position) const;
  LargestStrain largest_strain(const Vector &position) const;
  // All but what the flow says of pressure and flow rate. Throws what Conductor throws.
  SeriesRow row(double time, const Vector &position, const Vector &velocity) const;
  // Of the pore without a capsule, where resistances are measured.
  std::optional<double> empty_resistance() const;
  Profile profile(double time, const Vector &position, const Vector &velocity) const;

private:
  struct Integrals {
    double volume, first_moment, area;
  };
  Integrals integrals(const Trace &curve) const;
  double film(const Vector &x, const Vector &r) const; // at the points of fine_
  double arc_at(double index) const;
  LargestStrain largest_strain(const MembraneState &state) const;

  Membrane membrane_;
  std::optional<Pore> pore_;
  Sampling panels_;
  Sampling fine_;                 // from pole to pole
  UndeformedMeridian undeformed_; // at the points of fine_
  Vector arc_from_pole_;          // S at the points of fine_
  Matrix waves_;                  // nodal values of x -> amplitudes of cos(k zeta)
  Integrals initial_{};
  std::optional<Conductor> conductor_;
  MembraneMesh conductor_mesh_;
};

} // namespace capsule
