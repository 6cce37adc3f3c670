#include "steady/fold_error.hpp"
#include "base/failure.hpp"
#include "case/key_path.hpp"
#include "steady/newton.hpp"
#include "steady/refinement.hpp"
#include "steady/slopes.hpp"
#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

namespace capsule {
namespace {

// A change of the unknowns and of the key's value.
struct Change {
  Vector unknowns;
  double value = 0;
};

// The second derivative of F along two changes.
Vector second_derivative(SteadySystem &system, const Vector &unknowns, const std::string &key,
                         const Change &one, const Change &other) {
  constexpr double difference = 1e-3; // root mean square displacement, or change of the value by parts of it
  const Case here = system.input();
  const double value = number(key, here);
  const auto n = static_cast<double>(system.nodes());
  const auto small = [&](const Change &change) {
    const double moved = change.unknowns.head(2 * system.nodes()).norm() / std::sqrt(n);
    return difference / std::max(moved, std::abs(change.value) / natural_size(key, value));
  };
  const double h = small(one), k = small(other);
  const auto at = [&](double a, double b) {
    system.set_parameters(with_number(here, key, value + a * one.value + b * other.value));
    return system.residual(unknowns + a * one.unknowns + b * other.unknowns);
  };
  Vector result = (at(h, k) - at(h, -k) - at(-h, k) + at(-h, -k)) / (4 * h * k);
  system.set_parameters(here);
  return result;
}

// The fold next to a state of the system, which has its parameters from then on.
Vector fold_near(SteadySystem &system, const Vector &unknowns, const std::string &key) {
  const Eigen::Index m = unknowns.size();
  system.fit_tube(unknowns);
  const SteadySystem::Linearisation linear = system.linearise(unknowns);
  const Vector slope = slopes(system, unknowns, linear, std::span(&key, 1)).col(0);
  // Where the Jacobian is nearly singular, what solves with it is nearly its null vector.
  const Vector null_vector = lu_solve(linear.jacobian.partialPivLu(), slope);
  Matrix bordered(m + 1, m + 1);
  bordered << linear.jacobian, slope.normalized(), null_vector.normalized().transpose(), 0;
  const Eigen::PartialPivLU<Matrix> factors(bordered);
  const auto solution = [&](const Vector &right) {
    Vector all(m + 1);
    all << right, 0;
    return lu_solve(factors, all);
  };
  const Vector unit = Vector::Unit(m + 1, m);
  const Vector singular = lu_solve(factors, unit);
  const Vector left = factors.transpose().solve(unit);
  const Vector by_residual = solution(-linear.residual), by_slope = solution(-slope);
  const double change = -by_residual[m] / by_slope[m];
  const Change across{by_residual.head(m) + change * by_slope.head(m), change};
  const Change along{singular.head(m), 0};
  const auto bend = [&](const Change &other) {
    return left.head(m).dot(second_derivative(system, unknowns, key, along, other));
  };
  const Vector moved = across.unknowns + (singular[m] - bend(across)) / bend(along) * along.unknowns;
  if (!moved.allFinite() || !std::isfinite(change) || system.admissible_step(unknowns, moved) < 1)
    no_convergence();
  const Case here = system.input();
  system.set_parameters(with_number(here, key, number(key, here) + change));
  return unknowns + moved;
}

// Guesses on coarser meshes and, of a train, with coarser walls.
std::vector<SteadyState> coarser_guesses(const SteadyState &state) {
  std::vector<SteadyState> guesses{moved_to_coarser(state, first_mesh), moved_to_coarser(state, second_mesh)};
  if (state.system->input().flow.period > 0)
    for (const CoarserMesh &mesh : coarser_walls)
      guesses.push_back(moved_to_coarser(state, mesh));
  return guesses;
}

} // namespace

std::map<std::string, double> errors_of_fold(const SteadyState &fold, const std::string &key,
                                             const SeriesRow &row) {
  const double value = number(key, fold.system->input());
  double error = relative_error_of_quadrature(row) * natural_size(key, value);
  std::vector<SeriesRow> rows;
  try {
    for (SteadyState &coarse : coarser_guesses(fold)) {
      coarse.unknowns = fold_near(*coarse.system, coarse.unknowns, key);
      rows.push_back(row_of(coarse));
      error += std::abs(value - number(key, coarse.system->input()));
    }
  } catch (const NumericsFailure &) {
    return {};
  }
  std::map<std::string, double> errors = errors_of(row, rows);
  errors[key] = error_safety * error;
  return errors;
}

std::optional<double> error_of_fold(const SteadyState &fold, const std::string &key) {
  return error_of_place(errors_of_fold(fold, key, row_of(fold)), key);
}

} // namespace capsule
