#pragma once
// The profiles of a run as surfaces of revolution for ParaView, in VTK's XML: triangles with the stretches and tensions
// at their corners, and the collection of all instants. Lengths are scaled with R_t, tensions with G.
#include "observe/records.hpp"
#include <string>
#include <vector>

namespace capsule {

// The name of a profile's file: "membrane_0003.vtp".
std::string surface_name(std::size_t index);
// One profile turned about the axis, at most 129 of its points around 32 meridians.
std::string surface_vtp(const Profile &profile);
std::string surfaces_pvd(const std::vector<Profile> &profiles);

} // namespace capsule
