#pragma once
// The flow that a given membrane shape and load make, eq. 16, with the fixed wall eliminated once.
//
// Everything is split into the flow of the empty pore (subscript e, found once) and the disturbance, which is
// at rest on the exit section S_P and has a uniform pressure there:
//
//   - on the wall and the exit 0 = A phi + b, with phi = (traction on S_B; P') and
//     b = S_BM q/(8 pi eps) + (lambda - 1) D_BM v
//
//   - on the membrane (1 + lambda)/2 v = v_e + S_MM q/(8 pi eps) + (lambda - 1) D_MM v - C A^(-1) b
//
// A is inverted once; lambda = 1 leaves no system to solve in a step, any other lambda one of the membrane's
// size. Lengths, velocities and pressures are in the paper's scales; with flow.type "extension" the liquid is
// unbounded, v_e = (x, -r/2), and epsilon is mu e a/G. Derivation: paper-notes/equations.md. Throws
// NumericsFailure: "unresolved" if the membrane's system is singular or does not converge, "not-a-number" if the
// velocity is none.
#include "case/case.hpp"
#include "flow/flow_state.hpp"
#include "geometry/meridian.hpp"
#include "geometry/pore.hpp"
#include "integrals/layer_potential.hpp"
#include <limits>

namespace capsule {

// How fine the flow is resolved; from the accuracy asked for and the case's mesh keys.
struct FlowResolution {
  int membrane_panel_points = 12;
  double membrane_panel = 0.25; // largest panel in zeta
  Vector membrane_edges;        // of the panels in zeta, where they are not to follow from that
  int wall_panel_points = 12;
  double wall_panel = 0.75; // largest panel in the tube
  // Of a tube without a mouth: how far the panels are as short as that on both sides of its middle, where a
  // steady capsule stays; further out they double in length.
  double fine_half_length = std::numeric_limits<double>::infinity();
  double lip_panel = 0.02;         // panel at the lip
  double near_tolerance = 1e-8;    // of near panels
  double solver_tolerance = 1e-10; // of the velocities that lambda != 1 leaves to an iteration, relative
};

// The membrane's panels without regard to its shape: as long as allowed, shorter at the poles.
Vector even_membrane_edges(const MeridianBasis &basis, double largest_panel);

class FlowSystem {
public:
  FlowSystem(const Case &physics, const MeridianBasis &basis, const FlowResolution &resolution);

  // zeta of the membrane's quadrature points, Q
  const Vector &panel_points() const { return panels_.points; }

  // Everything that depends on the shape alone.
  // Membrane and wall act on each other through one matrix of kernels between nodes and wall points: the
  // kernel is symmetric, the wall's panels and the rule on the nodes are the weights. Pairs that are too near
  // for a rule have their own entries.
  struct Interaction {
    Curve membrane; // on panels
    Curve on_nodes; // with the rule on the nodes
    Targets nodes;
    Vector position;                // the same, 2N
    RowMatrix single_mm, double_mm; // to the membrane's nodes (2N) from its quadrature points (2Q)
    RowMatrix from_wall;            // to the membrane's nodes from the forces of wall points and P'
    struct Difference {             // of a kernel from what stands in from_wall
      Eigen::Index node, first_point;
      KernelBlock block;
    };
    std::vector<Difference> to_wall;
    Vector to_axis;                     // from forces on the nodes to the exit's axis point
    RowMatrix double_bm;                // stresslets of the nodes at the wall's points, unknowns x 2N
    std::vector<Eigen::Index> near_row; // rows of b whose wall point is too near for the rule on the nodes
    RowMatrix near_single, near_double; // these rows, from the panels' points (2Q)
    Vector empty_velocity;              // v_e at the nodes
  };
  Interaction interact(const Vector &position) const;
  // With both layers, whatever lambda.
  Interaction interact_in_full(const Vector &position) const;

