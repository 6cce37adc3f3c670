#pragma once
// The keys of a case file, each declared once: its meaning, its place in a Case, its default and what is
// allowed. Reading, validation, `capsule keys`, `capsule show`, resolved.toml, --set and sweeps all follow
// from this table.
#include "case/case.hpp"
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace capsule {

// A value as it stands in a file. Unsupported: something no key takes, in words ("a boolean").
struct Unsupported {
  std::string what;
};
using Value = std::variant<Unsupported, std::string, std::int64_t, double, std::vector<double>>;

// What a key may be, as an interval.
struct Range {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool low_allowed = false;
  bool high_allowed = false;
};

// Where a key's value lives in a Case.
template <class T>
struct Member {
  T &(*in)(Case &);
  const T &(*of)(const Case &);
};
struct Choice {
  std::vector<std::string> names; // in the order of the enumeration
  void (*set)(Case &, int);
  int (*get)(const Case &);
};
// With a unit: "5 um".
struct Measured {
  Member<Quantity> member;
  Dimension dimension;
};
using Field = std::variant<Member<std::string>, Member<double>, Member<int>, Member<std::optional<double>>,
                           Member<std::vector<double>>, Choice, Measured>;

struct Key {
  std::string name;    // "flow.capillary_number"
  std::string meaning; // with the paper's symbol
  Field field;
  Range range = {};
  // How the value is found when the key is not given; empty: the value of a fresh Case.
  std::string automatic = {};
  bool required = false;
};

const std::vector<Key> &keys();
const Key *find_key(const std::string &name);

// Why a value cannot be taken, and what may have been meant.
struct Complaint {
  std::string message;
  std::string hint;
};
std::optional<Complaint> set_value(const Key &key, const Value &value, Case &physics);

// No value: not given, chosen automatically. A quantity with its unit is a text, as it was typed.
std::optional<Value> get_value(const Key &key, const Case &physics);
// From now on all quantities stand in SI units, the same ones for "5 um" and "5e-3 mm".
void forget_spellings(Case &physics);

// As TOML writes it.
std::string value_text(const Value &value);
// What is allowed, in words: "0 < value <= 90", "one of 'pore', 'extension'".
std::string allowed_text(const Key &key);
// The default in words: "78.5", "required".
std::string default_text(const Key &key);

} // namespace capsule
