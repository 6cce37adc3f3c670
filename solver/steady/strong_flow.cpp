#include "steady/strong_flow.hpp"
#include "case/key_path.hpp"
#include "case/keys.hpp"
#include "steady/fold_curve.hpp"
#include "steady/fold_error.hpp"
#include "steady/relaxation.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <string>
#include <utility>

namespace capsule {
namespace {

constexpr double safe = 3; // times the last slope of a fold that bounds what it may still do
constexpr int finest =
    120; // nodes on which a fold is followed: a soft membrane may need more than are worth their time

// A fold on its way from a stiff membrane to the case's.
struct FollowedFold {
  double flow = 0, bending = 0;
  double slope = 0; // d flow/d log(bending), 0 before the first step
  std::string text; // of the flow
};

// How far the fold may still move until the membrane is as thin as the case's, if it moves up to so many times as fast as last.
double change_left(const FollowedFold &fold, double thin, double times) {
  constexpr double unknown_change = 0.5; // of the flow
  if (fold.bending == thin)
    return 0;
  return fold.slope == 0 ? unknown_change * fold.flow
                         : times * std::abs(fold.slope * std::log(thin / fold.bending));
}

// A softer membrane's fold lies at a weaker flow, by less than a third in all capsules that were followed to the end
// (paper-notes/methods.md).
bool proves(const FollowedFold &fold, double thin, double flow) {
  return fold.flow + change_left(fold, thin, fold.slope < 0 ? safe : 1) <= flow;
}

// Thrown where it need not be followed any farther.
struct Proven {};

// The fold of a membrane as thin as the case's, whose state has its parameters.
std::string text_of(const SteadyState &fold, const KeyPath &stronger) {
  const double part = stronger.part(number(stronger.key(), fold.system->input()));
  return stronger.fold_text(part, error_of_fold(fold, stronger.key()));
}

// Follows it, from parts of both keys' ways, as far as the nodes can resolve it; on many nodes only until it proves that the
// flow at the end of `stronger` is too strong.
FollowedFold follow_to(const KeyPath &softer, double softer_part, const KeyPath &stronger,
                       double stronger_part, Homotopy::Fold fold, const Control &control) {
  constexpr Eigen::Index many = 100;  // nodes, on which a point takes long
  constexpr double near_enough = 0.2; // part of the fold's flow
  FollowedFold now{.flow = stronger.value(stronger_part),
                   .bending = softer.value(softer_part),
                   .text = stronger.fold_text(stronger_part)};
  const double thin = softer.value(1);
  try {
    if (softer.needed())
      follow_fold(fold.state, {fold.state.unknowns, stronger_part, softer_part},
                  fold.tangent.head(fold.state.unknowns.size()), stronger, softer, finest, control,
                  [&](const SteadyState &state, const FoldPoint &point) {
                    const double before = std::exchange(now.flow, stronger.value(point.part));
                    const double stiffer = std::exchange(now.bending, softer.value(point.second_part));
                    now.text = stronger.fold_text(point.part);
                    if (now.bending < stiffer)
                      now.slope = (now.flow - before) / std::log(now.bending / stiffer);
                    if (state.system->nodes() >= many && now.slope != 0 &&
                        proves(now, thin, stronger.value(1)) &&
                        change_left(now, thin, safe) < near_enough * now.flow)
                      throw Proven{};
                  });
  } catch (const Proven &) {
  } catch (const NumericsFailure &) { // this is how far it could be followed
  }
  if (now.bending == thin)
    now.text = text_of(fold.state, stronger);
  return now;
}

NumericsFailure too_strong(const FollowedFold &fold, double thin) {
  const std::string place =
      fold.bending == thin
          ? "at " + fold.text
          : fmt::format("near {} for {} = {:.2g}; it lies within {:.0f} % of that", fold.text, bending_key,
                        fold.bending, std::ceil(100 * change_left(fold, thin, safe) / fold.flow));
  return no_steady_state({failure_kind::fold, "fold " + place, "stay on the near side of it"});
}

// The state of a stiff membrane in the case's flow, as the membrane gets softer.
std::optional<SteadyState> made_softer(const Case &input, const Case &stiff, const SteadyState &state,
                                       const KeyPath &softer, const KeyPath &stronger,
                                       const Control &control) {
  const double thin = softer.value(1);
  Homotopy homotopy(input, stiff, state);
  try {
    homotopy.vary(bending_key, thin, control);
    homotopy.vary(bending_key, input.membrane.bending_ratio, control);
    return homotopy.state();
  } catch (const NumericsFailure &failure) {
    if (failure.kind == failure_kind::fold)
      throw too_strong(follow_to(softer, homotopy.fold().part, stronger, 1, homotopy.fold(), control), thin);
  }
  return {};
}

} // namespace

bool ends_branch(const NumericsFailure &failure) {
  return failure.kind == failure_kind::fold || failure.kind == failure_kind::softening;
}

NumericsFailure no_steady_state(const NumericsFailure &end) {
  const char *none =
      end.kind == failure_kind::softening ? "no steady state that a mesh resolves" : "no steady state";
  return {end.kind, fmt::format("{}: {}", none, end.what()), end.advice};
}

std::optional<SteadyState> by_stiff_membrane(const Case &input, const Control &control) {
  const double flow = input.flow.capillary_number;
  const double thin = std::max(input.membrane.bending_ratio, thinnest);
  Case stiff = with_stiff_membrane(input);
  if (stiff.mesh.membrane == 0)
    stiff.mesh.membrane = finest;
  Case weaker = stiff;
  double &start = weaker.flow.capillary_number;
  do { // until it comes to rest
    start = start > weak_flow ? start / 4 : start;
    const KeyPath stronger(flow_key, weaker, flow), softer(bending_key, weaker, thin);
    std::optional<Homotopy> homotopy;
    try {
      homotopy.emplace(stiff, weaker, let_loose(weaker, control));
      homotopy->vary(flow_key, flow, control);
    } catch (const NumericsFailure &failure) {
      if (!homotopy || !ends_branch(failure))
        continue;
      if (failure.kind == failure_kind::softening)
        throw;
      if (const auto fold = follow_to(softer, 0, stronger, homotopy->fold().part, homotopy->fold(), control);
          proves(fold, thin, flow))
        throw too_strong(fold, thin);
      return {};
    }
    return made_softer(input, stiff, homotopy->state(), softer, stronger, control);
  } while (start > weak_flow);
  return {};
}

void throw_if_too_strong(const Homotopy &homotopy, const Case &input, const Control &control) {
  const double flow = input.flow.capillary_number, thin = input.membrane.bending_ratio;
  const KeyPath softer(bending_key, homotopy.reached(), thin), stronger(flow_key, homotopy.reached(), flow);
  const FollowedFold fold = follow_to(softer, homotopy.fold().part, stronger, 0, homotopy.fold(), control);
  if (proves(fold, thin, flow))
    throw too_strong(fold, thin);
}

} // namespace capsule
