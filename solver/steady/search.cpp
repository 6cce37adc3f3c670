#include "steady/search.hpp"
#include "base/failure.hpp"
#include "case/key_path.hpp"
#include "case/keys.hpp"
#include "steady/fold_curve.hpp"
#include "steady/from_profile.hpp"
#include "steady/growth_rates.hpp"
#include "steady/homotopy.hpp"
#include "steady/newton.hpp"
#include "steady/relaxation.hpp"
#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace capsule {
namespace {

// Where the homotopy begins, unless the case has less: a weaker flow, a smaller capsule, a stiffer shell.
constexpr double weak_flow = 5e-3;
constexpr double small_radius = 0.6;
constexpr double stiff_bending = 2e-2; // a shell that does not buckle
// The capsule relaxes with this one. Softer shells buckle on the way to a shape that does not.
constexpr double bending_to_relax = 1e-2;
constexpr int most_to_relax_on = 70; // nodes
constexpr double thinnest = 1e-7;    // from here on the case's own is near enough
// The membrane relaxes with a modulus of area up to this one. Stiffer ones would need steps that are too short.
constexpr std::array area_keys{"membrane.dilatation", "membrane.area_modulus"};
constexpr double area_modulus_to_relax = 100;

// A small stiff sphere in a weak flow.
Homotopy from_a_stiff_sphere(const Case &target, const Control &control) {
  Case begin = target;
  begin.flow.capillary_number = std::min(weak_flow, target.flow.capillary_number);
  begin.capsule.aspect_ratio = 1;
  begin.membrane.bending_ratio = std::max(stiff_bending, target.membrane.bending_ratio);
  if (target.pore.shape != PoreShape::none)
    begin.capsule.radius = std::min(small_radius, target.capsule.radius);
  const auto system = first_system(begin);
  return {target, begin, {system, solve_steady(*system, system->initial())}, control};
}

Case with_stiff_membrane(Case input) {
  input.membrane.bending_ratio = std::max(bending_to_relax, input.membrane.bending_ratio);
  return input;
}

// The capsule let loose in the tube: undeformed, or squeezed if it is wider than that.
SteadyState let_loose(const Case &input, const Control &control) {
  constexpr double widest = 0.85;
  SteadyState state{first_system(input), {}};
  Vector shape = state.system->initial();
  if (state.system->pore()) {
    const Eigen::Index n = state.system->nodes();
    const double squeeze = std::min(1.0, widest / shape.segment(n, n).maxCoeff());
    shape.segment(n, n) *= squeeze;
    shape.head(n) /= squeeze * squeeze;
  }
  state.unknowns = relaxed(*state.system, shape, control);
  return state;
}

// A state on so many nodes: by Newton's method, or if it does not get there from rest to rest.
SteadyState relaxed_on_mesh(const Case &input, int nodes, const SteadyState &state, const Control &control) {
  try {
    return on_mesh(input, nodes, state, control);
  } catch (const NumericsFailure &) {
    SteadyState moved = moved_to_mesh(input, nodes, state);
    moved.unknowns = solve_steady(*moved.system, relaxed(*moved.system, moved.unknowns, control));
    return moved;
  }
}

// The capsule itself, but for a stiff membrane, let loose in the tube. Then the membrane is softened in stages, on a finer
// mesh if it folds more than this one can show.
SteadyState by_relaxation(const Case &target, const Control &control) {
  constexpr double stage = 10;
  Case now = with_stiff_membrane(target);
  const double &bending = now.membrane.bending_ratio;
  SteadyState state = let_loose(now, control);
  while (bending > target.membrane.bending_ratio) {
    Case softer = now;
    softer.membrane.bending_ratio = bending / stage < thinnest
                                        ? target.membrane.bending_ratio
                                        : std::max(bending / stage, target.membrane.bending_ratio);
    state.system->set_parameters(softer);
    try {
      state.unknowns = relaxed(*state.system, state.unknowns, control);
      now = softer;
    } catch (const NumericsFailure &) {
      const auto nodes = static_cast<int>(state.system->nodes());
      if (nodes > most_to_relax_on)
        throw;
      state.system->set_parameters(now);
      state = on_mesh(now, finer_mesh(nodes), state, control);
    }
  }
  if (target.mesh.membrane > 0) // no finer than asked for
    state.unknowns = solve_steady(*state.system, state.unknowns);
  else
    state = relaxed_on_mesh(target, finer_mesh(static_cast<int>(state.system->nodes())), state, control);
  return state;
}

// Everything but the capillary number, in a flow of given strength: where the flow is not too weak, a shell gets thin
// without buckling.
Homotopy in_a_flow(double strength, const Case &target, const Control &control) {
  Homotopy homotopy = from_a_stiff_sphere(target, control);
  homotopy.vary(flow_key, strength);
  homotopy.vary("capsule.radius", target.capsule.radius);
  homotopy.vary("capsule.aspect_ratio", target.capsule.aspect_ratio);
  homotopy.vary(bending_key, target.membrane.bending_ratio);
  return homotopy;
}

// Whether a branch ends for good: in a fold, or where the membrane's law softens.
bool ends_branch(const NumericsFailure &failure) {
  return failure.kind == failure_kind::fold || failure.kind == failure_kind::softening;
}

// What such an end on the way of growing flow says of the case.
NumericsFailure no_steady_state(const NumericsFailure &end) {
  const char *none =
      end.kind == failure_kind::softening ? "no steady state that a mesh resolves" : "no steady state";
  return {end.kind, fmt::format("{}: {}", none, end.what()), end.advice};
}

// The same of one on another way, which says nothing of the case.
NumericsFailure of_this_way(const NumericsFailure &end) {
  return ends_branch(end)
             ? NumericsFailure(failure_kind::unresolved, end.what(), "try a larger membrane.bending_ratio")
             : end;
}

// The fold that a growing flow meets before the case's own, if it does: that of a stiff membrane, which few nodes show,
// followed to the case's. A soft membrane may need more nodes than are worth their time; the fold hardly moves there.
std::optional<NumericsFailure> fold_of_weaker_flow(const Case &input, const Control &control) {
  constexpr int finest = 120; // nodes
  constexpr double safe = 3;
  const double flow = input.flow.capillary_number;
  const double thin = std::max(input.membrane.bending_ratio, thinnest);
  Case stiff = with_stiff_membrane(input);
  if (stiff.mesh.membrane == 0)
    stiff.mesh.membrane = finest;
  double start = flow;
  while (start > weak_flow) { // to a flow in which it comes to rest
    start /= 4;
    Case weaker = stiff;
    weaker.flow.capillary_number = start;
    const KeyPath key(flow_key, weaker, flow), second(bending_key, weaker, thin);
    double value = 0, part = 0, bending = 0, slope = 0; // of the last fold, and d value/d log(bending)
    try {
      Homotopy homotopy(stiff, weaker, let_loose(weaker, control), control);
      try {
        homotopy.vary(flow_key, flow);
        return {};
      } catch (const NumericsFailure &failure) {
        if (failure.kind != failure_kind::fold)
          throw;
      }
      Homotopy::Fold fold = homotopy.fold();
      part = fold.part;
      value = key.value(part);
      bending = weaker.membrane.bending_ratio;
      if (second.needed())
        follow_fold(fold.state, {fold.state.unknowns, fold.part, 0},
                    fold.tangent.head(fold.state.unknowns.size()), key, second, finest, control,
                    [&](const SteadyState & /*state*/, const FoldPoint &point) {
                      part = point.part;
                      const double before = std::exchange(value, key.value(part));
                      const double stiffer = std::exchange(bending, second.value(point.second_part));
                      if (bending < stiffer)
                        slope = (value - before) / std::log(bending / stiffer);
                    });
    } catch (const NumericsFailure &) {
      if (value == 0)
        continue;
    }
    if (second.needed() && slope == 0)
      return {}; // the fold is that of the stiff membrane only
    const double change = safe * std::abs(slope * std::log(thin / bending)); // that is left
    if (value + change > flow)
      return {};
    const std::string place =
        bending == thin ? "at " + key.text(part)
                        : fmt::format("near {}, where it is for {} = {:.2g}; it lies within {:.1g} of that",
                                      key.text(part), bending_key, bending, change);
    return no_steady_state({failure_kind::fold, "fold " + place, "stay on the near side of it"});
  }
  return {};
}

// What it tried and saw is added to `tried`.
SteadyState searched(const Case &input, const Control &control, const MarchToRest &march,
                     std::vector<std::string> &tried) {
  const double flow = input.flow.capillary_number;
  std::optional<NumericsFailure> last;
  bool has_run_away = false;
  constexpr double weakest_part = 0.125;
  // Parts of the flow, in which the capsule may come to rest. Where its law softens before, a branch from a much weaker flow
  // tells where: coarse meshes have states beyond that place, from which no finer mesh goes on.
  for (double part = 1; part >= weakest_part;
       part = last->kind == failure_kind::softening && part > weakest_part ? weakest_part : part / 2) {
    Case weaker = input;
    weaker.flow.capillary_number *= part;
    for (const char *key : area_keys)
      weaker = with_number(weaker, key, std::min(area_modulus_to_relax, number(key, input)));
    bool only_flow_is_left = false;
    try {
      Homotopy homotopy(input, weaker, by_relaxation(weaker, control), control);
      for (const char *key : area_keys)
        homotopy.vary(key, number(key, input));
      only_flow_is_left = true;
      homotopy.vary(flow_key, flow);
      return homotopy.state();
    } catch (const NumericsFailure &failure) { // it may run away, or buckle on the way: other branches tell
      if (only_flow_is_left && ends_branch(failure))
        throw no_steady_state(failure);
      last = failure;
      tried.push_back(
          fmt::format("relaxed at {} = {:.3g}: {}", flow_key, weaker.flow.capillary_number, failure.what()));
    }
    if (last->kind == failure_kind::unbounded && !std::exchange(has_run_away, true))
      if (const auto fold = fold_of_weaker_flow(input, control))
        throw NumericsFailure(*fold);
    if (part == 1 && last->kind == failure_kind::unresolved && march)
      try {
        if (const auto end = march(input, control))
          return from_profile(input, *end, control);
      } catch (const NumericsFailure &failure) {
        tried.push_back(fmt::format("marched: {}", failure.what()));
      }
  }
  if (input.capsule.shape != CapsuleShape::spheroid) // a small stiff sphere does not become one
    throw of_this_way(*last);
  std::optional<NumericsFailure> first;
  const double weakest = input.flow.type == FlowType::extension ? 0 : 0.03; // only a tube squeezes
  for (const double strength : {std::clamp(flow, weakest, 0.06), 0.02, 0.12}) {
    bool only_flow_is_left = false;
    try {
      Homotopy homotopy = in_a_flow(strength, input, control);
      only_flow_is_left = flow > strength;
      homotopy.vary(flow_key, flow);
      return homotopy.state();
    } catch (const NumericsFailure &failure) {
      if (only_flow_is_left && ends_branch(failure))
        throw no_steady_state(failure);
      if (!first)
        first = failure;
      tried.push_back(
          fmt::format("from a small stiff sphere at {} = {:.3g}: {}", flow_key, strength, failure.what()));
    }
  }
  const NumericsFailure last_word = of_this_way(*first);
  throw NumericsFailure(last_word.kind,
                        fmt::format("no way found from a small stiff sphere: {}", last_word.what()),
                        last_word.advice);
}

bool is_unstable(const SteadyState &state) {
  constexpr double neutral = 1e-6;
  const double viscosity_ratio = state.system->input().flow.viscosity_ratio;
  return growth_rates(*state.system, state.unknowns, viscosity_ratio)[0].real() > neutral;
}

// The state that the motion reaches, where it is a stable one.
std::optional<SteadyState> stable_state_by_march(const Case &input, const Control &control,
                                                 const MarchToRest &march) {
  try {
    if (const auto end = march(input, control))
      if (SteadyState state = from_profile(input, *end, control); !is_unstable(state))
        return state;
  } catch (const NumericsFailure &) { // the unstable state is what there is
  } catch (const Exhausted &) {
  }
  return {};
}

// Within the work that a search may cost.
SteadyState without_neighbours(const Case &input, const Control &control, const MarchToRest &march) {
  double work = 0;
  Control limited = control;
  limited.spend = [&](double more) {
    if (control.spend)
      control.spend(more);
    work += more;
    if (work > most_work_of_search)
      throw Exhausted{};
  };
  std::vector<std::string> tried;
  try {
    SteadyState state = searched(input, limited, march, tried);
    if (march && is_unstable(state))
      if (auto other = stable_state_by_march(input, limited, march))
        return *other;
    return state;
  } catch (const Exhausted &) {
    throw NumericsFailure(failure_kind::unresolved,
                          fmt::format("no steady state found in the work that a search may cost ({})",
                                      tried.empty() ? "relaxing" : fmt::format("{}", fmt::join(tried, "; "))),
                          "try a weaker flow, or a larger membrane.bending_ratio, whose shapes are smoother, "
                          "or begin with a profile of a "
                          "march (--from)");
  }
}

// The state of a capsule alone, and then its neighbours: near enough to be felt at once, or coming closer if Newton's
// method does not get there.
SteadyState among_neighbours(const Case &input, const Control &control, const MarchToRest &march) {
  constexpr double out_of_reach = 6;
  constexpr const char *period_key = "flow.period";
  Case alone = input;
  alone.flow.period = 0;
  const SteadyState state = without_neighbours(alone, control, march);
  const auto nodes = static_cast<int>(state.system->nodes());
  SteadyState train = moved_to_mesh(input, nodes, state);
  try {
    train.unknowns = solve_steady(*train.system, train.unknowns);
    return train;
  } catch (const NumericsFailure &) {
    const double length = 2 * state.unknowns.head(nodes).cwiseAbs().maxCoeff();
    alone.flow.period = std::max(length + out_of_reach, input.flow.period);
    Homotopy homotopy(input, alone, moved_to_mesh(alone, nodes, state), control);
    homotopy.vary(period_key, input.flow.period);
    return homotopy.state();
  }
}

} // namespace

SteadyState search_steady(const Case &input, const Control &control, const MarchToRest &march) {
  return input.flow.period > 0 ? among_neighbours(input, control, march)
                               : without_neighbours(input, control, march);
}

} // namespace capsule
