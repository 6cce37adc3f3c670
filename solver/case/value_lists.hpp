#pragma once
// The value of a key that a case has. Several capsules may have a list, the leading one's value first. Throws nothing.
#include "case/key.hpp"
#include <optional>
#include <string>
#include <vector>

namespace capsule {

// What is said of a list of another length.
inline constexpr const char *one_value_or_each =
    "give one value for all of them, or one for each, the leading one's first";

// The value, unless it was not given, is chosen automatically, or means nothing to the case. Of several capsules that
// differ in it a list.
std::optional<Value> value_of(const Key &key, const Case &physics);

// Of a list of numbers or texts its entries, of any other value the value itself.
std::vector<Value> entries_of(const Value &value);
// The value that all have, or else their list.
Value joined(const std::vector<Value> &values);
// As the names of runs have it: without quotes, lists as "-4_-6.5".
std::string plain_text(const Value &value);

} // namespace capsule
