#include "layer_potential.hpp"
#include "ring_kernel.hpp"
#include <algorithm>
#include <array>
#include <cmath>

namespace capsule {

void complete(Curve &curve) {
  curve.arc = (curve.x_zeta.array().square() + curve.r_zeta.array().square()).sqrt();
  curve.normal_x = -curve.r_zeta.array() / curve.arc.array();
  curve.normal_r = curve.x_zeta.array() / curve.arc.array();
  curve.area = curve.weights.array() * curve.arc.array() * curve.r.array();
}

SelfRule make_self_rule(const Panels &panels, const Vector &target_zeta) {
  const Eigen::Index p = panels.rule.size();
  SelfRule self;
  for (const double zeta : target_zeta) {
    const double *begin = panels.edges.data();
    const double *end = begin + panels.edges.size();
    const Eigen::Index home =
        std::clamp<Eigen::Index>(std::upper_bound(begin, end, zeta) - begin - 1, 0, panels.count() - 1);
    const Eigen::Index first = std::max<Eigen::Index>(home - 1, 0);
    const Eigen::Index last = std::min(home + 1, panels.count() - 1);
    SelfRule::Site site;
    site.first_point = first * p;
    const Eigen::Index n = (last - first + 1) * p;
    site.gap_squared = (panels.points.segment(site.first_point, n).array() - zeta).square();
    site.logarithm.resize(n);
    for (Eigen::Index k = first; k <= last; ++k) {
      const double half = (panels.edges[k + 1] - panels.edges[k]) / 2;
      const double middle = (panels.edges[k + 1] + panels.edges[k]) / 2;
      // ln((zeta - zeta_0)^2) = ln((t - t_0)^2) + 2 ln(half)
      site.logarithm.segment((k - first) * p, p) =
          half *
          (logarithm_weights(panels.rule, (zeta - middle) / half) + 2 * std::log(half) * panels.rule.weights);
    }
    self.sites.push_back(std::move(site));
  }
  return self;
}

namespace {

using Block = Eigen::Matrix<double, 4, Eigen::Dynamic, Eigen::RowMajor>; // rows xx, xr, rx, rr

KernelRow rows_of(Block &block) {
  return {block.row(0).data(), block.row(1).data(), block.row(2).data(), block.row(3).data()};
}

Rings rings_of(const Curve &curve, Eigen::Index first, Eigen::Index count) {
  return {static_cast<int>(count), curve.x.data() + first, curve.r.data() + first,
          curve.normal_x.data() + first, curve.normal_r.data() + first};
}

void evaluate(Layer layer, double x0, double r0, const Rings &rings, const KernelRow &out) {
  if (layer == Layer::single)
    ring_stokeslet(x0, r0, rings, out);
  else
    ring_stresslet(x0, r0, rings, out);
}

// How far, in half lengths of a panel, a target must be for its p-point rule to err by less than the
// tolerance: the rule converges like rho^(-2 p) on the Bernstein ellipse through the target, at height
// sinh(ln rho).
double near_factor(Eigen::Index points, double tolerance) {
  return std::sinh(-std::log(tolerance) / (2.0 * static_cast<double>(points)));
}

// The near rule for one target and one panel.
class NearPanel {
public:
  NearPanel(Layer layer, Eigen::Index points, double tolerance)
      : layer_(layer), factor_(near_factor(points, tolerance)),
        weights_(gauss_legendre(static_cast<int>(points)).weights) {
    const Vector nodes = gauss_legendre(static_cast<int>(points)).nodes;
    halves_[0] = lagrange_matrix(nodes, (nodes.array() - 1) / 2);
    halves_[1] = lagrange_matrix(nodes, (nodes.array() + 1) / 2);
  }

  double factor() const { return factor_; }

  // Weights (kernel, area and interpolation) of the panel's own points, 4 x p.
  Block integrate(double x0, double r0, const Curve &curve, Eigen::Index first) const {
    const Eigen::Index p = curve.panel_points;
    Geometry panel(p, 4);
    panel << curve.x.segment(first, p), curve.r.segment(first, p), curve.x_zeta.segment(first, p),
        curve.r_zeta.segment(first, p);
    const double half = curve.weights[first] / weights_[0];
    return refine(x0, r0, panel, half, 0);
  }

private:
  using Geometry = Eigen::Matrix<double, Eigen::Dynamic, 4>; // columns x, r, dx/dzeta, dr/dzeta

  // Below this fraction of a panel nothing is left to integrate: the logarithm's share is at rounding error.
  static constexpr int deepest = 46;