  // How a system that changes with the shape is solved again and again: the inverse of an earlier matrix
  // turns the new system into a few corrections, and the last solutions, continued to the new shape, are the
  // first guess.
  struct Corrector {
    Matrix inverse;
    std::vector<Vector> positions, solutions; // the latest first
  };
  // What lambda != 1 carries from one shape to the next. Empty at the start; the flow is the same with any, to
  // the solver's tolerance.
  struct Memory {
    Corrector velocity;
    Corrector traction; // of the empty pore's flow, for the reciprocal route
  };
  // load: nodal q, 2N.
  FlowState flow(const Interaction &shape, const Vector &load, Memory &memory) const;
  // Velocity of the outer liquid at points off the membrane, 2 n, in the flow that this load has made.
  Vector outer_velocity(const Targets &points, const Interaction &shape, const Vector &load,
                        const FlowState &state) const;
  // d velocity/d load for a frozen shape, 2N x 2N.
  Matrix mobility(const Interaction &shape, Memory &memory) const;
  // Both layers on nodal densities with what the wall answers, 2N x 2N.
  struct Layers {
    Matrix single; // (S_MM - C A^(-1) S_BM)/(8 pi eps)
    Matrix dbl;    // D_MM - C A^(-1) D_BM
  };
  Layers layers(const Interaction &shape) const;
  // Delta P by the reciprocal theorem, from the load and the empty pore's flow:
  //   pi Delta P = -(1/eps) int q.v_e dA + (lambda - 1) int v.sigma_e n dA.
  double reciprocal_pressure_drop(const Interaction &shape, const Vector &load, const Vector &velocity,
                                  Memory &memory) const;

  // The empty pore at any points inside, 2 n; and its whole pressure drop from the entrance section to the
  // exit.
  Vector empty_velocity(const Targets &points) const;
  double empty_pressure_drop() const { return empty_pressure_drop_; }
  // Traction of the empty flow on the wall's points, for tests: columns arc length, f_x, f_r.
  Matrix empty_wall_traction() const;

private:
  // Order of the wall's unknowns: axial at the wall's points, P', radial at the wall's points; of its
  // equations: the same, with the axial velocity at the exit's axis point in the middle.
  bool has_inner_flow() const { return viscosity_ratio_ != 1; }
  bool has_wall() const { return wall_.size() > 0; }
  Eigen::Index unknowns() const { return 2 * wall_.size() + 1; }
  Interaction interact(const Vector &position, bool with_double_layers) const;
  void build_wall(const Pore &pore);
  void solve_empty_pore(const Pore &pore);
  Vector exit_field(const Targets &points) const;
  Vector exit_field(const RowMatrix &single, const RowMatrix &double_layer) const;
  RowMatrix wall_response(const Targets &points) const;
  void couple_to_wall(Interaction &shape) const;
  void refine_near_wall(Interaction &shape) const;
  void add_near_rows(Interaction &shape) const;
  void couple_to_exit(Interaction &shape) const;
  Vector single_at_wall(const Interaction &shape, const Vector &load) const;
  Vector double_at_wall(const Interaction &shape, const Vector &density) const;
  Matrix single_at_wall(const Interaction &shape) const;
  Matrix double_at_wall(const Interaction &shape) const;
  RowMatrix answer_of_wall(const Interaction &shape) const;
  Matrix single_layer(const Interaction &shape, const RowMatrix &answer) const; // those of Layers
  Matrix double_layer(const Interaction &shape, const RowMatrix &answer) const;
  Matrix membrane_operator(const Interaction &shape, const RowMatrix &answer) const;
  Vector apply_membrane_operator(const Interaction &shape, const Vector &velocity) const;
  Vector empty_traction(const Interaction &shape, Memory &memory) const;
  Vector membrane_velocity(const Interaction &shape, const Vector &right, const Vector &at_wall,
                           Memory &memory) const;
  Vector at_panels(const Vector &nodal) const;

  double capillary_number_;
  double viscosity_ratio_;
  FlowType type_;
  PoreShape pore_;
  FlowResolution resolution_;
  MeridianBasis basis_;
  Panels panels_; // of the membrane, in zeta
  SelfRule self_;
  Matrix even_bend_, odd_bend_;   // nodes -> bend of layer_potential.hpp
  Matrix even_[2], odd_[2];       // nodes -> quadrature points: value and derivative
  Matrix slope_even_, slope_odd_; // nodes -> derivative at the nodes
  NearRule near_, exit_near_;     // of the membrane's and the exit's panels
  Curve wall_;
  Vector wall_arc_;
  Curve exit_;           // from the wall to the axis: its normal points out of the liquid
  Targets wall_targets_; // wall points and the exit's axis point
  FixedNearRule wall_near_;
  // Of A, with the wall's weights: from b to the forces of wall points and P'. Applied several times a step,
  // once to a matrix in a Jacobian.
  RowMatrix wall_inverse_;
  Vector force_;       // weights that turn phi into forces
  Vector empty_force_; // of the empty pore
  double empty_pressure_drop_ = 0;
};

} // namespace capsule
