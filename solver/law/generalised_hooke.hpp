#pragma once
// The generalised law of Hooke: linear in the Green strains (a^2 - 1)/2 and (b^2 - 1)/2.
#include "law/strain_energy.hpp"

namespace capsule {

extern const Law generalised_hooke;

} // namespace capsule
