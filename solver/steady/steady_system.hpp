#pragma once
// The equations of a steady shape on one mesh. In the capsule's frame the membrane is at rest: every node
// moves with the speed V along the axis, whatever the viscosity ratio, so the flow is that of lambda = 1.
//   unknowns   2N + 2: the nodes' axial and radial positions, V, and a slack
//   equations  v_x - V + slack n_x = 0, v_r + slack n_r = 0 at the nodes; centre of the area before
//   the flow at x = 0, the same on any mesh; volume as before the flow
// The flux of v - V through the membrane vanishes identically, so that one equation of the nodes follows from the
// others. The slack makes up for it; its value is the error of discretisation. A hyperbolic pore is replaced by its
// tube, which is infinitely long in effect: the disturbance falls by exp(-4.47) per radius of the tube, and the wall is
// built as far as there is any. Where the pressure is given, the flow rate is what it drives through the case's own pore
// with the capsule in its tube.
//   A train of equal capsules is one of them with its images, on either side as many as it feels. They move with it: the
// derivative of its velocity is that of equal displacements of all.
// Throws NumericsFailure for shapes that are no capsule in the tube.
#include "case/case.hpp"
#include "membrane/softening.hpp"
#include "scene/scene.hpp"
#include "steady/linear_motion.hpp"
#include <optional>
#include <vector>

namespace capsule {

// What the neighbours in a train do in a small motion of one capsule.
enum class Neighbours { alike, opposed };

class SteadySystem {
public:
  // What stays fixed: pore, type of flow, and the mesh, with a node at each of these angles (node_density.hpp). The tube
  // is long enough for a capsule that reaches from -tip to tip.
  SteadySystem(const Case &input, const Resolution &resolution, const Vector &node_angle, double tip);

  // Everything else in the equations: capsule, membrane, capillary number.
  void set_parameters(const Case &input);
  const Case &input() const { return input_; }

  Eigen::Index nodes() const { return membrane_.basis.size(); }
  Vector initial() const; // unknowns of the capsule before the flow, at about the speed of a rigid sphere
  const Membrane &membrane() const { return membrane_; }
  const Resolution &resolution() const { return resolution_; }
  double largest_stretch(const Vector &unknowns) const; // meridional, at the nodes
  SoftestPoint softest(const Vector &unknowns) const;
  // Throws NumericsFailure if the membrane's law softens.
  void require_stiffness(const Vector &unknowns) const;
  const std::optional<Pore> &pore() const { return pore_; } // the tube that stands for it

  // Builds a longer tube, with more images, if the membrane has come too near to its ends.
  void fit_tube(const Vector &unknowns);
  // The largest part of a change, up to 1, that leaves to each node a share of its distance to the wall and to the axis, and
  // moves none along the axis by more than the membrane's length.
  double admissible_step(const Vector &unknowns, const Vector &change) const;

  Vector residual(const Vector &unknowns) const;
  struct Linearisation {
    Vector residual;
    Matrix jacobian; // 2N + 2 square
    NodalLayers layers;
    // Small motions depend on them: D_MM, or empty for equal viscosities; R of surface_viscosity.hpp, or empty.
    Matrix double_layer, friction;
  };
  // With neighbours that move alike this is the derivative of the residual. With opposed ones, of whom every second one
  // makes the same motion and the others its negative, only the matrices of small motions differ.
  Linearisation linearise(const Vector &unknowns, Neighbours neighbours = Neighbours::alike) const;
  // The part of the equations that depends on the parameters where the shape does not change: the nodal load
  // f = q/epsilon (2N), on which the velocity depends linearly, and the left sides of the two constraints.
  Vector load_and_constraints(const Vector &unknowns) const;

  FlowState flow(const Vector &position) const; // with both pressure drops, of one capsule
  // Of a train: the liquid between neighbours.
  double gap_to_next(const Vector &position) const;

private:
  void build_flow();
  int images_on_each_side() const;
  double needed_half_length() const;
  std::vector<Image> images(Neighbours neighbours) const;
  void require_shape(const Vector &position) const;
  Vector equations(const Vector &unknowns, const Vector &velocity) const;
  Eigen::Vector2d constraints(const Vector &position) const;
  Eigen::Matrix<double, 2, Eigen::Dynamic> constraint_slopes(const Vector &position) const;
  Vector load(const Vector &position) const;

  Case input_;
  std::optional<Pore> pore_;
  Resolution resolution_;
  double volume_ = 0;
  Vector centre_weights_;  // nodal areas as parts of the undeformed area
  double tip_ = 0;         // the farthest that the membrane may reach from x = 0
  double half_length_ = 0; // of the tube
  Membrane membrane_;
  std::optional<Flow> flow_;
};

// Whether a state is poorly resolved: then the exact derivative differs from that of the discrete equations, and Newton's
// method soon fails.
constexpr double fine_tail = 1e-6; // of a shape, in the last waves (unresolved_part in node_density.hpp)
bool poorly_resolved(const SteadySystem &system, const Vector &unknowns,
                     double largest_unresolved_part = fine_tail);

} // namespace capsule
