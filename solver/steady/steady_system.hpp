#pragma once
// The equations of a steady shape on one mesh. In the capsule's frame the membrane is at rest: every node
// moves with the speed V along the axis, whatever the viscosity ratio, so the flow is that of lambda = 1.
//   unknowns   2N + 2: the nodes' axial and radial positions, V, and a slack
//   equations  v_x - V + slack n_x = 0, v_r + slack n_r = 0 at the nodes; centre of the undeformed area
//   at x = 0, the same on any mesh; volume = undeformed
// The flux of v - V through the membrane vanishes identically: one equation of the nodes follows from the
// others, and the slack, which comes out as the error of discretisation, makes up for it. A hyperbolic pore is
// replaced by its tube, infinitely long in effect: the disturbance falls by exp(-4.47) per radius of the tube
// and only as much wall is built as is left of it.
// Throws NumericsFailure for shapes that are no capsule in the tube.
#include "case/case.hpp"
#include "scene/scene.hpp"
#include "steady/linear_motion.hpp"
#include <optional>

namespace capsule {

class SteadySystem {
public:
  // What stays fixed: the scene and the mesh, with a node at each of these angles (node_density.hpp).
  SteadySystem(const Case &physics, const Resolution &resolution, const Vector &node_angle);

  // Everything else that the equations hold: capsule, membrane, capillary number.
  void set_parameters(const Case &physics);

  Eigen::Index nodes() const { return membrane_.basis.size(); }
  Vector undeformed() const; // unknowns
  const Membrane &membrane() const { return membrane_; }
  double largest_stretch(const Vector &unknowns) const; // meridional, at the nodes
  const Case &scene() const { return scene_; }          // with the tube that stands for the pore
  const std::optional<Pore> &pore() const { return pore_; }

  // Builds a longer tube if the membrane has come too near to its ends.
  void fit_tube(const Vector &unknowns);
  // Where the straight way from one shape towards another leaves the tube: the largest step, up to 1, that
  // keeps a part of the film.
  double admissible_step(const Vector &unknowns, const Vector &change) const;

  Vector residual(const Vector &unknowns) const;
  struct Linearisation {
    Vector residual;
    Matrix jacobian;     // 2N + 2 square
    Matrix double_layer; // of linear_motion.hpp
  };
  Linearisation linearise(const Vector &unknowns) const;

  FlowState flow(const Vector &position) const; // with both pressure drops

private:
  void build_flow();
  Vector equations(const Vector &unknowns, const Vector &velocity) const;
  Eigen::Matrix<double, 2, Eigen::Dynamic> constraint_slopes(const Vector &position) const;

  Case scene_;
  std::optional<Pore> pore_;
  Resolution resolution_;
  double capillary_number_ = 0;
  double volume_ = 0;
  Vector centre_weights_;  // nodal areas as parts of the undeformed area
  double half_length_ = 0; // of the tube
  Membrane membrane_;
  std::optional<Flow> flow_;
};

} // namespace capsule
