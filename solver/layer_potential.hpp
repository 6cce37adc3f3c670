#pragma once
// The integrals of eq. 16 as matrices: what densities at the quadrature points of a curve do to target
// points. Every matrix has 2 n_t rows (axial, then radial velocity at the targets) and 2 Q columns (axial,
// then radial density at the curve's points) and includes the area element; factors 1/(8 pi), 1/epsilon,
// lambda - 1 are the caller's. Three kinds of panels are told apart:
//   far      the panel's own Gauss rule
//   near     the panel is halved, with its polynomial interpolant, until its Gauss rule reaches the tolerance
//   self     a target that lies on the curve: product weights for the logarithm on the panels that hold or
//   touch it
#include "quadrature.hpp"
#include <vector>

namespace capsule {

// A meridian curve sampled on panels. The unit normal is (-r', x')/|.|: with zeta running downstream along
// the membrane it points out of the capsule.
struct Curve {
  Eigen::Index panel_points = 0; // p
  Vector x, r;                   // Q
  Vector x_zeta, r_zeta;         // derivatives in the panels' parameter
  Vector weights;                // of the rule, in the parameter
  // Derived by complete():
  Vector arc; // ds/dzeta
  Vector normal_x, normal_r;
  Vector area; // r ds: density weight (the azimuth is in the kernel)
  Eigen::Index size() const { return x.size(); }
};
void complete(Curve &curve);

struct Targets {
  Vector x, r;
  Eigen::Index size() const { return x.size(); }
};

// Where targets lie on the curve itself, and the product weights that follow; fixed as long as the parameters
// are.
struct SelfRule {
  struct Site {
    Eigen::Index first_point = 0; // of the run of panels with product weights
    Vector gap_squared;           // (zeta_q - zeta_target)^2
    Vector logarithm; // integral of ln((zeta - zeta_target)^2) times the cardinal polynomial of point q
  };
  std::vector<Site> sites; // one a target
};
SelfRule make_self_rule(const Panels &panels, const Vector &target_zeta);

enum class Layer { single, dbl };

// `self` is null when the targets are no fixed points of the curve. Targets nearer to a panel than its Gauss
// rule can bear get the near rule, down to targets on the curve. tolerance: relative accuracy asked of the
// near rule.
void assemble_layer(Layer layer, const Targets &targets, const Curve &curve, const SelfRule *self,
                    double tolerance, RowMatrix &matrix);

} // namespace capsule
