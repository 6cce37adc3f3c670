#pragma once
// The law of Evans and Skalak: shear and a change of area resist each on its own.
#include "law/strain_energy.hpp"

namespace capsule {

extern const Law evans_skalak;

} // namespace capsule
