#include "case/chosen.hpp"
#include "case/keys.hpp"
#include "case/value_lists.hpp"
#include <algorithm>
#include <fmt/format.h>

namespace capsule {

Value Chosen::value(std::size_t assignment) const {
  const Assignment &given = reader.assignments[assignment];
  const Value &value = given.values[selection[assignment]].value;
  if (!given.key->of_each_capsule)
    return value;
  const std::vector<Value> entries = entries_of(value);
  return entries.size() > 1 ? entries.at(capsule) : entries.at(0);
}

std::size_t Chosen::capsules() const {
  std::size_t most = 1;
  for (std::size_t i = 0; i < reader.assignments.size(); ++i)
    if (reader.assignments[i].key->of_each_capsule)
      most = std::max(most, entries_of(reader.assignments[i].values[selection[i]].value).size());
  return most;
}

const GivenValue *Chosen::given(const std::string &name) const {
  for (std::size_t i = 0; i < reader.assignments.size(); ++i)
    if (reader.assignments[i].key->name == name)
      return &reader.assignments[i].values[selection[i]];
  return nullptr;
}

bool Chosen::stands(const std::string &name, const std::string &over) const {
  const auto level = [&](const std::string &key) {
    const auto found =
        std::ranges::find(reader.assignments, key, [](const Assignment &a) { return a.key->name; });
    return found == reader.assignments.end() ? -1 : static_cast<int>(found->level);
  };
  return given(name) != nullptr && level(name) >= level(over);
}

void Chosen::complain(const std::vector<std::string> &names, const std::string &message,
                      const std::string &hint) const {
  TextPlace place;
  std::string whose;
  for (const std::string &name : names)
    if (const auto *value = given(name)) {
      place = value->place;
      const Key *key = find_key(name);
      if (of_one && key && key->of_each_capsule && entries_of(value->value).size() > 1)
        whose = fmt::format("capsule {}: ", capsule + 1);
      break;
    }
  reader.complain(place, whose + message, hint);
}

} // namespace capsule
