#pragma once
// The wall of the pore, eq. 1: a hyperbola r^2 - x^2 tan^2(alpha) = 1 for x <= 0 that runs into the tube r =
// 1 for x > 0. Lengths are scaled with R_t.
//   The wall is described by arc length from the tube's end (L_P, 1): the lip (0, 1) is at arc L_P, and the
//   wall ends at entrance_arc, where the hyperbola meets the entrance section S_E, the cap of the sphere x^2
//   + r^2 = L_E^2. The tangent is continuous at the lip, the curvature is not: it jumps from 0 to
//   tan^2(alpha). With alpha = 90 degrees the hyperbola is the flat wall x = 0, r >= 1 and the lip a right
//   angle. PoreShape::tube is the straight tube r = 1 from L_P to x = -L_E.
//   PoreShape::two_mouths is its own mirror image in x = L_P/2: behind the second lip, at arc 0, arcs are negative.
#include "case/parameters.hpp"
#include <optional>

namespace capsule {

struct Pore {
  PoreShape shape = PoreShape::hyperbolic;
  double sine = 0; // of alpha
  double cosine = 0;
  double exit_x = 0;            // L_P, also the arc of the lip
  double entrance_distance = 0; // L_E
  double exit_arc = 0;          // arcs of the wall go from here
  double entrance_arc = 0;      // to here
  double end_of_way = 0;        // x, of parameters.hpp
};
// Empty for PoreShape::none, which has no wall. Throws InputError for L_P, L_E or alpha out of range.
std::optional<Pore> make_pore(const PoreSpec &spec);
// The same mouth and tube with other ends.
Pore with_ends(Pore pore, double exit_x, double entrance_distance);

struct WallPoint {
  double x, r;
  double normal_x, normal_r; // out of the liquid
};
// At the lip of a right-angled mouth the normal is the tube's.
WallPoint wall_point(const Pore &pore, double arc);

// Radius and slope dr/dx of the wall at x; infinite outside of a right-angled mouth.
double wall_radius(const Pore &pore, double x);
double wall_slope(const Pore &pore, double x);

// Distance of a point of the meridian plane to the wall, negative beyond it.
double wall_distance(const Pore &pore, double x, double r);

} // namespace capsule
