#pragma once
// The integrals of eq. 16 as matrices: what densities at the quadrature points of a curve do to target
// points. Every matrix has 2 n_t rows (axial, then radial velocity at the targets) and 2 Q columns (axial,
// then radial density at the curve's points) and includes the area element; 1/(8 pi) is the caller's. Those of
// Laplace's equation are n_t x Q. ring_stokeslet and ring_source make the single, ring_stresslet and ring_dipole the
// double layer. Three kinds of panels are told apart:
//   far      the panel's own Gauss rule
//   near     the panel is halved, with its polynomial interpolant, until its Gauss rule reaches the tolerance
//   self     a target that lies on the curve: product weights for the logarithm on the panels that hold or
//   touch it
// Throws nothing.
#include "geometry/quadrature.hpp"
#include "integrals/ring_kernel.hpp"
#include <functional>
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

// From a target on the curve to the nearest of the curve's points, at the gap h in zeta (SelfRule), it is
//   e = h (t - bend)   and   e.n = -h bend.n   with   bend = h int_0^1 s (x, r)_zetazeta(zeta + s h) ds,
// t = (x, r)_zeta and the normal n at that point. Differences of positions have no digits left where h is small.
struct Targets {
  Vector x, r;
  Vector bend_x = {}, bend_r = {}; // empty for targets off the curve
  Eigen::Index size() const { return x.size(); }
};

// Where targets lie on the curve itself, and the product weights that follow; fixed as long as the parameters
// are.
struct SelfRule {
  struct Site {
    Eigen::Index first_point = 0; // of the run of panels with product weights
    Vector gap_squared;           // (zeta_q - zeta_target)^2
    Vector logarithm; // integral of ln((zeta - zeta_target)^2) times the cardinal polynomial of point q
    double zeta = 0;
    // The nearest point q, which may all but coincide with the target, and its gap h = zeta_q - zeta.
    Eigen::Index nearest = 0;
    double gap = 0;
  };
  std::vector<Site> sites; // one a target
};
// neighbours: how many panels beside its own have product weights for a target; none where the curve is not smooth
// from one panel to the next.
SelfRule make_self_rule(const Panels &panels, const Vector &target_zeta, int neighbours = 1);
// One component of `bend`, a row for each target, from the second derivative at any points.
Matrix bend(const SelfRule &self, const std::function<Matrix(const Vector &zeta)> &second_derivative);

// Weights (kernel, area and interpolation) of points of a curve for one target: a row for each of the kernel's
// components in the order xx, xr, rx, rr of ring_kernel.hpp, a column a point.
using KernelBlock = RowMatrix;

// The near rule for panels of p points: which targets need it, and the weights that it gives.
class NearRule {
public:
  NearRule() = default;
  // tolerance: relative accuracy asked for.
  NearRule(Eigen::Index points, double tolerance);
  // How near a target may come to a panel of this arc length before the panel's own rule fails.
  double reach(double panel_length) const { return factor_ * panel_length / 2; }
  // The panel that begins at point `first`; any target, on the panel too.
  KernelBlock integrate(const RingKernel &kernel, double x0, double r0, const Curve &curve,
                        Eigen::Index first) const;

private:
  using Geometry = Eigen::Matrix<double, Eigen::Dynamic, 4>; // columns x, r, dx/dzeta, dr/dzeta
  KernelBlock refine(const RingKernel &kernel, double x0, double r0, const Geometry &panel, double half,
                     int depth) const;

  double factor_ = 0;
  Vector weights_;
  Matrix halves_[2]; // values on a half from those on the whole panel
};

// The near rule on a curve that stays: a panel is cut into 2, 4, 8 or 16 equal parts when a target first needs them, and they
// are kept.
class FixedNearRule {
public:
  FixedNearRule() = default;
  FixedNearRule(const Curve &curve, double tolerance);
  // Calls use(first point, weights) for each panel that the target is too near to.
  template <class Use>
  void at_near_panels(const RingKernel &kernel, double x0, double r0, Use &&use) const {
    for (Eigen::Index panel = 0; panel < reach_.size(); ++panel)
      if (const double distance = distance_to(panel, x0, r0); distance < reach_[panel]) {
        KernelBlock weights = integrate(kernel, x0, r0, panel, distance);
        use(panel * curve_.panel_points, weights);
      }
  }

private:
  // Of the nearest of the panel's points; infinite where the panel is surely out of reach.
  double distance_to(Eigen::Index panel, double x0, double r0) const;
  KernelBlock integrate(const RingKernel &kernel, double x0, double r0, Eigen::Index panel,
                        double distance) const;

  // A panel in 2^level parts.
  const Curve &cut(Eigen::Index panel, int level) const;

  static constexpr int levels = 4;
  Curve curve_;
  Vector reach_; // of each panel
  Vector span_;  // of each panel: reach and length
  std::vector<NearRule> rule_;
  std::vector<RowMatrix> interpolation_; // of each level: the parts' points from those of a panel
  mutable std::vector<Curve> cuts_; // levels of each panel; empty ones are not cut yet; not for two threads
};

// `self` is null when the targets are no fixed points of the curve. Targets nearer to a panel than its Gauss
// rule can bear get the near rule, down to targets on the curve.
void assemble_layer(const RingKernel &kernel, const Targets &targets, const Curve &curve,
                    const SelfRule *self, const NearRule &near, RowMatrix &matrix);

} // namespace capsule
