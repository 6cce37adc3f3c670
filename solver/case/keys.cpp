#include "case/keys.hpp"
#include "base/text.hpp"
#include "case/case.hpp"
#include "law/law.hpp"
#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <iterator>

namespace capsule {
namespace {

// `Access` is a generic lambda that returns a reference into a Case, constant or not.
template <class T, class Access>
Member<T> member(Access at) {
  return {at, at};
}

template <class E, class Access>
Field choice(Access at, std::vector<std::string> names) {
  return Choice{std::move(names), [at](Case &c, int index) { at(c) = static_cast<E>(index); },
                [at](const Case &c) { return static_cast<int>(at(c)); }};
}

template <class Access>
Field measured(Access at, Dimension dimension) {
  return Measured{member<Quantity>(at), dimension};
}

// NOLINTBEGIN(bugprone-macro-parentheses): a member cannot stand in parentheses
#define CAPSULE_AT(path)                                                                                     \
  [](auto &c) -> auto & {                                                                                    \
    return c.path;                                                                                           \
  }
// NOLINTEND(bugprone-macro-parentheses)

// Of a motion alone: steady states do not depend on it.
Key of_motion(Key key) {
  key.steady = SteadyRole::none;
  return key;
}

// Of the empty pore, which has a part in steady states under constant pressure, and a resistance.
Key of_the_pore(Key key) {
  key.steady = SteadyRole::pore;
  return key;
}

// In the equations of steady states, so that branches may go along it.
Key parameter(Key key) {
  key.steady = SteadyRole::parameter;
  return key;
}

// Several capsules may differ in it.
Key of_each_capsule(Key key) {
  key.of_each_capsule = true;
  return key;
}

Key only_with(Scope scope, Key key) {
  key.scope = std::move(scope);
  return key;
}

Key in_a_pore(Key key) {
  return only_with({"flow.type", {"pore"}}, std::move(key));
}

Key between_mouths(Key key) {
  return of_motion(only_with({"pore.shape", {"two-mouths"}, "flow.type"}, std::move(key)));
}

// A shorter march moves nothing; a shorter step is lost in a time of hundreds.
constexpr double shortest_time = 1e-6, shortest_step = 1e-12;

std::vector<Key> general_keys() {
  return {
      {"title", "one line about the case", member<std::string>(CAPSULE_AT(title)), any_number,
       "the case's name"},
      {"paper", "item of the paper that the case replicates", member<std::string>(CAPSULE_AT(paper)),
       any_number, "none"},
      {"numerics", "preset: the best we have, or section 3 of the paper to the letter",
       choice<Numerics>(CAPSULE_AT(numerics), {"standard", "paper"}), any_number},
      only_with({"numerics", {"standard"}}, {"accuracy", "relative error asked for",
                                             member<double>(CAPSULE_AT(accuracy)), from_to(1e-8, 1e-2)}),
  };
}

std::vector<Key> pore_keys() {
  return {
      of_the_pore(
          {"pore.shape",
           "hyperbolic mouth and tube; two-mouths: the mouth's mirror image behind the tube, too; tube "
           "without a mouth; none: unbounded liquid",
           choice<PoreShape>(CAPSULE_AT(pore.shape), {"hyperbolic", "two-mouths", "tube", "none"}),
           any_number, "hyperbolic; none with flow.type = \"extension\""}),
      of_the_pore(only_with({"pore.shape", {"hyperbolic", "two-mouths"}, "flow.type"},
                            {"pore.opening_angle_deg", "opening angle of the mouth, alpha of eq. 1, degrees",
                             member<double>(CAPSULE_AT(pore.opening_angle_deg)), above_up_to(0, 90)})),
      of_the_pore(in_a_pore({"pore.exit_x",
                             "where the tube ends, in the exit section or the second mouth, L_P; or "
                             "physical.pore_length",
                             member<double>(CAPSULE_AT(pore.exit_x)), above_up_to(0, 1000)})),
      of_the_pore(in_a_pore(
          {"pore.entrance_distance",
           "distance of the entrance section from the mouth, L_E; of the wall's end behind a second "
           "mouth, too",
           member<double>(CAPSULE_AT(pore.entrance_distance)), above_up_to(1, 1000)})),
  };
}

std::vector<Key> capsule_keys() {
  return {
      parameter({"capsule.radius",
                 "radius of the sphere of the same volume, R_eq; or physical.capsule_radius",
                 member<double>(CAPSULE_AT(capsule.radius)), from_to(1e-3, 10),
                 "required; 1 with flow.type = \"extension\"", true}),
      {"capsule.shape", "spheroid; biconcave: a red cell at rest, by Evans and Fung (1972)",
       choice<CapsuleShape>(CAPSULE_AT(capsule.shape), {"spheroid", "biconcave"}), any_number},
      only_with({"capsule.shape", {"spheroid"}},
                parameter({"capsule.aspect_ratio", "axial over radial semi-axis, A/B",
                           member<double>(CAPSULE_AT(capsule.aspect_ratio)), from_to(0.01, 100)})),
      parameter({"capsule.inflation",
                 "pre-stress, alpha_p: before the flow the membrane is stretched by 1 + alpha_p",
                 member<double>(CAPSULE_AT(capsule.inflation)), from_to(0, 1)}),
      of_motion({"capsule.start_x", "centre of the undeformed capsule at time 0",
                 member<double>(CAPSULE_AT(capsule.start_x)), any_number,
                 "-4; 0 with flow.type = \"extension\""}),
  };
}

// The parameters of all laws, in the order in which MembraneLaw holds their values.
std::vector<Key> law_parameter_keys() {
  std::vector<Key> found;
  for (const Law *law : laws())
    for (const LawParameter &declared : law->parameters) {
      const auto at = [place = found.size()](auto &c) -> auto & {
        return c.membrane.law.all_values()[place];
      };
      found.push_back(only_with({"membrane.law", {law->name}},
                                parameter({std::string("membrane.") + declared.name, declared.meaning,
                                           member<double>(at), declared.range})));
    }
  return found;
}

Key law_key() {
  std::vector<std::string> names;
  Key key{"membrane.law",
          "law of the in-plane tensions: w/G, with a and b for the stretches",
          {},
          any_number,
          "required",
          true};
  for (const Law *law : laws()) {
    names.emplace_back(law->name);
    key.notes.push_back(fmt::format("{}: {}", law->name, law->formula));
  }
  key.field =
      Choice{std::move(names),
             [](Case &c, int index) { c.membrane.law.choose(*laws()[static_cast<std::size_t>(index)]); },
             [](const Case &c) {
               return static_cast<int>(std::ranges::find(laws(), &c.membrane.law.law()) - laws().begin());
             }};
  return key;
}

std::vector<Key> membrane_keys() {
  std::vector<Key> table = {law_key()};
  std::ranges::move(law_parameter_keys(), std::back_inserter(table));
  table.push_back(parameter({"membrane.bending_ratio", "bending stiffness over G R_t^2, delta",
                             member<double>(CAPSULE_AT(membrane.bending_ratio)), at_least(0)}));
  table.push_back(only_with({"numerics", {"standard"}},
                            {"membrane.shear_viscosity",
                             "resistance of the membrane to the rate of shear over mu R_t, mu_s; steady "
                             "states do not depend on it, their growth rates do",
                             member<double>(CAPSULE_AT(membrane.viscosity.shear)), from_to(0, 1e6)}));
  table.push_back(only_with({"numerics", {"standard"}},
                            {"membrane.dilatational_viscosity",
                             "resistance of the membrane to the rate of dilatation over mu R_t, kappa_s; "
                             "steady states do not depend on it, their growth rates do",
                             member<double>(CAPSULE_AT(membrane.viscosity.dilatational)), from_to(0, 1e6)}));
  return table;
}

std::vector<Key> flow_keys() {
  return {
      {"flow.type", "through the pore, or uniaxial extension of an unbounded liquid",
       choice<FlowType>(CAPSULE_AT(flow.type), {"pore", "extension"}), any_number},
      in_a_pore({"flow.drive",
                 "what is constant: the flow rate, or the pressure drop from the reservoir to pore.exit_x, "
                 "or to the reservoir behind a second mouth",
                 choice<DriveBy>(CAPSULE_AT(flow.drive), {"flow-rate", "pressure"}), any_number}),
      of_each_capsule(parameter(
          {"flow.capillary_number", "epsilon = mu Q/(pi R_t^2 G), Q without a capsule; extension: mu e a/G",
           member<double>(CAPSULE_AT(flow.capillary_number)), above(0), "required", true})),
      of_each_capsule({"flow.viscosity_ratio", "internal over external viscosity, lambda",
                       member<double>(CAPSULE_AT(flow.viscosity_ratio)), from_to(1e-4, 1e4)}),
      in_a_pore(parameter(
          {"flow.period",
           "steady states of an infinite train of equal capsules: distance of neighbouring centres",
           member<double>(CAPSULE_AT(flow.period)), from_to(1e-2, 1000), "none: one capsule alone"})),
  };
}

std::vector<Key> mesh_keys() {
  const std::string of_accuracy = "from accuracy";
  return {
      of_each_capsule({"mesh.membrane", "elements or nodes of the membrane, N_M",
                       member<int>(CAPSULE_AT(mesh.membrane)), from_to(4, 10000),
                       of_accuracy + "; 60 with numerics = \"paper\""}),
      in_a_pore({"mesh.wall", "elements of the wall, N_B", member<int>(CAPSULE_AT(mesh.wall)),
                 from_to(4, 10000), of_accuracy + "; 120 with numerics = \"paper\""}),
      of_motion(
          only_with({"numerics", {"paper"}}, {"mesh.exit", "elements of the exit section, N_P",
                                              member<int>(CAPSULE_AT(mesh.exit)), from_to(2, 10000), "30"})),
  };
}

std::vector<Key> time_keys() {
  const std::string of_accuracy = "from accuracy";
  return {
      of_motion({"time.scheme",
                 "error-controlled BDF; explicit Euler or Runge-Kutta of order 4 with a given step",
                 choice<Scheme>(CAPSULE_AT(time.scheme), {"bdf", "euler", "rk4"}), any_number,
                 "bdf; euler with numerics = \"paper\""}),
      of_motion(
          only_with({"time.scheme", {"euler", "rk4"}, "numerics"},
                    {"time.step", "step of an explicit scheme", member<double>(CAPSULE_AT(time.step)),
                     at_least(shortest_step), "2.5e-4 with time.scheme = \"euler\", required with \"rk4\""})),
      of_motion(
          only_with({"time.scheme", {"bdf"}, "numerics"},
                    {"time.tolerance", "absolute error of the nodes' positions in one step, in units of R_t",
                     member<double>(CAPSULE_AT(time.tolerance)), from_to(1e-13, 1e-2), of_accuracy})),
  };
}

std::vector<Key> until_keys() {
  return {
      of_motion(in_a_pore({"until.x_g",
                           "stop when the centre of mass is here, of several capsules the leading one's",
                           member<std::optional<double>>(CAPSULE_AT(until.x_g)), any_number,
                           "11.84, or 4 behind a second mouth, unless another end is given"})),
      of_motion(
          in_a_pore({"until.last_x_g", "of several capsules: stop when the last one's centre of mass is here",
                     member<std::optional<double>>(CAPSULE_AT(until.last_x_g)), any_number, "none"})),
      of_motion({"until.time", "stop at this time", member<std::optional<double>>(CAPSULE_AT(until.time)),
                 at_least(shortest_time), "none"}),
      of_motion({"until.area_stretch",
                 "the membrane bursts where lambda_s lambda_phi comes to this anywhere on it",
                 member<std::optional<double>>(CAPSULE_AT(until.area_stretch)), above(1), "none"}),
      of_motion({"until.tension", "the membrane bursts where a principal tension comes to this",
                 member<std::optional<double>>(CAPSULE_AT(until.tension)), above(0), "none"}),
  };
}

std::vector<Key> physical_keys() {
  return {
      in_a_pore({"physical.tube_radius", "R_t with its unit; with this section results come in SI units too",
                 measured(CAPSULE_AT(physical.tube_radius), dimension::length)}),
      in_a_pore({"physical.viscosity", "of the external liquid, mu",
                 measured(CAPSULE_AT(physical.viscosity), dimension::viscosity)}),
      in_a_pore({"physical.flow_rate", "Q", measured(CAPSULE_AT(physical.flow_rate), dimension::flow_rate)}),
      in_a_pore({"physical.pressure",
                 "instead of Q: drop over the mouths and the tube of the empty pore; it stays constant with "
                 "flow.drive = \"pressure\", and only sets the constant flow rate otherwise",
                 measured(CAPSULE_AT(physical.pressure), dimension::pressure)}),
      in_a_pore({"physical.pore_length",
                 "of the tube that the pressure drives the liquid through; instead of pore.exit_x with two "
                 "mouths or flow.drive = \"pressure\"",
                 measured(CAPSULE_AT(physical.pore_length), dimension::length)}),
      of_motion(in_a_pore({"physical.capsule_velocity", "of the capsule, instead of Q, for `capsule fit`",
                           measured(CAPSULE_AT(physical.capsule_velocity), dimension::velocity)})),
      of_each_capsule(in_a_pore({"physical.shear_modulus", "surface shear modulus, G",
                                 measured(CAPSULE_AT(physical.shear_modulus), dimension::tension)})),
      of_each_capsule(
          in_a_pore({"physical.young_modulus", "instead of G: surface Young modulus at small strain, E_s",
                     measured(CAPSULE_AT(physical.young_modulus), dimension::tension)})),
      of_each_capsule(in_a_pore({"physical.bending_modulus", "D, instead of membrane.bending_ratio",
                                 measured(CAPSULE_AT(physical.bending_modulus), dimension::energy)})),
      of_each_capsule(
          in_a_pore({"physical.capsule_radius", "of the sphere of the same volume, instead of capsule.radius",
                     measured(CAPSULE_AT(physical.capsule_radius), dimension::length)})),
      of_each_capsule(in_a_pore({"physical.internal_viscosity", "instead of flow.viscosity_ratio",
                                 measured(CAPSULE_AT(physical.internal_viscosity), dimension::viscosity)})),
      of_each_capsule(in_a_pore(
          {"physical.membrane_shear_viscosity", "of the membrane, instead of membrane.shear_viscosity",
           measured(CAPSULE_AT(physical.shear_viscosity), dimension::surface_viscosity)})),
      of_each_capsule(
          in_a_pore({"physical.membrane_dilatational_viscosity",
                     "of the membrane, instead of membrane.dilatational_viscosity",
                     measured(CAPSULE_AT(physical.dilatational_viscosity), dimension::surface_viscosity)})),
      in_a_pore({"physical.resistivity", "of the liquid, rho: resistances come in ohm, too",
                 measured(CAPSULE_AT(physical.resistivity), dimension::resistivity)}),
      of_motion(in_a_pore({"physical.density",
                           "of the external liquid, rho: for the Reynolds number that `capsule show` states",
                           measured(CAPSULE_AT(physical.density), dimension::density), any_number,
                           "1000 kg/m3, of water"})),
  };
}

std::vector<Key> fit_keys() {
  return {
      of_motion({"fit.unknowns", "keys that `capsule fit` is to find",
                 member<Words>(CAPSULE_AT(fit.unknowns)), any_number,
                 "capsule.radius, flow.capillary_number"}),
      of_motion({"fit.laws", "laws of the membrane that are tried", member<Words>(CAPSULE_AT(fit.laws)),
                 any_number, "membrane.law"}),
      of_motion({"fit.noise", "standard deviation of a point from the outline, in R_t",
                 member<std::optional<double>>(CAPSULE_AT(fit.noise)), above_up_to(0, 0.5), "estimated"}),
      of_motion({"fit.velocity_noise", "relative standard deviation of a measured velocity",
                 member<std::optional<double>>(CAPSULE_AT(fit.velocity_noise)), above_up_to(0, 0.5), "0.01"}),
      of_motion({"fit.outline", "what the points lie on; in a silhouette a rim hides a concave rear",
                 choice<OutlineSeen>(CAPSULE_AT(fit.outline), {"meridian", "silhouette"}), any_number}),
      of_motion({"fit.bounds", "lowest and largest value of an unknown: \"capsule.radius\" = [0.8, 0.9]",
                 member<Intervals>(CAPSULE_AT(fit.bounds)), any_number, "ranges of the keys"}),
      of_motion({"fit.pixel", "size of a pixel", measured(CAPSULE_AT(fit.pixel), dimension::length)}),
  };
}

std::vector<Key> output_keys() {
  return {
      of_motion(
          in_a_pore({"output.profiles_at_x_g", "positions at which the profile is written",
                     member<std::vector<double>>(CAPSULE_AT(output.profiles_at_x_g)), any_number, "none"})),
      of_motion({"output.profiles_at_time", "times at which the profile is written",
                 member<std::vector<double>>(CAPSULE_AT(output.profiles_at_time)), at_least(0), "none"}),
      of_motion(
          {"output.profiles_every", "distance of further profiles in x_g; in time where only until.time ends",
           member<std::optional<double>>(CAPSULE_AT(output.profiles_every)), from_to(1e-3, 1000), "none"}),
      in_a_pore({"output.resistance", "whether the electric resistance that the capsule adds is reported",
                 member<bool>(CAPSULE_AT(output.resistance)), any_number, "false"}),
      between_mouths({"output.transit_from", "x_g from which on the time of the transit is taken",
                      member<std::optional<double>>(CAPSULE_AT(output.transit_from)), any_number, "-1"}),
      between_mouths({"output.transit_to", "x_g up to which the time of the transit is taken",
                      member<std::optional<double>>(CAPSULE_AT(output.transit_to)), any_number,
                      "1 behind pore.exit_x"}),
  };
}

#undef CAPSULE_AT

std::vector<Key> make_keys() {
  std::vector<Key> table;
  for (const auto &section : {general_keys, pore_keys, capsule_keys, membrane_keys, flow_keys, mesh_keys,
                              time_keys, until_keys, physical_keys, output_keys, fit_keys})
    std::ranges::move(section(), std::back_inserter(table));
  for (Key &key : table)
    if (const std::string section = section_of(key.name); section == "capsule" || section == "membrane")
      key.of_each_capsule = true;
  return table;
}

} // namespace

const std::vector<Key> &keys() {
  static const std::vector<Key> table = make_keys();
  return table;
}

const Key *find_key(const std::string &name) {
  const auto found = std::ranges::find(keys(), name, &Key::name);
  return found == keys().end() ? nullptr : &*found;
}

std::string_view short_name(const Key &key) {
  const std::string_view last = last_component(key.name);
  const auto shares_it = [&](const Key &other) { return last_component(other.name) == last; };
  return std::ranges::count_if(keys(), shares_it) == 1 ? last : key.name;
}

bool steady_states_depend_on(const Key &key, const Case &physics) {
  return key.steady == SteadyRole::pore ? physics.flow.drive == DriveBy::pressure || physics.output.resistance
                                        : key.steady != SteadyRole::none;
}

std::vector<std::string> parameters_of_steady_states() {
  std::vector<std::string> names;
  for (const Key &key : keys())
    if (key.steady == SteadyRole::parameter)
      names.push_back(key.name);
  return names;
}

bool is_of_fits(const Key &key) {
  return key.name.starts_with("fit.") || key.name == "physical.capsule_velocity";
}

bool means_something(const Key &key, const Case &physics) {
  if (key.scope.key.empty())
    return true;
  const std::string decided = std::get<std::string>(*get_value(*find_key(key.scope.key), physics));
  return std::ranges::find(key.scope.values, decided) != key.scope.values.end();
}

std::string why_meaningless(const Key &key, const Case &physics) {
  return fmt::format("{} means nothing to {} = {}", key.name, key.scope.key,
                     value_text(*get_value(*find_key(key.scope.key), physics)));
}

std::string scope_text(const Key &key) {
  std::vector<std::string> values;
  std::ranges::transform(key.scope.values, std::back_inserter(values), value_text);
  return values.empty() ? "" : fmt::format("{} = {}", key.scope.key, fmt::join(values, " or "));
}

void forget_spellings(Case &physics) {
  for (const Key &key : keys())
    if (const auto *measured = std::get_if<Measured>(&key.field))
      measured->member.in(physics).written.clear();
}

} // namespace capsule
