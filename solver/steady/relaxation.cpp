#include "steady/relaxation.hpp"
#include "base/failure.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <optional>
#include <utility>

namespace capsule {

Vector relaxed(SteadySystem &system, Vector shape, const Control &control) {
  constexpr int most_steps = 200;
  constexpr double first_step = 0.2, shortest_step = 1e-5, long_step = 2;
  constexpr double intended = 0.25, too_much = 0.7; // part of the motion that its linearisation misses
  constexpr double near = 3e-3;                     // a change that Newton's method can take up
  constexpr double at_rest = 1e-9;                  // a velocity that is none
  constexpr double small = 1e-3;                    // a motion whose linearisation is good on a fine mesh
  constexpr int most_poor = 5;
  constexpr double torn = 6; // stretch of a membrane that runs away
  const Eigen::Index n2 = 2 * system.nodes();
  shape.head(n2 / 2).array() -= system.residual(shape)[n2]; // its centre to where the equations want it
  system.fit_tube(shape);
  SteadySystem::Linearisation linear = system.linearise(shape);
  double step = first_step, most_growth = 10;
  int poor = 0;
  double speed_before = 0; // of the last step that was taken
  for (int k = 0; k < most_steps && step > shortest_step && system.largest_stretch(shape) < torn; ++k) {
    spend(control, 1, static_cast<double>(n2) / 2);
    Matrix implicit = linear.jacobian;
    implicit.diagonal().head(n2).array() -= 1 / step;
    const Vector change = lu_solve(implicit.partialPivLu(), Vector(-linear.residual));
    const double moved = change.head(n2).cwiseAbs().maxCoeff();
    if (moved <
        at_rest * std::min(step, 1.0)) // rounding errors may be left in the residual of a stiff membrane
      return shape;
    double error = std::numeric_limits<double>::infinity();
    std::optional<SteadySystem::Linearisation> next;
    if (system.admissible_step(shape, change) == 1)
      try {
        system.fit_tube(shape + change);
        next = system.linearise(shape + change);
        error = (next->residual - change / step).head(n2).cwiseAbs().maxCoeff() /
                linear.residual.head(n2).cwiseAbs().maxCoeff();
      } catch (const NumericsFailure &) { // no capsule: the step is too long
      }
    if (error < too_much) {
      shape += change;
      linear = std::move(*next);
      system.require_stiffness(shape);
      // The way that is left, if the motion goes on to decay as it did: a steep decay may be as far as a poor linearisation, on a
      // coarse mesh, lets the steps grow.
      const double speed = moved / step;
      const double way_left = speed < speed_before ? moved / std::log(speed_before / speed)
                                                   : std::numeric_limits<double>::infinity();
      if ((step > long_step && moved < near) || way_left < near)
        return shape;
      speed_before = speed;
    }
    // A linearisation that misses as much of a small motion as of a large one is that of a finer mesh.
    poor = error > intended / 2 && moved < small ? poor + 1 : 0;
    if (poor > most_poor)
      throw NumericsFailure(
          failure_kind::unresolved, "the mesh is too coarse for the shape in the tube",
          "try a larger membrane.bending_ratio, or begin with a profile of a march (--from)");
    step *= std::clamp(intended / error, 0.25, most_growth);
    most_growth = error < too_much ? std::min(2 * most_growth, 10.0) : 1.0;
  }
  if (system.largest_stretch(shape) >= torn)
    throw NumericsFailure(failure_kind::unbounded,
                          fmt::format("the capsule runs away in the tube, stretched beyond {}", torn),
                          "try a smaller flow.capillary_number");
  throw NumericsFailure(failure_kind::unresolved, "the shape does not come to rest in the tube",
                        "begin with a profile of a march at a later x_g (--from)");
}

Case with_stiff_membrane(Case input) {
  constexpr double stiff = 1e-2;
  input.membrane.bending_ratio = std::max(stiff, input.membrane.bending_ratio);
  return input;
}

SteadyState let_loose(const Case &input, const Control &control) {
  SteadyState state{first_system(input), {}};
  Vector shape = state.system->initial();
  if (state.system->pore()) {
    const Eigen::Index n = state.system->nodes();
    const double squeeze = std::min(1.0, widest_unsqueezed / shape.segment(n, n).maxCoeff());
    shape.segment(n, n) *= squeeze;
    shape.head(n) /= squeeze * squeeze;
  }
  state.unknowns = relaxed(*state.system, shape, control);
  return state;
}

} // namespace capsule
