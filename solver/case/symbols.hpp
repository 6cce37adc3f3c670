#pragma once
// What keys are called beside their names: the symbols of the paper and others that are usual in the field. And the key
// that a wrong name most likely meant. Throws nothing.
#include "case/key.hpp"
#include <string>
#include <vector>

namespace capsule {

// "epsilon", "eps", "Ca" of flow.capillary_number.
std::vector<std::string> symbols_of(const Key &key);

// By its whole or its short name; nullptr if there is none.
const Key *key_named(const std::string &name);

// By its symbol, or by the letters of its last word, of its section's keys first. Empty if none is near.
std::string nearest_key(const std::string &typed);

} // namespace capsule
