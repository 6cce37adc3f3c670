#pragma once
// The outline of a capsule in an image, as a table of points:
//   # velocity = 2.3 mm/s
//   x [um],r [um]
//   12.1,0.3
// Columns x, along the axis in the direction of the flow, and r, from the axis; in radii of the tube without a unit. Any
// part of the upper and the lower half, in any order. Lines that begin with # are comments, but for these:
//   velocity, flow_rate   of the capsule and of the liquid, with units, or without in units of Q/(pi R_t^2) and relative
//   rear_pole_x           where a concave rear crosses the axis, in the unit of the points
// Throws InputError, with the place in the file, for what is no contour of a capsule in the tube, and FileError.
#include "base/linear_algebra.hpp"
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace capsule {

struct Case;

struct Contour {
  std::filesystem::path file = {};
  Vector x, r;                            // in R_t, r >= 0
  std::optional<double> rear_pole_x = {}; // in R_t
  std::optional<double> velocity = {};    // m/s if the case is in physical units, otherwise in Q/(pi R_t^2)
  std::optional<double> flow_rate = {};   // m3/s, otherwise relative to the other contours'
  std::vector<bool> lower = {};           // points with r < 0 in the file; none if empty
};

Contour read_contour(const std::filesystem::path &file, const Case &input);

// Of the body of revolution: the radius of the sphere of its volume, and its foremost point on the axis. Crude: by the points'
// angles about a place inside.
struct ContourSize {
  double radius, front_x;
};
ContourSize size_of(const Contour &contour);

} // namespace capsule
