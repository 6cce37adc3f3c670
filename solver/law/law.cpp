#include "law/law.hpp"

namespace capsule {
namespace {

// a^2 b^2 - 1 and the like lose all digits when both stretches are close to 1; their factors don't.
double product_minus_one(double a, double b) {
  return (a - 1) * b + (b - 1);
}
double square_minus_one(double a) {
  return (a - 1) * (a + 1);
}

StrainEnergy neo_hookean(double a, double b) {
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

StrainEnergy skalak(double dilatation, double a, double b) {
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

} // namespace

double MembraneLaw::poisson_ratio() const {
  return name == LawName::neo_hookean ? 0.5 : dilatation / (1 + dilatation);
}

StrainEnergy strain_energy(const MembraneLaw &law, double a, double b) {
  return law.name == LawName::neo_hookean ? neo_hookean(a, b) : skalak(law.dilatation, a, b);
}

Tensions tensions(const MembraneLaw &law, double stretch_meridional, double stretch_azimuthal) {
  const StrainEnergy energy = strain_energy(law, stretch_meridional, stretch_azimuthal);
  return {energy.w_a / stretch_azimuthal, energy.w_b / stretch_meridional};
}

} // namespace capsule
