#pragma once
// The membrane as an elastic body: its reference shape sampled on a quadrature along the meridian, its strain, and the
// energy whose gradient is its load on the liquids.
#include "case.hpp"
#include "membrane_law.hpp"
#include "meridian.hpp"

namespace capsule {

// Points along the meridian where fields are sampled, and the matrices that take nodal values there.
struct Sampling {
  Vector zeta;
  Vector weights; // integral over [0, pi] = sum weights f
  Matrix even[3]; // value, first and second derivative in zeta; points x N
  Matrix odd[3];
};
Sampling sample(const MeridianBasis &basis, const Vector &zeta, const Vector &weights);

struct Membrane {
  MembraneLaw law;
  double bending_ratio = 0; // delta
  MeridianBasis basis;
  Vector reference;   // undeformed position of the nodes, 2N, centred at x = 0
  Sampling sampling;  // where the energy is integrated
  // Reference shape at the sampling's points.
  Vector reference_radius;     // R
  Vector reference_arc;        // dS/dzeta
  Vector reference_curvature_meridional, reference_curvature_azimuthal; // kappa^0
};

// A spheroid of semi-axes A (axial) and B with (A B^2)^(1/3) = capsule.radius; node j at X = -A cos(zeta_j),
// R = B sin(zeta_j).
Membrane make_membrane(const Case &physics, const MeridianBasis &basis, const Vector &zeta, const Vector &weights);

// Strain, tensions (eqs. 2, 4, 5), curvatures (eq. 3) and moments (eq. 6) at given points.
struct MembraneState {
  Vector x, r;
  Vector arc;                    // ds/dzeta
  Vector normal_x, normal_r;     // out of the capsule
  Vector stretch_meridional, stretch_azimuthal;
  Vector tension_meridional, tension_azimuthal;
  Vector curvature_meridional, curvature_azimuthal;
  Vector moment_meridional, moment_azimuthal;
};
MembraneState membrane_state(const Membrane &membrane, const Sampling &at, const Vector &position);

// Elastic energy, scaled with G R_t^2:
//   W = integral over the reference area of w(lambda_s, lambda_phi)
//       + (delta/2) (K_s^2 + 2 nu K_s K_phi + K_phi^2),  K_s = lambda_s kappa_s - kappa_s^0 (and s <-> phi),
// whose bending part gives exactly the moments of eq. 6 and, with the tensions, the equilibrium of eq. 7 (see
// paper-notes/equations.md).
double elastic_energy(const Membrane &membrane, const Vector &position);
// dW/dposition, 2N.
Vector energy_gradient(const Membrane &membrane, const Vector &position);
// d^2 W/dposition^2, 2N x 2N, symmetric.
Matrix energy_hessian(const Membrane &membrane, const Vector &position);

} // namespace capsule
