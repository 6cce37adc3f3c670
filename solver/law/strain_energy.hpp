#pragma once
// A law's strain energy per reference area, scaled with G, and what the laws need to keep its digits. Throws nothing.

namespace capsule {

// w and its derivatives with respect to a = lambda_s and b = lambda_phi.
struct StrainEnergy {
  double w, w_a, w_b, w_aa, w_ab, w_bb;
};

// a b - 1, a^2 - 1: written out, they lose all digits when the stretches are close to 1; these products don't.
inline double product_minus_one(double a, double b) {
  return (a - 1) * b + (b - 1);
}
inline double square_minus_one(double a) {
  return (a - 1) * (a + 1);
}

} // namespace capsule
