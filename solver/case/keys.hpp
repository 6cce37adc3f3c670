#pragma once
// The keys of a case file, each declared once. Reading, validation, `capsule keys`, `capsule show`, resolved.toml, --set,
// sweeps and branches all follow from this table. Throws nothing.
#include "case/key.hpp"
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace capsule {

// The keys of the strength of the flow and of the bending stiffness.
inline constexpr const char *flow_key = "flow.capillary_number", *bending_key = "membrane.bending_ratio";

const std::vector<Key> &keys();
const Key *find_key(const std::string &name);
// As runs are named: "capillary_number" of "flow.capillary_number"; the whole name where another key ends so, too.
std::string_view short_name(const Key &key);

// Whether the key means something to a case, and why not: `pore.exit_x means nothing to flow.type = "extension"`.
bool means_something(const Key &key, const Case &physics);
std::string why_meaningless(const Key &key, const Case &physics);
// Where it means something: `time.scheme = "euler" or "rk4"`; empty: everywhere.
std::string scope_text(const Key &key);

// What only `capsule fit` looks at: the table [fit], and what stands in for the flow rate.
bool is_of_fits(const Key &key);

bool steady_states_depend_on(const Key &key, const Case &physics);
// The keys along which branches go, and which a fit may find.
std::vector<std::string> parameters_of_steady_states();

// From now on all quantities stand in SI units, the same ones for "5 um" and "5e-3 mm".
void forget_spellings(Case &physics);

} // namespace capsule
