#pragma once
// What the studies of steady states share: branches followed to their first fold on a mesh of the study's choice.
#include "steady/mesh_change.hpp"
#include "study.hpp"
#include <functional>

namespace capsule {

// A steady state as the studies report it: value of the key, row, growth rate, and the slack of the equations, which is
// the error of discretisation.
struct SteadyPoint {
  double value = 0;
  SeriesRow row;
  double growth_rate = 0;
  double slack = 0;
};

struct Fold {
  SteadyPoint point;
  double value_before = 0; // of a steady state on this side of it, from which another mesh can start
  SteadyState before;
};

// How a branch ended without a fold: at the end of its path, or where the membrane stretches beyond 8, or where the
// mesh ends (the slack, or Newton's method).
struct FoldSearch {
  std::optional<Fold> fold;
  SteadyPoint last;
  SteadyState state; // of the last point
  std::string end;   // "fold", "end of the path", "stretch", "mesh"
};

// From a case's steady state along a key, upwards or downwards to a value. `look` sees every point.
using Look = std::function<void(const SteadyState &state, const Case &physics)>;
FoldSearch find_fold(const Case &physics, const SteadyState &start, const std::string &key, double to,
                     double largest_step, const Look &look = {});

// The same fold on another mesh.
Fold fold_on_mesh(const Case &physics, const std::string &key, double to, const Fold &fold, int nodes);

} // namespace capsule
