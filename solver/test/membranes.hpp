#pragma once
// Membranes, shapes and displacements for tests, and derivatives by differences.
#include "case/case.hpp"
#include "law/neo_hookean.hpp"
#include "law/skalak.hpp"
#include "membrane/membrane.hpp"
#include <functional>
#include <random>
#include <vector>

namespace capsule {

inline Case capsule_case(double radius, double aspect_ratio, const MembraneLaw &law, double bending_ratio) {
  Case physics;
  physics.capsule.radius = radius;
  physics.capsule.aspect_ratio = aspect_ratio;
  physics.membrane.law = law;
  physics.membrane.bending_ratio = bending_ratio;
  return physics;
}

// Sampled on the Gauss colatitudes of 5/2 as many nodes.
inline Membrane spectral_membrane(const Case &physics, int nodes) {
  const MeridianBasis dense = spectral_basis(nodes * 5 / 2);
  return make_membrane(physics.capsule, physics.membrane, spectral_basis(nodes), dense.nodes, dense.weights);
}

// Cubic splines, sampled in the same way: their shapes have kinks in the second derivative.
inline Membrane spline_membrane(const Case &physics, int elements) {
  const MeridianBasis dense = spectral_basis(elements * 4);
  return make_membrane(physics.capsule, physics.membrane, spline_basis(elements), dense.nodes, dense.weights);
}

inline std::vector<Case> all_laws(double bending_ratio) {
  return {capsule_case(0.9, 0.7, neo_hookean, bending_ratio),
          capsule_case(0.9, 0.7, {skalak, {0}}, bending_ratio),
          capsule_case(0.9, 0.7, {skalak, {1.5}}, bending_ratio)};
}

// A strongly deformed smooth shape: the reference plus random waves of decaying amplitude, parities kept.
inline Vector random_position(const Membrane &membrane, unsigned seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> amplitude(-0.15, 0.15);
  const Vector &zeta = membrane.basis.nodes;
  const Eigen::Index n = zeta.size();
  Vector position = membrane.reference;
  for (int k = 1; k <= 5; ++k) {
    position.head(n) += (amplitude(random) / k * (k * zeta).array().cos()).matrix();
    // An even factor keeps r positive.
    position.tail(n).array() *= 1 + amplitude(random) / k * (k * zeta).array().cos();
  }
  position.head(n).array() += 2.5;
  return position;
}

inline Vector random_direction(Eigen::Index size, unsigned seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> component(-1, 1);
  return Vector::NullaryExpr(size, [&] { return component(random); });
}

// Derivative at 0 by central differences of eighth order.
template <class Value>
Value derivative(const std::function<Value(double)> &f, double h) {
  const double weight[] = {4.0 / 5, -1.0 / 5, 4.0 / 105, -1.0 / 280};
  Value sum = weight[0] / h * (f(h) - f(-h));
  for (int k = 2; k <= 4; ++k) {
    sum += weight[k - 1] / h * (f(k * h) - f(-k * h));
  }
  return sum;
}

inline double largest(const Vector &v) {
  return v.lpNorm<Eigen::Infinity>();
}

} // namespace capsule
