#pragma once
// Names for the dense arrays of the whole solver.
//   A "position" or "velocity" of the membrane is one Vector of 2N numbers: the N axial components at the
//   nodes of the meridian, then the N radial ones.
#include <Eigen/Dense>

namespace capsule {

using Vector = Eigen::VectorXd;
using Matrix = Eigen::MatrixXd;
// Rows are contiguous: one row holds what all sources do to one target.
using RowMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

} // namespace capsule

// Compiled once, in linear_algebra.cpp, instead of in every file that solves a system.
extern template class Eigen::PartialPivLU<capsule::Matrix>;
