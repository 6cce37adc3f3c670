#pragma once
// The membrane's load on the liquids at the nodes of a spectral basis: eq. 7 in its weak form. Virtual work gives the
// integral of the load q against any displacement; Gauss's rule on the nodes makes its mass matrix diagonal:
//   q_j = -(dW/dposition_j)/(2 pi weights_j r_j ds/dzeta_j)
// Nodal values are 2N, axial components and then radial ones: forces per deformed area, scaled with G/R_t. All throw
// std::invalid_argument for a spline basis.
#include "membrane/membrane.hpp"

namespace capsule {

// The area that each node stands for, N: the denominators above.
Vector nodal_area(const Membrane &membrane, const Vector &position);

// q
Vector membrane_load(const Membrane &membrane, const Vector &position);

// Derivative of q/capillary_number with respect to the position, 2N x 2N.
Matrix load_jacobian(const Membrane &membrane, const Vector &position, double capillary_number);
// The same with the nodes' areas frozen.
Matrix frozen_load_jacobian(const Membrane &membrane, const Vector &position, double capillary_number);

} // namespace capsule
