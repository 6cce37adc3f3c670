// The paper's estimate of the resistance against closed forms and a plain sum.
#include "electric/long_conductor.hpp"
#include "folded.hpp"
#include "spheroid.hpp"
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <vector>

using namespace capsule;

BOOST_AUTO_TEST_SUITE(long_conductor)

// int r^2/(1 - r^2) dx
BOOST_AUTO_TEST_CASE(sphere_in_the_tube) {
  const Pore pore = make_pore({}).value();
  const MeridianBasis basis = spectral_basis(60);
  for (const double a : {0.01, 0.5, 0.9}) {
    const double rest = std::sqrt(1 - a * a);
    const double exact = 2 * std::atan(a / rest) / rest - 2 * a;
    BOOST_TEST(std::abs(long_conductor_change(pore, basis, sphere(basis, 3, a)) - exact) < 1e-10);
  }
}

// scenes.md, another program.
BOOST_AUTO_TEST_CASE(sphere_in_the_mouth) {
  const Pore pore = make_pore({}).value();
  struct Place {
    double x, change;
  };
  for (const MeridianBasis &basis : {spectral_basis(50), spline_basis(200)})
    for (const Place &place :
         {Place{-1, 0.005547}, {-0.5, 0.205910}, {0, 0.949202}, {0.5, 1.460621}, {1, 1.490984}})
      BOOST_TEST(std::abs(long_conductor_change(pore, basis, sphere(basis, place.x, 0.8)) - place.change) <
                 1e-6);
}

// The liquid in the concave rear does not count: only the outermost radius at each x does. Either end may be concave.
BOOST_AUTO_TEST_CASE(folded_rear) {
  const Pore pore = make_pore({}).value();
  const Eigen::Index n = 160;
  const MeridianBasis basis = spectral_basis(static_cast<int>(n));
  Vector position = 0.8 * folded(basis.nodes);
  position.head(n).array() += 0.2;

  const Vector zeta = Vector::LinSpaced(5001, 0, 3.14159265358979);
  const Vector x = basis.even(zeta, 0, position.head(n)), r = basis.odd(zeta, 0, position.tail(n));
  constexpr int slices = 1000;
  std::vector<double> outermost(slices, 0);
  const double width = (x.maxCoeff() - x.minCoeff()) / slices;
  for (Eigen::Index k = 0; k < x.size(); ++k) {
    const auto slice = static_cast<std::size_t>((x[k] - x.minCoeff()) / width * (1 - 1e-12));
    outermost[slice] = std::max(outermost[slice], r[k]);
  }
  double sum = 0;
  for (int k = 0; k < slices; ++k) {
    const double wall = wall_radius(pore, x.minCoeff() + (k + 0.5) * width);
    const double radius = outermost[static_cast<std::size_t>(k)];
    sum += width * (1 / (wall * wall - radius * radius) - 1 / (wall * wall));
  }
  const double change = long_conductor_change(pore, basis, position);
  BOOST_TEST(std::abs(change / sum - 1) < 2e-3);

  Vector turned(2 * n); // in the tube, where the direction does not matter
  turned << 6 - position.head(n).reverse().array(), position.tail(n).reverse();
  Vector there = position;
  there.head(n).array() += 6;
  BOOST_TEST(std::abs(long_conductor_change(pore, basis, turned) -
                      long_conductor_change(pore, basis, there)) < 1e-9);
}

BOOST_AUTO_TEST_SUITE_END()
