// Prints the coefficients of case/empty_pore.cpp: the loss of a mouth over half of the whole hyperboloid's, less 1, as a
// Chebyshev series in 2 sqrt(cos alpha) - 1. In cos alpha itself the series would converge slowly: at 90 degrees the
// lip becomes a corner. Up to 10 degrees the loss is the hyperboloid's to 1e-7. Takes a minute.
#include "case/empty_pore.hpp"
#include "flow/wall.hpp"
#include <cmath>
#include <cstdio>
#include <exception>
#include <numbers>
#include <vector>

namespace {

using namespace capsule;
using std::numbers::pi;

double excess(double cosine) {
  constexpr double cosine_of_10_degrees = 0.985;
  if (cosine > cosine_of_10_degrees)
    return 0;
  const PoreSpec spec{
      .opening_angle_deg = std::acos(cosine) * 180 / pi, .exit_x = 6, .entrance_distance = 1000};
  const Wall pore(make_pore(spec).value(), {.wall_panel = 0.5, .lip_panel = 1e-4, .near_tolerance = 1e-10});
  return (pore.base_pressure_drop() - 8 * spec.exit_x) / half_hyperboloid_loss(spec.opening_angle_deg) - 1;
}

} // namespace

int main() {
  try {
    constexpr int points = 20, terms = 11;
    std::vector<double> angles, values;
    for (int k = 0; k < points; ++k) {
      angles.push_back(pi * (k + 0.5) / points);
      values.push_back(excess(std::pow((1 + std::cos(angles.back())) / 2, 2)));
    }
    for (int j = 0; j < terms; ++j) {
      double sum = 0;
      for (int k = 0; k < points; ++k)
        sum += 2 * values[static_cast<std::size_t>(k)] * std::cos(j * angles[static_cast<std::size_t>(k)]) /
               points;
      std::printf("%.5e,\n", sum);
    }
  } catch (const std::exception &error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
