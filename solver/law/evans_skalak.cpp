#include "law/evans_skalak.hpp"

namespace capsule {
namespace {

// At 0 an area could change without a force, and below it would give energy.
constexpr LawParameter parameters[]{{.name = "area_modulus",
                                     .symbol = "A",
                                     .meaning = "area modulus of the law of Evans and Skalak over G, A",
                                     .initial = 3,
                                     .range = above(0)}};

StrainEnergy energy(LawValues values, double a, double b) {
  const double modulus = values[0];
  const double area = a * b, growth = product_minus_one(a, b);
  const double shear = a - b;
  const auto slope = [=](double along, double across, double excess) {
    return excess * (a + b) / (2 * along * area) + modulus * across * growth;
  };
  const auto stiffness = [modulus](double along, double across) {
    return across / (along * along * along) + modulus * across * across;
  };
  return {.w = shear * shear / (2 * area) + 0.5 * modulus * growth * growth,
          .w_a = slope(a, b, shear),
          .w_b = slope(b, a, -shear),
          .w_aa = stiffness(a, b),
          .w_ab = modulus * (growth + area) - 0.5 / (a * a) - 0.5 / (b * b),
          .w_bb = stiffness(b, a)};
}

double poisson_ratio(LawValues values) {
  return (values[0] - 1) / (values[0] + 1);
}

} // namespace

constinit const Law evans_skalak{.name = "evans-skalak",
                                 .title = "Evans-Skalak",
                                 .formula = "(a - b)^2/(2 a b) + A (a b - 1)^2/2",
                                 .parameters = parameters,
                                 .energy = energy,
                                 .poisson_ratio = poisson_ratio};

} // namespace capsule
