#include "base/decompositions.hpp"
#include <Eigen/Eigenvalues>
#include <Eigen/QR>

namespace capsule {

Eigen::VectorXcd eigenvalues(const Matrix &matrix) {
  return Eigen::EigenSolver<Matrix>(matrix, false).eigenvalues();
}

EigenPairs eigenpairs(const Matrix &matrix) {
  const Eigen::EigenSolver<Matrix> eigen(matrix);
  return {eigen.eigenvalues(), eigen.eigenvectors()};
}

Matrix orthogonal_to_rows(const Matrix &rows) {
  const Matrix directions = Eigen::HouseholderQR<Matrix>(rows.transpose()).householderQ();
  return directions.rightCols(rows.cols() - rows.rows());
}

Vector least_squares(const Matrix &columns, const Vector &target, double threshold) {
  Eigen::CompleteOrthogonalDecomposition<Matrix> decomposition(columns.rows(), columns.cols());
  decomposition.setThreshold(threshold);
  decomposition.compute(columns);
  return decomposition.solve(target);
}

} // namespace capsule
