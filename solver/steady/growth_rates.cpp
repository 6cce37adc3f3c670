#include "steady/growth_rates.hpp"
#include "base/decompositions.hpp"
#include "base/failure.hpp"
#include <algorithm>
#include <array>
#include <complex>
#include <limits>
#include <vector>

namespace capsule {
namespace {

// The matrix in front of v' in (8.3); the identity for equal viscosities without friction in the membrane.
Matrix velocity_operator(const SteadySystem &system, const SteadySystem::Linearisation &linear) {
  const double viscosity_ratio = system.input().flow.viscosity_ratio;
  const Eigen::Index n2 = 2 * system.nodes();
  Matrix matrix = (1 + viscosity_ratio) / 2 * Matrix::Identity(n2, n2);
  if (viscosity_ratio != 1)
    matrix -= (viscosity_ratio - 1) * linear.layers.double_with_wall(linear.double_layer);
  if (linear.friction.size() > 0)
    matrix += linear.layers.single_with_wall() * linear.friction;
  return matrix;
}

Matrix small_motion(const SteadySystem &system, const SteadySystem::Linearisation &linear) {
  const Eigen::Index n2 = 2 * system.nodes();
  const Matrix on_displacement = linear.jacobian.topLeftCorner(n2, n2);
  return lu_solve(velocity_operator(system, linear).partialPivLu(), on_displacement);
}

bool grows_more(const std::complex<double> &a, const std::complex<double> &b) {
  return a.real() > b.real();
}

// What small motions keep, centre and volume, and the velocities that correct it: the frame's and the slack's. Neighbours
// that are opposed see the centre move.
struct Border {
  Matrix constraints; // rows
  Matrix velocities;  // columns
};

Border border_of(const SteadySystem::Linearisation &linear, Neighbours neighbours) {
  const Eigen::Index n2 = linear.layers.single.rows();
  const Eigen::Index kept = neighbours == Neighbours::alike ? 2 : 1; // the last ones
  return {linear.jacobian.leftCols(n2).bottomRows(kept), linear.jacobian.topRows(n2).rightCols(kept)};
}

Eigen::VectorXcd all_growth_rates(const SteadySystem &system, const SteadySystem::Linearisation &linear,
                                  const Border &border) {
  const auto &[constraints, velocities] = border;
  Matrix motion = small_motion(system, linear);
  motion -= velocities * lu_solve((constraints * velocities).partialPivLu(), Matrix(constraints * motion));
  const Matrix allowed = orthogonal_to_rows(constraints);
  Eigen::VectorXcd rates = eigenvalues(allowed.transpose() * motion * allowed);
  std::sort(rates.begin(), rates.end(), grows_more);
  return rates;
}

// Arnoldi's method on the inverse of the motion. The inverse maps a rate of displacement to the displacement that
// keeps centre and volume and has this rate, seen from the centre. Newton's bordered matrix solves for it; its border,
// along which centre and volume are corrected, is a velocity and is multiplied by the velocity's operator for the other
// viscosity ratio. A growing motion is alone on its side of the inverse's spectrum and shows early, but it need not
// be the one that grows fastest: then all rates are computed.
Eigen::VectorXcd rates_by_arnoldi(const SteadySystem &system, const SteadySystem::Linearisation &linear,
                                  Neighbours neighbours, std::size_t wanted) {
  constexpr std::array vectors{40, 80}; // as many as the second where the first show too few rates
  constexpr double converged = 1e-8, visible = 0.1; // relative residuals of an eigenvalue
  const Eigen::Index n2 = 2 * system.nodes();
  const Matrix on_velocity = velocity_operator(system, linear);
  const Border border = border_of(linear, neighbours);
  const Eigen::Index size_of_all = n2 + border.constraints.rows();
  Matrix bordered = Matrix::Zero(size_of_all, size_of_all);
  bordered.topLeftCorner(n2, n2) = linear.jacobian.topLeftCorner(n2, n2);
  bordered.topRightCorner(n2, border.velocities.cols()) = on_velocity * border.velocities;
  bordered.bottomLeftCorner(border.constraints.rows(), n2) = border.constraints;
  const Eigen::PartialPivLU<Matrix> factors(bordered);
  const auto inverse = [&](const Vector &rate) -> Vector {
    Vector right = Vector::Zero(size_of_all);
    right.head(n2) = on_velocity * rate;
    return lu_solve(factors, right).head(n2);
  };
  const Eigen::Index m = std::min<Eigen::Index>(vectors.back(), 2 * n2 - size_of_all);
  Matrix basis(n2, m + 1);
  Matrix hessenberg = Matrix::Zero(m + 1, m);
  const auto zeta = system.membrane().basis.nodes.array();
  Vector start(n2); // contains every wave
  start << (1 / (1.25 - zeta.cos())), (zeta.sin() / (1.25 - (zeta + 0.3).cos()));
  basis.col(0) = inverse(start).normalized();
  Eigen::Index size = 0;
  const auto extend = [&] {
    Vector next = inverse(basis.col(size));
    const double length = next.norm();
    for (int again = 0; again < 2; ++again) {
      const Vector parts = basis.leftCols(size + 1).transpose() * next;
      next -= basis.leftCols(size + 1) * parts;
      hessenberg.col(size).head(size + 1) += parts;
    }
    const double rest = next.norm();
    hessenberg(size + 1, size) = rest;
    ++size;
    if (rest < 1e-14 * length) // the space is invariant: all its eigenvalues are exact
      return false;
    basis.col(size) = next / rest;
    return true;
  };
  std::vector<std::complex<double>> rates;
  bool is_open = true;
  for (const Eigen::Index most : vectors) {
    if (rates.size() >= wanted || !is_open || size == m)
      break;
    while (is_open && size < std::min(most, m))
      is_open = extend();
    const EigenPairs eigen = eigenpairs(hessenberg.topLeftCorner(size, size));
    rates.clear();
    for (Eigen::Index k = 0; k < size; ++k) {
      const std::complex<double> value = eigen.values[k];
      const double residual = hessenberg(size, size - 1) * std::abs(eigen.vectors(size - 1, k));
      if (value.real() > 0 && residual < visible * std::abs(value))
        return all_growth_rates(system, linear, border);
      if (residual < converged * std::abs(value))
        rates.push_back(1.0 / value);
    }
  }
  if (rates.empty())
    throw NumericsFailure(failure_kind::unresolved, "the growth rates do not converge",
                          "try a finer mesh.membrane");
  std::sort(rates.begin(), rates.end(), grows_more);
  return Eigen::Map<Eigen::VectorXcd>(rates.data(), std::ssize(rates));
}

} // namespace

Matrix small_motion(const SteadySystem &system, const Vector &unknowns, Neighbours neighbours) {
  return small_motion(system, system.linearise(unknowns, neighbours));
}

Eigen::VectorXcd all_growth_rates(const SteadySystem &system, const Vector &unknowns, Neighbours neighbours) {
  const SteadySystem::Linearisation linear = system.linearise(unknowns, neighbours);
  return all_growth_rates(system, linear, border_of(linear, neighbours));
}

Eigen::VectorXcd growth_rates(const SteadySystem &system, const Vector &unknowns, Neighbours neighbours) {
  constexpr std::size_t all_that_converge = std::numeric_limits<std::size_t>::max();
  return rates_by_arnoldi(system, system.linearise(unknowns, neighbours), neighbours, all_that_converge);
}

std::complex<double> slowest_rate(const SteadySystem &system, const SteadySystem::Linearisation &linear,
                                  Neighbours neighbours) {
  constexpr std::size_t enough = 10;
  return rates_by_arnoldi(system, linear, neighbours, enough)[0];
}

} // namespace capsule
