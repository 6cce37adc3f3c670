#pragma once
// What membranes, wall and outlet do to each other at one position of the membranes: the operators of (3.1) that
// depend on the shape. Nodal and panel vectors are those of membrane_mesh.hpp, vectors "at the wall" are the left
// sides of Wall's equations. Factors, such as 1/(8 pi), are the densities'.
//   Images are copies of the membranes, shifted along the axis, with the same densities times an amplitude: they add to the
// velocity, but there are no equations at their nodes. A train of equal capsules is one of them with its images.
//   The flow rate falls by Delta P over the drive's resistance: Q = 1 - Delta P/resistance. A pump that keeps the flow
// rate has an infinite one; constant pressure between the pore's ends is the resistance of the empty pore,
// Wall::base_pressure_drop. Throws nothing.
#include "flow/wall_coupling.hpp"
#include <memory>

namespace capsule {

// Refers to the mesh, which has to outlive it.
class Interaction {
public:
  Interaction(std::shared_ptr<const Wall> wall, const MembraneMesh &mesh, const Vector &position,
              Layers layers, std::span<const Image> images = {}, Drive drive = {});

  const Wall &wall() const { return *wall_; }
  const MembraneMesh &mesh() const { return *mesh_; }
  const MembraneShape &shape() const { return shape_; }
  // v_e at the nodes, at unit flow rate.
  const Vector &base_velocity() const { return base_velocity_; }
  const Drive &drive() const { return drive_; }

  // S_MM and D_MM of a membrane alone, to the nodes (2N) from the quadrature points (2Q).
  const RowMatrix &single_from_panels() const { return single_.from_panels(); }
  const RowMatrix &double_from_panels() const { return double_.from_panels(); }
  // The same of all from nodal densities.
  Vector single_layer(const Vector &density) const { return single_.velocity(density); }
  Vector double_layer(const Vector &density) const { return double_.velocity(density); }
  Matrix single_layer() const { return single_.matrix(); }
  Matrix double_layer() const { return double_.matrix(); }
  // S_BM and D_BM, to the wall from nodal densities.
  Vector single_at_wall(const Vector &density) const;
  Vector double_at_wall(const Vector &density) const;
  Matrix single_at_wall() const;
  Matrix double_at_wall() const;
  // C A^(-1): from the left sides of the wall's equations to velocities of the nodes, with the change of the flow rate
  // that the extra pressure drop makes (Drive).
  Vector answer_of_wall(const Vector &at_wall) const;
  template <class Answer = RowMatrix> // or RoughMatrix
  Answer answer_of_wall() const;

  // Velocity at points off the membranes: the layers of nodal densities and what the wall answers. An empty density
  // is none.
  Vector velocity_at(const Targets &points, const Vector &single_density, const Vector &double_density) const;

private:
  std::shared_ptr<const Wall> wall_;
  const MembraneMesh *mesh_;
  std::vector<Image> images_;
  Drive drive_;
  MembraneShape shape_;
  MembraneLayer single_, double_;
  std::vector<WallCoupling> couplings_; // of each membrane
  Vector base_velocity_;
};

} // namespace capsule
