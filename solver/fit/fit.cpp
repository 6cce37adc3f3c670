#include "fit/fit.hpp"
#include "base/failure.hpp"
#include "case/case.hpp"
#include "case/key_path.hpp"
#include "case/keys.hpp"
#include "fit/fit_checks.hpp"
#include "fit/profile_likelihood.hpp"
#include "steady/steady_state.hpp"
#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>

namespace capsule {
namespace {

constexpr const char *radius_key = "capsule.radius";
constexpr const char *inflation_key = "capsule.inflation";
constexpr double some_inflation = 0.03;
constexpr double normal_95 = 1.6449; // quantile of the standard normal distribution
constexpr double growth_90 = normal_95 * normal_95;
constexpr double correlated = 0.97;

bool contains(const std::vector<std::string> &keys, const std::string &key) {
  return std::ranges::find(keys, key) != keys.end();
}

// Of a parameter "key#2" of the second contour: its key.
std::string base_name(const std::string &name) {
  return name.substr(0, name.find('#'));
}

// Bounds of a key: those of the case within its range.
std::pair<double, double> bounds_of(const Case &input, const std::string &key) {
  double low = -1e9, high = 1e9;
  const Range &range = find_key(key)->range;
  const double inside = key == flow_key ? 1e-6 : 1e-4; // of a range without its ends
  low = std::max(low, range.low + (range.low_allowed ? 0 : inside));
  high = std::min(high, range.high - (range.high_allowed ? 0 : inside));
  if (const auto given = input.fit.bounds.find(key);
      given != input.fit.bounds.end() && !given->second.empty()) {
    low = std::max(low, given->second.front());
    high = std::min(high, given->second.back());
  }
  return {low, high};
}

// One law's fit while it is made.
class LawFit {
public:
  LawFit(const Case &input, std::span<const Contour> contours, const Law &law, const Control &control)
      : input_(input), control_(control) {
    input_.membrane.law.choose(law);
    for (const std::string &key : input.fit.unknowns)
      if (means_something(*find_key(key), input_))
        keys_.push_back(key);
    states_.emplace(input_, keys_, contours);
    if (input.fit.noise)
      states_->set_noise(*input.fit.noise);
  }

  void begin(const FitStarts &starts) {
    const auto found = starts.find(input_.membrane.law.law().name);
    bool done = false;
    if (found != starts.end())
      try {
        const Vector start = begin_at(found->second.first);
        search(start);
        done = minimum_.converged;
      } catch (const NumericsFailure &) { // from nothing, then
      }
    if (!done)
      from_nothing();
    if (!input_.fit.noise)
      estimate_noise();
  }

  // Finer meshes as long as the shapes' error is not far below the noise.
  void settle() {
    constexpr double part = 1e-3, smallest = 1e-9;
    for (int nodes = finer_mesh(states_->nodes());
         nodes < most_nodes && states_->unresolved() > std::max(part * states_->noise(), smallest);
         nodes = finer_mesh(nodes)) {
      states_->change_mesh(nodes, control_);
      minimum_ = minimise(problem_, minimum_.parameters);
      if (!input_.fit.noise)
        estimate_noise();
    }
  }

  const Minimum &minimum() const { return minimum_; }
  FittedStates &states() { return *states_; }
  const LeastSquares &problem() const { return problem_; }
  const std::vector<std::string> &keys() const { return keys_; }

private:
  // A state with the contour's volume in a flow of this strength.
  Case first_case(double flow) const {
    Case first = input_;
    const ContourSize size = size_of(states_->contours().front());
    if (contains(keys_, radius_key)) {
      const auto [low, high] = bounds_of(input_, radius_key);
      first.capsule.radius = std::clamp(size.radius, low, high);
    }
    if (contains(keys_, flow_key)) {
      const auto [low, high] = bounds_of(input_, flow_key);
      first.flow.capillary_number = std::clamp(flow, low, high);
    }
    if (contains(keys_, inflation_key) && input_.capsule.inflation == 0)
      first.capsule.inflation = some_inflation; // a membrane under tension does not fold
    for (const std::string &key : keys_) {
      const auto [low, high] = bounds_of(input_, key);
      first = with_number(first, key, std::clamp(number(key, first), low, high));
    }
    return first;
  }

