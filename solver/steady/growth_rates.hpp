#pragma once
// Small motions of the membrane about a steady state: displacements d of the nodes obey dd/dt = M d, with the matrix M
// of linear_motion.hpp, and grow as exp(rate t). Rates are per unit of time, those with the largest real part first.
// Two motions are left out: the displacement along the axis, which changes nothing, and a change of volume, for which
// there is no velocity. In a train the neighbours move alike, or opposed: then displacements along the axis bring capsules
// together in pairs, and are not left out. Derivation: paper-notes/equations.md, section 8.
#include "steady/steady_system.hpp"
#include <complex>

namespace capsule {

// M, 2N x 2N, with the viscosity ratio of the system's case and the membrane's own viscosity.
Matrix small_motion(const SteadySystem &system, const Vector &unknowns,
                    Neighbours neighbours = Neighbours::alike);

// All 2N - 2 rates; 2N - 1 with opposed neighbours.
Eigen::VectorXcd all_growth_rates(const SteadySystem &system, const Vector &unknowns,
                                  Neighbours neighbours = Neighbours::alike);

// All of them if one grows; otherwise only those of smallest modulus (30 or more), to 1e-8 relative. Throws
// NumericsFailure("unresolved") if none converges.
Eigen::VectorXcd growth_rates(const SteadySystem &system, const Vector &unknowns,
                              Neighbours neighbours = Neighbours::alike);
// The first of them alone, from the linearisation at the state, in less time.
std::complex<double> slowest_rate(const SteadySystem &system, const SteadySystem::Linearisation &linear,
                                  Neighbours neighbours = Neighbours::alike);

} // namespace capsule
