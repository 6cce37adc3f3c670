#pragma once
// How the equations F(u; p) = 0 of steady_system.hpp, and the steady state itself, depend on keys of the case.
//
// The flow's matrices depend on the shape alone. At a given shape parameters enter through the load f = q/epsilon and
// the two constraints c, so that dF/dp = (S/(8 pi) df/dp, dc/dp) with the single layer S that the linearisation has
// already. f and c are those of the membrane alone: cheap, and smooth in every key. They are differentiated by central
// differences of fourth order with steps h = 1e-3 relative: errors of order h^4 and, from rounding, of 1e-16/h times the
// load's own condition, together below 1e-8 of the slope (test_slopes.cpp). Newton's method needs less: after a
// correction of length c, a relative error e of the parameter's column leaves e c. With corrections of about 1e-4
// before the last one, e < 1e-5 keeps that below the tolerance of 1e-9.
//   The period of a train moves images: it enters through the flow. Then the whole residual is differentiated likewise, to
// about 1e-6, as kernels are integrated to 1e-9.
// Throws NumericsFailure for shapes that are no capsule in the tube (sensitivities).
#include "steady/steady_system.hpp"
#include <span>
#include <string>

namespace capsule {

// dF/dp of keys that hold real numbers, (2N + 2) x keys, each per unit of the key's value, at the parameters that the
// system has. Zero for a key that a steady state does not depend on. `linear` is the system's linearisation there.
Matrix slopes(SteadySystem &system, const Vector &unknowns, const SteadySystem::Linearisation &linear,
              std::span<const std::string> keys);

// du/dp = -J^-1 dF/dp at a steady state, (2N + 2) x keys.
Matrix sensitivities(SteadySystem &system, const Vector &unknowns, std::span<const std::string> keys);

} // namespace capsule
