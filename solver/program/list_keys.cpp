#include "program/list_keys.hpp"
#include "case/keys.hpp"
#include <fmt/format.h>
#include <string>

namespace capsule {

ExitCode list_keys() {
  std::string section;
  for (const Key &key : keys()) {
    const std::string here = key.name.substr(0, key.name.find('.'));
    fmt::print("{}{:<33}{}\n{:<33}default: {}; allowed: {}{}\n", here == section ? "" : "\n", key.name,
               key.meaning, "", default_text(key), allowed_text(key),
               key.of_each_capsule ? "; a list for several capsules" : "");
    if (!key.scope.key.empty())
      fmt::print("{:<33}only with {}\n", "", scope_text(key));
    for (const std::string &note : key.notes)
      fmt::print("{:<33}{}\n", "", note);
    section = here;
  }
  fmt::print("\n{:<26}values of another case file, relative to this one, that this one overrides;\n"
             "{:<26}of several, [\"a\", \"b\"]: the runs of each\n"
             "sweep.\"any.key\" = [...]   one run per value; several sweeps make every combination\n",
             "inherit", "");
  return ExitCode::done;
}

} // namespace capsule
