#include "case/case_checks.hpp"
#include "base/text.hpp"
#include "case/case.hpp"
#include "case/empty_pore.hpp"
#include "case/keys.hpp"
#include "case/physical.hpp"
#include "case/symbols.hpp"
#include "case/value_lists.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <iterator>
#include <numbers>
#include <utility>

namespace capsule {
namespace {

struct Checks {
  const Chosen &chosen;
  const Case &physics;

  void check_scheme() {
    if (physics.time.scheme != Scheme::bdf && physics.time.step == 0)
      chosen.complain(
          {"time.scheme"}, "time.scheme = \"rk4\" needs a time.step",
          "the longest stable step is about 1.4 times that of \"euler\"; both fall with mesh.membrane");
  }

  // Section 3 of the paper is one method for one flow.
  void check_numerics() {
    const Case &c = physics;
    if (c.numerics == Numerics::standard)
      return;
    if (c.time.scheme != Scheme::euler)
      chosen.complain({"time.scheme", "numerics"}, "numerics = \"paper\" marches with Euler's scheme only",
                      "leave out time.scheme, or set it to \"euler\"");
    if (c.flow.type != FlowType::pore)
      chosen.complain({"flow.type", "numerics"}, "numerics = \"paper\" computes no unbounded liquid",
                      "flow.type = \"extension\" needs numerics = \"standard\"");
    if (c.flow.drive != DriveBy::flow_rate)
      chosen.complain({"flow.drive", "numerics"}, "numerics = \"paper\" has a given flow rate only",
                      "flow.drive = \"pressure\" needs numerics = \"standard\"");
    if (c.flow.type == FlowType::pore && c.pore.shape != PoreShape::hyperbolic)
      chosen.complain({"pore.shape", "numerics"}, "numerics = \"paper\" has the hyperbolic pore only",
                      "another pore.shape needs numerics = \"standard\"");
    if (c.capsule.shape != CapsuleShape::spheroid)
      chosen.complain({"capsule.shape", "numerics"}, "numerics = \"paper\" has spheroids only",
                      "capsule.shape = \"biconcave\" needs numerics = \"standard\"");
    if (c.output.resistance)
      chosen.complain({"output.resistance", "numerics"}, "numerics = \"paper\" computes no resistance",
                      "output.resistance = true needs numerics = \"standard\"");
  }

  void check_extension() {
    const Case &c = physics;
    if (c.pore.shape != PoreShape::none)
      chosen.complain({"pore.shape", "flow.type"}, "an extension is unbounded",
                      "pore.shape must be \"none\"");
    if (c.capsule.radius != 1)
      chosen.complain({"capsule.radius"}, "in an extension lengths are scaled with the capsule's radius",
                      "leave out capsule.radius, or set it to 1");
  }

  void check_end_of_extension() {
    const Case &c = physics;
    if (c.capsule.start_x != 0)
      chosen.complain({"capsule.start_x"}, "in an extension the capsule starts in the centre of the flow",
                      "leave out capsule.start_x, or set it to 0");
    if (!c.until.time)
      chosen.complain({"flow.type"}, "an extension needs until.time");
  }

  // Room for the cap that the flow rate is measured through, and for a capsule before it.
  void check_reservoirs() {
    constexpr double shortest = 10;
    const PoreSpec &pore = physics.pore;
    if (pore.shape == PoreShape::two_mouths && pore.entrance_distance < shortest)
      chosen.complain({"pore.entrance_distance", "pore.shape"},
                      fmt::format("reservoirs of {} radii are too short for two mouths",
                                  number_text(pore.entrance_distance)),
                      fmt::format("try a pore.entrance_distance of {} or more", number_text(shortest)));
  }

