#include "steady/slopes.hpp"
#include "case/key_path.hpp"
#include <cmath>

namespace capsule {

Matrix slopes(SteadySystem &system, const Vector &unknowns, const SteadySystem::Linearisation &linear,
              std::span<const std::string> keys) {
  constexpr double relative_step = 1e-3;
  const Eigen::Index n2 = 2 * system.nodes();
  const Case here = system.input();
  Matrix result(n2 + 2, std::ssize(keys));
  for (Eigen::Index k = 0; k < result.cols(); ++k) {
    const std::string &key = keys[static_cast<std::size_t>(k)];
    const double value = number(key, here);
    const double h = relative_step * (value == 0 ? 1 : std::abs(value));
    const auto at = [&](double steps) {
      system.set_parameters(with_number(here, key, value + steps * h));
      return system.load_and_constraints(unknowns);
    };
    const Vector slope = (8 * (at(1) - at(-1)) - (at(2) - at(-2))) / (12 * h);
    result.col(k) << linear.single_layer * slope.head(n2), slope.tail(2);
  }
  system.set_parameters(here);
  return result;
}

Matrix sensitivities(SteadySystem &system, const Vector &unknowns, std::span<const std::string> keys) {
  const SteadySystem::Linearisation linear = system.linearise(unknowns);
  return -linear.jacobian.partialPivLu().solve(slopes(system, unknowns, linear, keys));
}

} // namespace capsule
