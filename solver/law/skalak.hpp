#pragma once
// Skalak's law, eq. 5, made for red cells: with a large C it resists a change of area more than shear.
#include "law/law.hpp"

namespace capsule {

extern const Law skalak;

} // namespace capsule
