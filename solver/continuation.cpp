#include "continuation.hpp"
#include "failure.hpp"
#include <boost/math/tools/roots.hpp>
#include <cmath>

namespace capsule {
namespace {

constexpr int most_iterations = 10;
constexpr double correction_tolerance = 1e-4; // of points on a branch: the next one would be its square
constexpr double position_tolerance = 1e-9;
constexpr double smallest_step = 1e-5;

[[noreturn]] void no_convergence() {
  throw NumericsFailure("unresolved", "Newton's method does not converge",
                        "try a finer mesh.membrane or a larger membrane.bending_ratio");
}

// Whether corrections of these lengths, one after the other, lead anywhere.
bool contracts(int iteration, double before, double now) {
  return std::isfinite(now) && (iteration < 2 || now < 0.7 * before);
}

} // namespace

Vector solve_steady(SteadySystem &system, Vector guess, double tolerance) {
  constexpr double farthest = 3; // that a guess can be from a solution
  const Eigen::Index n2 = 2 * system.nodes();
  double before = 0;
  for (int iteration = 0; iteration < 2 * most_iterations; ++iteration) {
    system.fit_tube(guess);
    const SteadySystem::Linearisation linear = system.linearise(guess);
    const Vector change = linear.jacobian.partialPivLu().solve(-linear.residual);
    const double step = system.admissible_step(guess, change);
    const double length = change.head(n2).cwiseAbs().maxCoeff();
    if (!(length < farthest) || (iteration > most_iterations && !contracts(iteration, before, length)))
      no_convergence();
    guess += step * change;
    if (step == 1 && length < tolerance)
      return guess;
    before = length;
  }
  no_convergence();
}

Branch::Branch(SteadySystem &system, Path path, BranchPoint start, int towards, double first_step,
               double largest_step)
    : system_(&system), path_(std::move(path)), point_(std::move(start)), step_(first_step),
      largest_step_(largest_step) {
  system_->take(path_(point_.parameter));
  system_->fit_tube(point_.unknowns);
  const Vector slope = parameter_slope(point_);
  tangent_.resize(slope.size() + 1);
  tangent_ << -system_->linearise(point_.unknowns).jacobian.partialPivLu().solve(slope), 1;
  tangent_ *= towards / std::sqrt(weighted(tangent_, tangent_));
}

// Mean over the nodes of the product of displacements, and the parameters' product.
double Branch::weighted(const Vector &a, const Vector &b) const {
  const Eigen::Index n = system_->nodes();
  return a.head(2 * n).dot(b.head(2 * n)) / static_cast<double>(n) + a[a.size() - 1] * b[b.size() - 1];
}

// d residual/d parameter by central differences: the residual is smooth in it, the error about 1e-9.
Vector Branch::parameter_slope(const BranchPoint &at) const {
  constexpr double h = 1e-5;
  system_->take(path_(at.parameter + h));
  const Vector above = system_->residual(at.unknowns);
  system_->take(path_(at.parameter - h));
  const Vector below = system_->residual(at.unknowns);
  system_->take(path_(at.parameter));
  return (above - below) / (2 * h);
}

Branch::Corrected Branch::correct(const BranchPoint &from, const Vector &tangent, double step,
                                  double tolerance) const {
  const Eigen::Index m = from.unknowns.size();
  const Eigen::Index n = system_->nodes();
  Vector row = Vector::Zero(m + 1);
  row.head(2 * n) = tangent.head(2 * n) / static_cast<double>(n);
  row[m] = tangent[m];
  BranchPoint now{from.unknowns + step * tangent.head(m), from.parameter + step * tangent[m]};
  Vector slope; // it changes little from one correction to the next
  double before = 0;
  for (int iteration = 0; iteration < most_iterations; ++iteration) {
    system_->take(path_(now.parameter));
    system_->fit_tube(now.unknowns);
    if (iteration == 0)
      slope = parameter_slope(now);
    const SteadySystem::Linearisation linear = system_->linearise(now.unknowns);
    Matrix bordered(m + 1, m + 1);
    bordered << linear.jacobian, slope, row.transpose();
    Vector right = Vector::Zero(m + 1);
    right.head(m) = -linear.residual;
    right[m] = step - row.head(2 * n).dot((now.unknowns - from.unknowns).head(2 * n)) -
               row[m] * (now.parameter - from.parameter);
    const Eigen::PartialPivLU<Matrix> factors(bordered);
    const Vector change = factors.solve(right);
    const double length = std::sqrt(weighted(change, change));
    if (!contracts(iteration, before, length) || system_->admissible_step(now.unknowns, change.head(m)) < 1)
      no_convergence();
    before = length;
    now.unknowns += change.head(m);
    now.parameter += change[m];
    if (length < tolerance) {
      right.setZero();
      right[m] = 1;
      Vector direction = factors.solve(right);
      direction /= std::sqrt(weighted(direction, direction));
      return {now, direction, iteration + 1};
    }
  }
  no_convergence();
}

void Branch::advance() {
  constexpr double straight = 0.85; // cosine between neighbouring tangents
  for (;;) {
    try {
      const Corrected next = correct(point_, tangent_, step_, correction_tolerance);
      if (weighted(next.tangent, tangent_) > straight) {
        before_ = point_;
        tangent_before_ = tangent_;
        last_step_ = step_;
        point_ = next.point;
        tangent_ = next.tangent;
        if (next.iterations <= 4)
          step_ = std::min(1.7 * step_, largest_step_);
        else if (next.iterations >= 6)
          step_ /= 1.5;
        return;
      }
    } catch (const NumericsFailure &) {
      if (step_ < 2 * smallest_step)
        throw;
    }
    step_ /= 2;
    if (step_ < smallest_step)
      no_convergence();
  }
}

BranchPoint Branch::at_parameter(double parameter) const {
  const double part = (parameter - before_.parameter) / (point_.parameter - before_.parameter);
  system_->take(path_(parameter));
  const Vector guess = before_.unknowns + part * (point_.unknowns - before_.unknowns);
  return {solve_steady(*system_, guess, position_tolerance), parameter};
}

BranchPoint Branch::fold() const {
  const auto slope_after = [&](double step) {
    const Corrected at = correct(before_, tangent_before_, step, position_tolerance);
    return at.tangent[at.tangent.size() - 1];
  };
  std::uintmax_t evaluations = 30;
  const auto found = boost::math::tools::toms748_solve(
      slope_after, 0.0, last_step_, tangent_before_[tangent_before_.size() - 1], slope(),
      boost::math::tools::eps_tolerance<double>(30), evaluations);
  return correct(before_, tangent_before_, (found.first + found.second) / 2, position_tolerance).point;
}

} // namespace capsule
