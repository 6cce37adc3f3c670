#pragma once
// Skalak's law, eq. 5, made for red cells: with a large C it resists a change of area more than shear.
#include "law/strain_energy.hpp"

namespace capsule {

extern const Law skalak;

} // namespace capsule
