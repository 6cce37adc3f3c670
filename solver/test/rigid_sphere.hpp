#pragma once
// The motion of a rigid sphere on the axis, for tests and studies: the limit of a stiff membrane.
#include "flow/flow.hpp"
#include "spheroid.hpp"

namespace capsule {

// A force-free rigid sphere on the axis. The load that keeps it rigid is found from S q = 8 pi (U - v_e).
struct RigidSphere {
  double v_g, pressure_drop, reciprocal, flow_rate;
};
inline RigidSphere rigid_sphere(const Flow &flow, const MeridianBasis &basis, double x, double a) {
  const Eigen::Index n = basis.size();
  const Vector position = sphere(basis, x, a);
  const Interaction interaction = flow.interact(position);
  Recycled recycled, traction;
  const Matrix mobility = flow.mobility(interaction, recycled);
  // Unknown load and speed: M q - U e_x = -v_e, no force; a pressure inside is free, so q.n is pinned.
  Vector area(n);
  area = basis.weights.array() * a * position.tail(n).array();
  Matrix matrix = Matrix::Zero(2 * n + 1, 2 * n + 1);
  Vector right = Vector::Zero(2 * n + 1);
  Vector normal(2 * n);
  normal << (position.head(n).array() - x) / a, position.tail(n).array() / a;
  Vector area2(2 * n);
  area2 << area, area;
  matrix.topLeftCorner(2 * n, 2 * n) =
      mobility + normal * (normal.array() * area2.array()).matrix().transpose();
  matrix.col(2 * n).head(n).setConstant(-1);
  matrix.row(2 * n).head(n) = area.transpose();
  right.head(2 * n) = -interaction.base_velocity();
  const Vector solution = matrix.partialPivLu().solve(right);
  const Vector load = solution.head(2 * n);
  const FlowState state = flow.solve(interaction, load, recycled);
  return {solution[2 * n], state.pressure_drop,
          flow.reciprocal_pressure_drops(interaction, load, state, traction).sum(), state.flow_rate};
}

} // namespace capsule
