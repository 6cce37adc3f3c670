#pragma once
// Functions along the membrane's meridian from their values at the nodes. The meridian is half of a closed
// smooth curve with parameter zeta in [0, pi] from the upstream to the downstream pole; x and v_x are even, r
// and v_r odd in zeta at both poles. A basis turns nodal values into values and derivatives (in zeta)
// anywhere:
//   f(points) = even(points, 0) * f(nodes),  f''(points) = even(points, 2) * f(nodes)
// - The spectral basis: cos(k zeta), k < N, and sin(k zeta), 1 <= k <= N, on the N Gauss-Legendre
//   colatitudes (no node at a pole). Exponential accuracy on smooth shapes.
// - The spline basis: cubic B-splines on N + 1 equidistant nodes, poles included, with the parities as end
//   conditions (eqs. 19-26): the first derivative of even functions vanishes at the poles, the second one of odd
//   functions. Order 4 for the value, one less for each derivative.
// An odd function vanishes at the poles: with splines, its nodal values there must be zero.
// All throw std::invalid_argument when nodes are too few or not ascending, or points lie outside.
#include "base/linear_algebra.hpp"

namespace capsule {

struct MeridianBasis {
  bool spline = false; // otherwise spectral
  Vector nodes;        // zeta, ascending
  // Quadrature on the nodes: sum_j weights_j f(nodes_j) is the integral of an odd f over [0, pi]: exact for
  // sin(zeta) times a polynomial of degree 2N - 1 in cos(zeta) (spectral), for the interpolating spline
  // (spline).
  Vector weights;
  Matrix even_from_nodes; // expansion coefficients from nodal values
  Matrix odd_from_nodes;

  Eigen::Index size() const { return nodes.size(); }
  // points.size() x N matrices; derivative = 0 ... 3 in zeta.
  Matrix even(const Vector &points, int derivative) const;
  Matrix odd(const Vector &points, int derivative) const;
  // These matrices times nodal values, without building them.
  Vector even(const Vector &points, int derivative, const Vector &at_nodes) const;
  Vector odd(const Vector &points, int derivative, const Vector &at_nodes) const;
};

// A meridian at a position, 2N, for many small sets of points: expanded once, and no matrix is built.
class Meridian {
public:
  // Refers to the basis, which has to outlive it.
  Meridian(const MeridianBasis &basis, const Vector &position);
  struct Points {
    Vector x, x_1, x_2, r; // x with derivatives in zeta
  };
  Points at(const Vector &zeta) const;

private:
  const MeridianBasis *basis_;
  Vector x_, r_; // coefficients
};

// Series of cos(k zeta), k = 0, 1 ..., and of sin(k zeta), k = 1, 2 ..., at points.
Vector cosine_series(const Vector &coefficients, const Vector &points);
Vector sine_series(const Vector &coefficients, const Vector &points);
// Sums over the points of values times cos(k zeta), k < count.
Vector cosine_moments(const Vector &values, const Vector &points, Eigen::Index count);

MeridianBasis spectral_basis(int nodes);
MeridianBasis spline_basis(int elements);

} // namespace capsule
