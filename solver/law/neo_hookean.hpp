#pragma once
// The neo-Hookean law, eq. 4: an incompressible rubber whose thickness yields as its area grows.
#include "law/strain_energy.hpp"

namespace capsule {

extern const Law neo_hookean;

} // namespace capsule
