#include "steady/slopes.hpp"
#include "case/key_path.hpp"
#include <cmath>

namespace capsule {
namespace {

constexpr double relative_step = 1e-3;

double step_of(const std::string &key, double value) {
  const double size = natural_size(key, value);
  return relative_step * (size == 0 ? 1 : size);
}

} // namespace

Matrix slopes(SteadySystem &system, const Vector &unknowns, const SteadySystem::Linearisation &linear,
              std::span<const std::string> keys) {
  const Eigen::Index n2 = 2 * system.nodes();
  const Case here = system.input();
  Matrix result(n2 + 2, std::ssize(keys));
  for (Eigen::Index k = 0; k < result.cols(); ++k) {
    const std::string &key = keys[static_cast<std::size_t>(k)];
    const double value = number(key, here);
    const double h = step_of(key, value);
    const bool moves_images = key == "flow.period" && value > 0;
    const auto at = [&](double steps) {
      system.set_parameters(with_number(here, key, value + steps * h));
      return moves_images ? system.residual(unknowns) : system.load_and_constraints(unknowns);
    };
    const Vector slope = (8 * (at(1) - at(-1)) - (at(2) - at(-2))) / (12 * h);
    if (moves_images)
      result.col(k) = slope;
    else
      result.col(k) << linear.layers.velocity_of(slope.head(n2)), slope.tail(2);
  }
  system.set_parameters(here);
  return result;
}

Matrix sensitivities(SteadySystem &system, const Vector &unknowns, std::span<const std::string> keys) {
  const SteadySystem::Linearisation linear = system.linearise(unknowns);
  return -lu_solve(linear.jacobian.partialPivLu(), slopes(system, unknowns, linear, keys));
}

} // namespace capsule
