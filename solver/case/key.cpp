#include "case/key.hpp"
#include "base/text.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace capsule {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

constexpr Range any{};
constexpr Range above(double low) {
  return {.low = low};
}
constexpr Range at_least(double low) {
  return {.low = low, .low_allowed = true};
}
constexpr Range above_up_to(double low, double high) {
  return {.low = low, .high = high, .high_allowed = true};
}
constexpr Range from_to(double low, double high) {
  return {low, high, true, true};
}

// `Access` is a generic lambda that returns a reference into a Case, constant or not.
template <class T, class Access>
Member<T> member(Access /*at*/) {
  return {[](Case &c) -> T & { return Access{}(c); }, [](const Case &c) -> const T & { return Access{}(c); }};
}

template <class E, class Access>
Field choice(Access /*at*/, std::vector<std::string> names) {
  return Choice{std::move(names), [](Case &c, int index) { Access{}(c) = static_cast<E>(index); },
                [](const Case &c) { return static_cast<int>(Access{}(c)); }};
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

std::vector<Key> make_keys() {
  const std::string of_accuracy = "from accuracy";
  return {
      {"title", "one line about the case", member<std::string>(CAPSULE_AT(title)), any, "the case's name"},
      {"paper", "item of the paper that the case replicates", member<std::string>(CAPSULE_AT(paper)), any,
       "none"},
      {"numerics", "preset: the best we have, or section 3 of the paper to the letter",
       choice<Numerics>(CAPSULE_AT(numerics), {"standard", "paper"}), any},
      {"accuracy", "relative error asked for", member<double>(CAPSULE_AT(accuracy)), from_to(1e-8, 1e-2)},

      {"pore.shape", "hyperbolic mouth and tube; tube without a mouth; none: unbounded liquid",
       choice<PoreShape>(CAPSULE_AT(pore.shape), {"hyperbolic", "tube", "none"}), any,
       "hyperbolic; none with flow.type = \"extension\""},
      {"pore.opening_angle_deg", "opening angle of the mouth, alpha of eq. 1, degrees",
       member<double>(CAPSULE_AT(pore.opening_angle_deg)), above_up_to(0, 90)},
      {"pore.exit_x", "position of the exit section, L_P", member<double>(CAPSULE_AT(pore.exit_x)),
       above_up_to(0, 1000)},
      {"pore.entrance_distance", "distance of the entrance section, L_E",
       member<double>(CAPSULE_AT(pore.entrance_distance)), above_up_to(1, 1000)},

      {"capsule.radius", "radius of the sphere of the same volume, R_eq; or physical.capsule_radius",
       member<double>(CAPSULE_AT(capsule.radius)), above_up_to(0, 10),
       "required; 1 with flow.type = \"extension\"", true},
      {"capsule.aspect_ratio", "axial over radial semi-axis, A/B",
       member<double>(CAPSULE_AT(capsule.aspect_ratio)), from_to(0.01, 100)},
      {"capsule.start_x", "centre of the undeformed capsule at time 0",
       member<double>(CAPSULE_AT(capsule.start_x)), any, "-4; 0 with flow.type = \"extension\""},

      {"membrane.law", "law of the in-plane tensions, eqs. 4 and 5",
       choice<LawName>(CAPSULE_AT(membrane.law), {"neo-hookean", "skalak"}), any, "required", true},
      {"membrane.dilatation", "C of Skalak's law, eq. 5", member<double>(CAPSULE_AT(membrane.dilatation)),
       above(-0.5)},
      {"membrane.bending_ratio", "bending stiffness over G R_t^2, delta",
       member<double>(CAPSULE_AT(membrane.bending_ratio)), at_least(0)},

      {"flow.type", "given flow rate through the pore, or uniaxial extension of an unbounded liquid",
       choice<FlowType>(CAPSULE_AT(flow.type), {"pore", "extension"}), any},
      {"flow.capillary_number", "epsilon = mu Q/(pi R_t^2 G); extension: mu e a/G",
       member<double>(CAPSULE_AT(flow.capillary_number)), above(0), "required", true},
      {"flow.viscosity_ratio", "internal over external viscosity, lambda",
       member<double>(CAPSULE_AT(flow.viscosity_ratio)), from_to(1e-4, 1e4)},

      {"mesh.membrane", "elements or nodes of the membrane, N_M", member<int>(CAPSULE_AT(mesh.membrane)),
       from_to(4, 10000), of_accuracy + "; 60 with numerics = \"paper\""},
      {"mesh.wall", "elements of the wall, N_B", member<int>(CAPSULE_AT(mesh.wall)), from_to(4, 10000),
       of_accuracy + "; 120 with numerics = \"paper\""},
      {"mesh.exit", "elements of the exit section, N_P", member<int>(CAPSULE_AT(mesh.exit)),
       from_to(2, 10000), "30 with numerics = \"paper\", otherwise without meaning"},

      {"time.scheme", "error-controlled BDF; explicit Euler or Runge-Kutta of order 4 with a given step",
       choice<Scheme>(CAPSULE_AT(time.scheme), {"bdf", "euler", "rk4"}), any,
       "bdf; euler with numerics = \"paper\""},
      {"time.step", "step of an explicit scheme", member<double>(CAPSULE_AT(time.step)), above(0),
       "2.5e-4 with time.scheme = \"euler\", required with \"rk4\""},
      {"time.tolerance", "absolute error of the nodes' positions in one step, in units of R_t",
       member<double>(CAPSULE_AT(time.tolerance)), from_to(1e-13, 1e-2), of_accuracy},

      {"until.x_g", "stop when the centre of mass is here",
       member<std::optional<double>>(CAPSULE_AT(until.x_g)), any, "11.84, unless until.time is given"},
      {"until.time", "stop at this time", member<std::optional<double>>(CAPSULE_AT(until.time)), above(0),
       "none"},

      {"physical.tube_radius", "R_t with its unit; with this section results come in SI units too",
       measured(CAPSULE_AT(physical.tube_radius), dimension::length)},
      {"physical.viscosity", "of the external liquid, mu",
       measured(CAPSULE_AT(physical.viscosity), dimension::viscosity)},
      {"physical.flow_rate", "Q", measured(CAPSULE_AT(physical.flow_rate), dimension::flow_rate)},
      {"physical.pressure", "instead of Q: drop over the mouth and a tube of pore_length without a capsule",
       measured(CAPSULE_AT(physical.pressure), dimension::pressure)},
      {"physical.pore_length", "of the tube that the pressure drives the liquid through",
       measured(CAPSULE_AT(physical.pore_length), dimension::length)},
      {"physical.shear_modulus", "surface shear modulus, G",
       measured(CAPSULE_AT(physical.shear_modulus), dimension::tension)},
      {"physical.young_modulus", "instead of G: surface Young modulus at small strain, E_s",
       measured(CAPSULE_AT(physical.young_modulus), dimension::tension)},
      {"physical.bending_modulus", "D, instead of membrane.bending_ratio",
       measured(CAPSULE_AT(physical.bending_modulus), dimension::energy)},
      {"physical.capsule_radius", "of the sphere of the same volume, instead of capsule.radius",
       measured(CAPSULE_AT(physical.capsule_radius), dimension::length)},
      {"physical.internal_viscosity", "instead of flow.viscosity_ratio",
       measured(CAPSULE_AT(physical.internal_viscosity), dimension::viscosity)},

      {"output.profiles_at_x_g", "positions at which the profile is written",
       member<std::vector<double>>(CAPSULE_AT(output.profiles_at_x_g)), any, "none"},
      {"output.profiles_at_time", "times at which the profile is written",
       member<std::vector<double>>(CAPSULE_AT(output.profiles_at_time)), at_least(0), "none"},
  };
}

#undef CAPSULE_AT

bool inside(const Range &range, double value) {
  return (value > range.low || (range.low_allowed && value == range.low)) &&
         (value < range.high || (range.high_allowed && value == range.high));
}

std::string range_text(const Range &range) {
  const std::string low = number_text(range.low) + (range.low_allowed ? " <= " : " < ");
  const std::string high = (range.high_allowed ? " <= " : " < ") + number_text(range.high);
  if (range.low == -infinity && range.high == infinity)
    return "any number";
  if (range.high == infinity)
    return std::string("value ") + (range.low_allowed ? ">= " : "> ") + number_text(range.low);
  return low + "value" + high;
}

std::string quoted_list(const std::vector<std::string> &names) {
  return fmt::format("'{}'", fmt::join(names, "', '"));
}

std::string described(const Value &value) {
  if (const auto *other = std::get_if<Unsupported>(&value))
    return other->what;
  if (const auto *text = std::get_if<std::string>(&value))
    return "the text '" + *text + "'";
  if (std::holds_alternative<std::vector<double>>(value))
    return "a list";
  return value_text(value);
}

Complaint wrong_type(const Key &key, const std::string &wanted, const Value &value) {
  return {fmt::format("{} must be {}, not {}", key.name, wanted, described(value)), ""};
}

std::optional<Complaint> check_number(const Key &key, double value) {
  if (!std::isfinite(value))
    return Complaint{fmt::format("{} must be a finite number, not {}", key.name, number_text(value)), ""};
  if (!inside(key.range, value))
    return Complaint{fmt::format("{} = {} is out of range", key.name, number_text(value)),
                     "allowed: " + range_text(key.range)};
  return std::nullopt;
}

std::optional<double> as_number(const Value &value) {
  if (const auto *integer = std::get_if<std::int64_t>(&value))
    return static_cast<double>(*integer);
  if (const auto *number = std::get_if<double>(&value))
    return *number;
  return std::nullopt;
}

std::string allowed_hint(const Key &key, const std::string &meant) {
  return (meant.empty() ? "" : fmt::format("did you mean '{}'? ", meant)) + "allowed: " + allowed_text(key);
}

// set_value for each kind of field.
struct Setter {
  const Key &key;
  const Value &value;
  Case &physics;

  std::optional<Complaint> operator()(const Member<std::string> &member) const {
    const auto *text = std::get_if<std::string>(&value);
    if (!text)
      return wrong_type(key, "a text", value);
    member.in(physics) = *text;
    return std::nullopt;
  }
  std::optional<Complaint> operator()(const Member<int> &member) const {
    const auto *integer = std::get_if<std::int64_t>(&value);
    if (!integer)
      return wrong_type(key, "a whole number", value);
    if (auto complaint = check_number(key, static_cast<double>(*integer)))
      return complaint;
    member.in(physics) = static_cast<int>(*integer);
    return std::nullopt;
  }
  template <class T>
  std::optional<Complaint> operator()(const Member<T> &member) const {
    const auto number = as_number(value);
    if (!number)
      return wrong_type(key, "a number", value);
    if (auto complaint = check_number(key, *number))
      return complaint;
    member.in(physics) = *number;
    return std::nullopt;
  }
  std::optional<Complaint> operator()(const Member<std::vector<double>> &member) const {
    const auto *list = std::get_if<std::vector<double>>(&value);
    if (!list)
      return wrong_type(key, "a list of numbers", value);
    for (const double entry : *list)
      if (auto complaint = check_number(key, entry))
        return complaint;
    // Order and repetition mean nothing, so that they do not make a different run either.
    std::vector<double> sorted = *list;
    std::ranges::sort(sorted);
    sorted.erase(std::unique(sorted.begin(), sorted.end()), sorted.end());
    member.in(physics) = std::move(sorted);
    return std::nullopt;
  }
  std::optional<Complaint> operator()(const Measured &measured) const {
    const auto *text = std::get_if<std::string>(&value);
    if (!text)
      return Complaint{wrong_type(key, "a number with its unit in quotes", value).message,
                       allowed_hint(key, "")};
    const auto read = read_quantity(*text, measured.dimension);
    if (const auto *none = std::get_if<NoQuantity>(&read))
      return Complaint{fmt::format("{}: {}", key.name, none->why), allowed_hint(key, none->meant)};
    measured.member.in(physics) = std::get<Quantity>(read);
    return std::nullopt;
  }
  std::optional<Complaint> operator()(const Choice &choice) const {
    const auto *text = std::get_if<std::string>(&value);
    if (!text)
      return wrong_type(key, "one of " + quoted_list(choice.names), value);
    const auto found = std::ranges::find(choice.names, *text);
    if (found == choice.names.end()) {
      return Complaint{fmt::format("unknown {} '{}'", key.name, *text),
                       allowed_hint(key, nearest_word(*text, choice.names))};
    }
    choice.set(physics, static_cast<int>(found - choice.names.begin()));
    return std::nullopt;
  }
};

// get_value for each kind of field. Zero and empty stand for "not given".
struct Getter {
  const Key &key;
  const Case &physics;

  std::optional<Value> operator()(const Member<std::string> &member) const {
    return member.of(physics).empty() ? std::nullopt : std::optional<Value>(member.of(physics));
  }
  std::optional<Value> operator()(const Member<int> &member) const {
    return member.of(physics) == 0 ? std::nullopt : std::optional<Value>(std::int64_t{member.of(physics)});
  }
  std::optional<Value> operator()(const Member<double> &member) const {
    const double value = member.of(physics);
    return inside(key.range, value) ? std::optional<Value>(value) : std::nullopt;
  }
  std::optional<Value> operator()(const Member<std::optional<double>> &member) const {
    return member.of(physics) ? std::optional<Value>(*member.of(physics)) : std::nullopt;
  }
  std::optional<Value> operator()(const Member<std::vector<double>> &member) const {
    return member.of(physics).empty() ? std::nullopt : std::optional<Value>(member.of(physics));
  }
  std::optional<Value> operator()(const Measured &measured) const {
    const Quantity &quantity = measured.member.of(physics);
    return quantity.si == 0 ? std::nullopt
                            : std::optional<Value>(quantity_text(quantity, measured.dimension));
  }
  std::optional<Value> operator()(const Choice &choice) const {
    return choice.names.at(static_cast<std::size_t>(choice.get(physics)));
  }
};

std::string toml_string(const std::string &text) {
  std::string quoted = "\"";
  for (const char c : text) {
    const auto code = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\')
      quoted += {'\\', c};
    else if (code < 0x20 || code == 0x7f)
      quoted += fmt::format("\\u{:04x}", code);
    else
      quoted += c;
  }
  return quoted + "\"";
}

struct Writer {
  std::string operator()(const Unsupported &other) const { return other.what; }
  std::string operator()(const std::string &text) const { return toml_string(text); }
  std::string operator()(std::int64_t integer) const { return std::to_string(integer); }
  std::string operator()(double number) const { return number_text(number); }
  std::string operator()(const std::vector<double> &list) const {
    std::vector<std::string> texts;
    std::ranges::transform(list, std::back_inserter(texts), number_text);
    return fmt::format("[{}]", fmt::join(texts, ", "));
  }
};

} // namespace

