#pragma once
// Names for the dense arrays of the whole solver.
//   A "position" or "velocity" of the membrane is one Vector of 2N numbers: the N axial components at the
//   nodes of the meridian, then the N radial ones.
#include <Eigen/Core>
#include <Eigen/LU>
#include <vector>

namespace capsule {

using Vector = Eigen::VectorXd;
using Matrix = Eigen::MatrixXd;
// Rows are contiguous: one row holds what all sources do to one target.
using RowMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
// In single precision: a product takes half the time.
using RoughMatrix = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

// A square matrix times `blocks`, of the same size, which has no entries between different parts. A part is the list of its
// indices; each index is in one part. The cost falls with the number of parts.
Matrix times_blocks(const Matrix &matrix, const Matrix &blocks,
                    const std::vector<std::vector<Eigen::Index>> &parts);

// By LU with exchanged rows. Eigen's templates for it take long to compile: in linear_algebra.cpp and nowhere else.
Matrix lu_inverse(const Matrix &matrix);
RowMatrix lu_inverse(const RowMatrix &matrix);
Vector lu_solve(const Eigen::PartialPivLU<Matrix> &factors, const Vector &right);
Matrix lu_solve(const Eigen::PartialPivLU<Matrix> &factors, const Matrix &right);

} // namespace capsule

extern template class Eigen::PartialPivLU<capsule::Matrix>;
