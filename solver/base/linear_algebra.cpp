#include "base/linear_algebra.hpp"

template class Eigen::PartialPivLU<capsule::Matrix>;
