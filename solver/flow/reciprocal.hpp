#pragma once
// The second route to the pressure drop, (3.3): from the membranes alone, by the reciprocal theorem,
//   pi Delta P = -(1/eps) int q.v_e dA + (lambda - 1) int v.sigma_e n dA.
// It shares neither the wall's unknowns nor the outlet with the first route. Of a train it is the drop of the
// capsule whose images the others are. Throws NumericsFailure("unresolved") if sigma_e n is not found.
#include "flow/interaction.hpp"
#include "flow/recycled_solver.hpp"

namespace capsule {

// Nodal load, scaled with G/R_t, and velocity. Both layers are needed if lambda is not 1; then `traction` is what
// finding sigma_e n reuses, and the tolerance that of sigma_e n.
double reciprocal_pressure_drop(const Interaction &interaction, const Vector &load, const Vector &velocity,
                                double capillary_number, double viscosity_ratio, double tolerance,
                                Recycled &traction);

} // namespace capsule
