#include "law/skalak.hpp"

namespace capsule {
namespace {

constexpr LawParameter parameters[]{{.name = "dilatation",
                                     .symbol = "C",
                                     .meaning = "C of Skalak's law, eq. 5",
                                     .initial = 1,
                                     .range = above(-0.5)}};

StrainEnergy energy(LawValues values, double a, double b) {
  const double dilatation = values[0];
  const double area = a * b, growth = product_minus_one(a, b);
  const double strain_a = square_minus_one(a), strain_b = square_minus_one(b);
  const double strain_area = growth * (growth + 2);
  const auto slope = [=](double along, double across, double strain) {
    return along * strain + dilatation * strain_area * area * across;
  };
  const auto stiffness = [=](double along, double across) {
    return 3 * along * along - 1 + dilatation * across * across * (3 * area * area - 1);
  };
  return {.w = 0.25 * (strain_a * strain_a + strain_b * strain_b + dilatation * strain_area * strain_area),
          .w_a = slope(a, b, strain_a),
          .w_b = slope(b, a, strain_b),
          .w_aa = stiffness(a, b),
          .w_ab = 2 * dilatation * area * (2 * area * area - 1),
          .w_bb = stiffness(b, a)};
}

double poisson_ratio(LawValues values) {
  return values[0] / (1 + values[0]);
}

} // namespace

constinit const Law skalak{.name = "skalak",
                           .title = "Skalak",
                           .formula = "((a^2 - 1)^2 + (b^2 - 1)^2 + C (a^2 b^2 - 1)^2)/4",
                           .parameters = parameters,
                           .energy = energy,
                           .poisson_ratio = poisson_ratio};

} // namespace capsule