  // The undeformed capsule between the two end sections and inside the wall of eq. 1.
  void check_start() {
    const Case &c = physics;
    const Extent capsule = extent(c.capsule);
    const double half_length = capsule.half_length, half_width = capsule.half_width;
    const double x_0 = c.capsule.start_x;
    const double back = x_0 - half_length, front = x_0 + half_length;
    if (back <= -c.pore.entrance_distance)
      chosen.complain(
          {"capsule.start_x", "pore.entrance_distance", "capsule.radius"},
          fmt::format("capsule outside the {}: it begins at x = {:.4g}",
                      c.pore.shape == PoreShape::tube ? "tube" : "reservoir", back),
          fmt::format("the entrance section is at x = {}", number_text(-c.pore.entrance_distance)));
    if (c.pore.shape == PoreShape::two_mouths && x_0 > c.pore.exit_x)
      chosen.complain({"capsule.start_x", "pore.exit_x"},
                      fmt::format("the capsule starts behind the pore, at x = {}", number_text(x_0)),
                      fmt::format("the second mouth is at x = {}", number_text(c.pore.exit_x)));
    else if (front >= end_of_way(c.pore))
      chosen.complain({"capsule.start_x", "pore.exit_x", "capsule.radius"},
                      fmt::format("capsule beyond the exit: it ends at x = {:.4g}", front),
                      fmt::format("the exit section is at x = {}", number_text(c.pore.exit_x)));

    // r_w^2 - r^2 along the capsule is a parabola on each side of a lip.
    // For a red cell the cylinder around it is taken.
    const double slope =
        c.capsule.shape == CapsuleShape::spheroid ? std::pow(half_width / half_length, 2) : 0;
    const double opening = c.pore.shape == PoreShape::tube
                               ? 0
                               : std::pow(std::tan(c.pore.opening_angle_deg * std::numbers::pi / 180), 2);
    const auto smallest = [&](double centre, double from, double to, double growth) {
      const double nearest = growth + slope > 0 ? centre * slope / (growth + slope) : from;
      const double x = std::clamp(nearest, from, to);
      return 1 - half_width * half_width + growth * x * x + slope * (x - centre) * (x - centre);
    };
    const auto outside = [&](double centre) { // of the lip at x = 0, on the side of negative x
      return centre < half_length &&
             smallest(centre, centre - half_length, std::min(centre + half_length, 0.0), opening) <= 0;
    };
    const bool behind = c.pore.shape == PoreShape::two_mouths && outside(c.pore.exit_x - x_0);
    const bool inside = front > 0 && back < c.pore.exit_x &&
                        smallest(x_0, std::max(back, 0.0), std::min(front, c.pore.exit_x), 0) <= 0;
    if (outside(x_0) || behind || inside)
      chosen.complain({"capsule.start_x", "capsule.radius"},
                      "capsule larger than the pore's entrance at its start",
                      fmt::format("its largest radius is {:.4g} at x = {}; the tube's is 1 from x = 0 on",
                                  half_width, number_text(x_0)));
  }

  // Of the leading capsule.
  void check_end() {
    const Case &c = physics;
    if (c.until.x_g && *c.until.x_g <= c.capsule.start_x)
      chosen.complain({"until.x_g", "capsule.start_x"},
                      fmt::format("until.x_g = {} lies upstream of the start", number_text(*c.until.x_g)),
                      fmt::format("capsule.start_x is {}", number_text(c.capsule.start_x)));
    const double end = end_of_way(c.pore);
    if (c.until.x_g && *c.until.x_g + extent(c.capsule).half_length >= end)
      chosen.complain(
          {"until.x_g", "pore.exit_x", "capsule.radius"},
          fmt::format("at until.x_g = {} the capsule would cross {}", number_text(*c.until.x_g),
                      c.pore.shape == PoreShape::two_mouths ? "the end of its way" : "the exit section"),
          c.pore.shape == PoreShape::two_mouths
              ? fmt::format("that is x = {}: pore.exit_x and a third of pore.entrance_distance, at most 10",
                            number_text(end))
              : fmt::format("pore.exit_x is {}: give an until.x_g below {:.4g}", number_text(end),
                            end - extent(c.capsule).half_length));
    const double last = c.until.x_g.value_or(end);
    if (c.output.transit_from && c.output.transit_to && *c.output.transit_from >= *c.output.transit_to)
      chosen.complain(
          {"output.transit_to", "output.transit_from"},
          fmt::format("the transit ends at {}, before it begins", number_text(*c.output.transit_to)),
          fmt::format("output.transit_from is {}", number_text(*c.output.transit_from)));
    for (const auto &[key, place] : {std::pair("output.transit_from", c.output.transit_from),
                                     std::pair("output.transit_to", c.output.transit_to)})
      if (place && (*place < c.capsule.start_x || *place > last))
        chosen.complain(
            {key}, fmt::format("the capsule never comes to x_g = {}", number_text(*place)),
            fmt::format("its way goes from {} to {}", number_text(c.capsule.start_x), number_text(last)));
    for (const double x : c.output.profiles_at_x_g)
      if (x < c.capsule.start_x || x > last)
        chosen.complain(
            {"output.profiles_at_x_g"}, fmt::format("the capsule never comes to x_g = {}", number_text(x)),
            fmt::format("its way goes from {} to {}", number_text(c.capsule.start_x), number_text(last)));
  }

