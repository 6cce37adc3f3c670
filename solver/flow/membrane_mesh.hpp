#pragma once
// The membranes of a flow on nodes and on quadrature panels. To the integrals several membranes are one curve of
// several parts, and their fields are stacked so that nothing else tells them apart:
//   nodal vectors, 2N   axial components at the nodes of the first membrane, of the second ...; then the radial ones
//   panel vectors, 2Q   the same at the quadrature points
// Throws std::invalid_argument for membranes whose panels differ in their number of points or near tolerance.
#include "flow/flow_resolution.hpp"
#include "geometry/sampling.hpp"
#include "integrals/layer_potential.hpp"
#include <span>

namespace capsule {

// Panels without regard to a membrane's shape: as long as allowed, shorter at the poles.
Vector even_membrane_edges(const MeridianBasis &basis, double largest_panel);

// Edges of panels: those given, and more where panels are halved until the tangent turns by no more than most_turning
// (radians) in each.
Vector halved_edges(const MeridianBasis &basis, const Vector &position, const Vector &edges,
                    double most_turning);

// Where the 2 n components of one membrane stand in a nodal vector of all: n nodes from the first one on, of `nodes`.
std::vector<Eigen::Index> rows_of_part(Eigen::Index first_node, Eigen::Index n, Eigen::Index nodes);

struct MembraneMesh {
  struct Part { // one membrane
    MeridianBasis basis;
    Sampling at_nodes, at_panels;
    SelfRule self;              // of its nodes on its panels
    Matrix even_bend, odd_bend; // nodes -> bend of layer_potential.hpp
    Eigen::Index first_node = 0, first_point = 0;
    Eigen::Index nodes() const { return basis.size(); }
    Eigen::Index points() const { return at_panels.zeta.size(); }
    // Nodal values of this membrane alone, 2n -> values at its quadrature points, 2q; a matrix on those, or on their
    // derivatives in zeta of this order, as one on nodal values.
    Vector values_at_panels(const Vector &nodal) const;
    Matrix on_nodes(const RowMatrix &on_panels, int derivative = 0) const;
  };
  std::vector<Part> parts;
  Eigen::Index nodes = 0, points = 0; // N, Q of all parts
  Eigen::Index panel_points = 0;
  double near_tolerance = 0;
  NearRule near;

  // Of one membrane in a nodal vector.
  std::vector<Eigen::Index> rows(std::size_t part) const;
  // Nodal values -> values at the quadrature points, both components.
  Vector at_panels(const Vector &nodal) const;
};
MembraneMesh make_membrane_mesh(const MeridianBasis &basis, const FlowResolution &resolution);
MembraneMesh join(std::span<const MembraneMesh> meshes);

// The membranes at a position, 2N.
struct MembraneShape {
  Vector position;
  Targets targets; // the nodes
  Curve nodes;     // with the rule on the nodes
  Curve panels;
};
MembraneShape shape_at(const MembraneMesh &mesh, const Vector &position);
// What belongs to one of them.
Targets targets_of(const MembraneMesh &mesh, const MembraneShape &shape, std::size_t membrane);
Curve nodes_of(const MembraneMesh &mesh, const MembraneShape &shape, std::size_t membrane);
Curve panels_of(const MembraneMesh &mesh, const MembraneShape &shape, std::size_t membrane);

// Where the rule on a membrane's nodes is too coarse for a target: it converges like exp(-2 pi d/h), h the distance of the
// nodes and d theirs to the target.
class NodesNearby {
public:
  NodesNearby(const MembraneMesh &mesh, const MembraneShape &shape, std::size_t membrane);
  bool hold(double x, double r) const;

private:
  Eigen::ArrayXd x_, r_, reach_squared_;
  double low_, high_;
};

} // namespace capsule
