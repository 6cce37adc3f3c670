#pragma once
// The units of an expression's references: "pressure_drop [Pa]", "v_g [mm/s]@x_g [um]=50".
#include "compare/expression.hpp"
#include "output/run_result.hpp"
#include <string>
#include <string_view>

namespace capsule {

// Begins a name that means the estimated error of the quantity behind it.
inline constexpr std::string_view of_errors = "error_estimate.";

// Throws InputError, with one line, if a name of the reference has no unit, or not this one.
void check_units(const Reference &reference);

// By what the number that stands under a name is multiplied to be in this unit; 1 for none. The units have been checked.
// Throws NoValue if the run is not in physical units, or along a branch.
double in_unit(const RunResult &run, const std::string &name, const std::string &unit);

} // namespace capsule
