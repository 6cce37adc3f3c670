#pragma once
// How far one parameter may go from a minimum before the sum of squares, minimised over all others, has grown by so much.
// Throws what the problem's evaluation throws, but for NumericsFailure, which ends the way.
#include "fit/least_squares.hpp"

namespace capsule {

struct Reach {
  double value = 0;
  bool open = false;     // the sum has not grown by so much up to here
  bool at_bound = false; // because the way ends at a bound,
  bool at_end = false;   // or because no sum is found beyond
};
// `sense`: 1 upwards, -1 downwards. To within a hundredth of the way.
Reach reach(const LeastSquares &problem, const Minimum &minimum, const Matrix &covariance,
            Eigen::Index parameter, int sense, double growth);

} // namespace capsule
