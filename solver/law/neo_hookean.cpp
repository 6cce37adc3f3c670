#include "law/neo_hookean.hpp"

namespace capsule {
namespace {

StrainEnergy energy(LawValues /*none*/, double a, double b) {
  const double area = a * b, growth = product_minus_one(a, b);
  const double shear = a - b;
  const double cube = area * area * area;
  // a - 1/(a^3 b^2) = ((a^2 b)^2 - 1)/(a^3 b^2)
  const auto slope = [area](double along, double across) {
    const double squeeze = square_minus_one(along) * across + (across - 1);
    return squeeze * (squeeze + 2) / (along * area * area);
  };
  const auto stiffness = [area](double along) { return 1 + 3 / (along * along * area * area); };
  return {.w = 0.5 * (shear * shear + growth * growth * (2 * area + 1) / (area * area)),
          .w_a = slope(a, b),
          .w_b = slope(b, a),
          .w_aa = stiffness(a),
          .w_ab = 2 / cube,
          .w_bb = stiffness(b)};
}

double poisson_ratio(LawValues /*none*/) {
  return 0.5;
}

} // namespace

constinit const Law neo_hookean{.name = "neo-hookean",
                                .title = "neo-Hookean",
                                .formula = "(a^2 + b^2 + 1/(a b)^2 - 3)/2",
                                .parameters = {},
                                .energy = energy,
                                .poisson_ratio = poisson_ratio};

} // namespace capsule
