#pragma once
// The membrane as an elastic body: its reference shape sampled on a quadrature along the meridian, its
// strain, and the energy whose gradient is its load on the liquids (load.hpp). Lengths are scaled with R_t, tensions with G,
// moments with G R_t. Throws what the basis throws (meridian.hpp).
#include "case/parameters.hpp"
#include "geometry/sampling.hpp"
#include "law/law.hpp"

namespace capsule {

// The undeformed meridian at the points of a sampling, from the same basis as the deformed one: without motion
// there is no strain, whatever the resolution.
struct UndeformedMeridian {
  Vector radius;                                    // R
  Vector arc;                                       // S' = dS/dzeta
  Vector curvature_meridional, curvature_azimuthal; // kappa^0
};

struct Membrane {
  MembraneLaw law;
  double bending_ratio = 0; // delta
  MeridianBasis basis;
  Vector node_angle;             // where the nodes lie on the undeformed shape, reference_shape.hpp
  Vector initial;                // position of the nodes before the flow, 2N, centred at x = 0
  Vector reference;              // and free of stress: undeformed
  Sampling sampling;             // where the energy is integrated: no point at a pole
  UndeformedMeridian undeformed; // at the sampling's points
  Sampling at_nodes;             // the nodes themselves, with the basis' weights
  UndeformedMeridian undeformed_at_nodes;
};

// With the nodes at angles zeta; the energy is integrated at the given points.
Membrane make_membrane(const CapsuleSpec &capsule, const MembraneSpec &material, const MeridianBasis &basis,
                       const Vector &zeta, const Vector &weights);

// Gives the membrane another law and bending stiffness, and the shapes of a capsule with its nodes at
// node_angle.
void set_material(const CapsuleSpec &capsule, const MembraneSpec &material, Membrane &membrane);

// Strain, tensions (eqs. 2, 4, 5), curvatures (eq. 3) and moments (eq. 6) at given points, which may be
// poles: there azimuthal and meridional quantities are the same.
struct MembraneState {
  Vector x, r;
  Vector arc;                // ds/dzeta
  Vector normal_x, normal_r; // out of the capsule
  Vector stretch_meridional, stretch_azimuthal;
  Vector tension_meridional, tension_azimuthal;
  Vector curvature_meridional, curvature_azimuthal;
  Vector moment_meridional, moment_azimuthal;
};
MembraneState membrane_state(const Membrane &membrane, const Sampling &at, const Vector &position);
// The same where the undeformed meridian at these points is at hand.
MembraneState membrane_state(const Membrane &membrane, const Sampling &at,
                             const UndeformedMeridian &undeformed, const Vector &position);
UndeformedMeridian undeformed_at(const Sampling &at, const Vector &reference);

// Elastic energy, scaled with G R_t^2:
//   W = integral over the reference area of w(lambda_s, lambda_phi)
//       + (delta/2) (K_s^2 + 2 nu K_s K_phi + K_phi^2),  K_s = lambda_s kappa_s - kappa_s^0 (and s <-> phi),
// whose bending part gives exactly the moments of eq. 6 and, with the tensions, the equilibrium of eq. 7 (see
// paper-notes/equations.md).
double elastic_energy(const Membrane &membrane, const Vector &position);
// dW/dposition, 2N. With splines, the radial entries at the poles are forces that hold them on the axis, and no
// load.
Vector energy_gradient(const Membrane &membrane, const Vector &position);
// d^2 W/dposition^2, 2N x 2N, symmetric.
Matrix energy_hessian(const Membrane &membrane, const Vector &position);

} // namespace capsule
