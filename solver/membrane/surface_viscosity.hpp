#pragma once
// The viscosity of the membrane itself (Boussinesq and Scriven). With the rates of stretch e_s = d ln lambda_s/dt and
// e_phi = d ln lambda_phi/dt,
//   T_s   gains  mu_s (e_s - e_phi) + kappa_s (e_s + e_phi)
//   T_phi gains -mu_s (e_s - e_phi) + kappa_s (e_s + e_phi)
// which is linear in the velocity v of the nodes (2N). The load on the liquids follows from virtual power as the elastic
// one does from virtual work (load.hpp): q = -R v, (R v)_j = (V v)_j/area_j, with a matrix V that is symmetric and not negative, and
// v.V v is the power that becomes heat in the membrane. Tensions are scaled with mu Q/(pi R_t^2), loads with
// mu Q/(pi R_t^3), as those of the liquids. Throws nothing.
#include "case/parameters.hpp"
#include "geometry/sampling.hpp"

namespace capsule {

inline bool is_viscous(const SurfaceViscosity &viscosity) {
  return viscosity.shear > 0 || viscosity.dilatational > 0;
}

// V and R of a shape; `at` are points where the power is integrated, none at a pole, nodal_area (N) what the nodes stand for.
class SurfaceFriction {
public:
  SurfaceFriction(const Sampling &at, const Vector &nodal_area, const Vector &position,
                  const SurfaceViscosity &viscosity);

  Matrix dissipation() const;                // V, 2N x 2N
  Matrix matrix() const;                     // R in q = -R v
  Vector load(const Vector &velocity) const; // R v

private:
  Matrix sum_, difference_;       // e_s + e_phi and e_s - e_phi at the points, of nodal velocities
  Vector of_sum_, of_difference_; // viscosity times area, at the points
  Vector nodal_area_;             // 2N
};

// Derivative of R v with respect to the position for a fixed velocity, with the nodes' areas frozen, 2N x 2N.
Matrix friction_jacobian(const Sampling &at, const Vector &nodal_area, const Vector &position,
                         const SurfaceViscosity &viscosity, const Vector &velocity);

} // namespace capsule
