#pragma once
// The potential that distant rings make around a place of the axis, as a series in rho^l P_l(cos theta). Throws nothing.
#include "integrals/layer_potential.hpp"

namespace capsule {

class SolidHarmonics {
public:
  SolidHarmonics() = default; // holds no points
  // Of the ring kernel's sources or dipoles, one times the area at each point of a distant curve.
  SolidHarmonics(const RingKernel &kernel, const Curve &curve, double centre);

  // Whether all points are so near to the centre that the series has the kernels' digits there.
  bool hold(const Targets &points) const;
  Vector at(const Targets &points) const;

private:
  double centre_ = 0, reach_ = 0;
  Vector amplitudes_; // of (rho/reach)^l P_l
};

} // namespace capsule
