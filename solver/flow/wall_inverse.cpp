#include "flow/wall_inverse.hpp"
#include <stdexcept>

namespace capsule {
namespace {

constexpr double signs[] = {1, -1}; // of symmetric and of antisymmetric fields

// Fields stand in rows, both components at all points. A field plus sign times its mirror image: its first half.
RowMatrix folded(const RowMatrix &fields, double sign) {
  const Eigen::Index half = fields.cols() / 4;
  RowMatrix sums(fields.rows(), 2 * half);
  sums.leftCols(half) = fields.leftCols(half) - sign * fields.middleCols(half, half).rowwise().reverse();
  sums.rightCols(half) =
      fields.middleCols(2 * half, half) + sign * fields.rightCols(half).rowwise().reverse();
  return sums;
}

// Adds the whole fields of which these are the first halves.
template <class Fields>
void add_unfolded(const Fields &halves, typename Fields::Scalar sign, Fields &fields) {
  const Eigen::Index half = halves.cols() / 2;
  const auto axial = halves.leftCols(half), radial = halves.rightCols(half);
  fields.leftCols(half) += axial;
  fields.middleCols(half, half) -= sign * axial.rowwise().reverse();
  fields.middleCols(2 * half, half) += radial;
  fields.rightCols(half) += sign * radial.rowwise().reverse();
}

// Without the outlet's value.
RowMatrix at_points(const RowMatrix &rows) {
  const Eigen::Index n = rows.cols() / 2;
  RowMatrix points(rows.rows(), 2 * n);
  points << rows.leftCols(n), rows.rightCols(n);
  return points;
}

} // namespace

WallInverse::WallInverse(const RowMatrix &of_first_half, const Vector &column, const Vector &row)
    : unknowns_(row.size()) {
  const Eigen::Index n = column.size() / 2;
  if (n % 2 != 0)
    throw std::invalid_argument("the halves of a mirrored wall have the same number of points");
  const RowMatrix between_points = at_points(of_first_half);
  for (int k = 0; k < 2; ++k)
    halves_[k] = lu_inverse(folded(between_points, signs[k]));
  column_ = answer_of_points(column);
  const RowMatrix row_at_points = at_points(row.transpose());
  row_ = answers_of_points(row_at_points).transpose();
  corner_ = row[n] - row_at_points.row(0).dot(column_);
}

// A field is half the sum of its symmetric and antisymmetric parts.
Vector WallInverse::answer_of_points(const Vector &left_sides) const {
  const RowMatrix field = left_sides.transpose();
  RowMatrix answer = RowMatrix::Zero(1, field.cols());
  for (int k = 0; k < 2; ++k) {
    const Vector half = 0.5 * folded(field, signs[k]).transpose();
    add_unfolded(RowMatrix((halves_[k] * half).transpose()), signs[k], answer);
  }
  return answer.transpose();
}

template <class Answer>
Answer WallInverse::answers_of_points(const RowMatrix &from_points) const {
  using Scalar = typename Answer::Scalar;
  Answer answers = Answer::Zero(from_points.rows(), from_points.cols());
  for (int k = 0; k < 2; ++k) {
    const Answer half = (0.5 * folded(from_points, signs[k])).cast<Scalar>();
    add_unfolded(Answer(half * halves_[k].cast<Scalar>()), static_cast<Scalar>(signs[k]), answers);
  }
  return answers;
}

double WallInverse::answer_of_outlet(const Vector &left_sides) const {
  const Eigen::Index n = unknowns_ / 2;
  if (!is_mirrored())
    return whole_.row(n).dot(left_sides);
  return (left_sides[n] - row_.head(n).dot(left_sides.head(n)) - row_.tail(n).dot(left_sides.tail(n))) /
         corner_;
}

Vector WallInverse::answer(const Vector &left_sides) const {
  if (!is_mirrored())
    return whole_ * left_sides;
  const Eigen::Index n = unknowns_ / 2;
  const double outlet = answer_of_outlet(left_sides);
  Vector at_points(2 * n), unknowns(unknowns_);
  at_points << left_sides.head(n), left_sides.tail(n);
  const Vector of_points = answer_of_points(at_points) - outlet * column_;
  unknowns << of_points.head(n), outlet, of_points.tail(n);
  return unknowns;
}

template <class Answer>
Answer WallInverse::answers(const RowMatrix &from_unknowns) const {
  using Scalar = typename Answer::Scalar;
  if (!is_mirrored())
    return from_unknowns.cast<Scalar>() * whole_.cast<Scalar>();
  const Eigen::Index n = unknowns_ / 2;
  const RowMatrix from_points = at_points(from_unknowns);
  const Vector of_outlet = (from_unknowns.col(n) - from_points * column_) / corner_;
  const RowMatrix by_outlet = of_outlet * row_.transpose();
  const Answer of_points = answers_of_points<Answer>(from_points) - by_outlet.cast<Scalar>();
  Answer answers(from_unknowns.rows(), unknowns_);
  answers << of_points.leftCols(n), of_outlet.cast<Scalar>(), of_points.rightCols(n);
  return answers;
}
template RowMatrix WallInverse::answers(const RowMatrix &from_unknowns) const;
template RoughMatrix WallInverse::answers(const RowMatrix &from_unknowns) const;

// Half of the sum of both halves is what the first points answer to themselves, half of the difference what they answer to
// the images of others.
RowMatrix WallInverse::matrix() const {
  if (!is_mirrored())
    return whole_;
  const Eigen::Index n = unknowns_ / 2, half = n / 2;
  const RowMatrix own = 0.5 * (halves_[0] + halves_[1]), of_images = 0.5 * (halves_[0] - halves_[1]);
  RowMatrix whole(unknowns_, unknowns_);
  for (const Eigen::Index to : {0, 1})
    for (const Eigen::Index from : {0, 1}) {
      const double mirror = from == 0 ? -1 : 1; // of a component
      auto block = whole.block(to * (n + 1), from * (n + 1), n, n);
      block.topLeftCorner(half, half) = own.block(to * half, from * half, half, half);
      block.topRightCorner(half, half) =
          mirror * of_images.block(to * half, from * half, half, half).rowwise().reverse();
      block.bottomRows(half) = (to == from ? 1 : -1) * block.topRows(half).reverse();
      block.noalias() += column_.segment(to * n, n) / corner_ * row_.segment(from * n, n).transpose();
    }
  whole.col(n) << -column_.head(n) / corner_, 1 / corner_, -column_.tail(n) / corner_;
  whole.row(n) << -row_.head(n).transpose() / corner_, 1 / corner_, -row_.tail(n).transpose() / corner_;
  return whole;
}

} // namespace capsule