  // Of an inflated sphere; other shapes are near to it.
  void check_burst() {
    const Case &c = physics;
    const double stretch = 1 + c.capsule.inflation;
    const double tension = tensions(c.membrane.law, stretch, stretch).meridional;
    if (c.until.area_stretch && stretch * stretch >= *c.until.area_stretch)
      chosen.complain({"until.area_stretch", "capsule.inflation"},
                      fmt::format("the area stretch is {:.6g} before the flow", stretch * stretch),
                      "until.area_stretch must lie above (1 + capsule.inflation)^2");
    if (c.until.tension && tension >= *c.until.tension)
      chosen.complain({"until.tension", "capsule.inflation"},
                      fmt::format("the tension is {:.6g} before the flow", tension),
                      "until.tension must lie above what capsule.inflation brings about");
  }

  void check_train(const Task &task) {
    const Case &c = physics;
    if (task.motion)
      chosen.complain({"flow.period"}, "an infinite train is computed as a steady state only",
                      "`capsule steady` and `capsule branch` do; leave out flow.period to march in time");
    const double shortest = 4.0 / 3 * std::pow(c.capsule.radius, 3); // that holds the volume
    if (c.flow.period <= shortest)
      chosen.complain(
          {"flow.period", "capsule.radius"},
          fmt::format("flow.period = {} of the tube holds less than one capsule", number_text(c.flow.period)),
          fmt::format("it must lie above 4/3 capsule.radius^3 = {:.4g}", shortest));
    if (c.flow.drive == DriveBy::pressure)
      chosen.complain({"flow.drive", "flow.period"}, "an infinite train has no pore that a pressure drives",
                      "leave out flow.drive: the train's flow rate is given");
    if (c.output.resistance)
      chosen.complain({"output.resistance", "flow.period"}, "the resistance of a train is not computed",
                      "leave out output.resistance, or flow.period");
  }

  void check(const Task &task) {
    const Case &c = physics;
    check_scheme();
    check_numerics();
    if (!task.motion && c.numerics == Numerics::paper)
      chosen.complain({"numerics"}, "numerics = \"paper\" only marches in time",
                      "steady states need numerics = \"standard\"");
    if (!task.motion && c.pore.shape == PoreShape::two_mouths)
      chosen.complain({"pore.shape"}, "there is no steady state in a pore of finite length",
                      "steady states are those of its tube, infinitely long: pore.shape = \"tube\"");
    if (!task.motion && c.flow.drive == DriveBy::pressure && driven_tube_length(c) < shortest_fitted_tube)
      chosen.complain({"pore.exit_x", "flow.drive"},
                      fmt::format("a steady state under constant pressure needs a pore of {} radii or more",
                                  shortest_fitted_tube),
                      "in a shorter one the mouths act on the capsule");
    if (c.flow.period > 0)
      check_train(task);
    if (c.flow.type == FlowType::extension)
      check_extension();
    else if (c.pore.shape == PoreShape::none)
      chosen.complain({"pore.shape"}, "a pore flow needs a pore",
                      "pore.shape = \"none\" goes with flow.type = \"extension\"");
    check_pressure();
    if (task.fit)
      check_fit();
    if (task.motion)
      check_way();
  }

