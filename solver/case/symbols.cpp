#include "case/symbols.hpp"
#include "base/text.hpp"
#include "case/keys.hpp"
#include "law/law.hpp"
#include <algorithm>
#include <cctype>

namespace capsule {
namespace {

struct Called {
  const char *key;
  std::vector<std::string> symbols;
};

// Those of laws are in their files. What is usual for several keys, such as rho, is missing on purpose.
const std::vector<Called> &table() {
  static const std::vector<Called> called = {{"pore.opening_angle_deg", {"alpha", "\u03b1"}},
                                             {"pore.exit_x", {"L_P"}},
                                             {"pore.entrance_distance", {"L_E"}},
                                             {"capsule.radius", {"R_eq"}},
                                             {"capsule.aspect_ratio", {"A/B"}},
                                             {"capsule.inflation", {"alpha_p", "\u03b1_p"}},
                                             {"membrane.bending_ratio", {"delta", "\u03b4"}},
                                             {"membrane.shear_viscosity", {"mu_s"}},
                                             {"membrane.dilatational_viscosity", {"kappa_s"}},
                                             {"flow.capillary_number", {"epsilon", "eps", "Ca", "\u03b5"}},
                                             {"flow.viscosity_ratio", {"lambda", "\u03bb"}},
                                             {"mesh.membrane", {"N_M"}},
                                             {"mesh.wall", {"N_B"}},
                                             {"mesh.exit", {"N_P"}},
                                             {"physical.tube_radius", {"R_t"}},
                                             {"physical.viscosity", {"mu", "\u03bc"}},
                                             {"physical.flow_rate", {"Q"}},
                                             {"physical.shear_modulus", {"G", "G_s"}},
                                             {"physical.young_modulus", {"E_s"}}};
  return called;
}

// Without underscores, in lower case: "R_eq" and "req" are the same. Single letters differ: A is no a.
std::string plain(std::string_view symbol) {
  if (symbol.size() == 1)
    return std::string(symbol);
  std::string letters;
  for (const char c : symbol)
    if (c != '_')
      letters += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return letters;
}

bool is_called(const Key &key, std::string_view symbol) {
  const std::vector<std::string> symbols = symbols_of(key);
  return std::ranges::find(symbols, plain(symbol), plain) != symbols.end();
}

} // namespace

std::vector<std::string> symbols_of(const Key &key) {
  for (const Law *law : laws())
    for (const LawParameter &parameter : law->parameters)
      if (key.name == std::string("membrane.") + parameter.name)
        return {parameter.symbol};
  const auto found = std::ranges::find(table(), key.name, &Called::key);
  return found == table().end() ? std::vector<std::string>{} : found->symbols;
}

const Key *key_named(const std::string &name) {
  const auto named = [&](const Key &key) { return key.name == name || short_name(key) == name; };
  const auto found = std::ranges::find_if(keys(), named);
  return found == keys().end() ? nullptr : &*found;
}

std::string nearest_key(const std::string &typed) {
  constexpr std::string_view diameter = "diameter"; // there are radii only
  std::string name = typed;
  if (const std::size_t at = name.rfind(diameter); at != std::string::npos)
    name.replace(at, diameter.size(), "radius");
  const std::string word(last_component(name)), section = section_of(name);
  std::vector<std::string> all, last, here;
  for (const Key &key : keys()) {
    if (is_called(key, word))
      return key.name;
    all.push_back(key.name);
    last.emplace_back(last_component(key.name));
    if (section_of(key.name) == section)
      here.emplace_back(last.back());
  }
  if (const std::string near = nearest_word(word, here); !near.empty())
    return section.empty() ? near : section + "." + near;
  if (const std::string near = nearest_word(word, last); !near.empty())
    return all.at(static_cast<std::size_t>(std::ranges::find(last, near) - last.begin()));
  return section.empty() ? nearest_word(name, all) : ""; // the section's letters tell nothing
}

} // namespace capsule
