#pragma once
// Pressure drop of a pore without a capsule, scaled with mu Q/(pi R_t^3): 8 L of Poiseuille's flow, and what each mouth
// costs. From a length of two radii on the mouths cost the same as in a long pore. The loss of a mouth is half of what the
// whole hyperboloid of eq. 1 costs, which is exact, times a fit to what Wall computes; in flow rates the fit errs by less
// than 1e-6. Throws nothing.
#include "case/parameters.hpp"

namespace capsule {

constexpr double shortest_fitted_tube = 2; // L/R_t

// 3 pi sin^3/((1 - cos)^2 (1 + 2 cos))/2 of the opening angle.
double half_hyperboloid_loss(double opening_angle_deg);
double mouth_loss(double opening_angle_deg);
// Of all mouths that the shape has and a tube of this length.
double empty_pressure_drop(const PoreSpec &pore, double tube_length);

} // namespace capsule
