#pragma once
// What does not move: the wall, the outlet, and the flow without membranes. A of (3.1) is inverted once.
//   unknowns    force_x on the wall's points, P' at the outlet, force_r on the wall's points
//   equations   v_x = 0 at the wall's points, the outlet's row, v_r = 0 at the wall's points
// A force is a traction times its point's share of the wall over 8 pi: what a point force needs as a factor of the ring
// stokeslet. Without a pore the liquid is unbounded and there are no unknowns. Scales as in undisturbed.hpp. Throws
// nothing.
#include "flow/flow_resolution.hpp"
#include "flow/outlet.hpp"
#include "flow/undisturbed.hpp"
#include "flow/wall_inverse.hpp"
#include "geometry/pore.hpp"

namespace capsule {

// Panels by arc length from the outlet to the entrance, and the wall at their points, with the normal into the liquid.
Panels wall_panels(const Pore &pore, const FlowResolution &resolution);
Curve wall_curve(const Pore &pore, const Panels &along);
// Where its points lie on it, and they as targets; their gap to the nearest point, themselves, is that of the rule.
SelfRule self_rule_of_wall(const Panels &along);
Targets on_itself(const Curve &wall, const Panels &along, const SelfRule &self);

class Wall {
public:
  // Unbounded liquid that flows like this far away.
  explicit Wall(UndisturbedFlow far_away = liquid_at_rest) : closed_form_(far_away) {}
  Wall(const Pore &pore, const FlowResolution &resolution);
  // The same wall on longer panels, each of which holds whole panels of it: the unknowns and equations of a panel's points
  // are interpolated from those of the longer one. As good as the whole wall for what is so far away that the
  // ring stokeslet can be interpolated along the longer panels.
  Wall(const Wall &whole, const Vector &edges);

  Eigen::Index unknowns() const { return inverse_.unknowns(); }
  Eigen::Index outlet_unknown() const { return curve_.size(); }
  const Curve &curve() const { return curve_; }    // from the outlet's end to the entrance
  const Panels &panels() const { return panels_; } // of the curve, by arc length
  double near_tolerance() const { return near_tolerance_; }
  const Outlet &outlet() const { return outlet_; }
  // Of the curve's panels, for targets off the wall.
  const FixedNearRule &near() const { return fixed_near_; }

  // From velocities in the equations to forces.
  const WallInverse &inverse() const { return inverse_; }
  // The outlet's row of it: the extra pressure drop -P'.
  double pressure_drop(const Vector &at_wall) const;
  // Velocity at any points, 2 n, of the forces that answer b.
  Vector velocity_of(const Vector &at_wall, const Targets &points) const;

  // The flow without membranes at unit flow rate, and its pressure drop from the entrance section to the outlet.
  Vector base_velocity(const Targets &points) const;
  double base_pressure_drop() const { return base_pressure_drop_; }
  // The same velocity where what forces do (2 n x unknowns) and the outlet's single layer are at hand.
  Vector base_velocity(const Targets &points, const RowMatrix &from_forces,
                       const RowMatrix &outlet_single) const;
  // Its traction on the wall's points: columns arc length of pore.hpp, f_x, f_r.
  Matrix base_traction() const;

private:
  RowMatrix response(const Targets &points, const SelfRule *self = nullptr) const;
  RowMatrix matrix() const;
  WallInverse mirrored_inverse() const;
  void solve_base_flow();

  Panels panels_;
  Curve curve_;
  double near_tolerance_ = 0;
  NearRule near_;
  FixedNearRule fixed_near_;
  Outlet outlet_;
  WallInverse inverse_;                   // with the forces' weights
  Vector weights_;                        // force = weight times traction, or P'
  UndisturbedFlow closed_form_ = nullptr; // the flow without membranes, or null
  Vector base_forces_;
  double base_pressure_drop_ = 0;
};

} // namespace capsule
