#pragma once
// Branches of steady states: pseudo-arclength continuation along one key, through folds, from guesses that bend with
// the branch. A point is (unknowns of steady_system.hpp, parameter); the parameter is the part of a key's path, from 0
// to 1. Lengths along a branch combine the parameter and the root mean square displacement of the nodes, with a weight
// that makes both count: a shell that buckles turns a branch within displacements of 1e-3.
#include "case/key_path.hpp"
#include "observe/outcome.hpp"
#include "steady/steady_system.hpp"
#include <array>
#include <limits>
#include <optional>
#include <span>

namespace capsule {

struct BranchPoint {
  Vector unknowns;
  double parameter = 0;
};

constexpr std::array ends_of_path{0.0, 1.0};

class Branch {
public:
  // Lengths along the branch; how far, in displacement, the next correction of a point would move it; the unresolved part of a
  // shape above which it wants a finer mesh; and how far, in steps, a point may lie from its guess. Beyond a fifth it may lie
  // on another branch, which a way to some state need not care for.
  struct Steps {
    double first, largest, tolerance;
    double largest_unresolved_part = fine_tail;
    double largest_miss = std::numeric_limits<double>::infinity();
  };
  // Whether the parameter grows along the branch.
  enum class Trend { falls, grows };
  // `start` is near to a steady state. The branch begins with the state next to it in the plane across `direction`
  // (changes of the unknowns, then of the parameter), and goes on to that side. `trend` is that of the way to the start:
  // a fold may lie between. What it asks of `control` it asks before each correction, and throws Interrupted, too.
  Branch(SteadySystem &system, KeyPath path, BranchPoint start, const Vector &direction, const Steps &steps,
         Trend trend = Trend::grows, Control control = {});
  // The direction in which the parameter alone grows.
  static Vector upwards(const SteadySystem &system);

  const BranchPoint &point() const { return point_; }
  // Where the last correction of the point began, which is nearer than Steps::tolerance.
  const SteadySystem::Linearisation &linearisation() const { return slopes_->linear; }
  // Length of the next step as Steps::first has it, without a weight.
  double plain_step() const;
  // The direction in which the branch goes on, like `direction` above.
  const Vector &tangent() const { return tangent_; }
  // Of the last step.
  Trend trend() const { return trend_; }
  // The same for the point before.
  const BranchPoint &point_before() const { return before_; }
  const Vector &tangent_before() const { return tangent_before_; }
  Trend trend_before() const { return trend_before_; }

  // To the next point: at the first of these parameters that the step would pass, else at the step's end. Throws
  // NumericsFailure when the smallest step fails; the branch stays where it was.
  void advance(std::span<const double> stops = ends_of_path);
  bool wants_a_finer_mesh() const {
    return poorly_resolved(*system_, point_.unknowns, steps_.largest_unresolved_part);
  }
  // The steady state between the last two points at a parameter between theirs: a surer end of a way with long steps.
  BranchPoint at_parameter(double parameter) const;
  // Throws NumericsFailure if the membrane has softened in the last step, before the parameter came to `end`. It says from
  // which parameter on: behind it states depend on the mesh.
  void require_stiffness(double end) const;
  // Whether the parameter has turned back in the last step or shortly before it.
  bool turned() const;
  // Whether the tangent has turned, too; if not, the mesh resolves some part of the shape too poorly to tell.
  bool tangent_has_turned() const;
  // The fold where it has turned. Throws NumericsFailure if there is none: on a poor mesh points may turn back where the
  // branch does not.
  BranchPoint fold() const;
  // The steady state on the near side of that fold, at a parameter between the fold's and that of the last point before.
  BranchPoint before_fold(const BranchPoint &fold, double parameter) const;

private:
  struct Slopes {
    SteadySystem::Linearisation linear;
    Vector in_parameter;
  };
  struct Corrected {
    BranchPoint point;
    Vector tangent;
    Slopes slopes; // where the last correction began
    // From Newton's first correction to the next one; 0 where the first one was small enough.
    double contraction = 0;
  };
  Corrected correct(const BranchPoint &from, const Vector &row, double length, double tolerance,
                    const Vector &way_to_guess, std::optional<Slopes> slopes) const;
  Vector way_to_guess(double step) const;
  std::optional<double> first_passed(std::span<const double> stops, double parameter) const;
  double step_to(double parameter, double farthest) const;
  double weighted(const Vector &a, const Vector &b) const;
  double along_tangent_before(const BranchPoint &at) const;
  Vector row_across(const Vector &tangent) const;
  Vector slope_in_parameter(const BranchPoint &at, const SteadySystem::Linearisation &linear) const;
  Vector bend_towards(const BranchPoint &end) const;
  void balance();

  SteadySystem *system_;
  KeyPath path_;
  Control control_;
  BranchPoint point_, before_, oldest_;
  std::optional<Slopes> slopes_;
  Vector tangent_, tangent_before_;
  Steps steps_;
  double step_;
  int points_ = 1;
  Trend trend_, trend_before_;
  double weight_ = 1; // of displacements
};

} // namespace capsule
