#pragma once
// What one membrane, with its images, and the wall do to each other at one shape: its part of S_BM, D_BM and C of (3.1), and
// the undisturbed flow at its nodes. Vectors of nodes and panels are those of this membrane, 2n and 2q; vectors "at the
// wall" are the left sides of Wall's equations. Factors, such as 1/(8 pi), are the densities'.
//   Membrane and wall act on each other through one matrix of kernels between nodes and wall points: the kernel is
// symmetric, the wall's panels and the rule on the nodes are the weights. Pairs that are too near for a rule have entries of
// their own. Throws nothing.
#include "flow/membrane_layer.hpp"
#include "flow/wall.hpp"
#include <limits>

namespace capsule {

enum class Layers { single, both };

struct Drive {
  double resistance = std::numeric_limits<double>::infinity();
};

// Refers to wall and mesh, which have to outlive it.
class WallCoupling {
public:
  WallCoupling(const Wall &wall, const MembraneMesh &mesh, const MembraneShape &shape, std::size_t membrane,
               Layers layers, std::span<const Image> images, const Drive &drive);

  // v_e at the nodes, at unit flow rate.
  const Vector &base_velocity() const { return base_velocity_; }
  // To the wall from nodal densities.
  Vector single_at_wall(const Vector &density) const;
  Vector double_at_wall(const Vector &density) const;
  Matrix single_at_wall() const;
  Matrix double_at_wall() const;
  // C: to the nodes from the forces of wall points and P', with the change of the flow rate that P' makes (Drive).
  const RowMatrix &from_wall() const { return from_wall_; }

private:
  void couple(Layers layers, std::span<const Image> images);
  void refine_near_wall();
  void add_near_rows(const MembraneMesh &mesh, const MembraneShape &shape, std::size_t membrane,
                     Layers layers, std::span<const Image> images);
  void couple_to_outlet(const Targets &targets, std::span<const Image> images, const Drive &drive);

  const Wall *wall_;
  const MembraneMesh::Part *part_;
  Curve nodes_;
  Vector base_velocity_;
  RowMatrix from_wall_;
  RowMatrix from_wall_to_images_; // the same at the images, times amplitudes, summed; empty without images
  struct Difference {             // between a kernel and what stands in from_wall_
    Eigen::Index node, first_point;
    KernelBlock block;
  };
  std::vector<Difference> to_wall_;
  Vector to_outlet_;                   // the outlet's row for forces on the nodes
  RowMatrix double_at_wall_;           // stresslets of the nodes at the wall's points, unknowns x 2n
  std::vector<Eigen::Index> near_row_; // equations at wall points that are too near for the rule on the nodes
  RowMatrix near_single_, near_double_; // their rows, from the panels' points (2q)
};

} // namespace capsule
