#include "law/mooney_rivlin.hpp"
#include "law/neo_hookean.hpp"

namespace capsule {
namespace {

// Below 0 and above 1 one of the two energies is negative: the membrane gives way at a large strain.
constexpr LawParameter parameters[]{{.name = "psi",
                                     .symbol = "Psi",
                                     .meaning = "Psi of the Mooney-Rivlin law, its neo-Hookean part",
                                     .initial = 0.5,
                                     .range = from_to(0, 1)}};

// (a^2 b^2 + 1/a^2 + 1/b^2 - 3)/2, the neo-Hookean energy of 1/a and 1/b.
StrainEnergy inverse_energy(double a, double b) {
  const double area = a * b, growth = product_minus_one(a, b);
  const double shear = (a - b) / area;
  // a b^2 - 1/a^3 = ((a^2 b)^2 - 1)/a^3
  const auto slope = [](double along, double across) {
    const double squeeze = square_minus_one(along) * across + (across - 1);
    return squeeze * (squeeze + 2) / (along * along * along);
  };
  const auto stiffness = [](double along, double across) {
    return across * across + 3 / (along * along * along * along);
  };
  return {.w = 0.5 * (shear * shear + growth * growth * (area + 2) / area),
          .w_a = slope(a, b),
          .w_b = slope(b, a),
          .w_aa = stiffness(a, b),
          .w_ab = 2 * area,
          .w_bb = stiffness(b, a)};
}

StrainEnergy energy(LawValues values, double a, double b) {
  const double psi = values[0];
  const StrainEnergy first = neo_hookean.energy({}, a, b), second = inverse_energy(a, b);
  const auto mean = [psi](double x, double y) { return psi * x + (1 - psi) * y; };
  return {.w = mean(first.w, second.w),
          .w_a = mean(first.w_a, second.w_a),
          .w_b = mean(first.w_b, second.w_b),
          .w_aa = mean(first.w_aa, second.w_aa),
          .w_ab = mean(first.w_ab, second.w_ab),
          .w_bb = mean(first.w_bb, second.w_bb)};
}

double poisson_ratio(LawValues /*values*/) {
  return 0.5;
}

} // namespace

constinit const Law mooney_rivlin{
    .name = "mooney-rivlin",
    .title = "Mooney-Rivlin",
    .formula = "(Psi (a^2 + b^2 + 1/(a b)^2 - 3) + (1 - Psi) ((a b)^2 + 1/a^2 + 1/b^2 - 3))/2",
    .parameters = parameters,
    .energy = energy,
    .poisson_ratio = poisson_ratio};

} // namespace capsule
