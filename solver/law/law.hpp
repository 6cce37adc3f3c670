#pragma once
// The membrane's in-plane laws, eqs. 4 to 6: each is a strain energy per reference area w(lambda_s, lambda_phi), scaled
// with G, from which the tensions follow, T_s = (1/lambda_phi) dw/dlambda_s, and with the subscripts exchanged T_phi.
// A law stands in one file of its own and in the table of law.cpp. The choices of "membrane.law", the keys of the
// parameters and all that depends on the law follow from the table.
// w, w_a and w_b keep their relative accuracy at small strains: what vanishes in the undeformed state is written as a
// product. Throws nothing; both stretches must be positive.
#include "law/strain_energy.hpp"
#include <cstddef>
#include <initializer_list>
#include <span>
#include <string_view>
#include <vector>

namespace capsule {

std::span<const Law *const> laws();

// One of the laws with values for its parameters. The other laws' values are kept beside them, so that values and law may
// be set in any order.
class MembraneLaw {
public:
  MembraneLaw() : MembraneLaw(*laws().front()) {}
  // Parameters that get no value keep their initial one.
  MembraneLaw(const Law &law,
              std::initializer_list<double> values = {}); // NOLINT(google-explicit-constructor)

  const Law &law() const { return *law_; }
  bool is(const Law &law) const { return law_ == &law; }
  void choose(const Law &law);
  LawValues values() const { return {values_.data() + first_, law_->parameters.size()}; }
  // Of all laws one after the other, in the order of the table.
  std::vector<double> &all_values() { return values_; }
  const std::vector<double> &all_values() const { return values_; }

  double poisson_ratio() const { return law_->poisson_ratio(values()); }
  // The surface Young modulus of small strains over G.
  double young_modulus() const { return 2 * (1 + poisson_ratio()); }

private:
  const Law *law_;
  std::size_t first_ = 0; // where its values begin
  std::vector<double> values_;
};

inline StrainEnergy strain_energy(const MembraneLaw &law, double a, double b) {
  return law.law().energy(law.values(), a, b);
}

struct Tensions {
  double meridional, azimuthal;
};
Tensions tensions(const MembraneLaw &law, double stretch_meridional, double stretch_azimuthal);

} // namespace capsule
