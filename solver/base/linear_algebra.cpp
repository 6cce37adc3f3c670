#include "base/linear_algebra.hpp"

template class Eigen::PartialPivLU<capsule::Matrix>;

namespace capsule {

Matrix times_blocks(const Matrix &matrix, const Matrix &blocks,
                    const std::vector<std::vector<Eigen::Index>> &parts) {
  Matrix product(matrix.rows(), blocks.cols());
  for (const std::vector<Eigen::Index> &part : parts) {
    const Matrix columns = matrix(Eigen::all, part), block = blocks(part, part);
    product(Eigen::all, part) = columns * block;
  }
  return product;
}

Matrix lu_inverse(const Matrix &matrix) {
  return matrix.partialPivLu().inverse();
}

RowMatrix lu_inverse(const RowMatrix &matrix) {
  return matrix.partialPivLu().inverse();
}

Vector lu_solve(const Eigen::PartialPivLU<Matrix> &factors, const Vector &right) {
  return factors.solve(right);
}

Matrix lu_solve(const Eigen::PartialPivLU<Matrix> &factors, const Matrix &right) {
  return factors.solve(right);
}

} // namespace capsule
