#pragma once
// The membrane's in-plane law, eqs. 4 and 5, as a strain energy per reference area w(lambda_s, lambda_phi),
// scaled with G: T_s = (1/lambda_phi) dw/dlambda_s, and with the subscripts exchanged T_phi.
//   neo-Hookean  w = (a^2 + b^2 + 1/(a b)^2 - 3)/2
//   Skalak       w = ((a^2 - 1)^2 + (b^2 - 1)^2 + C (a^2 b^2 - 1)^2)/4
// w, w_a and w_b keep their relative accuracy at small strains: what vanishes in the undeformed state is
// written as a product. Throws nothing; both stretches must be positive.
#include "case/case.hpp"

namespace capsule {

struct MembraneLaw {
  LawName name = LawName::neo_hookean;
  double dilatation = 1; // C

  // Two-dimensional Poisson ratio of small strains, nu of eq. 6: 1/2 (NH), C/(1 + C) (Skalak).
  double poisson_ratio() const;
};

// w and its derivatives with respect to a = lambda_s and b = lambda_phi.
struct StrainEnergy {
  double w, w_a, w_b, w_aa, w_ab, w_bb;
};
StrainEnergy strain_energy(const MembraneLaw &law, double a, double b);

struct Tensions {
  double meridional, azimuthal;
};
Tensions tensions(const MembraneLaw &law, double stretch_meridional, double stretch_azimuthal);

} // namespace capsule
