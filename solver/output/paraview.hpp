#pragma once
// The profiles of a run and the wall as surfaces of revolution for ParaView, in VTK's XML: triangles, of a membrane with the
// stretches and tensions at their corners, and the collection of all instants. Lengths are scaled with R_t, tensions with G.
// Throws nothing.
#include "geometry/pore.hpp"
#include "observe/records.hpp"
#include <string>
#include <vector>

namespace capsule {

// The name of a profile's file: "membrane_0003.vtp", and of the second capsule "membrane-2_0003.vtp".
std::string surface_name(std::size_t index, std::size_t capsule = 0);
// One profile turned about the axis, at most 129 of its points around 32 meridians. Of a branch, `along` a key, the key's
// value is a field of the surface.
std::string surface_vtp(const Profile &profile, const std::string &along = "");
// Of a branch their numbers stand for times: beyond a fold the key's value goes back, and readers sort by time.
// Several capsules have as many profiles each; they are the parts of one collection.
std::string surfaces_pvd(const std::vector<Profile> &profiles, const std::string &along = "",
                         std::size_t capsules = 1);

// The wall up to ten radii outside of its mouths, or all of a tube, turned about the axis.
std::string wall_vtp(const Pore &pore);

} // namespace capsule
