#include "linear_motion.hpp"
#include <numbers>
#include <utility>

namespace capsule {
namespace {

// The membrane's frame and load at the nodes.
struct Frame {
  Vector x_zeta, r_zeta, arc;       // derivatives in zeta
  Vector tangent_x, tangent_r;      // downstream; the normal is (-tangent_r, tangent_x)
  Vector load_tangent, load_normal; // q/eps
};

Frame frame_of(const Membrane &membrane, const Vector &position, double capillary_number) {
  const Eigen::Index n = membrane.basis.size();
  Frame frame;
  frame.x_zeta = membrane.at_nodes.even[1] * position.head(n);
  frame.r_zeta = membrane.at_nodes.odd[1] * position.tail(n);
  frame.arc = (frame.x_zeta.array().square() + frame.r_zeta.array().square()).sqrt();
  frame.tangent_x = frame.x_zeta.array() / frame.arc.array();
  frame.tangent_r = frame.r_zeta.array() / frame.arc.array();
  const Vector load = membrane_load(membrane, position) / capillary_number;
  const auto load_x = load.head(n).array();
  const auto load_r = load.tail(n).array();
  frame.load_tangent = load_x * frame.tangent_x.array() + load_r * frame.tangent_r.array();
  frame.load_normal = -load_x * frame.tangent_r.array() + load_r * frame.tangent_x.array();
  return frame;
}

// A vector at each node that depends on the displacement of that node alone.
struct Nodewise {
  Vector xx, xr, rx, rr;

  // a e_a.d + b e_b.d ...: sum of dyads u (v.d)
  static Nodewise zero(Eigen::Index n) {
    return {Vector::Zero(n), Vector::Zero(n), Vector::Zero(n), Vector::Zero(n)};
  }
  void add(const Vector &factor, const Vector &to_x, const Vector &to_r, const Vector &of_x,
           const Vector &of_r) {
    xx.array() += factor.array() * to_x.array() * of_x.array();
    xr.array() += factor.array() * to_x.array() * of_r.array();
    rx.array() += factor.array() * to_r.array() * of_x.array();
    rr.array() += factor.array() * to_r.array() * of_r.array();
  }
};

// matrix * nodewise
Matrix times(const Matrix &matrix, const Nodewise &local) {
  const Eigen::Index n = local.xx.size();
  Matrix result(matrix.rows(), 2 * n);
  result.leftCols(n) =
      matrix.leftCols(n) * local.xx.asDiagonal() + matrix.rightCols(n) * local.rx.asDiagonal();
  result.rightCols(n) =
      matrix.leftCols(n) * local.xr.asDiagonal() + matrix.rightCols(n) * local.rr.asDiagonal();
  return result;
}

// f' of the head comment.
Matrix load_change(const Membrane &membrane, const Vector &position, const Frame &frame,
                   double capillary_number) {
  const Eigen::Index n = membrane.basis.size();
  const Vector &t_x = frame.tangent_x;
  const Vector &t_r = frame.tangent_r;
  const Vector n_x = -t_r;
  const Vector &n_r = t_x;
  const Vector r = position.tail(n);
  const Vector tangential = r.array() * frame.load_tangent.array();
  const Vector normal = r.array() * frame.load_normal.array();

  // The stress of the load's jump on the strip that the displacement of a ring sweeps.
  Nodewise swept = Nodewise::zero(n);
  swept.add(tangential, t_x, t_r, t_x, t_r);
  swept.add(-normal, t_x, t_r, n_x, n_r);
  swept.add(normal, n_x, n_r, t_x, t_r);
  swept.add(-tangential, n_x, n_r, n_x, n_r);

  Matrix change = -energy_hessian(membrane, position) / (2 * std::numbers::pi * capillary_number);
  const Vector per_weight = membrane.basis.weights.cwiseInverse();
  change.topRows(n) = per_weight.asDiagonal() * change.topRows(n);
  change.bottomRows(n) = per_weight.asDiagonal() * change.bottomRows(n);
  const Matrix &of_odd = membrane.at_nodes.odd[1];
  const Matrix &of_even = membrane.at_nodes.even[1];
  // Across the meridian instead of along: the axial component is odd, and even after the factor r.
  change.topLeftCorner(n, n) -= of_even * swept.xx.asDiagonal();
  change.topRightCorner(n, n) -= of_even * swept.xr.asDiagonal();
  change.bottomLeftCorner(n, n) -= of_odd * swept.rx.asDiagonal();
  change.bottomRightCorner(n, n) -= of_odd * swept.rr.asDiagonal();
  // The hoop stress on the strip between the two surfaces.
  const Vector hoop = frame.load_normal.array() * frame.arc.array();
  change.bottomLeftCorner(n, n) -= Matrix((hoop.array() * n_x.array()).matrix().asDiagonal());
  change.bottomRightCorner(n, n) -= Matrix((hoop.array() * n_r.array()).matrix().asDiagonal());

  const Vector per_area = (r.array() * frame.arc.array()).inverse();
  change.topRows(n) = per_area.asDiagonal() * change.topRows(n);
  change.bottomRows(n) = per_area.asDiagonal() * change.bottomRows(n);
  return change;
}

} // namespace

LinearMotion linear_motion(const FlowSystem &flow, const FlowSystem::Interaction &shape,
                           const Membrane &membrane, const Vector &position, double capillary_number) {
  const Eigen::Index n = membrane.basis.size();
  const Frame frame = frame_of(membrane, position, capillary_number);
  LinearMotion motion;
  FlowSystem::Layers layers = flow.layers(shape);
  motion.double_layer = std::move(layers.dbl);
  Nodewise slip = Nodewise::zero(n); // w
  slip.add(frame.load_tangent, frame.tangent_x, frame.tangent_r, -frame.tangent_r, frame.tangent_x);
  motion.equal_viscosities = layers.single * load_change(membrane, position, frame, capillary_number) -
                             times(motion.double_layer + 0.5 * Matrix::Identity(2 * n, 2 * n), slip);
  return motion;
}

} // namespace capsule
