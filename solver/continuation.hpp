#pragma once
// Branches of steady states: Newton's method at given parameters, and pseudo-arclength continuation along one
// parameter, through folds. A point is (unknowns of steady_system.hpp, parameter); lengths along a branch
// weigh the root mean square displacement of the nodes and the parameter alike, so the parameter should be
// scaled to go through about one.
#include "steady_system.hpp"
#include <functional>

namespace capsule {

// The case at a value of the parameter. The scene stays the same.
using Path = std::function<Case(double)>;

struct BranchPoint {
  Vector unknowns;
  double parameter = 0;
};

// The steady state next to a guess, at the parameters that the system has taken; position to `tolerance`.
// Throws NumericsFailure("unresolved") if Newton's method does not converge, or what is wrong with the shape.
Vector solve_steady(SteadySystem &system, Vector guess, double tolerance);

class Branch {
public:
  // `start` is a steady state; the branch begins in the direction in which the parameter grows (towards +1)
  // or falls (-1).
  Branch(SteadySystem &system, Path path, BranchPoint start, int towards, double first_step,
         double largest_step);

  const BranchPoint &point() const { return point_; }
  // d parameter/d arclength: changes its sign at a fold.
  double slope() const { return tangent_[tangent_.size() - 1]; }

  // To the next point. Throws NumericsFailure when the smallest step fails; the branch stays where it was.
  void advance();
  // The steady state between the last two points at a parameter between theirs.
  BranchPoint at_parameter(double parameter) const;
  // After an advance in which the slope changed its sign: the fold between.
  BranchPoint fold() const;

private:
  struct Corrected {
    BranchPoint point;
    Vector tangent;
    int iterations = 0;
  };
  Corrected correct(const BranchPoint &from, const Vector &tangent, double step, double tolerance) const;
  Vector parameter_slope(const BranchPoint &at) const;
  double weighted(const Vector &a, const Vector &b) const;

  SteadySystem *system_;
  Path path_;
  BranchPoint point_, before_;
  Vector tangent_, tangent_before_;
  double step_, largest_step_, last_step_ = 0;
};

} // namespace capsule