const std::vector<Key> &keys() {
  static const std::vector<Key> table = make_keys();
  return table;
}

const Key *find_key(const std::string &name) {
  const auto found = std::ranges::find(keys(), name, &Key::name);
  return found == keys().end() ? nullptr : &*found;
}

std::optional<Complaint> set_value(const Key &key, const Value &value, Case &physics) {
  return std::visit(Setter{key, value, physics}, key.field);
}

std::optional<Value> get_value(const Key &key, const Case &physics) {
  return std::visit(Getter{key, physics}, key.field);
}

void forget_spellings(Case &physics) {
  for (const Key &key : keys())
    if (const auto *measured = std::get_if<Measured>(&key.field))
      measured->member.in(physics).written.clear();
}

std::string value_text(const Value &value) {
  return std::visit(Writer{}, value);
}

std::string allowed_text(const Key &key) {
  if (const auto *choice = std::get_if<Choice>(&key.field))
    return quoted_list(choice->names);
  if (const auto *measured = std::get_if<Measured>(&key.field))
    return examples_text(measured->dimension);
  if (std::holds_alternative<Member<std::string>>(key.field))
    return "any text";
  if (std::holds_alternative<Member<int>>(key.field))
    return range_text(key.range) + ", whole";
  if (std::holds_alternative<Member<std::vector<double>>>(key.field))
    return "a list, each " + range_text(key.range);
  return range_text(key.range);
}

std::string default_text(const Key &key) {
  if (!key.automatic.empty())
    return key.automatic;
  if (std::holds_alternative<Measured>(key.field))
    return "none";
  return value_text(get_value(key, Case{}).value());
}

} // namespace capsule
