#include "law/generalised_hooke.hpp"

namespace capsule {
namespace {

// At 1 an area cannot change, at -1 its change costs nothing; beyond, it gives energy.
constexpr LawParameter parameters[]{{.name = "poisson_ratio",
                                     .symbol = "nu",
                                     .meaning = "surface Poisson ratio of the generalised law of Hooke, nu_s",
                                     .initial = 0.5,
                                     .range = {.low = -1, .high = 1}}};

StrainEnergy energy(LawValues values, double a, double b) {
  const double nu = values[0];
  const double strain_a = square_minus_one(a), strain_b = square_minus_one(b);
  const auto slope = [nu](double along, double strain, double strain_across) {
    return along * (strain + nu * strain_across) / (1 - nu);
  };
  const auto stiffness = [nu](double along, double strain_across) {
    return (3 * along * along - 1 + nu * strain_across) / (1 - nu);
  };
  // The mean and half the difference of the strains: nothing cancels near nu = -1.
  const double mean = 0.5 * (strain_a + strain_b), shear = 0.5 * (strain_a - strain_b);
  return {.w = 0.5 * (shear * shear + (1 + nu) / (1 - nu) * mean * mean),
          .w_a = slope(a, strain_a, strain_b),
          .w_b = slope(b, strain_b, strain_a),
          .w_aa = stiffness(a, strain_b),
          .w_ab = 2 * nu * a * b / (1 - nu),
          .w_bb = stiffness(b, strain_a)};
}

double poisson_ratio(LawValues values) {
  return values[0];
}

} // namespace

constinit const Law generalised_hooke{
    .name = "generalised-hooke",
    .title = "generalised Hooke",
    .formula = "((a^2 - 1)^2 + (b^2 - 1)^2 + 2 nu (a^2 - 1) (b^2 - 1))/(4 (1 - nu))",
    .parameters = parameters,
    .energy = energy,
    .poisson_ratio = poisson_ratio};

} // namespace capsule
