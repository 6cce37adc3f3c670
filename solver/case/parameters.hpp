#pragma once
// What a case says, a struct for each section of a case file. All lengths are scaled with R_t, velocities with
// Q/(pi R_t^2), times with pi R_t^3/Q, pressures with mu Q/(pi R_t^3), tensions with G, bending moments with G R_t.
// Where the pressure is given, Q is the flow rate that it drives through the empty pore.
// The keys of a case file are the names below, joined by dots: "pore.exit_x".
#include "case/units.hpp"
#include "law/law.hpp"
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace capsule {

enum class PoreShape { hyperbolic, two_mouths, tube, none };
enum class CapsuleShape { spheroid, biconcave };
enum class FlowType { pore, extension };
enum class DriveBy { flow_rate, pressure }; // what is given and constant
enum class Numerics { standard, paper };    // the best preset we have; section 3 of the paper
enum class Scheme { bdf, euler, rk4 };
enum class OutlineSeen { meridian, silhouette }; // of a capsule in an image

struct PoreSpec {
  PoreShape shape = PoreShape::hyperbolic;
  double opening_angle_deg = 78.5; // alpha, eq. 1
  double exit_x = 15;              // L_P
  double entrance_distance = 30;   // L_E
};
// How far behind a second mouth the cap is that the flow rate is measured through: well before the wall's free end, and no
// farther than needed, as what a wall of panels lets through grows with the square of the distance.
inline double outlet_distance(double entrance_distance) {
  return std::min(entrance_distance / 2, 15.0);
}
// A capsule stays before this place: the exit section, or well before that cap.
inline double end_of_way(const PoreSpec &pore) {
  return pore.exit_x +
         (pore.shape == PoreShape::two_mouths ? outlet_distance(pore.entrance_distance) * 2 / 3 : 0);
}

struct CapsuleSpec {
  double radius = 0;       // R_eq, of the sphere with the same volume
  double aspect_ratio = 1; // A/B
  double inflation = 0;    // alpha_p: the stress-free shape is smaller by 1/(1 + alpha_p)
  double start_x = -4;
  CapsuleShape shape = CapsuleShape::spheroid; // biconcave: a red cell at rest, of fixed proportions
};

// Half thickness of a red cell, Evans and Fung (1972): z = (R_0/2) sqrt(1 - p^2) (c_0 + c_1 p^2 + c_2 p^4), p = r/R_0.
constexpr double biconcave_thickness[] = {0.207161, 2.002558, -1.122762};

// Of the capsule before the flow: half its length along the axis of the pore and half its width across it; of a spheroid
// the half axes A and B. A red cell is longest between its axis and its rim.
struct Extent {
  double half_length, half_width;
};
Extent extent(const CapsuleSpec &capsule);
// Length over width, A/B.
double aspect_ratio(const CapsuleSpec &capsule);

// Of the membrane itself, scaled with mu R_t.
struct SurfaceViscosity {
  double shear = 0;        // mu_s
  double dilatational = 0; // kappa_s
};

struct MembraneSpec {
  MembraneLaw law;
  double bending_ratio = 1e-5; // delta
  SurfaceViscosity viscosity;
};

struct FlowSpec {
  FlowType type = FlowType::pore;
  DriveBy drive = DriveBy::flow_rate;
  double capillary_number = 0; // epsilon
  double viscosity_ratio = 1;  // lambda
  double period = 0;           // distance of neighbouring centres in an infinite train; 0: one capsule alone
};

// 0: chosen from the accuracy asked for (standard preset) or the paper's value (paper preset).
struct MeshSpec {
  int membrane = 0; // N_M
  int wall = 0;     // N_B
  int exit = 0;     // N_P
};

struct TimeSpec {
  Scheme scheme = Scheme::bdf;
  double step = 0;      // of an explicit scheme
  double tolerance = 0; // absolute error of the nodes' positions in one step, in units of R_t; 0: chosen
};

struct UntilSpec {
  bool by_place() const { return x_g || last_x_g; }
  std::optional<double> x_g;      // of the leading capsule
  std::optional<double> last_x_g; // of the last of several
  std::optional<double> time;
  std::optional<double> area_stretch; // what the membrane bears: lambda_s lambda_phi
  std::optional<double> tension;      // the larger principal one
};

// What the dimensionless values above may follow from, physical.hpp.
struct PhysicalSpec {
  Quantity tube_radius, viscosity, flow_rate, pressure, pore_length;
  Quantity capsule_velocity; // instead of the flow rate, for a fit
  Quantity shear_modulus, young_modulus, bending_modulus, capsule_radius, internal_viscosity;
  Quantity shear_viscosity, dilatational_viscosity;
  Quantity resistivity; // of the liquid
  Quantity density;     // of water if it is not given; only for the Reynolds number
};

struct OutputSpec {
  std::vector<double> profiles_at_x_g;
  std::vector<double> profiles_at_time;
  std::optional<double> profiles_every; // in x_g, in time where the march ends at a time
  bool resistance = false;
  std::optional<double> transit_from, transit_to; // none: a radius outside of the mouths
};

// How profiles are fitted, fit/fit.hpp.
struct FitSpec {
  std::vector<std::string> unknowns, laws;
  std::optional<double> noise, velocity_noise; // standard deviations: of a point, in R_t; relative
  OutlineSeen outline = OutlineSeen::meridian;
  Quantity pixel;
  std::map<std::string, std::vector<double>> bounds; // of unknowns: the lowest and the largest value
};

} // namespace capsule
