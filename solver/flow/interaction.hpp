#pragma once
// What membranes, wall and outlet do to each other at one position of the membranes: the operators of (3.1) that
// depend on the shape. Nodal and panel vectors are those of membrane_mesh.hpp, vectors "at the wall" are the left
// sides of Wall's equations. Factors, such as 1/(8 pi), are the densities'.
//   Membranes and wall act on each other through one matrix of kernels between nodes and wall points: the kernel
// is symmetric, the wall's panels and the rule on the nodes are the weights. Pairs that are too near for a rule have
// entries of their own.
//   Images are copies of the membranes, shifted along the axis, with the same densities times an amplitude: they add to the
// velocity, but there are no equations at their nodes. A train of equal capsules is one of them with its images.
//   The flow rate falls by Delta P over the drive's resistance: Q = 1 - Delta P/resistance. A pump that keeps the flow
// rate has an infinite one; constant pressure between the pore's ends is the resistance of the empty pore,
// Wall::base_pressure_drop. Throws nothing.
#include "flow/membrane_mesh.hpp"
#include "flow/wall.hpp"
#include <limits>
#include <memory>

namespace capsule {

enum class Layers { single, both };

struct Image {
  double shift = 0, amplitude = 1;
};

struct Drive {
  double resistance = std::numeric_limits<double>::infinity();
};

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

  // S_MM and D_MM, to the nodes (2N) from the quadrature points (2Q).
  const RowMatrix &single_from_panels() const { return single_; }
  const RowMatrix &double_from_panels() const { return double_; }
  // The same from nodal densities.
  Vector single_layer(const Vector &density) const { return single_ * mesh_->at_panels(density); }
  Vector double_layer(const Vector &density) const { return double_ * mesh_->at_panels(density); }
  Matrix single_layer() const { return mesh_->on_nodes(single_); }
  Matrix double_layer() const { return mesh_->on_nodes(double_); }
  // S_BM and D_BM, to the wall from nodal densities.
  Vector single_at_wall(const Vector &density) const;
  Vector double_at_wall(const Vector &density) const;
  Matrix single_at_wall() const;
  Matrix double_at_wall() const;
  // C A^(-1): from the left sides of the wall's equations to velocities of the nodes, with the change of the flow rate
  // that the extra pressure drop makes (Drive).
  Vector answer_of_wall(const Vector &at_wall) const;
  RowMatrix answer_of_wall() const { return from_wall_ * wall_->inverse(); }

  // Velocity at points off the membranes: the layers of nodal densities and what the wall answers. An empty density
  // is none.
  Vector velocity_at(const Targets &points, const Vector &single_density, const Vector &double_density) const;

private:
  void assemble(const RingKernel &kernel, const Targets &targets, const SelfRule *self,
                RowMatrix &matrix) const;
  void couple_to_wall(Layers layers);
  void refine_near_wall();
  void add_near_rows(Layers layers);
  void couple_to_outlet();

  std::shared_ptr<const Wall> wall_;
  const MembraneMesh *mesh_;
  std::vector<Image> images_;
  Drive drive_;
  MembraneShape shape_;
  Vector base_velocity_;
  RowMatrix single_, double_;
  RowMatrix from_wall_;           // to the nodes from the forces of wall points and P'
  RowMatrix from_wall_to_images_; // the same at the images, times amplitudes, summed; empty without images
  struct Difference {             // between a kernel and what stands in from_wall_
    Eigen::Index node, first_point;
    KernelBlock block;
  };
  std::vector<Difference> to_wall_;
  Vector to_outlet_;                   // the outlet's row for forces on the nodes
  RowMatrix double_at_wall_;           // stresslets of the nodes at the wall's points, unknowns x 2N
  std::vector<Eigen::Index> near_row_; // equations at wall points that are too near for the rule on the nodes
  RowMatrix near_single_, near_double_; // their rows, from the panels' points (2Q)
};

} // namespace capsule
