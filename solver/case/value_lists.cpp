#include "case/value_lists.hpp"
#include "case/case.hpp"
#include "case/keys.hpp"
#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace capsule {

std::vector<Value> entries_of(const Value &value) {
  if (const auto *numbers = std::get_if<std::vector<double>>(&value))
    return {numbers->begin(), numbers->end()};
  if (const auto *words = std::get_if<Words>(&value))
    return {words->begin(), words->end()};
  return {value};
}

Value joined(const std::vector<Value> &values) {
  const auto is_first = [&](const Value &value) { return value_text(value) == value_text(values[0]); };
  if (std::ranges::all_of(values, is_first))
    return values[0];
  std::vector<double> numbers;
  Words words;
  for (const Value &value : values)
    if (const auto *word = std::get_if<std::string>(&value))
      words.push_back(*word);
    else if (const auto *whole = std::get_if<std::int64_t>(&value))
      numbers.push_back(static_cast<double>(*whole));
    else
      numbers.push_back(std::get<double>(value));
  return words.empty() ? Value(numbers) : Value(words);
}

std::string plain_text(const Value &value) {
  std::vector<std::string> texts;
  for (const Value &entry : entries_of(value)) {
    const auto *word = std::get_if<std::string>(&entry);
    texts.push_back(word != nullptr ? *word : value_text(entry));
  }
  return fmt::format("{}", fmt::join(texts, "_"));
}

std::optional<Value> value_of(const Key &key, const Case &physics) {
  const auto own = [&key](const Case &capsule) {
    return means_something(key, capsule) ? get_value(key, capsule) : std::nullopt;
  };
  if (!key.of_each_capsule || physics.followers.empty())
    return own(physics);
  std::vector<Value> of_those_with_a_use, of_all;
  for (const Case *capsule : capsules_of(physics)) {
    if (const std::optional<Value> value = own(*capsule))
      of_those_with_a_use.push_back(*value);
    if (const std::optional<Value> value = get_value(key, *capsule))
      of_all.push_back(*value);
  }
  if (of_those_with_a_use.empty())
    return std::nullopt;
  const Value value = joined(of_those_with_a_use);
  return entries_of(value).size() == 1 ? value : joined(of_all);
}

} // namespace capsule
