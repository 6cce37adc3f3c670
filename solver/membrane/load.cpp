#include "membrane/load.hpp"
#include <numbers>
#include <stdexcept>

namespace capsule {

Vector nodal_area(const Membrane &membrane, const Vector &position) {
  if (membrane.basis.spline)
    throw std::invalid_argument("nodal loads need a spectral basis");
  const Eigen::Index n = membrane.basis.size();
  // At the nodes x and r are the nodal values: only their derivatives are needed.
  const Eigen::ArrayXd x_zeta = membrane.at_nodes.even[1] * position.head(n);
  const Eigen::ArrayXd r_zeta = membrane.at_nodes.odd[1] * position.tail(n);
  return 2 * std::numbers::pi * membrane.basis.weights.array() * position.tail(n).array() *
         (x_zeta.square() + r_zeta.square()).sqrt();
}

Vector membrane_load(const Membrane &membrane, const Vector &position) {
  return -energy_gradient(membrane, position).array() /
         nodal_area(membrane, position).replicate(2, 1).array();
}

Matrix frozen_load_jacobian(const Membrane &membrane, const Vector &position, double capillary_number) {
  const Vector mass = (capillary_number * nodal_area(membrane, position)).replicate(2, 1);
  const Vector factor = -mass.cwiseInverse();
  return factor.asDiagonal() * energy_hessian(membrane, position);
}

Matrix load_jacobian(const Membrane &membrane, const Vector &position, double capillary_number) {
  const Eigen::Index n = membrane.basis.size();
  const Vector load = membrane_load(membrane, position) / capillary_number;
  const Matrix area = area_change(membrane.at_nodes, trace(membrane.at_nodes, position));
  Matrix jacobian = frozen_load_jacobian(membrane, position, capillary_number);
  jacobian.topRows(n) -= load.head(n).asDiagonal() * area;
  jacobian.bottomRows(n) -= load.tail(n).asDiagonal() * area;
  return jacobian;
}

} // namespace capsule
