#pragma once
// What an integrator of a march remembers between two steps, so that the march goes on from a checkpoint bit by bit
// (motion/split_bdf.hpp). An explicit scheme has its last point alone.
#include "base/linear_algebra.hpp"
#include <cstddef>
#include <vector>

namespace capsule {

struct StepMemory {
  struct Point {
    double time = 0;
    Vector state, load, rate;  // load and rate: where the rate was asked for
    Vector rate_at_state = {}; // to first order in the distance of the two
    Vector further = {};       // what came with the rate
  };
  // A matrix of an earlier state, and the steps since.
  struct Frozen {
    Vector at = {};
    int age = 0;
  };
  std::vector<Point> past; // the latest first
  std::size_t order = 1, steps_at_order = 0;
  double step = 0;      // that the next one may have
  double left_over = 0; // what the last step's rate changed in it, in tolerances
  Frozen mobility = {}, load_jacobian = {};
  double factored = 0; // the share of the factored matrix; 0: none
};

} // namespace capsule
