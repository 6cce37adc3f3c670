#pragma once
// Capsules at random, the same ones with any library: the domain of the studies random-capsules and random-marches.
#include "case/case.hpp"
#include "law/skalak.hpp"
#include <cmath>
#include <random>

namespace capsule {

class Sample {
public:
  explicit Sample(unsigned long seed) : random_(seed) {}
  double between(double low, double high) { return low + (high - low) * uniform(); }
  double log_between(double low, double high) { return low * std::pow(high / low, uniform()); }
  bool coin() { return uniform() < 0.5; }

private:
  double uniform() { return std::ldexp(static_cast<double>(random_() >> 11), -53); }
  std::mt19937_64 random_;
};

inline Case random_capsule(Sample &of) {
  Case c;
  c.capsule.radius = of.between(0.3, 1.3);
  c.capsule.aspect_ratio = of.log_between(0.28, 2.5);
  c.flow.capillary_number = of.log_between(1e-3, 0.3);
  c.membrane.bending_ratio = of.log_between(1e-6, 1e-2);
  const bool is_skalak = of.coin(), resists_area = of.coin();
  const double dilatation = of.log_between(0.1, 100);
  if (is_skalak)
    c.membrane.law = {skalak, {resists_area ? dilatation : 0}};
  return c;
}

} // namespace capsule
