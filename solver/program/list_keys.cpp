#include "program/list_keys.hpp"
#include "base/failure.hpp"
#include "case/keys.hpp"
#include "case/symbols.hpp"
#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <vector>

namespace capsule {
namespace {

std::vector<const Key *> keys_with(const std::string &word) {
  std::vector<const Key *> found;
  for (const Key &key : keys()) {
    const std::vector<std::string> symbols = symbols_of(key);
    if (key.name.find(word) != std::string::npos || key.meaning.find(word) != std::string::npos ||
        std::ranges::find(symbols, word) != symbols.end())
      found.push_back(&key);
  }
  return found;
}

} // namespace

ExitCode list_keys(const std::string &word) {
  const std::vector<const Key *> listed = keys_with(word);
  if (listed.empty()) {
    const std::string near = nearest_key(word);
    throw InputError(fmt::format("error: no key has to do with '{}'\n{}\n", word,
                                 near.empty() ? "`capsule keys` lists them all"
                                              : fmt::format("did you mean '{}'?", near)));
  }
  std::size_t width = 0; // of the names, and two blanks
  for (const Key *key : listed)
    width = std::max(width, key->name.size() + 2);
  const std::string below(width, ' ');
  const auto section_of = [](const Key &key) { return key.name.substr(0, key.name.find('.')); };
  std::string section = section_of(*listed.front());
  for (const Key *key : listed) {
    const std::string here = section_of(*key);
    fmt::print("{}{:<{}}{}\n{}default: {}; allowed: {}{}\n", here == section ? "" : "\n", key->name, width,
               key->meaning, below, default_text(*key), allowed_text(*key),
               key->of_each_capsule ? "; a list for several capsules" : "");
    if (!key->scope.key.empty())
      fmt::print("{}only with {}\n", below, scope_text(*key));
    if (const std::vector<std::string> symbols = symbols_of(*key); !symbols.empty())
      fmt::print("{}symbol: {}\n", below, fmt::join(symbols, ", "));
    for (const std::string &note : key->notes)
      fmt::print("{}{}\n", below, note);
    section = here;
  }
  if (word.empty())
    fmt::print("\n{:<26}values of another case file, relative to this one, that this one overrides;\n"
               "{:<26}of several, [\"a\", \"b\"]: the runs of each\n"
               "sweep.\"any.key\" = [...]   one run per value; several sweeps make every combination\n",
               "inherit", "");
  return ExitCode::done;
}

} // namespace capsule
