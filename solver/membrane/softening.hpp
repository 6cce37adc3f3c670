#pragma once
// Where a law softens: a membrane resists short meridional waves with d^2 w/d lambda_s^2 alone, as a small displacement
// along the normal relieves the bending that they would cause. Where that is not positive, the equations are no longer
// elliptic: such waves grow the faster the shorter they are, and a shape depends on its mesh. Skalak's law softens in
// compression, where C = 0 below lambda_s = 1/sqrt(3). Throws nothing.
#include "membrane/membrane.hpp"
#include <optional>
#include <string>

namespace capsule {

// The node that resists the least.
struct SoftestPoint {
  double stiffness; // d^2 w/d lambda_s^2, scaled with G
  double stretch_meridional, stretch_azimuthal;
};
SoftestPoint softest_point(const Membrane &membrane, const Vector &position);
// The same unless the membrane is viscous: then short waves grow at bounded rates.
std::optional<SoftestPoint> softest_if_elastic(const MembraneSpec &material, const Membrane &membrane,
                                               const Vector &position);
inline bool softens(const SoftestPoint &point) {
  return !(point.stiffness > 0);
}

// What is said of it, and what to try.
std::string softening_text(const SoftestPoint &point);
inline constexpr const char *softening_advice =
    "lower flow.capillary_number, or take a law that resists compression";

} // namespace capsule
