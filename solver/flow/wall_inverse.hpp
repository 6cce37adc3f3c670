#pragma once
// A^(-1) of wall.hpp: from what stands on the left sides of the wall's equations to its unknowns. Both are a component
// along x at n points, a value of the outlet, and a component along r at the points.
//   A tube, or a pore with two mouths, is its own mirror image. Its wall answers symmetric velocities by symmetric forces and
// antisymmetric ones by antisymmetric forces: each takes a matrix of half the size, which needs an eighth of the work to be
// inverted and a quarter of it in products. The outlet, at one end only, borders the two.
#include "base/linear_algebra.hpp"
#include "flow/joined_panels.hpp"
#include <utility>

namespace capsule {

class WallInverse {
public:
  WallInverse() = default;
  explicit WallInverse(RowMatrix whole) : unknowns_(whole.rows()), whole_(std::move(whole)) {}
  // Of a wall whose points lie symmetrically. Throws std::invalid_argument if their number is odd. Of A: the rows of the first half of the points (n x 2n + 1),
  // the column of the outlet at all points (2n), and its row (2n + 1).
  WallInverse(const RowMatrix &of_first_half, const Vector &column, const Vector &row);

  Eigen::Index unknowns() const { return unknowns_; }
  bool is_mirrored() const { return halves_[0].size() > 0; }
  // A^(-1) b, and the outlet's unknown in it.
  Vector answer(const Vector &left_sides) const;
  double answer_of_outlet(const Vector &left_sides) const;
  // C A^(-1)
  template <class Answer = RowMatrix> // or RoughMatrix
  Answer answers(const RowMatrix &from_unknowns) const;
  RowMatrix matrix() const;
  // P^T A^(-1) P: that of joined panels.
  WallInverse joined(const Joining &joining) const {
    return WallInverse(is_mirrored() ? joining.both_sides(matrix()) : joining.both_sides(whole_));
  }

private:
  Vector answer_of_points(const Vector &left_sides) const;
  template <class Answer = RowMatrix>
  Answer answers_of_points(const RowMatrix &from_points) const;

  Eigen::Index unknowns_ = 0;
  RowMatrix whole_;     // empty if it is mirrored
  RowMatrix halves_[2]; // of symmetric and of antisymmetric fields
  Vector column_, row_; // what the points answer to the outlet's column, and its row of what they answer
  double corner_ = 0;   // of the outlet, less what the points answer to it
};

} // namespace capsule
