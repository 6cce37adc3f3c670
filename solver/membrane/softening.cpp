#include "membrane/softening.hpp"
#include "membrane/surface_viscosity.hpp"
#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace capsule {

SoftestPoint softest_point(const Membrane &membrane, const Vector &position) {
  const MembraneState state =
      membrane_state(membrane, membrane.at_nodes, membrane.undeformed_at_nodes, position);
  SoftestPoint softest{std::numeric_limits<double>::infinity(), 1, 1};
  for (Eigen::Index i = 0; i < state.stretch_meridional.size(); ++i) {
    const double a = state.stretch_meridional[i], b = state.stretch_azimuthal[i];
    const double stiffness = strain_energy(membrane.law, a, b).w_aa;
    if (!(stiffness >= softest.stiffness))
      softest = {stiffness, a, b};
    if (std::isnan(stiffness))
      break;
  }
  return softest;
}

std::optional<SoftestPoint> softest_if_elastic(const MembraneSpec &material, const Membrane &membrane,
                                               const Vector &position) {
  return is_viscous(material.viscosity) ? std::nullopt : std::optional(softest_point(membrane, position));
}

std::string softening_text(const SoftestPoint &point) {
  return fmt::format(
      "the membrane's law softens: where it is stretched by {:.3g} along the meridian and {:.3g} "
      "around the axis, it resists short waves no longer, and the shape depends on the mesh",
      point.stretch_meridional, point.stretch_azimuthal);
}

} // namespace capsule
