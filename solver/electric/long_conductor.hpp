#pragma once
// The paper's estimate of what a capsule adds to the resistance of its pore: slices of a long conductor in series,
//   int 1/(r_w^2 - r^2) - 1/r_w^2 dx,   in units of rho/(pi R_t).
// r is the meridian's outermost radius where a concave rear or front gives it several. Throws nothing.
#include "geometry/meridian.hpp"
#include "geometry/pore.hpp"

namespace capsule {

// Position: 2N, of one membrane.
double long_conductor_change(const Pore &pore, const MeridianBasis &basis, const Vector &position);

} // namespace capsule
