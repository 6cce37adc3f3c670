#pragma once
// Time integration of dy/dt = u(y) where a cheap and stiff part of the rate, the load F, stands behind an expensive one
// that changes slowly, the mobility:
//   dy/dt = M F(y) + g(y),   g = u - M F
// M is the mobility of an earlier state. Backward differences of order k (1 to 5) over the last steps, of whatever lengths
// these had, give the new state twice:
//   - with g extrapolated from the last k states. The load is implicit, so that only F is computed again and again;
//   - corrected once with the rate u of that state. What is left is the correction times what M misses of the mobility.
// A step so costs one rate, at the state of its first part. Between its ends the state, the rate, and what came with it, are
// polynomials of the step's order. The error of a step is the difference of its end to the extrapolated past, times the
// formula's factor. Everything that the next step depends on can be saved. paper-notes/methods.md has the measurements.
#include "base/failure.hpp"
#include "base/linear_algebra.hpp"
#include "observe/step_memory.hpp"
#include <cstddef>
#include <functional>
#include <limits>
#include <optional>
#include <vector>

namespace capsule {

struct SplitEquations {
  std::function<Vector(const Vector &state)> load;
  // dy/dt, and what else is computed with it. May throw NumericsFailure: a shorter step is tried.
  struct Rate {
    Vector rate;
    Vector further = {};
  };
  std::function<Rate(const Vector &state)> rate;
  // du/dF; dF/dy, which may be approximate.
  std::function<Matrix(const Vector &state)> mobility, load_jacobian;
  // Components whose loads depend on each other: dF/dy has no entries between different parts. Each component is in one;
  // without parts all depend on all.
  std::vector<std::vector<Eigen::Index>> parts = {};
};

class SplitBdf {
public:
  // tolerance: error of a step, root mean square over the components, absolute.
  SplitBdf(SplitEquations equations, double time, const Vector &state, double tolerance);
  // Goes on from where another one was.
  SplitBdf(SplitEquations equations, StepMemory memory, double tolerance);

  // One step, not longer than given. When no step is short enough, throws what the rate throws, or NumericsFailure("step")
  // where the rate is known in shorter steps but these have too large errors.
  void step(double longest = std::numeric_limits<double>::infinity());
  double time() const { return memory_.past[0].time; }
  double previous_time() const { return memory_.past.at(1).time; }
  // At a time of the last step, from the polynomial of its order: the state, the rate, and what came with it.
  Vector state_at(double time) const;
  Vector rate_at(double time) const;
  Vector further_at(double time) const;
  const StepMemory &memory() const { return memory_; }

private:
  // A step that is being tried, in which y = known + share (M F(y) + remainder).
  struct Trial {
    std::size_t order = 0;
    double time = 0, share = 0;
    Vector known, remainder, predicted, state;
  };

  std::size_t available() const { return memory_.past.size(); }
  Vector extrapolated(std::size_t points, double time) const;
  Vector interpolated(Vector StepMemory::Point::*values, double time) const;
  Trial set_up() const;
  void find_matrices();
  void multiply();
  void freeze_mobility();
  void freeze_load_jacobian();
  void factor(double share);
  Vector correction(const Vector &residual, double share) const;
  bool solve(Trial &trial);
  double error(const Trial &trial, std::size_t order, const Vector &state) const;
  void choose_next(const Trial &trial, const Vector &state, double error);
  bool try_step(std::optional<NumericsFailure> &cause);

  SplitEquations equations_;
  double tolerance_;
  StepMemory memory_;
  std::vector<Vector> remainders_;             // g of memory_.past
  Matrix mobility_, load_jacobian_, jacobian_; // M, dF/dy, M dF/dy
  Eigen::PartialPivLU<Matrix> factors_;        // of 1 - share M dF/dy
  std::size_t last_order_ = 1;                 // of the last step
};

} // namespace capsule
