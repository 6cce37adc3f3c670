#pragma once
// A case in physical units: the dimensionless groups that follow from its quantities (section 2.2 of the paper), and the
// scales that turn results back.
//   length R_t, velocity Q/(pi R_t^2), time pi R_t^3/Q, pressure mu Q/(pi R_t^3), tension G, flow rate Q,
//   resistance rho/(pi R_t)
// Everything is held in SI units. Throws nothing.
#include "case/case.hpp"
#include <string>
#include <vector>

namespace capsule {

// A dimensionless key that physical ones determine, its value, and the one of them that a complaint names.
struct Derived {
  std::string key; // "flow.capillary_number"
  double value = 0;
  std::string from;      // "physical.flow_rate"
  std::string unit = {}; // in words: " tube radii"
};

// Whether the case speaks of physical units at all.
bool has_physical(const Case &physics);
// Physical keys that are missing or exclude each other, in words, and the keys to say so at.
struct PhysicalComplaint {
  std::string message;
  std::vector<std::string> keys;
};
// To a fit of profiles the modulus is unknown, and the flow rate may be.
std::vector<PhysicalComplaint> physical_complaints(const Case &physics, bool of_a_fit = false);
// Advice that names dimensionless keys: those that the case gives in physical units are named as they are given.
std::string with_physical_keys(std::string advice, const Case &physics);
// What follows from the physical keys of a case; where there are complaints, only which keys have a value. With a given
// pressure the flow rate is that of the empty pore (empty_pore.hpp). If the pressure stays constant, or the pore has two
// mouths, its length is pore.exit_x.
std::vector<Derived> derived_values(const Case &physics, bool of_a_fit = false);

// Of the tube that a given pressure drives the liquid through, in tube radii.
double driven_tube_length(const Case &physics);
// The unit in which a case is told of results: that in which it gives its own flow rate, pressure and modulus, and the
// length and velocity that go with its tube's radius; of everything else the SI unit.
TypedUnit own_unit(const Case &physics, const Dimension &of);
// What a value of a dimensionless key is in physical units: the quantities that the case gives it by, or may.
struct Physical {
  std::string key; // "physical.capsule_radius"
  double si = 0;
  Dimension dimension;
  std::string text; // in the unit in which the case gives it: "4 um"
};
// Of the capillary number a flow rate and, if the case gives one, a pressure; of the radius and the bending stiffness. None
// where the modulus is unknown: without physical units, and in a fit.
std::vector<Physical> physical_of(const Case &physics, const std::string &key, double value);
// Their keys, of whatever case: "physical.flow_rate" and "physical.pressure", either of which sets flow.capillary_number.
std::vector<std::string> physical_keys_of(const std::string &key);
// All that there are, of any key.
std::vector<std::string> physical_keys();
// The flow rate at any capillary number, in the unit in which the case gives its own: "0.253 nl/s". Empty where the modulus
// is unknown: without physical units, and in a fit.
std::string flow_rate_text(const Case &physics, double capillary_number);

// rho Q/(pi R_t mu) of the external liquid, of a case in physical units. The model has no inertia, which holds where this is
// small.
double reynolds_number(const Case &physics);
// The density of that liquid: "1000 kg/m3".
std::string density_text(const Case &physics);
// With its density, and with a warning where it is above 0.1: "the Reynolds number is 0.0064 (of a liquid of 1000 kg/m3)".
std::string reynolds_text(const Case &physics);
bool is_inertia_small(const Case &physics);

struct Scales {
  double length = 1, velocity = 1, time = 1, pressure = 1, tension = 1, flow_rate = 1;
  double viscosity = 1, rate = 1, per_length = 1;
  double resistance = 0; // unknown without the liquid's resistivity
};
Scales physical_scales(const Case &physics);
// The same with the flow rate that the capillary number tells, which may be another one than the given: on a branch.
Scales scales_by_capillary_number(const Case &physics);

} // namespace capsule
