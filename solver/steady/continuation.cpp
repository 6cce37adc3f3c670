#include "steady/continuation.hpp"
#include "base/failure.hpp"
#include "steady/newton.hpp"
#include "steady/slopes.hpp"
#include <algorithm>
#include <boost/math/tools/roots.hpp>
#include <cmath>
#include <fmt/format.h>
#include <optional>

namespace capsule {
namespace {

constexpr double smallest_step = 1e-6;
constexpr double work_of_residual = 0.06; // of a linearisation

// Factor from one step to the next. The contraction of Newton's method grows with the error of the guess, which is of second
// order in the first step, along the tangent, and of fourth in the others, on a cubic: the cube root lies between.
double step_factor(double contraction) {
  constexpr double intended = 0.25;
  return contraction == 0 ? 1.4 : std::clamp(std::cbrt(intended / contraction), 0.5, 2.0);
}

// Changes of the unknowns, then of the parameter.
Vector way(const BranchPoint &from, const BranchPoint &to) {
  Vector changes(to.unknowns.size() + 1);
  changes << to.unknowns - from.unknowns, to.parameter - from.parameter;
  return changes;
}

} // namespace

Branch::Branch(SteadySystem &system, KeyPath path, BranchPoint start, const Vector &direction,
               const Steps &steps, Trend trend, Control control)
    : system_(&system), path_(std::move(path)), control_(std::move(control)), point_(std::move(start)),
      steps_(steps), step_(steps.first), trend_(trend), trend_before_(trend) {
  const Vector row = row_across(direction / std::sqrt(weighted(direction, direction)));
  const Corrected first = correct(point_, row, 0, position_tolerance, Vector::Zero(direction.size()), {});
  point_ = first.point;
  tangent_ = first.tangent;
  slopes_ = first.slopes;
}

Vector Branch::upwards(const SteadySystem &system) {
  const Eigen::Index m = 2 * system.nodes() + 2;
  return Vector::Unit(m + 1, m);
}

// Weighted mean over the nodes of the product of displacements, and the parameters' product.
double Branch::weighted(const Vector &a, const Vector &b) const {
  const Eigen::Index n = system_->nodes();
  return weight_ / static_cast<double>(n) * a.head(2 * n).dot(b.head(2 * n)) +
         a[a.size() - 1] * b[b.size() - 1];
}

// Raises the weight of displacements where the parameter alone would count, until both count alike; lowers it where
// displacements alone count.
void Branch::balance() {
  constexpr double largest_weight = 1e5;
  const double share = std::pow(tangent_[tangent_.size() - 1], 2); // the tangent has length one
  if (share > 0.8)
    weight_ = std::min(weight_ * share / std::max(1 - share, 1e-12), largest_weight);
  else if (share < 0.1)
    weight_ = std::max(weight_ / 2, 1.0);
  const double stretched = std::sqrt(weighted(tangent_, tangent_));
  tangent_ /= stretched;
  step_ = std::min(step_ * stretched, steps_.largest); // to the same point as before, if allowed
}

// Its product with a change is that change's length along a tangent.
Vector Branch::row_across(const Vector &tangent) const {
  const Eigen::Index n = system_->nodes(), m = tangent.size() - 1;
  Vector row = Vector::Zero(m + 1);
  row.head(2 * n) = weight_ / static_cast<double>(n) * tangent.head(2 * n);
  row[m] = tangent[m];
  return row;
}

// Derivative of the equations with respect to the parameter.
Vector Branch::slope_in_parameter(const BranchPoint &at, const SteadySystem::Linearisation &linear) const {
  return path_.slope(at.parameter) * slopes(*system_, at.unknowns, linear, std::span(&path_.key(), 1)).col(0);
}

// The point whose way from here has a given product with a row, from a guess. Corrections begin with the slopes at a point
// nearby, if there are any. Where they have come to an end, or do not shrink, they go on with those at the place that
// they have led to, until the first one with new slopes is small enough.
Branch::Corrected Branch::correct(const BranchPoint &from, const Vector &row, double length, double tolerance,
                                  const Vector &way_to_guess, std::optional<Slopes> slopes) const {
  constexpr int most_linearisations = 6;
  constexpr int most_kept = 12; // corrections with the same matrix
  constexpr double fast = 0.7;  // ratio of corrections for which a matrix is kept
  const Eigen::Index m = from.unknowns.size();
  const double enough = tolerance * std::sqrt(weight_);
  const BranchPoint guess{from.unknowns + way_to_guess.head(m), from.parameter + way_to_guess[m]};
  BranchPoint now = guess;
  std::optional<BroydenCorrections> corrections;
  double contraction = 0, after_linearisation = 1;
  const auto start_corrections = [&] {
    Matrix bordered(m + 1, m + 1);
    bordered << slopes->linear.jacobian, slopes->in_parameter, row.transpose();
    corrections.emplace(bordered.partialPivLu());
  };
  const auto correction = [&](const Vector &residual) {
    Vector all(m + 1);
    all << residual, row.dot(way(from, now)) - length;
    return corrections->next(all);
  };
  const auto place = [&] {
    system_->set_parameters(path_.at(now.parameter));
    system_->fit_tube(now.unknowns);
  };
  const auto move = [&](const Vector &change) {
    if (!change.allFinite() || system_->admissible_step(now.unknowns, change.head(m)) < 1)
      no_convergence();
    now.unknowns += change.head(m);
    now.parameter += change[m];
    place();
  };
  if (system_->admissible_step(from.unknowns, way_to_guess.head(m)) < 1)
    no_convergence();
  place();
  if (slopes)
    start_corrections();
  for (int count = 0; count < most_linearisations; ++count) {
    double before = 1;
    for (int k = 0; corrections && k < most_kept; ++k) {
      spend(control_, work_of_residual, static_cast<double>(system_->nodes()));
      const Vector change = correction(system_->residual(now.unknowns));
      const double moved = std::sqrt(weighted(change, change)), ratio = moved / before;
      if (k == 0 && count == 1)
        contraction = moved / after_linearisation;
      if (k > 0 && !(ratio < fast)) {
        if (k == 1 && count == 0) { // the slopes are of too far away
          now = guess;
          place();
        }
        break;
      }
      move(change);
      if (moved * (k == 0 ? 1 : ratio) < enough)
        break;
      before = moved;
    }
    spend(control_, 1, static_cast<double>(system_->nodes()));
    slopes = Slopes{system_->linearise(now.unknowns), {}};
    slopes->in_parameter = slope_in_parameter(now, slopes->linear);
    start_corrections();
    const Vector change = correction(slopes->linear.residual);
    move(change);
    after_linearisation = std::sqrt(weighted(change, change));
    if (after_linearisation < enough) {
      const Vector direction = corrections->solve(Vector(Vector::Unit(m + 1, m)));
      return {now, direction / std::sqrt(weighted(direction, direction)), std::move(*slopes), contraction};
    }
  }
  no_convergence();
}

// The way to the first guess at a length along the tangent: on the cubic through the last two points along their tangents. A
// straight displacement that rotates parts of the shell stretches them in second order, and a thin shell resists any
// stretch.
Vector Branch::way_to_guess(double step) const {
  if (points_ == 1)
    return step * tangent_;
  const Vector chord = way(before_, point_);
  const double length = weighted(chord, tangent_);
  const Vector earlier = tangent_before_ / weighted(tangent_before_, tangent_);
  const Vector by_points = (tangent_ - chord / length) / length, by_tangents = (tangent_ - earlier) / length;
  return step * tangent_ + step * step * (3 * by_points - by_tangents) +
         step * step * step / length * (2 * by_points - by_tangents);
}

// The nearest of these parameters on the way to another one.
std::optional<double> Branch::first_passed(std::span<const double> stops, double parameter) const {
  std::optional<double> first;
  for (const double stop : stops)
    if (const double part = (stop - point_.parameter) / (parameter - point_.parameter); part > 0 && part <= 1)
      first = parameter = stop;
  return first;
}

// The length, up to a farthest one, at which the guess has a parameter; the farthest one if it does not come there.
double Branch::step_to(double parameter, double farthest) const {
  const auto beyond = [&](double part) {
    const Vector guess = way_to_guess(part * farthest);
    return guess[guess.size() - 1] / (parameter - point_.parameter) - 1;
  };
  const double at_farthest = beyond(1);
  if (!(at_farthest > 0))
    return farthest;
  std::uintmax_t evaluations = 30;
  const auto found = boost::math::tools::toms748_solve(
      beyond, 0.0, 1.0, -1.0, at_farthest, boost::math::tools::eps_tolerance<double>(30), evaluations);
  return (found.first + found.second) / 2 * farthest;
}

void Branch::advance(std::span<const double> stops) {
  constexpr double straight = 0.85; // cosine between neighbouring tangents
  balance();
  const Eigen::Index m = point_.unknowns.size();
  take_step(step_, smallest_step, [&] {
    Vector guess = way_to_guess(step_);
    Corrected next;
    std::optional<double> stop = first_passed(stops, point_.parameter + guess[m]);
    if (!stop) {
      next = correct(point_, row_across(tangent_), step_, steps_.tolerance, guess, slopes_);
      stop = first_passed(stops, next.point.parameter);
    }
    if (stop) {
      guess = way_to_guess(step_to(*stop, step_));
      const double change = guess[m] = *stop - point_.parameter;
      next = correct(point_, std::copysign(1.0, change) * Vector::Unit(m + 1, m), std::abs(change),
                     steps_.tolerance, guess, slopes_);
      next.point.parameter = *stop;
    }
    const Vector taken = way(point_, next.point), miss = taken - guess;
    if (!(weighted(next.tangent, tangent_) > straight) ||
        std::sqrt(weighted(miss, miss)) > steps_.largest_miss * step_)
      return false;
    const double next_step = step_factor(next.contraction) * weighted(taken, tangent_);
    oldest_ = before_;
    before_ = point_;
    tangent_before_ = tangent_;
    ++points_;
    point_ = next.point;
    tangent_ = next.tangent;
    slopes_ = std::move(next.slopes);
    trend_before_ = trend_;
    trend_ = point_.parameter < before_.parameter ? Trend::falls : Trend::grows;
    step_ = std::min(stop ? std::max(step_, next_step) : next_step, steps_.largest);
    return true;
  });
}

// By the slopes at the last point while they do.
BranchPoint Branch::at_parameter(double parameter) const {
  const double back = -weighted(way(before_, point_), tangent_);
  const Vector guess = point_.unknowns + way_to_guess(step_to(parameter, back)).head(point_.unknowns.size());
  system_->set_parameters(path_.at(parameter));
  return {solve_steady(*system_, guess, slopes_->linear.jacobian.partialPivLu()), parameter};
}

double Branch::plain_step() const {
  const auto displacement = tangent_.head(2 * system_->nodes());
  return step_ * std::hypot(displacement.norm() / std::sqrt(static_cast<double>(system_->nodes())),
                            tangent_[tangent_.size() - 1]);
}

void Branch::require_stiffness(double end) const {
  const SoftestPoint softest = system_->softest(point_.unknowns);
  if (!softens(softest))
    return;
  const double stiffness_before = std::max(0.0, system_->softest(before_.unknowns).stiffness);
  const double fall = stiffness_before - softest.stiffness;
  const double part = fall > 0 ? stiffness_before / fall : 0;
  const double onset = before_.parameter + part * (point_.parameter - before_.parameter);
  if (onset < end)
    throw NumericsFailure(failure_kind::softening,
                          fmt::format("{} (from {} on)", softening_text(softest), path_.text(onset)),
                          softening_advice);
}

bool Branch::turned() const {
  return points_ > 1 && trend_ != trend_before_;
}

bool Branch::tangent_has_turned() const {
  return (tangent_[tangent_.size() - 1] > 0) == (trend_ == Trend::grows);
}

double Branch::along_tangent_before(const BranchPoint &at) const {
  return weighted(way(before_, at), tangent_before_);
}

// The curvature with which a parabola from the point before, along its tangent there, ends at a given point.
Vector Branch::bend_towards(const BranchPoint &end) const {
  const double length = along_tangent_before(end);
  return 2 / (length * length) * (way(before_, end) - length * tangent_before_);
}

// The point where the parameter's slope along the arc vanishes. The slope is that of the tangents, or, if these do not
// change sign because the mesh resolves a tip of the shape poorly, a difference of the parameter itself.
BranchPoint Branch::fold() const {
  const double last = along_tangent_before(point_);
  double first = points_ > 2 ? along_tangent_before(oldest_) : -last / 8;
  const double h = 0.03 * std::min(-first, last);
  const Vector bend_after = bend_towards(point_);
  const Vector bend_before = points_ > 2 ? bend_towards(oldest_) : bend_after;
  constexpr double tolerance = 1e-11; // the slope along the arc is as exact as the point
  const Vector row = row_across(tangent_before_);
  Slopes nearby = *slopes_;
  const auto at = [&](double step) {
    Corrected found =
        correct(before_, row, step, tolerance,
                step * tangent_before_ + step * step / 2 * (step < 0 ? bend_before : bend_after), nearby);
    nearby = found.slopes;
    return found;
  };
  const auto by_tangents = [&](double step) {
    const Vector tangent = at(step).tangent;
    return tangent[tangent.size() - 1];
  };
  const auto by_differences = [&](double step) {
    return at(step + h).point.parameter - at(step - h).point.parameter;
  };
  const auto solve = [&](const auto &slope, double begin, double end, double slope_begin, double slope_end) {
    if (!(slope_begin * slope_end < 0)) // noise of a poorly resolved branch
      no_convergence();
    std::uintmax_t evaluations = 30;
    const auto found =
        boost::math::tools::toms748_solve(slope, begin, end, slope_begin, slope_end,
                                          boost::math::tools::eps_tolerance<double>(30), evaluations);
    return at((found.first + found.second) / 2).point;
  };
  double tangent_first = by_tangents(first);
  const double tangent_last = by_tangents(last);
  // The fold may lie before the first point of the branch.
  while (points_ == 2 && tangent_first * tangent_last > 0 && -first < 2 * last) {
    first *= 1.5;
    tangent_first = by_tangents(first);
  }
  return tangent_first * tangent_last < 0 ? solve(by_tangents, first, last, tangent_first, tangent_last)
                                          : solve(by_differences, first + h, last - h,
                                                  by_differences(first + h), by_differences(last - h));
}

BranchPoint Branch::before_fold(const BranchPoint &fold, double parameter) const {
  const BranchPoint &begin = along_tangent_before(fold) > 0 ? before_ : oldest_;
  // Near the fold the parameter falls with the square of the distance.
  const double distance = std::sqrt((fold.parameter - parameter) / (fold.parameter - begin.parameter));
  system_->set_parameters(path_.at(parameter));
  return {solve_steady(*system_, fold.unknowns + distance * (begin.unknowns - fold.unknowns)), parameter};
}

} // namespace capsule