  Vector begin_at(const SteadyState &state) {
    Vector start = states_->begin_with(state);
    make_problem(start);
    return start;
  }

  void make_problem(const Vector &start) {
    const Eigen::Index size = start.size();
    problem_.low = Vector::Constant(size, -1e9);
    problem_.high = Vector::Constant(size, 1e9);
    problem_.longest = Vector::Constant(size, 0.5);
    const std::vector<std::string> names = states_->names();
    for (Eigen::Index j = 0; j < size; ++j) {
      const std::string &key = names[static_cast<std::size_t>(j)];
      const std::string base = base_name(key);
      if (find_key(base) == nullptr)
        continue;
      std::tie(problem_.low[j], problem_.high[j]) = bounds_of(input_, base);
      constexpr double longest = 0.3;
      problem_.longest[j] = base == flow_key     ? longest * start[j]
                            : base == radius_key ? 0.03
                                                 : longest * std::max(0.2, natural_size(base, start[j]));
      if (base == inflation_key)
        problem_.longest[j] = 0.03;
    }
    problem_.evaluate = [this](const Vector &parameters) {
      throw_if_interrupted(control_);
      return states_->evaluate(parameters);
    };
  }

  // Where a shape gets too sharp for its mesh, Newton's method fails before there is no state: on finer meshes, then.
  void search(const Vector &start) {
    constexpr int most_to_search_on = 120;
    minimum_ = minimise(problem_, start);
    for (int nodes = finer_mesh(states_->nodes()); !minimum_.failure.empty() && nodes < most_to_search_on;
         nodes = finer_mesh(nodes)) {
      states_->change_mesh(nodes, control_);
      minimum_ = minimise(problem_, minimum_.parameters);
    }
  }

  void from_nothing() {
    std::optional<Minimum> best;
    std::vector<FittedStates::Anchor> anchors;
    std::optional<NumericsFailure> last;
    for (const double flow : {0.04, 0.015, 0.1}) {
      try {
        throw_if_interrupted(control_);
        const Case first = first_case(flow);
        search(begin_at(on_mesh(first, first_nodes, find_steady(first, {}, control_), control_)));
        if (!best || minimum_.sum() < best->sum()) {
          best = minimum_;
          anchors = states_->anchors();
        }
        if (minimum_.failure.empty())
          break;
      } catch (const NumericsFailure &failure) {
        last = failure;
      }
      if (!contains(keys_, flow_key))
        break;
    }
    if (!best)
      throw NumericsFailure(*last);
    minimum_ = *best;
    states_->return_to(anchors);
  }

  void estimate_noise() {
    const Eigen::Index points = states_->points();
    const double sum = minimum_.at.values.head(points).squaredNorm();
    const auto free = points - minimum_.parameters.size();
    const double ratio =
        std::max(std::sqrt(sum / static_cast<double>(std::max<Eigen::Index>(free, 1))), 1e-12);
    states_->set_noise(ratio * states_->noise());
    minimum_.at.values.head(points) /= ratio;
    minimum_.at.slopes.topRows(points) /= ratio;
    if (states_->has_velocities())
      minimum_ = minimise(problem_, minimum_.parameters);
  }

