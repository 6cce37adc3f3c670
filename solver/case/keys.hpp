#pragma once
// The keys of a case file, each declared once. Reading, validation, `capsule keys`, `capsule show`, resolved.toml, --set,
// sweeps and branches all follow from this table. Throws nothing.
#include "case/key.hpp"
#include <string>
#include <vector>

namespace capsule {

const std::vector<Key> &keys();
const Key *find_key(const std::string &name);

// From now on all quantities stand in SI units, the same ones for "5 um" and "5e-3 mm".
void forget_spellings(Case &physics);

} // namespace capsule
