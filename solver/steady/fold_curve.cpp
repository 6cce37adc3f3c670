#include "steady/fold_curve.hpp"
#include "base/failure.hpp"
#include "steady/newton.hpp"
#include "steady/slopes.hpp"
#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <memory>
#include <optional>
#include <utility>

namespace capsule {
namespace {

constexpr double first_length = 0.05, largest_length = 0.5, shortest_length = 1e-5; // lengths of weighted()
constexpr int slow = 5;               // iterations of Newton's method on a mesh that is too coarse
constexpr double small_enough = 1e-9; // of a correction's length

// J and the slopes of both keys in one matrix, (2N + 2) x (2N + 4).
Matrix derivatives(SteadySystem &system, const Vector &unknowns, const SteadySystem::Linearisation &linear,
                   const KeyPath &key, double part, const KeyPath &second, double second_part) {
  const std::array<std::string, 2> keys{key.key(), second.key()};
  Matrix all(unknowns.size(), unknowns.size() + 2);
  all << linear.jacobian, slopes(system, unknowns, linear, keys);
  all.col(unknowns.size()) *= key.slope(part);
  all.col(unknowns.size() + 1) *= second.slope(second_part);
  return all;
}

Vector joined(const FoldPoint &point) {
  Vector all(point.unknowns.size() + 2);
  all << point.unknowns, point.part, point.second_part;
  return all;
}

} // namespace

FoldCurve::FoldCurve(SteadySystem &system, KeyPath key, KeyPath second, FoldPoint start,
                     const Vector &null_vector, const Vector &tangent)
    : system_(&system), key_(std::move(key)), second_(std::move(second)), point_(std::move(start)),
      null_vector_(null_vector.normalized()), step_(first_length) {
  set_parameters(point_.part, point_.second_part);
  system_->fit_tube(point_.unknowns);
  const SteadySystem::Linearisation linear = system_->linearise(point_.unknowns);
  const Eigen::Index m = point_.unknowns.size();
  // The branch's own slope lies outside of J's range.
  left_vector_ =
      derivatives(*system_, point_.unknowns, linear, key_, point_.part, second_, point_.second_part)
          .col(m)
          .normalized();
  const Vector upwards = tangent.size() > 0 ? tangent : Vector(Vector::Unit(m + 2, m + 1));
  accept(correct(point_, upwards / std::sqrt(weighted(upwards, upwards)), 0, Vector::Zero(m + 2)));
}

void FoldCurve::set_parameters(double part, double second_part) const {
  system_->set_parameters(with_number(key_.at(part), second_.key(), second_.value(second_part)));
}

double FoldCurve::weighted(const Vector &a, const Vector &b) const {
  const Eigen::Index n = system_->nodes();
  return a.head(2 * n).dot(b.head(2 * n)) / static_cast<double>(n) + a.tail(2).dot(b.tail(2));
}

FoldCurve::Corrected FoldCurve::correct(const FoldPoint &from, const Vector &tangent, double step,
                                        const Vector &curvature) const {
  const Eigen::Index n = system_->nodes();
  Vector row = Vector::Zero(tangent.size());
  row.head(2 * n) = tangent.head(2 * n) / static_cast<double>(n);
  row.tail(2) = tangent.tail(2);
  const Eigen::Index m = from.unknowns.size();
  const Vector ahead = step * tangent + step * step / 2 * curvature;
  return corrected({from.unknowns + ahead.head(m), from.part + ahead[m], from.second_part + ahead[m + 1]},
                   row, row.dot(joined(from)) + step, tangent);
}

// The fold where row . (u, p, q) = aim, from a guess. Its tangent is on the side of `direction`.
FoldCurve::Corrected FoldCurve::corrected(FoldPoint now, const Vector &row, double aim,
                                          const Vector &direction) const {
  constexpr double difference = 1e-5; // root mean square displacement of h v
  constexpr double fast = 0.2;        // ratio of corrections with the same matrix
  const Eigen::Index m = now.unknowns.size();
  const Eigen::Index n = system_->nodes();
  const auto all_derivatives = [&](const Vector &unknowns, const SteadySystem::Linearisation &linear) {
    return derivatives(*system_, unknowns, linear, key_, now.part, second_, now.second_part);
  };
  std::optional<Eigen::PartialPivLU<Matrix>> factors;
  Corrected result;
  double before = 1;
  for (int iteration = 0; iteration < most_iterations; ++iteration) {
    set_parameters(now.part, now.second_part);
    system_->fit_tube(now.unknowns);
    const SteadySystem::Linearisation linear = system_->linearise(now.unknowns);
    Matrix bordered(m + 1, m + 1);
    bordered << linear.jacobian, left_vector_, null_vector_.transpose(), 0;
    const Eigen::PartialPivLU<Matrix> singular(bordered);
    const Vector unit = Vector::Unit(m + 1, m);
    const Vector right_solution = lu_solve(singular, unit), left_solution = singular.transpose().solve(unit);
    const Vector v = right_solution.head(m), w = left_solution.head(m);
    if (!factors) {
      const double h = difference / std::max(v.head(2 * n).norm() / std::sqrt(static_cast<double>(n)), 1e-3);
      const auto across = [&](double sign) -> Vector {
        const Vector there = now.unknowns + sign * h * v;
        return all_derivatives(there, system_->linearise(there)).transpose() * w;
      };
      Matrix matrix(m + 2, m + 2);
      matrix.topRows(m) = all_derivatives(now.unknowns, linear);
      matrix.row(m) = -(across(1) - across(-1)).transpose() / (2 * h);
      matrix.row(m + 1) = row.transpose();
      factors.emplace(matrix);
    }
    Vector right(m + 2);
    right << -linear.residual, -right_solution[m], aim - row.dot(joined(now));
    const Vector change = lu_solve(*factors, right);
    const double length = std::sqrt(weighted(change, change));
    if (!contracts(iteration, before, length) || system_->admissible_step(now.unknowns, change.head(m)) < 1)
      no_convergence();
    const double ratio = length / before;
    if (iteration == 0)
      result.first_correction = length;
    before = length;
    now.unknowns += change.head(m);
    now.part += change[m];
    now.second_part += change[m + 1];
    if (length * std::min(ratio, 1.0) < small_enough) {
      Vector tangent = factors->solve(Vector(Vector::Unit(m + 2, m + 1)));
      tangent /= std::sqrt(weighted(tangent, tangent));
      result.tangent = weighted(tangent, direction) < 0 ? Vector(-tangent) : tangent;
      result.point = std::move(now);
      result.null_vector = v;
      result.left_vector = w;
      result.iterations = iteration;
      return result;
    }
    if (iteration > 0 && ratio > fast)
      factors.reset();
  }
  no_convergence();
}

void FoldCurve::accept(Corrected next) {
  before_ = std::exchange(point_, std::move(next.point));
  tangent_before_ = std::exchange(tangent_, std::move(next.tangent));
  null_vector_ = next.null_vector.normalized();
  left_vector_ = next.left_vector.normalized();
  is_slow_ = next.iterations > slow;
  ++points_;
}

// Of the curve at the last point, from the tangents of the last two.
Vector FoldCurve::curvature() const {
  if (points_ == 1)
    return Vector::Zero(tangent_.size());
  return (tangent_ - tangent_before_) / weighted(joined(point_) - joined(before_), tangent_);
}

void FoldCurve::advance() {
  constexpr double intended = 3e-3; // first correction
  constexpr double straight = 0.9;  // cosine between neighbouring tangents
  const Vector bend = curvature();
  take_step(step_, shortest_length, [&] {
    Corrected next = correct(point_, tangent_, step_, bend);
    if (!(weighted(next.tangent, tangent_) > straight))
      return false;
    const double factor = std::clamp(std::cbrt(intended / next.first_correction), 0.5, 2.0);
    accept(std::move(next));
    step_ = std::min(factor * step_, largest_length);
    return true;
  });
}

FoldPoint FoldCurve::at_second(double part) const {
  const double share = (part - before_.second_part) / (point_.second_part - before_.second_part);
  const FoldPoint guess{before_.unknowns + share * (point_.unknowns - before_.unknowns),
                        before_.part + share * (point_.part - before_.part), part};
  return corrected(guess, Vector::Unit(tangent_.size(), tangent_.size() - 1), part, tangent_).point;
}

FoldPoint follow_fold(SteadyState &state, const FoldPoint &start, const Vector &null_vector,
                      const KeyPath &key, const KeyPath &second, int finest, const Control &control,
                      const OnFold &found) {
  constexpr int most_points = 300;
  const auto case_at = [&](const FoldPoint &point) {
    return with_number(key.at(point.part), second.key(), second.value(point.second_part));
  };
  const auto tell = [&](const FoldPoint &point) {
    state.unknowns = point.unknowns;
    state.system->set_parameters(case_at(point));
    found(state, point);
  };
  auto curve = std::make_unique<FoldCurve>(*state.system, key, second, start, null_vector);
  const auto next_mesh = [&] { return finer_mesh(static_cast<int>(state.system->nodes())); };
  const auto can_refine = [&] { return next_mesh() <= finest; };
  // What was found on a mesh that turns out too coarse may be amiss: the finer one begins before it.
  const auto refine_at = [&](const FoldPoint &here, const Vector &tangent) {
    const SteadyState finer = moved_to_mesh(case_at(here), next_mesh(), {state.system, here.unknowns});
    curve = std::make_unique<FoldCurve>(*finer.system, key, second,
                                        FoldPoint{finer.unknowns, here.part, here.second_part},
                                        moved_to(*finer.system, *state.system, curve->null_vector()),
                                        moved_to(*finer.system, *state.system, tangent));
    state = {finer.system, curve->point().unknowns};
  };
  tell(curve->point());
  for (int k = 0; k < most_points; ++k) {
    spend(control, 6, static_cast<double>(state.system->nodes()));
    try {
      curve->advance();
    } catch (const NumericsFailure &) {
      if (!can_refine())
        throw;
      refine_at(curve->point(), curve->tangent());
      continue;
    }
    if (curve->wants_a_finer_mesh()) {
      if (!can_refine())
        throw NumericsFailure(failure_kind::unresolved,
                              fmt::format("{} nodes do not resolve the fold at {}", state.system->nodes(),
                                          second.text(curve->point().second_part)),
                              "a nearer end");
      refine_at(curve->point_before(), curve->tangent_before());
      continue;
    }
    const double part = curve->point().second_part;
    FoldPoint now = part >= 1 ? curve->at_second(1) : part <= 0 ? curve->at_second(0) : curve->point();
    tell(now);
    if (part >= 1 || part <= 0)
      return now;
  }
  throw NumericsFailure(failure_kind::step,
                        fmt::format("{} points of a fold have led to {} only", most_points,
                                    second.text(curve->point().second_part)),
                        "a nearer end");
}

} // namespace capsule
