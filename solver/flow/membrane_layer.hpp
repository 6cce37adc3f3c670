#pragma once
// A layer of densities on all membranes of a flow, and what it does at their nodes: S_MM or D_MM of (3.1).
//   A membrane and its images act on the membrane itself from the points of its panels. On another membrane it acts from
// its nodes: their rule converges like exp(-2 pi d/h), h the distance of the nodes and d theirs to the target, so that only
// targets that are very near need the panels. Nodal and panel vectors are those of membrane_mesh.hpp; factors, such as
// 1/(8 pi), are the densities'. Throws nothing.
#include "flow/membrane_mesh.hpp"
#include <span>
#include <vector>

namespace capsule {

// A copy of the membranes, shifted along the axis, with the same densities times an amplitude.
struct Image {
  double shift = 0, amplitude = 1;
};

Curve moved(Curve curve, double shift);

// One target's kernels in the rows `target` and `second + target` of a matrix, radial sources from the column
// `radial` on.
KernelRow kernel_row(RowMatrix &matrix, Eigen::Index target, Eigen::Index second, Eigen::Index radial);

// The layer of a curve and its images at targets, 2 n_t x 2 Q.
RowMatrix layer_with_images(const RingKernel &kernel, const Targets &targets, const Curve &curve,
                            const SelfRule *self, const NearRule &near, std::span<const Image> images);

class MembraneLayer {
public:
  MembraneLayer() = default;
  // Refers to the mesh, which has to outlive it.
  MembraneLayer(const RingKernel &kernel, const MembraneMesh &mesh, const MembraneShape &shape,
                std::span<const Image> images);

  // Where there is one membrane only: to its nodes (2N) from its quadrature points (2Q).
  const RowMatrix &from_panels() const { return own_.front(); }
  // The same from nodal densities, of any number of membranes.
  Vector velocity(const Vector &density) const;
  Matrix matrix() const;

private:
  struct Pair { // one membrane on another one
    std::size_t to, from;
    RowMatrix from_nodes;           // without the area of the nodes
    std::vector<Eigen::Index> near; // rows that come from the panels instead
    RowMatrix from_panels;
  };
  void add_pair(const RingKernel &kernel, const MembraneShape &shape, std::span<const Image> images,
                std::size_t to, std::size_t from);

  const MembraneMesh *mesh_ = nullptr;
  Vector area_; // of the nodes
  std::vector<RowMatrix> own_;
  std::vector<Pair> pairs_;
};

} // namespace capsule
