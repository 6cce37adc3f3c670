#pragma once
// What a law is: a strain energy per reference area, scaled with G, with parameters of its own. And what the laws need to
// keep its digits. Throws nothing.
#include "base/range.hpp"
#include <span>

namespace capsule {

// w and its derivatives with respect to a = lambda_s and b = lambda_phi.
struct StrainEnergy {
  double w, w_a, w_b, w_aa, w_ab, w_bb;
};

struct LawParameter {
  const char *name; // the key is "membrane.<name>"
  const char *symbol;
  const char *meaning;
  double initial; // unless it is given
  Range range;
};

// Values of a law's parameters, in the order in which it declares them.
using LawValues = std::span<const double>;

struct Law {
  const char *name;    // in case files: "neo-hookean"
  const char *title;   // in sentences: "neo-Hookean"
  const char *formula; // of w, with a and b for the stretches
  std::span<const LawParameter> parameters;
  StrainEnergy (*energy)(LawValues values, double a, double b);
  // Two-dimensional Poisson ratio of small strains, nu of eq. 6.
  double (*poisson_ratio)(LawValues values);
};

// a b - 1, a^2 - 1: written out, they lose all digits when the stretches are close to 1; these products don't.
inline double product_minus_one(double a, double b) {
  return (a - 1) * b + (b - 1);
}
inline double square_minus_one(double a) {
  return (a - 1) * (a + 1);
}

} // namespace capsule
