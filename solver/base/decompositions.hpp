#pragma once
// Decompositions of dense matrices other than LU. Eigen's templates for them take ten seconds to compile: here and nowhere
// else. Throws nothing.
#include "base/linear_algebra.hpp"

namespace capsule {

struct EigenPairs {
  Eigen::VectorXcd values;
  Eigen::MatrixXcd vectors; // columns of length 1
};

// In no order.
Eigen::VectorXcd eigenvalues(const Matrix &matrix);
EigenPairs eigenpairs(const Matrix &matrix);
// Orthonormal columns that span what all rows of a matrix are orthogonal to; there are fewer rows than columns.
Matrix orthogonal_to_rows(const Matrix &rows);
// Columns are combined to what is nearest to `target`, with the shortest such coefficients: what of a column is below
// `threshold` of the longest one counts as dependent on the others.
Vector least_squares(const Matrix &columns, const Vector &target, double threshold);

} // namespace capsule
