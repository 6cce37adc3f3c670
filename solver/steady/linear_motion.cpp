#include "steady/linear_motion.hpp"
#include "membrane/load.hpp"
#include <utility>

namespace capsule {
namespace {

// Shape and load f = q/eps at points of the meridian, from what they are at the nodes.
struct Frame {
  const Sampling *at; // the points
  Trace curve;
  Vector tangent_x, tangent_r; // downstream; the normal is (-tangent_r, tangent_x)
  Vector turning;              // of the tangent, d alpha/dzeta
  Vector load_tangent, load_normal, load_tangent_zeta, load_normal_zeta;
};

Frame frame_at(const Sampling &at, const Vector &position, const Vector &load) {
  const Eigen::Index n = position.size() / 2;
  Frame frame;
  frame.at = &at;
  frame.curve = trace(at, position);
  const auto x_zeta = frame.curve.x_zeta.array();
  const auto r_zeta = frame.curve.r_zeta.array();
  const Eigen::ArrayXd x_second = frame.at->even[2] * position.head(n);
  const Eigen::ArrayXd r_second = frame.at->odd[2] * position.tail(n);
  const auto arc = frame.curve.arc.array();
  const Eigen::ArrayXd t_x = x_zeta / arc;
  const Eigen::ArrayXd t_r = r_zeta / arc;
  const Eigen::ArrayXd turning = (x_zeta * r_second - r_zeta * x_second) / arc.square();
  const Eigen::ArrayXd f_x = frame.at->even[0] * load.head(n);
  const Eigen::ArrayXd f_r = frame.at->odd[0] * load.tail(n);
  const Eigen::ArrayXd f_x_zeta = frame.at->even[1] * load.head(n);
  const Eigen::ArrayXd f_r_zeta = frame.at->odd[1] * load.tail(n);
  const Eigen::ArrayXd f_t = f_x * t_x + f_r * t_r;
  const Eigen::ArrayXd f_n = f_r * t_x - f_x * t_r;
  frame.tangent_x = t_x;
  frame.tangent_r = t_r;
  frame.turning = turning;
  frame.load_tangent = f_t;
  frame.load_normal = f_n;
  frame.load_tangent_zeta = f_x_zeta * t_x + f_r_zeta * t_r + turning * f_n;
  frame.load_normal_zeta = f_r_zeta * t_x - f_x_zeta * t_r - turning * f_t;
  return frame;
}

// A vector at each point that depends on a displacement there.
struct Pointwise {
  Eigen::ArrayXd xx, xr, rx, rr;
};

// tt (t.d) t + tn (n.d) t + nt (t.d) n + nn (n.d) n
Pointwise dyads(const Frame &frame, const Eigen::ArrayXd &tt, const Eigen::ArrayXd &tn,
                const Eigen::ArrayXd &nt, const Eigen::ArrayXd &nn) {
  const auto t_x = frame.tangent_x.array();
  const auto t_r = frame.tangent_r.array();
  const Eigen::ArrayXd n_x = -t_r;
  const Eigen::ArrayXd n_r = t_x;
  return {tt * t_x * t_x + tn * t_x * n_x + nt * n_x * t_x + nn * n_x * n_x,
          tt * t_x * t_r + tn * t_x * n_r + nt * n_x * t_r + nn * n_x * n_r,
          tt * t_r * t_x + tn * t_r * n_x + nt * n_r * t_x + nn * n_r * n_x,
          tt * t_r * t_r + tn * t_r * n_r + nt * n_r * t_r + nn * n_r * n_r};
}

Pointwise operator*(double factor, const Pointwise &map) {
  return {factor * map.xx, factor * map.xr, factor * map.rx, factor * map.rr};
}

Pointwise operator-(const Pointwise &one, const Pointwise &other) {
  return {one.xx - other.xx, one.xr - other.xr, one.rx - other.rx, one.rr - other.rr};
}

// A map of a displacement's derivative of this order, 2 points x 2N.
Matrix of_displacement(const Sampling &at, const Pointwise &map, int derivative) {
  const Matrix &even = at.even[derivative].whole();
  const Matrix &odd = at.odd[derivative].whole();
  Matrix result(2 * even.rows(), 2 * even.cols());
  result << map.xx.matrix().asDiagonal() * even, map.xr.matrix().asDiagonal() * odd,
      map.rx.matrix().asDiagonal() * even, map.rr.matrix().asDiagonal() * odd;
  return result;
}

// A matrix times a map at each point.
template <class Dense>
Dense times(const Dense &matrix, const Pointwise &map) {
  const Eigen::Index points = map.xx.size();
  const auto of_x = matrix.leftCols(points).array(), of_r = matrix.rightCols(points).array();
  Dense result(matrix.rows(), matrix.cols());
  result.leftCols(points) = of_x.rowwise() * map.xx.transpose() + of_r.rowwise() * map.rx.transpose();
  result.rightCols(points) = of_x.rowwise() * map.xr.transpose() + of_r.rowwise() * map.rr.transpose();
  return result;
}

// f' of the head comment is the load's change at the nodes, interpolated, and these maps of the displacement and of its
// derivative in zeta: the load times the change of the area that it acts on, less the stress of its jump on the strips that
// the displacement sweeps.
struct CarriedLoad {
  Pointwise of_displacement, of_slope;
};

CarriedLoad carried_load(const Frame &frame) {
  const auto r = frame.curve.r.array();
  const auto arc = frame.curve.arc.array();
  const auto t_x = frame.tangent_x.array(), t_r = frame.tangent_r.array();
  const auto f_t = frame.load_tangent.array();
  const auto f_n = frame.load_normal.array();
  const Eigen::ArrayXd f_x = f_t * t_x - f_n * t_r, f_r = f_t * t_r + f_n * t_x;
  const Eigen::ArrayXd none = Eigen::ArrayXd::Zero(r.size());
  const Pointwise area{none, f_x / r, none, f_r / r};
  const Pointwise area_of_slope{f_x * t_x / arc, f_x * t_r / arc, f_r * t_x / arc, f_r * t_r / arc};
  // r [(f_t d_t - f_n d_n) t + (f_n d_t - f_t d_n) n] over r s', differentiated
  const Eigen::ArrayXd r_zeta = arc * t_r;
  const Eigen::ArrayXd growth_t = (frame.load_tangent_zeta.array() + r_zeta / r * f_t) / arc;
  const Eigen::ArrayXd growth_n = (frame.load_normal_zeta.array() + r_zeta / r * f_n) / arc;
  const Eigen::ArrayXd turning = 2 * frame.turning.array() * f_t / arc;
  const Pointwise strip = dyads(frame, growth_t, turning - growth_n, turning + growth_n, -growth_t);
  const Pointwise strip_of_slope = dyads(frame, f_t / arc, -f_n / arc, f_n / arc, -f_t / arc);
  // The hoop stress on the strip between the two surfaces.
  const Pointwise hoop{none, none, -f_n * t_r / r, f_n * t_x / r};
  return {area - strip - hoop, area_of_slope - strip_of_slope};
}

// w of the head comment, as a map of the displacement.
Pointwise slip(const Frame &frame) {
  const Eigen::ArrayXd none = Eigen::ArrayXd::Zero(frame.curve.r.size());
  return dyads(frame, none, frame.load_tangent, none, none);
}

// d.grad u of the inner flow, which the shear inside, the velocity along the meridian and the constant
// volume of the liquid tell.
Matrix advance_of_inner_flow(const Frame &at_nodes, const Vector &shear, const Vector &velocity) {
  const Eigen::Index n = at_nodes.curve.r.size();
  const auto t_x = at_nodes.tangent_x.array();
  const auto t_r = at_nodes.tangent_r.array();
  const Eigen::ArrayXd along_x =
      (at_nodes.at->even[1] * velocity.head(n)).array() / at_nodes.curve.arc.array();
  const Eigen::ArrayXd along_r =
      (at_nodes.at->odd[1] * velocity.tail(n)).array() / at_nodes.curve.arc.array();
  const Eigen::ArrayXd along_t = along_x * t_x + along_r * t_r;
  const Eigen::ArrayXd along_n = along_r * t_x - along_x * t_r;
  const Eigen::ArrayXd across_t = shear.array() - along_n;
  const Eigen::ArrayXd across_n = -along_t - velocity.tail(n).array() / at_nodes.curve.r.array();
  return of_displacement(*at_nodes.at, dyads(at_nodes, along_t, across_t, along_n, across_n), 0);
}

// t.sigma n inside: the traction that goes with the velocity there, S sigma n/(8 pi) = v/2 - D v; a
// pressure is free in it. The wall has no part in it.
Vector inner_shear(const Interaction &interaction, Matrix single, const Frame &at_nodes, const Vector &area,
                   const Vector &velocity) {
  const Eigen::Index n = area.size();
  Vector normal(2 * n);
  normal << -at_nodes.tangent_r, at_nodes.tangent_x;
  single += normal * normal.cwiseProduct(area.replicate(2, 1)).transpose();
  const Vector traction =
      lu_solve(single.partialPivLu(), Vector(0.5 * velocity - interaction.double_layer(velocity)));
  return traction.head(n).cwiseProduct(at_nodes.tangent_x) +
         traction.tail(n).cwiseProduct(at_nodes.tangent_r);
}

} // namespace

Matrix linear_motion(const Interaction &interaction, const NodalLayers &layers, const Membrane &membrane,
                     const Vector &position, const Vector &velocity, double capillary_number) {
  const Sampling &nodes = membrane.at_nodes;
  const MembraneMesh::Part &part = interaction.mesh().parts[0];
  const Vector load = membrane_load(membrane, position) / capillary_number;
  const Frame at_nodes = frame_at(nodes, position, load),
              at_panels = frame_at(part.at_panels, position, load);
  const Matrix nodal_change = load_jacobian(membrane, position, capillary_number);
  const RowMatrix &single = interaction.single_from_panels(), &dbl = interaction.double_from_panels();
  const CarriedLoad carried = carried_load(at_panels);
  const auto single_times = [&](const Pointwise &map) { return times(single, stokeslet_factor * map); };
  Matrix motion = layers.single * nodal_change;
  motion += part.on_nodes(single_times(carried.of_displacement) - times(dbl, slip(at_panels)));
  motion += part.on_nodes(single_times(carried.of_slope), 1);
  // The wall answers to what the nodes have.
  const CarriedLoad carried_by_nodes = carried_load(at_nodes);
  const Pointwise slip_at_nodes = slip(at_nodes);
  const Matrix load_change = nodal_change + of_displacement(nodes, carried_by_nodes.of_displacement, 0) +
                             of_displacement(nodes, carried_by_nodes.of_slope, 1);
  Matrix at_wall = layers.single_at_wall * load_change;
  at_wall -= times(layers.double_at_wall, slip_at_nodes);
  motion -= layers.answer * at_wall;
  motion -= of_displacement(nodes, 0.5 * slip_at_nodes, 0);
  const Vector shear =
      inner_shear(interaction, layers.single, at_nodes, nodal_area(membrane, position), velocity);
  return motion + advance_of_inner_flow(at_nodes, shear, velocity);
}

} // namespace capsule