  Block refine(double x0, double r0, const Geometry &panel, double half, int depth) const {
    const Eigen::ArrayXd arc = (panel.col(2).array().square() + panel.col(3).array().square()).sqrt();
    const double nearest =
        std::sqrt(((panel.col(0).array() - x0).square() + (panel.col(1).array() - r0).square()).minCoeff());
    if (depth > deepest)
      return Block::Zero(4, panel.rows());
    if (nearest < factor_ * half * arc.mean()) {
      Block sum = Block::Zero(4, panel.rows());
      for (const Matrix &child : halves_)
        sum.noalias() += refine(x0, r0, child * panel, half / 2, depth + 1) * child;
      return sum;
    }
    const Eigen::ArrayXd normal_x = -panel.col(3).array() / arc;
    const Eigen::ArrayXd normal_r = panel.col(2).array() / arc;
    Block block(4, panel.rows());
    evaluate(layer_, x0, r0,
             {static_cast<int>(panel.rows()), panel.col(0).data(), panel.col(1).data(), normal_x.data(),
              normal_r.data()},
             rows_of(block));
    const Eigen::ArrayXd area = half * weights_.array() * arc * panel.col(1).array();
    block.array().rowwise() *= area.transpose();
    return block;
  }

  Layer layer_;
  double factor_;
  Vector weights_;
  std::array<Matrix, 2> halves_;
};

// Weights of the panels that hold or touch a target on the curve. The kernel is
// smooth - ln(m1) logarithmic with ln(m1) = ln(gap^2) + a smooth function (layer split of ring_kernel.hpp).
Block integrate_self(Layer layer, double x0, double r0, const Curve &curve, const SelfRule::Site &site) {
  const Eigen::Index n = site.logarithm.size();
  const Eigen::Index first = site.first_point;
  Block smooth(4, n);
  Block logarithmic(4, n);
  const Rings rings = rings_of(curve, first, n);
  if (layer == Layer::single)
    ring_stokeslet_split(x0, r0, rings, rows_of(smooth), rows_of(logarithmic));
  else
    ring_stresslet_split(x0, r0, rings, rows_of(smooth), rows_of(logarithmic));
  const auto dx2 = (curve.x.segment(first, n).array() - x0).square();
  const auto dr2 = (curve.r.segment(first, n).array() - r0).square();
  const auto sum2 = (curve.r.segment(first, n).array() + r0).square();
  const Eigen::ArrayXd remainder = ((dx2 + dr2) / ((dx2 + sum2) * site.gap_squared.array())).log();
  const Eigen::ArrayXd element = curve.arc.segment(first, n).array() * curve.r.segment(first, n).array();
  const Eigen::ArrayXd plain = curve.weights.segment(first, n).array() * element;
  const Eigen::ArrayXd product = plain * remainder + site.logarithm.array() * element;
  return (smooth.array().rowwise() * plain.transpose() - logarithmic.array().rowwise() * product.transpose())
      .matrix();
}

} // namespace

void assemble_layer(Layer layer, const Targets &targets, const Curve &curve, const SelfRule *self,
                    double tolerance, RowMatrix &matrix) {
  const Eigen::Index nt = targets.size();
  const Eigen::Index q = curve.size();
  const Eigen::Index p = curve.panel_points;
  const NearPanel near(layer, p, tolerance);
  matrix.resize(2 * nt, 2 * q);
  const Rings rings = rings_of(curve, 0, q);
  const Vector length = (curve.weights.array() * curve.arc.array()).matrix();
  for (Eigen::Index i = 0; i < nt; ++i) {
    const double x0 = targets.x[i];
    const double r0 = targets.r[i];
    double *axial = matrix.row(i).data();
    double *radial = matrix.row(nt + i).data();
    evaluate(layer, x0, r0, rings, {axial, axial + q, radial, radial + q});
    for (double *component : {axial, axial + q, radial, radial + q})
      Eigen::Map<Eigen::ArrayXd>(component, q) *= curve.area.array();
    const auto replace = [&](const Block &block, Eigen::Index first) {
      const Eigen::Index n = block.cols();
      matrix.row(i).segment(first, n) = block.row(0);
      matrix.row(i).segment(q + first, n) = block.row(1);
      matrix.row(nt + i).segment(first, n) = block.row(2);
      matrix.row(nt + i).segment(q + first, n) = block.row(3);
    };
    Eigen::Index self_begin = 0;
    Eigen::Index self_end = 0;
    if (self != nullptr) {
      const SelfRule::Site &site = self->sites[static_cast<std::size_t>(i)];
      self_begin = site.first_point;
      self_end = site.first_point + site.logarithm.size();
      replace(integrate_self(layer, x0, r0, curve, site), self_begin);
    }
    for (Eigen::Index first = 0; first < q; first += p) {
      if (first >= self_begin && first < self_end)
        continue;
      const double reach = near.factor() * length.segment(first, p).sum() / 2;
      const double nearest2 = ((curve.x.segment(first, p).array() - x0).square() +
                               (curve.r.segment(first, p).array() - r0).square())
                                  .minCoeff();
      if (nearest2 < reach * reach)
        replace(near.integrate(x0, r0, curve, first), first);
    }
  }
}

} // namespace capsule
