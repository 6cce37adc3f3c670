#include "case/identity.hpp"
#include "base/build_info.hpp"
#include "base/digest.hpp"
#include "base/text.hpp"
#include "case/case.hpp"
#include "case/keys.hpp"
#include "case/value_lists.hpp"
#include <fmt/format.h>

namespace capsule {
namespace {

// The keys that `wanted` accepts, as a case file.
template <class Wanted>
std::string toml_of(const Case &physics, Wanted wanted) {
  std::string text, section;
  for (const Key &key : keys()) {
    const auto value = wanted(key) ? value_of(key, physics) : std::nullopt;
    if (!value)
      continue;
    if (section_of(key.name) != section) {
      section = section_of(key.name);
      text += fmt::format("\n[{}]\n", section);
    }
    text += fmt::format("{} = {}\n", last_component(key.name), value_text(*value));
  }
  return text;
}

// The input without what makes no difference to the results.
std::string what_counts(const Case &physics, const Task &task) {
  Case in_si = physics;
  forget_spellings(in_si);
  for (Case &follower : in_si.followers)
    forget_spellings(follower);
  return toml_of(in_si, [&](const Key &key) {
    if (key.name == "title" || key.name == "paper")
      return false;
    if (is_of_fits(key))
      return task.fit;
    return task.motion || steady_states_depend_on(key, physics);
  });
}

} // namespace

std::string resolved_toml(const Case &physics) {
  return toml_of(physics, [](const Key &key) { return !is_of_fits(key); });
}

std::string changed_toml(const Case &physics, const Case &than) {
  return toml_of(physics, [&](const Key &key) {
    const auto text = [&key](const Case &of) {
      const auto value = value_of(key, of);
      return value ? value_text(*value) : "";
    };
    return !is_of_fits(key) && text(physics) != text(than);
  });
}

bool same_input(const Case &a, const Case &b, const Task &task) {
  return what_counts(a, task) == what_counts(b, task);
}

std::string run_identity(const Case &physics, const Task &task) {
  return digest(fmt::format("{}\n{}\n{}", build_info::source_digest, task.name, what_counts(physics, task)));
}

} // namespace capsule
