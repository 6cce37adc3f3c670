#pragma once
// The second route to the pressure drop, (3.3): from the membranes alone, by the reciprocal theorem,
//   pi Delta P = -int f.v_e dA + int (lambda - 1) v.sigma_e n dA,   f = q/epsilon.
// It shares neither the wall's unknowns nor the outlet with the first route. What each membrane's part of the integrals
// gives is that membrane's share; of a train it is that of the capsule whose images the others are. Without a wall there is
// no pressure drop. Throws NumericsFailure("unresolved") if sigma_e n is not found.
#include "flow/interaction.hpp"
#include "flow/recycled_solver.hpp"

namespace capsule {

// f and (lambda - 1) v at the nodes, 2N. The second may be empty: lambda is 1. Otherwise the interaction needs both
// layers, `traction` is what finding sigma_e n reuses, and the tolerance that of sigma_e n.
// Returns the shares, one for each membrane.
Vector reciprocal_pressure_drops(const Interaction &interaction, const Vector &f,
                                 const Vector &excess_velocity, double tolerance, Recycled &traction);

} // namespace capsule
