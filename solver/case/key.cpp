#include "case/key.hpp"
#include "base/text.hpp"
#include "case/case.hpp"
#include <algorithm>
#include <cctype>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <type_traits>

namespace capsule {
namespace {

std::string quoted_list(const std::vector<std::string> &names) {
  return fmt::format("'{}'", fmt::join(names, "', '"));
}

std::string described(const Value &value) {
  if (const auto *other = std::get_if<Unsupported>(&value))
    return other->what;
  if (const auto *text = std::get_if<std::string>(&value))
    return "the text '" + *text + "'";
  if (std::holds_alternative<std::vector<double>>(value) || std::holds_alternative<Words>(value))
    return "a list";
  if (std::holds_alternative<Intervals>(value))
    return "a table";
  return value_text(value);
}

Complaint wrong_type(const Key &key, const std::string &wanted, const Value &value,
                     const std::string &hint = "") {
  return {fmt::format("{} must be {}, not {}", key.name, wanted, described(value)), hint};
}

// Whether a text is a number with a word behind it, such as a unit: "6 mm".
bool has_unit(const std::string &text) {
  const std::size_t digits = std::min(text.find_first_not_of("+-.0123456789"), text.size());
  const std::string word = trimmed(text.substr(digits));
  const bool begins = !word.empty() && std::isalpha(static_cast<unsigned char>(word[0])) != 0;
  return (begins || word.starts_with("\u00b5") || word.starts_with("\u03bc")) &&
         to_number(text.substr(0, digits));
}

// For a text in a number's place.
std::string number_hint(const Value &value) {
  const auto *text = std::get_if<std::string>(&value);
  const std::string meant = text != nullptr ? respelled_number(trimmed(*text)) : "";
  return text == nullptr ? ""
         : meant.empty() && has_unit(trimmed(*text))
             ? "write a number without a unit: lengths in tube radii; the keys of [physical] take units"
         : meant.empty()           ? number_notation
         : meant == trimmed(*text) ? fmt::format("a number stands without quotes: {}", meant)
                                   : "write " + meant;
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

  std::optional<Complaint> operator()(const Member<bool> &member) const {
    const bool *truth = std::get_if<bool>(&value);
    if (!truth)
      return wrong_type(key, "true or false", value);
    member.in(physics) = *truth;
    return std::nullopt;
  }
  std::optional<Complaint> operator()(const Member<std::string> &member) const {
    const auto *text = std::get_if<std::string>(&value);
    if (!text)
      return wrong_type(key, "a text", value);
    member.in(physics) = *text;
    return std::nullopt;
  }
  std::optional<Complaint> operator()(const Member<int> &member) const {
    const auto number = as_number(value);
    if (!number || (std::isfinite(*number) && *number != std::trunc(*number)))
      return wrong_type(key, "a whole number", value, number_hint(value));
    if (auto complaint = check_number(key, *number))
      return complaint;
    member.in(physics) = static_cast<int>(*number);
    return std::nullopt;
  }
  template <class T>
  std::optional<Complaint> operator()(const Member<T> &member) const {
    const auto number = as_number(value);
    if (!number)
      return wrong_type(key, "a number", value, number_hint(value));
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
  std::optional<Complaint> operator()(const Member<Words> &member) const {
    const auto *words = std::get_if<Words>(&value);
    if (const auto *none = std::get_if<std::vector<double>>(&value); none != nullptr && none->empty())
      return Complaint{fmt::format("{} needs at least one text", key.name), "leave it out for its default"};
    if (!words)
      return wrong_type(key, "a list of texts", value);
    member.in(physics) = *words;
    return std::nullopt;
  }
  std::optional<Complaint> operator()(const Member<Intervals> &member) const {
    const auto *intervals = std::get_if<Intervals>(&value);
    if (!intervals)
      return wrong_type(key, "a table of intervals", value, "as \"capsule.radius\" = [0.8, 0.9]");
    for (const auto &[name, ends] : *intervals)
      if (ends.size() != 2 || !(ends[0] <= ends[1]))
        return Complaint{fmt::format("{}: '{}' needs two ascending numbers", key.name, name),
                         "as \"capsule.radius\" = [0.8, 0.9]"};
    member.in(physics) = *intervals;
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

// get_value for each kind of field. False, zero and empty stand for "not given".
struct Getter {
  const Key &key;
  const Case &physics;

  std::optional<Value> operator()(const Member<bool> &member) const {
    return member.of(physics) ? std::optional<Value>(true) : std::nullopt;
  }
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
  std::optional<Value> operator()(const Member<Words> &member) const {
    return member.of(physics).empty() ? std::nullopt : std::optional<Value>(member.of(physics));
  }
  std::optional<Value> operator()(const Member<Intervals> &member) const {
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
  std::string operator()(bool truth) const { return truth ? "true" : "false"; }
  std::string operator()(const std::string &text) const { return toml_string(text); }
  std::string operator()(std::int64_t integer) const { return std::to_string(integer); }
  std::string operator()(double number) const { return number_text(number); }
  std::string operator()(const std::vector<double> &list) const {
    std::vector<std::string> texts;
    std::ranges::transform(list, std::back_inserter(texts), number_text);
    return fmt::format("[{}]", fmt::join(texts, ", "));
  }
  std::string operator()(const Words &list) const {
    std::vector<std::string> texts;
    std::ranges::transform(list, std::back_inserter(texts), toml_string);
    return fmt::format("[{}]", fmt::join(texts, ", "));
  }
  std::string operator()(const Intervals &intervals) const {
    std::vector<std::string> texts;
    for (const auto &[name, ends] : intervals)
      texts.push_back(fmt::format("{} = {}", toml_string(name), (*this)(ends)));
    return fmt::format("{{{}}}", fmt::join(texts, ", "));
  }
};

} // namespace

std::optional<Complaint> set_value(const Key &key, const Value &value, Case &physics) {
  return std::visit(Setter{key, value, physics}, key.field);
}

std::optional<Value> get_value(const Key &key, const Case &physics) {
  return std::visit(Getter{key, physics}, key.field);
}

void reset_value(const Key &key, Case &physics) {
  static const Case fresh;
  const auto reset = [&](const auto &field) {
    if constexpr (std::is_same_v<std::decay_t<decltype(field)>, Choice>)
      field.set(physics, field.get(fresh));
    else if constexpr (std::is_same_v<std::decay_t<decltype(field)>, Measured>)
      field.member.in(physics) = field.member.of(fresh);
    else
      field.in(physics) = field.of(fresh);
  };
  std::visit(reset, key.field);
}

std::string value_text(const Value &value) {
  return std::visit(Writer{}, value);
}

std::string allowed_text(const Key &key) {
  if (const auto *choice = std::get_if<Choice>(&key.field))
    return quoted_list(choice->names);
  if (const auto *measured = std::get_if<Measured>(&key.field))
    return examples_text(measured->dimension);
  if (std::holds_alternative<Member<bool>>(key.field))
    return "true or false";
  if (std::holds_alternative<Member<std::string>>(key.field))
    return "any text";
  if (std::holds_alternative<Member<Words>>(key.field))
    return "a list of texts";
  if (std::holds_alternative<Member<Intervals>>(key.field))
    return "a table of intervals";
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