  Case input_;
  const Control &control_;
  std::vector<std::string> keys_;
  std::optional<FittedStates> states_;
  LeastSquares problem_;
  Minimum minimum_;
};

Candidate candidate_of(LawFit &fit, const std::string &law, bool noise_given) {
  const Minimum &minimum = fit.minimum();
  FittedStates &states = fit.states();
  const auto rows = minimum.at.values.size();
  Candidate candidate{law, states.names(), minimum.parameters, 0, 0, rows, 0, 0, ""};
  const auto n = static_cast<double>(states.points());
  const double points = minimum.at.values.head(states.points()).squaredNorm();
  candidate.residual = states.noise() * std::sqrt(points / n);
  candidate.chi_squared = minimum.sum();
  const double rest = minimum.sum() - points; // of velocities
  candidate.aic = (noise_given ? points : n * std::log(candidate.residual * candidate.residual)) + rest +
                  2 * static_cast<double>(minimum.parameters.size());
  if (!minimum.converged && !minimum.failure.empty())
    candidate.failure = "the search ends where no steady state is found: " + minimum.failure;
  return candidate;
}

std::string interval_text(const Reach &low, const Reach &high) {
  return fmt::format("{:.4g} to {:.4g}", low.value, high.value);
}

// Values with their errors, and what cannot be told.
void describe(LawFit &fit, FitResult &result) {
  const Minimum &minimum = fit.minimum();
  FittedStates &states = fit.states();
  const LeastSquares &problem = fit.problem();
  const Matrix errors = covariance(problem, minimum.at);
  const std::vector<std::string> names = states.names();
  std::vector<Eigen::Index> told;
  for (Eigen::Index j = 0; j < std::ssize(names); ++j)
    if (!names[static_cast<std::size_t>(j)].starts_with("place"))
      told.push_back(j);
  const std::vector<FittedStates::Anchor> anchors = states.anchors();
  states.keep_anchors();
  for (const Eigen::Index j : told) {
    FittedValue value{names[static_cast<std::size_t>(j)], minimum.parameters[j], std::sqrt(errors(j, j))};
    const Reach low = reach(problem, minimum, errors, j, -1, growth_90);
    states.return_to(anchors);
    const Reach high = reach(problem, minimum, errors, j, 1, growth_90);
    states.return_to(anchors);
    value.low = low.value;
    value.high = high.value;
    value.low_is_open = low.open;
    value.high_is_open = high.open;
    for (const Reach &end : {low, high})
      if (end.open && !end.at_bound)
        result.warnings.push_back(fmt::format(
            "{}: {} {:.4g} {}; the interval {} is open there", value.name, end.at_end ? "beyond" : "up to",
            end.value, end.at_end ? "no steady state is found" : "the fit gets hardly worse",
            interval_text(low, high)));
    result.values.push_back(value);
  }
  const Matrix part = errors(told, told);
  const Vector deviations = part.diagonal().cwiseSqrt();
  result.correlations =
      deviations.cwiseInverse().asDiagonal() * part * deviations.cwiseInverse().asDiagonal();
  const auto at_bounds = held(problem, minimum);
  for (std::size_t i = 0; i < told.size(); ++i) {
    if (at_bounds[told[i]])
      result.warnings.push_back(fmt::format(
          "{} = {:.4g} is at {}", result.values[i].name, result.values[i].value,
          states.input().fit.bounds.contains(base_name(result.values[i].name)) ? "its bound"
                                                                               : "the end of its range"));
    for (std::size_t k = 0; k < i; ++k)
      if (const double r = result.correlations(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k));
          std::abs(r) > correlated)
        result.warnings.push_back(
            fmt::format("{} and {} are correlated {:.3f}: one contour hardly tells them apart; give the "
                        "velocity of the capsule, or contours at other flow rates with --together",
                        result.values[k].name, result.values[i].name, r));
  }
  if (const auto modulus = states.modulus(minimum.parameters)) {
    const double own = modulus->of_velocity ? states.input().fit.velocity_noise.value_or(0.01) : 0;
    const double relative = std::sqrt(modulus->slopes.dot(errors * modulus->slopes) + own * own);
    const double value = std::exp(modulus->logarithm);
    FittedValue shear{"physical.shear_modulus", value, value * relative,
                      value * std::exp(-normal_95 * relative), value * std::exp(normal_95 * relative)};
    for (const FittedValue &flow : result.values)
      if (flow.name == flow_key && !modulus->of_velocity) { // G is inversely proportional to it
        shear.low = value * flow.value / flow.high;
        shear.high = value * flow.value / flow.low;
        shear.low_is_open = flow.high_is_open;
        shear.high_is_open = flow.low_is_open;
      }
    result.values.push_back(shear);
  }
  const double scale = states.input().physical.tube_radius.si;
  for (std::size_t i = 0; scale > 0 && i < told.size(); ++i)
    if (const FittedValue radius = result.values[i]; radius.name == radius_key)
      result.values.push_back({"physical.capsule_radius", scale * radius.value, scale * radius.standard_error,
                               scale * radius.low, scale * radius.high, radius.low_is_open,
                               radius.high_is_open});
  for (std::size_t k = 0; k < states.contours().size(); ++k) {
    const auto &anchor = states.anchors()[k];
    result.contours.push_back({minimum.parameters[states.place(k)],
                               anchor.state.system->input().flow.capillary_number, anchor.state,
                               states.feet(minimum.parameters, k)});
  }
}

} // namespace

