#include "steady/search.hpp"
#include "base/failure.hpp"
#include "case/key_path.hpp"
#include "case/keys.hpp"
#include "steady/from_profile.hpp"
#include "steady/growth_rates.hpp"
#include "steady/homotopy.hpp"
#include "steady/newton.hpp"
#include "steady/relaxation.hpp"
#include "steady/strong_flow.hpp"
#include "steady/work.hpp"
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
constexpr double small_radius = 0.6;
constexpr double stiff_bending = 2e-2; // a shell that does not buckle
constexpr int most_to_relax_on = 70;   // nodes
// The membrane relaxes with a modulus of area up to this one. Stiffer ones would need steps that are too short.
constexpr std::array area_keys{"membrane.dilatation", "membrane.area_modulus"};
constexpr double area_modulus_to_relax = 100;

// A small stiff sphere in a weak flow.
Homotopy from_a_stiff_sphere(const Case &target) {
  Case begin = target;
  begin.flow.capillary_number = std::min(weak_flow, target.flow.capillary_number);
  begin.capsule.aspect_ratio = 1;
  begin.membrane.bending_ratio = std::max(stiff_bending, target.membrane.bending_ratio);
  if (target.pore.shape != PoreShape::none)
    begin.capsule.radius = std::min(small_radius, target.capsule.radius);
  const auto system = first_system(begin);
  return {target, begin, {system, solve_steady(*system, system->initial())}};
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

// What the end of a branch on a way of its own says of the case: nothing.
NumericsFailure of_this_way(const NumericsFailure &end) {
  return ends_branch(end)
             ? NumericsFailure(failure_kind::unresolved, end.what(), "try a larger membrane.bending_ratio")
             : end;
}

// What a search has tried and seen, for its last word.
struct Attempts {
  std::vector<std::string> seen;
  std::string kind = failure_kind::unresolved; // of the last word: what the membrane was seen to do
  bool has_asked_stiff_membrane = false;

  void add(const std::string &attempt, const NumericsFailure &failure) {
    seen.push_back(fmt::format("{}: {}", attempt, failure.what()));
  }

  NumericsFailure last_word(const std::string &text) const {
    return {
        kind,
        fmt::format("{} ({})", text, seen.empty() ? "relaxing" : fmt::format("{}", fmt::join(seen, "; "))),
        "try a weaker flow, or a larger membrane.bending_ratio, whose shapes are smoother, "
        "or begin with a profile of a march (--from)"};
  }
};

// Once in a search. A stiff membrane whose law softens proves nothing, but it tells.
std::optional<SteadyState> by_stiff_membrane(const Case &input, const Control &control, Attempts &attempts) {
  if (std::exchange(attempts.has_asked_stiff_membrane, true))
    return {};
  try {
    return by_stiff_membrane(input, control);
  } catch (const NumericsFailure &failure) {
    if (failure.kind != failure_kind::softening)
      throw;
    attempts.add("with a stiff membrane", failure);
    attempts.kind = failure.kind;
  }
  return {};
}

// From the end of a march to just behind the mouth.
std::optional<SteadyState> by_march(const Case &input, const Control &control, const MarchToRest &march,
                                    Attempts &attempts) {
  try {
    if (const auto end = march(input, MarchLength::into_tube, control))
      return solved_from_profile(input, *end, control);
  } catch (const NumericsFailure &failure) {
    attempts.add("marched into the tube", failure);
    if (failure.kind == failure_kind::wrinkled)
      attempts.kind = failure.kind;
  }
  return {};
}

constexpr double most_work_of_a_key = 300; // what arrives takes less (methods.md)

// By branches from a small stiff sphere: first all but the capillary number, in a flow of given strength, because where the flow
// is not too weak a shell gets thin without buckling; last the flow to the case's.
std::optional<SteadyState> from_a_stiff_sphere_at(double strength, const Case &input, const Control &control,
                                                  Attempts &attempts) {
  const double flow = input.flow.capillary_number;
  const bool grows = flow > strength;
  const std::array<std::pair<const char *, double>, 5> way{
      {{flow_key, strength},
       {"capsule.radius", input.capsule.radius},
       {"capsule.aspect_ratio", input.capsule.aspect_ratio},
       {bending_key, input.membrane.bending_ratio},
       {flow_key, flow}}};
  std::size_t done = 0;
  std::optional<Homotopy> homotopy;
  try {
    homotopy.emplace(from_a_stiff_sphere(input));
    for (; done < way.size() - 1; ++done)
      within(most_work_of_a_key, control,
             [&](const Control &limited) { homotopy->vary(way[done].first, way[done].second, limited); });
    homotopy->vary(flow_key, flow, control);
    return homotopy->state();
  } catch (const NumericsFailure &failure) {
    if (grows && done == way.size() - 1 && ends_branch(failure))
      throw no_steady_state(failure);
    if (grows && way[done].first == bending_key && failure.kind == failure_kind::fold)
      throw_if_too_strong(*homotopy, input, control);
    const double bending = number(bending_key, homotopy ? homotopy->state().system->input() : input);
    attempts.add(fmt::format("from a small stiff sphere at {} = {:.3g}, with {} = {:.3g}", flow_key, strength,
                             bending_key, bending),
                 failure);
  }
  return {};
}

// A flat capsule wider than the tube, which a sphere can become.
bool is_folded(const Case &input) {
  const Extent size = extent(input.capsule);
  return input.capsule.shape == CapsuleShape::spheroid && input.flow.type == FlowType::pore &&
         size.half_width > widest_unsqueezed && size.half_length < size.half_width;
}

SteadyState searched(const Case &input, const Control &control, const MarchToRest &march,
                     Attempts &attempts) {
  constexpr double most_work_of_relaxing = 600,
                   most_work_of_a_way = 700; // what is found takes less (methods.md)
  const double flow = input.flow.capillary_number;
  const bool fits = extent(input.capsule).half_width <= widest_unsqueezed;
  const double weakest = input.flow.type == FlowType::extension ? 0 : 0.015; // only a tube squeezes
  // Straight to the case's own flow, unless a shell buckles on the way, as in a weak one, or a small sphere cannot follow.
  constexpr double strong = 0.12, medium = 0.06, weak = 0.03;
  std::vector<double> strengths{flow > strong ? medium : std::max(flow, weakest)};
  for (const double other : {weak, strong})
    if (other != strengths.front())
      strengths.push_back(other);
  std::optional<NumericsFailure> last;
  bool has_looked_elsewhere = false;
  constexpr double weakest_part = 0.125;
  // Parts of the flow, in which the capsule may come to rest. Where its law softens before, a branch from a much weaker flow
  // tells where: coarse meshes have states beyond that place, from which no finer mesh goes on.
  double part = 1;
  while (part >= weakest_part) {
    Case weaker = input;
    weaker.flow.capillary_number *= part;
    for (const char *key : area_keys)
      weaker = with_number(weaker, key, std::min(area_modulus_to_relax, number(key, input)));
    bool only_flow_is_left = false;
    try {
      Homotopy homotopy(input, weaker, within(most_work_of_relaxing, control, [&](const Control &limited) {
                          return by_relaxation(weaker, limited);
                        }));
      for (const char *key : area_keys)
        homotopy.vary(key, number(key, input), control);
      only_flow_is_left = true;
      homotopy.vary(flow_key, flow, control);
      return homotopy.state();
    } catch (const NumericsFailure &failure) { // it may run away, or buckle on the way: other branches tell
      if (only_flow_is_left && ends_branch(failure))
        throw no_steady_state(failure);
      last = failure;
      attempts.add(fmt::format("relaxed at {} = {:.3g}", flow_key, weaker.flow.capillary_number), failure);
      if (part == 1 && failure.kind == failure_kind::softening && fits)
        attempts.kind = failure.kind;
    }
    if (last->kind == failure_kind::unbounded) {
      if (auto state = by_stiff_membrane(input, control, attempts))
        return *state;
    } else if (!has_looked_elsewhere &&
               (part < 1 || is_folded(input) || last->kind != failure_kind::softening)) {
      has_looked_elsewhere = true;
      if (is_folded(input)) {
        const double strength = strengths.front();
        strengths.erase(strengths.begin());
        try {
          if (auto state = within(most_work_of_a_way, control, [&](const Control &limited) {
                return from_a_stiff_sphere_at(strength, input, limited, attempts);
              }))
            return *state;
        } catch (const NumericsFailure &failure) {
          if (ends_branch(failure))
            throw;
          attempts.add("from a small stiff sphere", failure);
        }
      }
      if (march)
        if (auto state = by_march(input, control, march, attempts))
          return *state;
      if (auto state = by_stiff_membrane(input, control, attempts))
        return *state;
    }
    part = last->kind == failure_kind::softening && part > weakest_part ? weakest_part : part / 2;
  }
  if (input.capsule.shape != CapsuleShape::spheroid)
    throw of_this_way(*last);
  for (const double strength : strengths)
    if (auto state = from_a_stiff_sphere_at(strength, input, control, attempts))
      return *state;
  throw attempts.last_word("no steady state found");
}

bool is_unstable(const SteadyState &state) {
  constexpr double neutral = 1e-6;
  return slowest_rate(*state.system, state.system->linearise(state.unknowns)).real() > neutral;
}

// The state that the motion reaches, where it is a stable one.
std::optional<SteadyState> stable_state_by_march(const Case &input, const Control &control,
                                                 const MarchToRest &march) {
  try {
    if (const auto end = march(input, MarchLength::far_into_tube, control))
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
  const Control limited = counting(work, most_work_of_search, control);
  Attempts attempts;
  try {
    SteadyState state = searched(input, limited, march, attempts);
    if (march && is_unstable(state))
      if (auto other = stable_state_by_march(input, limited, march))
        return *other;
    return state;
  } catch (const Exhausted &) {
    throw attempts.last_word("no steady state found in the work that a search may cost");
  }
}

// Where the last state on the way to a shorter period has hardly any gap.
void throw_if_touching(const SteadyState &last) {
  constexpr double hardly_any = 0.03;
  const SteadySystem &system = *last.system;
  const double gap = system.gap_to_next(last.unknowns.head(2 * system.nodes()));
  if (gap < hardly_any)
    throw NumericsFailure(
        failure_kind::touching,
        fmt::format("neighbouring capsules of the train come to touch: near flow.period = {:.4g} "
                    "their gap is {:.2g}",
                    system.input().flow.period, gap),
        "try a larger flow.period");
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
    Homotopy homotopy(input, alone, moved_to_mesh(alone, nodes, state));
    try {
      homotopy.vary(period_key, input.flow.period, control);
    } catch (const NumericsFailure &) {
      throw_if_touching(homotopy.state());
      throw;
    }
    return homotopy.state();
  }
}

} // namespace

SteadyState search_steady(const Case &input, const Control &control, const MarchToRest &march) {
  return input.flow.period > 0 ? among_neighbours(input, control, march)
                               : without_neighbours(input, control, march);
}

} // namespace capsule
