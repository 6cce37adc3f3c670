#pragma once
// What a key of a case file is: its meaning, its place in a Case, its default and what is allowed; and how values are set,
// read and told. The keys themselves are in keys.hpp. Throws nothing.
#include "base/range.hpp"
#include "case/located_text.hpp"
#include "case/units.hpp"
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace capsule {

struct Case;

// A value as it stands in a file. Unsupported: something no key takes, in words ("a date or time").
struct Unsupported {
  std::string what;
};
using Words = std::vector<std::string>;
using Intervals = std::map<std::string, std::vector<double>>; // of keys
using Value =
    std::variant<Unsupported, bool, std::string, std::int64_t, double, std::vector<double>, Words, Intervals>;

// Where a key's value lives in a Case.
template <class T>
struct Member {
  std::function<T &(Case &)> in;
  std::function<const T &(const Case &)> of;
};
struct Choice {
  std::vector<std::string> names;
  std::function<void(Case &, int)> set; // to a name's index
  std::function<int(const Case &)> get;
};
// With a unit: "5 um".
struct Measured {
  Member<Quantity> member;
  Dimension dimension;
};
using Field = std::variant<Member<bool>, Member<std::string>, Member<double>, Member<int>,
                           Member<std::optional<double>>, Member<std::vector<double>>, Member<Words>,
                           Member<Intervals>, Choice, Measured>;

// What a key is to a steady state.
enum class SteadyRole {
  none, // of the motion alone: its start, its end, its steps
  pore, // the empty pore's length and mouths: results under constant pressure, and its resistance, depend on it
  result,   // results depend on it
  parameter // a number in its equations: branches go along it
};

// Where a key means something: with one of these values of another key. Without a key: everywhere.
struct Scope {
  std::string key;
  std::vector<std::string> values;
  std::string decided_by = {}; // the key that `key` follows unless it is given
};

struct Key {
  std::string name;    // "flow.capillary_number"
  std::string meaning; // with the paper's symbol
  Field field;
  Range range = {};
  // How the value is found when the key is not given; empty: the value of a fresh Case.
  std::string automatic = {};
  bool required = false;
  SteadyRole steady = SteadyRole::result;
  Scope scope = {};
  bool of_each_capsule = false;        // several capsules may have a list of values, the leading one's first
  std::vector<std::string> notes = {}; // for `capsule keys`, a line each
};

// Why the key cannot take a value, if it cannot.
std::optional<Complaint> set_value(const Key &key, const Value &value, Case &physics);

// No value: not given, chosen automatically. A quantity with its unit is a text, as it was typed. Whether the value means
// something is up to value_of in keys.hpp.
std::optional<Value> get_value(const Key &key, const Case &physics);
// Back to the value of a fresh Case.
void reset_value(const Key &key, Case &physics);
// As TOML writes it.
std::string value_text(const Value &value);
// What is allowed, in words: "0 < value <= 90", "one of 'pore', 'extension'".
std::string allowed_text(const Key &key);
// The default in words: "78.5", "required".
std::string default_text(const Key &key);

} // namespace capsule
