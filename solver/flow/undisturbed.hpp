#pragma once
// The flows without membranes that have a closed form, in the paper's scales: lengths R_t, velocities Q/(pi R_t^2),
// pressures mu Q/(pi R_t^3). Velocities at any points: 2 n, axial, then radial. Throws nothing.
#include "integrals/layer_potential.hpp"

namespace capsule {

// Poiseuille's flow in the tube r = 1: axial velocity, traction f_r on a section whose normal points downstream,
// and the pressure drop over a length.
double poiseuille_velocity(double r);
double poiseuille_shear(double r);
double poiseuille_pressure_drop(double length);

using UndisturbedFlow = Vector (*)(const Targets &points);
Vector liquid_at_rest(const Targets &points);
Vector poiseuille_flow(const Targets &points);
Vector extensional_flow(const Targets &points); // uniaxial, (x, -r/2)

} // namespace capsule
