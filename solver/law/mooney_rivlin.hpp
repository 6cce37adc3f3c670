#pragma once
// The Mooney-Rivlin law: an incompressible rubber that hardens as the neo-Hookean one, Psi = 1, does not.
#include "law/strain_energy.hpp"

namespace capsule {

extern const Law mooney_rivlin;

} // namespace capsule
