#pragma once
// A fold of a branch along one key, followed as a second key changes: a curve in the plane of the two.
//
// A point is a steady state F(u; p, q) = 0 whose Jacobian J is singular. With fixed vectors b and c the system
//   | J  b | |v|   |0|
//   | c' 0 | |g| = |1|
// has the solution g = 0 just there (W. Govaerts, Numerical Methods for Bifurcations of Dynamical Equilibria, SIAM
// 2000, section 4.1), and with w, the same of the transposed matrix, dg = -w' dJ v. As second derivatives are
// symmetric, w' dJ v for a change of u is that change times (J(u + h v) - J(u - h v))' w/(2h), and for one of a key it is
// (dF/dp(u + h v) - dF/dp(u - h v))' w/(2h). These serve Newton's method only: the point is as exact as F and J.
// The keys' parts p and q run on their paths, from 0 to 1 and further (key_path.hpp). Throws NumericsFailure.
#include "case/key_path.hpp"
#include "observe/outcome.hpp"
#include "steady/continuation.hpp"
#include "steady/mesh_change.hpp"
#include <functional>

namespace capsule {

struct FoldPoint {
  Vector unknowns;
  double part = 0, second_part = 0; // on the paths of the branch's key and of the second key
};

class FoldCurve {
public:
  // `start` is near to a fold, and `null_vector`, the tangent of the branch there, to one of J. The curve goes on to the
  // side of growing second_part; with a tangent (changes of the unknowns, then of both parts) to its side.
  FoldCurve(SteadySystem &system, KeyPath key, KeyPath second, FoldPoint start, const Vector &null_vector,
            const Vector &tangent = {});

  const FoldPoint &point() const { return point_; }
  const Vector &tangent() const { return tangent_; }
  const FoldPoint &point_before() const { return before_; }
  const Vector &tangent_before() const { return tangent_before_; }
  const Vector &null_vector() const { return null_vector_; }
  // To the next point. Throws when the smallest step fails; the curve stays where it was.
  void advance();
  bool wants_a_finer_mesh() const { return is_slow_ || poorly_resolved(*system_, point_.unknowns); }
  // The fold between the last two points at a second part between theirs.
  FoldPoint at_second(double part) const;

private:
  struct Corrected {
    FoldPoint point;
    Vector tangent, null_vector, left_vector;
    double first_correction = 0;
    int iterations = 0;
  };
  Corrected correct(const FoldPoint &from, const Vector &tangent, double step, const Vector &curvature) const;
  Corrected corrected(FoldPoint now, const Vector &row, double aim, const Vector &direction) const;
  Vector curvature() const;
  double weighted(const Vector &a, const Vector &b) const;
  void set_parameters(double part, double second_part) const;
  void accept(Corrected next);

  SteadySystem *system_;
  KeyPath key_, second_;
  FoldPoint point_, before_;
  Vector tangent_, tangent_before_, null_vector_, left_vector_;
  double step_;
  int points_ = 0;
  bool is_slow_ = false; // Newton's method, at the last point
};

// A fold followed on meshes that are fine enough, up to so many nodes, to where the second key's path ends or begins
// again. `state` is on the fold's mesh, and at last the point that is returned. Each point is told as it is found; the
// state's system has its parameters then. Throws Interrupted, too.
using OnFold = std::function<void(const SteadyState &state, const FoldPoint &point)>;
FoldPoint follow_fold(SteadyState &state, const FoldPoint &start, const Vector &null_vector,
                      const KeyPath &key, const KeyPath &second, int finest, const Control &control,
                      const OnFold &found);

} // namespace capsule