  void check_fit() {
    const FitSpec &fit = physics.fit;
    if (physics.flow.type != FlowType::pore)
      chosen.complain({"flow.type"}, "a fit is of a capsule in a tube");
    if (physics.flow.drive == DriveBy::pressure)
      chosen.complain({"flow.drive"}, "a fit is of a capsule at the flow rate that it has",
                      "leave out flow.drive, whatever is constant");
    const std::vector<std::string> parameters = parameters_of_steady_states();
    std::vector<std::string> names;
    for (const Law *law : laws())
      names.emplace_back(law->name);
    for (const std::string &law : fit.laws)
      if (std::ranges::find(names, law) == names.end())
        chosen.complain({"fit.laws"}, fmt::format("unknown law '{}'", law), meant(law, names));
    for (const std::string &unknown : fit.unknowns) {
      if (std::ranges::find(parameters, unknown) == parameters.end())
        chosen.complain({"fit.unknowns"}, fmt::format("'{}' is nothing that a fit can find", unknown),
                        unknown.starts_with("physical.")
                            ? "list dimensionless keys: from flow.capillary_number follows the modulus, from "
                              "capsule.radius the radius"
                            : meant(unknown, parameters));
      else if (std::ranges::count(fit.unknowns, unknown) > 1)
        chosen.complain({"fit.unknowns"}, fmt::format("'{}' stands twice", unknown));
      else if (!is_of_a_candidate(*find_key(unknown)))
        chosen.complain({"fit.unknowns", "fit.laws"},
                        fmt::format("'{}' means nothing to the laws that are tried", unknown),
                        fmt::format("it belongs to {}", scope_text(*find_key(unknown))));
    }
    for (const auto &[key, bounds] : fit.bounds)
      if (std::ranges::find(fit.unknowns, key) == fit.unknowns.end())
        chosen.complain({"fit.bounds"}, fmt::format("'{}' is not unknown", key),
                        "fit.unknowns lists what is to be found");
    if (fit.pixel.si > 0 && physics.physical.tube_radius.si == 0)
      chosen.complain({"fit.pixel"}, "fit.pixel needs physical.tube_radius");
  }

  static std::string meant(const std::string &word, const std::vector<std::string> &words) {
    std::string near = nearest_key(word); // by its symbol
    if (std::ranges::find(words, near) == words.end())
      near = nearest_word(word, words);
    return near.empty() ? fmt::format("one of {}", fmt::join(words, ", "))
                        : fmt::format("did you mean '{}'?", near);
  }

  bool is_of_a_candidate(const Key &key) const {
    const std::vector<std::string> &tried = physics.fit.laws;
    if (tried.empty() || key.scope.key != "membrane.law")
      return means_something(key, physics);
    return std::ranges::any_of(key.scope.values, [&](const std::string &law) {
      return std::ranges::find(tried, law) != tried.end();
    });
  }

  // Mouths that are close to each other cost less than two.
  void check_pressure() {
    const Case &c = physics;
    if (c.physical.pressure.si > 0 && c.pore.shape != PoreShape::tube &&
        driven_tube_length(c) < shortest_fitted_tube)
      chosen.complain(
          {"physical.pore_length", "pore.exit_x", "physical.pressure"},
          fmt::format("physical.pressure sets no flow rate in a pore of {:.3g} radii", driven_tube_length(c)),
          fmt::format("give physical.flow_rate instead, or a pore of {} radii or more",
                      shortest_fitted_tube));
  }

