#include "law/law.hpp"
#include "law/evans_skalak.hpp"
#include "law/generalised_hooke.hpp"
#include "law/mooney_rivlin.hpp"
#include "law/neo_hookean.hpp"
#include "law/skalak.hpp"
#include <algorithm>
#include <array>

namespace capsule {

std::span<const Law *const> laws() {
  static constexpr std::array table{
      &neo_hookean, &skalak, &mooney_rivlin, &generalised_hooke, &evans_skalak,
  };
  return table;
}

MembraneLaw::MembraneLaw(const Law &law, std::initializer_list<double> values) {
  for (const Law *each : laws())
    for (const LawParameter &parameter : each->parameters)
      values_.push_back(parameter.initial);
  choose(law);
  std::ranges::copy(values, values_.begin() + static_cast<std::ptrdiff_t>(first_));
}

void MembraneLaw::choose(const Law &law) {
  law_ = &law;
  first_ = 0;
  for (const Law *each : laws()) {
    if (each == law_)
      break;
    first_ += each->parameters.size();
  }
}

Tensions tensions(const MembraneLaw &law, double stretch_meridional, double stretch_azimuthal) {
  const StrainEnergy energy = strain_energy(law, stretch_meridional, stretch_azimuthal);
  return {energy.w_a / stretch_azimuthal, energy.w_b / stretch_meridional};
}

} // namespace capsule
