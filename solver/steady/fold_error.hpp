#pragma once
// The error of a fold: how far the same fold lies from it on two coarser meshes, as for a steady state (refinement.hpp). Their
// nodes are spread as those of the fold's mesh, which may suit an earlier shape of the branch.
//
// There it is found by one step of Newton's method for F(u, p) = 0 and g(u, p) = 0, with g, v and w of fold_curve.hpp. The
// change of g is -w' dJ v, where dJ v is the second derivative of F along v and the step, by differences of F. So it costs one
// linearisation a mesh; what the step leaves is of second order in the distance of both folds.
#include "observe/records.hpp"
#include "steady/mesh_change.hpp"
#include <map>
#include <optional>
#include <string>

namespace capsule {

// Bounds by estimate of the errors of the key's value and of the quantities of the row, by their names. The state's system has
// the parameters of the fold along the key. Empty where a coarser mesh does not tell.
std::map<std::string, double> errors_of_fold(const SteadyState &fold, const std::string &key,
                                             const SeriesRow &row);
// That of the key's value alone.
std::optional<double> error_of_fold(const SteadyState &fold, const std::string &key);

} // namespace capsule