  // From the start to the end of a motion.
  void check_way() {
    const Case &c = physics;
    if (c.flow.type == FlowType::extension) {
      check_end_of_extension();
    } else if (c.pore.shape != PoreShape::none) {
      check_reservoirs();
      check_start();
      if (chosen.capsule == 0)
        check_end();
    }
    check_burst();
    for (const double t : c.output.profiles_at_time)
      if (c.until.time && t > *c.until.time)
        chosen.complain({"output.profiles_at_time"},
                        fmt::format("time {} comes after the end", number_text(t)),
                        fmt::format("until.time is {}", number_text(*c.until.time)));
  }
};

} // namespace

void check_together(const Chosen &chosen, const Case &physics, const Task &task) {
  Checks{chosen, physics}.check(task);
}

void check_capsules(const Chosen &chosen, const Case &physics, const Task &task) {
  if (physics.followers.empty()) {
    if (physics.until.last_x_g)
      chosen.complain({"until.last_x_g"}, "until.last_x_g is of several capsules, and there is one",
                      "write until.x_g");
    return;
  }
  // The first list says that there are several.
  std::vector<std::string> lists;
  for (const Assignment &assignment : chosen.reader.assignments)
    if (const std::string &name = assignment.key->name;
        assignment.key->of_each_capsule && entries_of(chosen.given(name)->value).size() > 1)
      lists.push_back(name);
  const std::vector<const Case *> capsules = capsules_of(physics);
  if (physics.flow.period > 0) {
    chosen.complain(lists, "the capsules of a train are equal", "give one value for all of them");
    return;
  }
  if (!task.motion)
    chosen.complain(lists, "a steady state is of one capsule, or of a train of equal ones",
                    "flow.period is the distance of those; `capsule run` marches several");
  if (physics.numerics == Numerics::paper)
    chosen.complain({"numerics"}, "numerics = \"paper\" has one capsule",
                    "several capsules need numerics = \"standard\"");
  if (physics.flow.type == FlowType::extension)
    chosen.complain({"flow.type"}, "an extension has one capsule", "several capsules need a pore");
  if (physics.output.resistance)
    chosen.complain({"output.resistance"}, "the resistance of several capsules is not computed",
                    "leave out output.resistance");
  for (std::size_t k = 1; k < capsules.size(); ++k) {
    const CapsuleSpec &ahead = capsules[k - 1]->capsule, &behind = capsules[k]->capsule;
    const double rear = ahead.start_x - extent(ahead).half_length;
    const double front = behind.start_x + extent(behind).half_length;
    if (ahead.start_x == behind.start_x) {
      std::vector<std::string> places{"capsule.start_x"};
      std::ranges::copy(lists, std::back_inserter(places));
      chosen.complain(
          places, fmt::format("capsules {} and {} start at the same place", k, k + 1),
          "several capsules need a list of starts, the leading one's first: capsule.start_x = [1, -3]");
    } else if (ahead.start_x < behind.start_x)
      chosen.complain({"capsule.start_x"},
                      fmt::format("capsule {} starts before the one that is to lead it", k + 1),
                      "the leading capsule comes first, the others behind it");
    else if (front >= rear)
      chosen.complain(
          {"capsule.start_x", "capsule.radius"},
          fmt::format(
              "capsules {} and {} overlap at their start: the rear of one is at x = {:.4g}, the front of "
              "the other at {:.4g}",
              k, k + 1, rear, front),
          fmt::format("their centres have to be more than {:.4g} apart",
                      extent(ahead).half_length + extent(behind).half_length));
  }
  const CapsuleSpec &last = capsules.back()->capsule;
  if (physics.until.last_x_g &&
      *physics.until.last_x_g + extent(last).half_length >= end_of_way(physics.pore))
    chosen.complain({"until.last_x_g"},
                    fmt::format("at until.last_x_g = {} the last capsule would be at the end of the way",
                                number_text(*physics.until.last_x_g)),
                    fmt::format("that is x = {}, and the leading capsule is to be before it, too",
                                number_text(end_of_way(physics.pore))));
  const double last_start = last.start_x;
  if (physics.until.last_x_g && *physics.until.last_x_g <= last_start)
    chosen.complain({"until.last_x_g"},
                    fmt::format("until.last_x_g = {} lies upstream of the last capsule's start",
                                number_text(*physics.until.last_x_g)),
                    fmt::format("it starts at {}", number_text(last_start)));
}

} // namespace capsule