FitResult fit_contours(const Case &input, std::span<const Contour> contours, FitStarts &starts,
                       const Control &control) {
  std::vector<const Law *> candidates;
  for (const Law *law : laws())
    if (input.fit.laws.empty() ? &input.membrane.law.law() == law : contains(input.fit.laws, law->name))
      candidates.push_back(law);
  FitResult result;
  result.noise_is_given = input.fit.noise.has_value();
  std::map<std::string, LawFit> fits;
  FitStarts found;
  std::optional<NumericsFailure> failure;
  for (const Law *law : candidates) {
    const auto entry = fits.try_emplace(law->name, input, contours, *law, control).first;
    try {
      entry->second.begin(starts);
      result.candidates.push_back(candidate_of(entry->second, law->name, result.noise_is_given));
      found.emplace(law->name, std::pair(entry->second.states().anchors().front().state,
                                         entry->second.minimum().parameters));
    } catch (const NumericsFailure &why) {
      failure = why;
      result.candidates.push_back({.law = law->name, .names = {}, .parameters = {}, .failure = why.what()});
    }
  }
  std::ranges::stable_sort(result.candidates, {},
                           [](const Candidate &c) { return std::pair(!c.failure.empty(), c.aic); });
  Candidate &best = result.candidates.front();
  if (!best.failure.empty())
    throw NumericsFailure(failure ? failure->kind : failure_kind::unresolved, "no fit: " + best.failure,
                          "try other laws or bounds, or a smaller set of unknowns");
  for (Candidate &candidate : result.candidates)
    if (candidate.failure.empty())
      candidate.evidence_ratio = std::exp((best.aic - candidate.aic) / 2);
  LawFit &fit = fits.at(best.law);
  refuse_other_shapes(fit.states(), fit.minimum());
  fit.settle();
  // The evidence stays that of meshes on which no law was better resolved than the others.
  const Candidate settled = candidate_of(fit, best.law, result.noise_is_given);
  best.parameters = settled.parameters;
  best.residual = settled.residual;
  best.chi_squared = settled.chi_squared;
  found.insert_or_assign(best.law, std::pair(fit.states().anchors().front().state, fit.minimum().parameters));
  result.law = best.law;
  result.noise = fit.states().noise();
  result.residual = best.residual;
  result.chi_squared = best.chi_squared;
  result.degrees_of_freedom = best.rows - best.parameters.size();
  describe(fit, result);
  warn_of_noise(result);
  warn_of_runs(result, contours);
  warn_of_velocities(result, fit.states(), fit.minimum());
  warn_of_rivals(result);
  for (const Candidate &candidate : result.candidates)
    if (candidate.failure.empty() && !fits.at(candidate.law).minimum().converged)
      result.warnings.push_back(fmt::format(
          "{}: the search ended before its minimum; values and errors may be wrong: give narrower "
          "fit.bounds or fewer unknowns",
          candidate.law));
  starts = std::move(found);
  return result;
}

} // namespace capsule
