#include "fit/fitted_states.hpp"
#include "base/failure.hpp"
#include "case/case.hpp"
#include "case/key_path.hpp"
#include "case/keys.hpp"
#include "case/physical.hpp"
#include "geometry/node_density.hpp"
#include "steady/newton.hpp"
#include "steady/slopes.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numbers>

namespace capsule {
namespace {

// A state that is further from where it was expected is another one.
constexpr double farthest = 0.2;

} // namespace

FittedStates::FittedStates(Case input, std::vector<std::string> keys, std::span<const Contour> contours)
    : input_(std::move(input)), keys_(std::move(keys)), contours_(contours.begin(), contours.end()) {
  flow_key_ = static_cast<std::size_t>(std::ranges::find(keys_, flow_key) - keys_.begin());
  std::size_t velocities = 0;
  flows_known_ = true;
  for (std::size_t k = 0; k < contours_.size(); ++k) {
    flows_known_ = flows_known_ && flow_rate(k);
    velocities += velocity(k) ? 1 : 0;
  }
  const bool separate = contours_.size() > 1 && !flows_known_ && flow_key_ < keys_.size();
  const auto count = std::ssize(contours_);
  places_ = std::ssize(keys_) + (separate ? count - 1 : 0);
  const bool scaled = !flows_known_ && velocities > 1 && has_physical(input_);
  size_ = places_ + count + (scaled ? 1 : 0);
  scale_ = scaled ? size_ - 1 : -1;
  velocity_rows_ =
      flows_known_ || scaled || !has_physical(input_) ? static_cast<Eigen::Index>(velocities) : 0;
}

std::optional<double> FittedStates::flow_rate(std::size_t contour) const {
  if (contours_[contour].flow_rate)
    return contours_[contour].flow_rate;
  const double of_case = input_.physical.flow_rate.si;
  return has_physical(input_) && of_case > 0 && contours_.size() == 1 ? std::optional(of_case)
         : !has_physical(input_) && contours_.size() == 1             ? std::optional(1.0)
                                                                      : std::nullopt;
}

std::optional<double> FittedStates::velocity(std::size_t contour) const {
  const double of_case = input_.physical.capsule_velocity.si;
  return contours_[contour].velocity            ? contours_[contour].velocity
         : contours_.size() == 1 && of_case > 0 ? std::optional(of_case)
                                                : std::nullopt;
}

Eigen::Index FittedStates::parameter(std::size_t contour, std::size_t key) const {
  const bool own = key == flow_key_ && contour > 0 && places_ > std::ssize(keys_);
  return own ? std::ssize(keys_) + static_cast<Eigen::Index>(contour) - 1 : static_cast<Eigen::Index>(key);
}

double FittedStates::factor(std::size_t contour, std::size_t key) const {
  return key == flow_key_ && flows_known_ && contour > 0 ? *flow_rate(contour) / *flow_rate(0) : 1;
}

double FittedStates::value(const Vector &parameters, std::size_t contour, std::size_t key) const {
  return factor(contour, key) * parameters[parameter(contour, key)];
}

std::vector<std::string> FittedStates::names() const {
  std::vector<std::string> names = keys_;
  for (std::size_t k = 1; std::ssize(names) < places_; ++k)
    names.push_back(fmt::format("{}#{}", flow_key, k + 1));
  for (std::size_t k = 0; k < contours_.size(); ++k)
    names.push_back(fmt::format("place#{}", k + 1));
  if (scale_ >= 0)
    names.emplace_back("ln(viscosity/shear_modulus)");
  return names;
}

Eigen::Index FittedStates::points() const {
  Eigen::Index count = 0;
  for (const Contour &contour : contours_)
    count += contour.x.size() + (contour.rear_pole_x ? 1 : 0);
  return count;
}

Vector FittedStates::begin_with(const SteadyState &state) {
  const auto count = std::ssize(keys_);
  kept_.clear();
  Vector parameters = Vector::Zero(size_), values(count);
  for (Eigen::Index j = 0; j < count; ++j)
    values[j] = number(keys_[static_cast<std::size_t>(j)], state.system->input());
  parameters.head(count) = values;
  const Matrix slopes = sensitivities(*state.system, state.unknowns, keys_);
  const DenseMeridian dense = dense_meridian(state.system->membrane().basis);
  const Outline outline(dense, state.unknowns.head(2 * state.system->nodes()), input_.fit.outline);
  anchors_.clear();
  for (std::size_t k = 0; k < contours_.size(); ++k) {
    anchors_.push_back(
        {{std::make_shared<SteadySystem>(*state.system), state.unknowns}, values, slopes, dense});
    if (flow_key_ < keys_.size() && parameter(k, flow_key_) >= count)
      parameters[parameter(k, flow_key_)] = values[static_cast<Eigen::Index>(flow_key_)];
    parameters[place(k)] = contours_[k].x.maxCoeff() - outline.front_x();
  }
  if (scale_ >= 0)
    parameters[scale_] = std::log(number(flow_key, state.system->input()) *
                                  state.unknowns[2 * state.system->nodes()] / velocity(0).value_or(1));
  return parameters;
}

void FittedStates::change_mesh(int nodes, const Control &control) {
  std::vector<Anchor> finer;
  for (const Anchor &anchor : anchors_) {
    const SteadyState state = on_mesh(anchor.state.system->input(), nodes, anchor.state, control);
    finer.push_back({state, anchor.values, sensitivities(*state.system, state.unknowns, keys_),
                     dense_meridian(state.system->membrane().basis)});
  }
  anchors_ = std::move(finer);
  kept_.clear();
}

double FittedStates::unresolved() const {
  double largest = 0;
  for (const Anchor &anchor : anchors_) {
    const SteadySystem &system = *anchor.state.system;
    largest = std::max(
        largest, unresolved_part(system.membrane().basis, anchor.state.unknowns.head(2 * system.nodes())));
  }
  return largest;
}

Case FittedStates::case_with(const Vector &values) const {
  Case input = input_;
  for (std::size_t j = 0; j < keys_.size(); ++j)
    input = with_number(std::move(input), keys_[j], values[static_cast<Eigen::Index>(j)]);
  return input;
}

// A system has the parameters of the last state that was found with it.
void FittedStates::return_to(const std::vector<Anchor> &anchors) {
  anchors_ = anchors;
  for (const Anchor &anchor : anchors_)
    anchor.state.system->set_parameters(case_with(anchor.values));
}

Residuals FittedStates::evaluate(const Vector &parameters) {
  try {
    return evaluate_from(anchors_, parameters);
  } catch (const NumericsFailure &) {
    if (kept_.empty())
      throw;
    return evaluate_from(kept_, parameters);
  }
}

Residuals FittedStates::evaluate_from(const std::vector<Anchor> &anchors, const Vector &parameters) {
  const auto count = std::ssize(keys_);
  std::vector<Anchor> found;
  Residuals result{Vector::Zero(points() + velocity_rows_), Matrix::Zero(points() + velocity_rows_, size_)};
  Eigen::Index row = 0, velocity_row = points();
  for (std::size_t k = 0; k < contours_.size(); ++k) {
    const Anchor &anchor = anchors[k];
    SteadySystem &system = *anchor.state.system;
    const Eigen::Index n = system.nodes();
    Vector values(count);
    for (Eigen::Index j = 0; j < count; ++j)
      values[j] = value(parameters, k, static_cast<std::size_t>(j));
    const Case here = case_with(values);
    const Vector expected = anchor.state.unknowns + anchor.sensitivities * (values - anchor.values);
    const Case before = system.input();
    system.set_parameters(here);
    Vector unknowns;
    Matrix slopes;
    try {
      unknowns = solve_steady(system, expected);
      if ((unknowns - expected).head(2 * n).cwiseAbs().maxCoeff() > farthest)
        throw NumericsFailure(failure_kind::unresolved, "no steady state near the one before", "");
      slopes = sensitivities(system, unknowns, keys_);
    } catch (...) {
      system.set_parameters(before);
      throw;
    }
    found.push_back({{anchor.state.system, unknowns}, values, slopes, anchor.dense});

    const Matrix x_slopes = anchor.dense.even[0] * slopes.topRows(n);
    const Matrix r_slopes = anchor.dense.odd[0] * slopes.middleRows(n, n);
    const Outline outline(anchor.dense, unknowns.head(2 * n), input_.fit.outline);
    const Contour &contour = contours_[k];
    const double shift = parameters[place(k)];
    const auto add = [&](double residual, const Vector &along_keys, double along_place) {
      result.values[row] = residual / noise_;
      for (Eigen::Index j = 0; j < count; ++j) {
        const auto key = static_cast<std::size_t>(j);
        result.slopes(row, parameter(k, key)) += factor(k, key) * along_keys[j] / noise_;
      }
      result.slopes(row++, place(k)) = along_place / noise_;
    };
    for (Eigen::Index i = 0; i < contour.x.size(); ++i) {
      const Foot foot = outline.foot(contour.x[i] - shift, contour.r[i]);
      const auto moved = moved_at(x_slopes, r_slopes, foot.at);
      add(foot.distance, -(foot.normal_x * moved.row(0) + foot.normal_r * moved.row(1)).transpose(),
          -foot.normal_x);
    }
    if (contour.rear_pole_x)
      add(*contour.rear_pole_x - shift - outline.rear_pole_x(), -x_slopes.row(0).transpose(), -1);
    if (velocity_rows_ == 0 || !velocity(k))
      continue;
    const double speed = unknowns[2 * n];
    const Vector speed_slopes = slopes.row(2 * n).transpose() / speed; // of its logarithm
    double residual = std::log(speed / *velocity(k));
    const auto slope_of = [&](Eigen::Index j) -> double & { return result.slopes(velocity_row, j); };
    for (Eigen::Index j = 0; j < count; ++j) {
      const auto key = static_cast<std::size_t>(j);
      slope_of(parameter(k, key)) += factor(k, key) * speed_slopes[j] / velocity_noise();
    }
    if (scale_ >= 0) {
      const double flow = here.flow.capillary_number;
      residual += std::log(flow) - parameters[scale_];
      slope_of(scale_) -= 1 / velocity_noise();
      if (flow_key_ < keys_.size())
        slope_of(parameter(k, flow_key_)) += factor(k, flow_key_) / flow / velocity_noise();
    } else if (has_physical(input_))
      residual += std::log(*flow_rate(k) / (std::numbers::pi * std::pow(input_.physical.tube_radius.si, 2)));
    result.values[velocity_row++] = residual / velocity_noise();
  }
  anchors_ = std::move(found);
  return result;
}

std::optional<FittedStates::Modulus> FittedStates::modulus(const Vector &parameters) const {
  const auto &p = input_.physical;
  const bool by_flow = flow_rate(0).has_value();
  if (!has_physical(input_) || flow_key_ == keys_.size() || (!by_flow && !velocity(0)))
    return std::nullopt;
  const Anchor &anchor = anchors_.front();
  const double flow = parameters[static_cast<Eigen::Index>(flow_key_)];
  Modulus modulus{0, Vector::Zero(size_), !by_flow};
  if (by_flow) {
    modulus.logarithm =
        std::log(p.viscosity.si * *flow_rate(0) / (std::numbers::pi * std::pow(p.tube_radius.si, 2) * flow));
    modulus.slopes[static_cast<Eigen::Index>(flow_key_)] = -1 / flow;
  } else if (scale_ >= 0) {
    modulus.logarithm = std::log(p.viscosity.si) - parameters[scale_];
    modulus.slopes[scale_] = -1;
  } else {
    const Eigen::Index speed = 2 * anchor.state.system->nodes();
    modulus.logarithm = std::log(p.viscosity.si * *velocity(0) / (flow * anchor.state.unknowns[speed]));
    modulus.slopes.head(std::ssize(keys_)) =
        -anchor.sensitivities.row(speed).transpose() / anchor.state.unknowns[speed];
    modulus.slopes[static_cast<Eigen::Index>(flow_key_)] -= 1 / flow;
  }
  return modulus;
}

std::vector<Foot> FittedStates::feet(const Vector &parameters, std::size_t contour) const {
  const Anchor &anchor = anchors_[contour];
  const double shift = parameters[place(contour)];
  const Outline outline(anchor.dense, anchor.state.unknowns.head(2 * anchor.state.system->nodes()),
                        input_.fit.outline);
  std::vector<Foot> feet;
  for (Eigen::Index i = 0; i < contours_[contour].x.size(); ++i) {
    feet.push_back(outline.foot(contours_[contour].x[i] - shift, contours_[contour].r[i]));
    feet.back().x += shift;
  }
  return feet;
}

} // namespace capsule
