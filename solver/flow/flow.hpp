#pragma once
// The flow that the membranes' shapes and loads make, eq. 16, with the fixed wall eliminated once. The load is handed in
// as f = q/epsilon.
//
// Everything is split into the flow without membranes (subscript e, found once) and the disturbance, which is
// at rest on the exit section S_P and has a uniform pressure there (behind a second mouth: outlet.hpp):
//
//   - on the wall and the exit 0 = A phi + b, with phi = (traction on S_B; P') and
//     b = S_BM f/(8 pi) + D_BM (lambda - 1) v
//
//   - on the membranes (1 + lambda)/2 v = v_e + S_MM f/(8 pi) + D_MM (lambda - 1) v - C A^(-1) b
//
// Where a membrane is viscous, f has the load -R v of its own friction, too (membrane/surface_viscosity.hpp).
// A is inverted once (wall.hpp); lambda = 1 without friction leaves no system to solve in a step, anything else one of the
// membranes' size. Lengths, velocities and pressures are in the paper's scales. Derivation:
// paper-notes/equations.md. Throws NumericsFailure: "unresolved" if the membranes' system is singular or does not
// converge, "not-a-number" if the velocity is not a number.
#include "flow/compressed_wall.hpp"
#include "flow/flow_state.hpp"
#include "flow/interaction.hpp"
#include "flow/layer_identities.hpp"
#include "flow/recycled_solver.hpp"
#include "membrane/surface_viscosity.hpp"
#include <utility>
#include <vector>

namespace capsule {

struct FlowParameters {
  std::vector<double> viscosity_ratios = {};              // lambda of each membrane; empty: 1
  std::vector<SurfaceViscosity> surface_viscosities = {}; // of each membrane; empty: none
  Drive drive = {};
  std::vector<Image> images = {};
};

// The single layer on nodal densities, 2N x 2N, and what the wall answers to both layers. Products with a few densities are
// cheaper than the matrices with the wall.
struct NodalLayers {
  Matrix single;                         // S_MM/(8 pi)
  RowMatrix answer;                      // C A^(-1)
  Matrix single_at_wall, double_at_wall; // S_BM/(8 pi), D_BM

  Vector velocity_of(const Vector &load) const; // (S_MM - C A^(-1) S_BM) load/(8 pi)
  Matrix single_with_wall() const;              // (S_MM - C A^(-1) S_BM)/(8 pi)
  // D_MM - C A^(-1) D_BM, from D_MM.
  Matrix double_with_wall(const Matrix &double_layer) const;
};
NodalLayers nodal_layers(const Interaction &interaction);

class Flow {
public:
  // solver_tolerance: of FlowResolution.
  Flow(Wall wall, MembraneMesh mesh, const FlowParameters &parameters, double solver_tolerance);

  const Wall &wall() const { return wall_.whole(); }
  const MembraneMesh &mesh() const { return mesh_; }
  void place_images(std::vector<Image> images) { images_ = std::move(images); }
  void drive_by(Drive drive) { drive_ = drive; }

  // Everything that depends on the position alone, with the layers that this flow needs or with both. Refers to
  // this flow.
  Interaction interact(const Vector &position) const;
  Interaction interact(const Vector &position, Layers layers) const;
  Interaction interact(const Vector &position, Layers layers, std::span<const Image> images) const;
  FlowState solve(const Interaction &interaction, const Vector &f, Recycled &recycled) const;
  // Each membrane's share of Delta P by the reciprocal theorem.
  Vector reciprocal_pressure_drops(const Interaction &interaction, const Vector &f, const FlowState &state,
                                   Recycled &traction) const;
  // Velocity of the outer liquid at points off the membranes, 2 n, in the flow that f has made.
  Vector outer_velocity(const Targets &points, const Interaction &interaction, const Vector &f,
                        const FlowState &state) const;
  bool has_friction() const { return !surface_viscosities_.empty(); }
  // Derivative of the membranes' friction R v with respect to the position for a fixed velocity, 2N x 2N.
  Matrix friction_jacobian(const Interaction &interaction, const Vector &velocity) const;
  // dv/df for frozen shapes, 2N x 2N.
  Matrix mobility(const Interaction &interaction, Recycled &recycled) const;
  // With the wall's answer in single precision, in less time and to some thousandths (test_flow.cpp): for where what is missed
  // is corrected.
  Matrix rough_mobility(const Interaction &interaction, Recycled &recycled) const;

private:
  // Densities of both layers; an empty one is none.
  struct Densities {
    Vector single, dbl;
  };
  static Vector at_nodes(const Interaction &interaction, const Densities &densities);
  static Vector at_wall(const Interaction &interaction, const Densities &densities);

  Vector double_density(const Vector &velocity) const;
  std::vector<SurfaceFriction> frictions(const Interaction &interaction) const;
  Matrix friction_matrix(const std::vector<SurfaceFriction> &frictions) const;
  Vector friction_load(const std::vector<SurfaceFriction> &frictions, const Vector &velocity) const;
  Vector load_with_friction(const Interaction &interaction, const Vector &f, const Vector &velocity) const;
  template <class Answer>
  Matrix membrane_operator(const Interaction &interaction, const LayerIdentities &identities,
                           const Answer &answer_of_wall, const std::vector<SurfaceFriction> &frictions) const;
  template <class Answer>
  Matrix mobility(const Interaction &interaction, const Answer &answer_of_wall, Recycled &recycled) const;
  Vector membrane_velocity(const Interaction &interaction, const Vector &right, Vector &at_wall,
                           Recycled &recycled) const;

  CompressedWall wall_;
  MembraneMesh mesh_;
  Drive drive_;
  std::vector<Image> images_;
  Vector beta_, excess_viscosity_; // (1 + lambda)/2 and lambda - 1 of each component, 2N
  bool equal_viscosities_ = true;
  std::vector<SurfaceViscosity> surface_viscosities_; // empty where no membrane is viscous
  double solver_tolerance_;
};

} // namespace capsule
