#include "integrals/layer_potential.hpp"
#include <algorithm>
#include <cmath>
#include <limits>

namespace capsule {

void complete(Curve &curve) {
  curve.arc = (curve.x_zeta.array().square() + curve.r_zeta.array().square()).sqrt();
  curve.normal_x = -curve.r_zeta.array() / curve.arc.array();
  curve.normal_r = curve.x_zeta.array() / curve.arc.array();
  curve.area = curve.weights.array() * curve.arc.array() * curve.r.array();
}

namespace {

void find_nearest(const Panels &panels, SelfRule::Site &site) {
  constexpr double tiny = 1e-30; // instead of no gap: the kernel wants a direction
  site.gap_squared.minCoeff(&site.nearest);
  site.gap = panels.points[site.first_point + site.nearest] - site.zeta;
  if (std::abs(site.gap) < tiny)
    site.gap = tiny;
  site.gap_squared[site.nearest] = site.gap * site.gap;
}

} // namespace

SelfRule make_self_rule(const Panels &panels, const Vector &target_zeta, int neighbours) {
  const Eigen::Index p = panels.rule.size();
  SelfRule self;
  for (const double zeta : target_zeta) {
    const double *begin = panels.edges.data();
    const double *end = begin + panels.edges.size();
    const Eigen::Index home =
        std::clamp<Eigen::Index>(std::upper_bound(begin, end, zeta) - begin - 1, 0, panels.count() - 1);
    const Eigen::Index first = std::max<Eigen::Index>(home - neighbours, 0);
    const Eigen::Index last = std::min(home + neighbours, panels.count() - 1);
    SelfRule::Site site;
    site.zeta = zeta;
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
    find_nearest(panels, site);
    self.sites.push_back(std::move(site));
  }
  return self;
}

Matrix bend(const SelfRule &self, const std::function<Matrix(const Vector &zeta)> &second_derivative) {
  const auto n = static_cast<Eigen::Index>(self.sites.size());
  Vector zeta(n), gap(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    zeta[i] = self.sites[static_cast<std::size_t>(i)].zeta;
    gap[i] = self.sites[static_cast<std::size_t>(i)].gap;
  }
  const GaussRule along = gauss_legendre(6);
  Matrix sum;
  for (Eigen::Index k = 0; k < along.size(); ++k) {
    const double s = (1 + along.nodes[k]) / 2;
    const Matrix part = (along.weights[k] / 2 * s * gap).asDiagonal() * second_derivative(zeta + s * gap);
    sum = k == 0 ? part : sum + part;
  }
  return sum;
}

namespace {

Eigen::Index components(const RingKernel &kernel) {
  return Eigen::Index{kernel.dimension} * kernel.dimension;
}

KernelRow rows_of(KernelBlock &block) {
  if (block.rows() == 1)
    return {block.data()};
  return {block.row(0).data(), block.row(1).data(), block.row(2).data(), block.row(3).data()};
}

double squared_distance(double x0, double r0, const Curve &curve, Eigen::Index first, Eigen::Index count) {
  double nearest = std::numeric_limits<double>::infinity();
  for (Eigen::Index k = first; k < first + count; ++k) {
    const double dx = curve.x[k] - x0;
    const double dr = curve.r[k] - r0;
    nearest = std::min(nearest, dx * dx + dr * dr);
  }
  return nearest;
}

// How far, in half lengths of a panel, a target must be for its p-point rule to err by less than the
// tolerance: the rule converges like rho^(-2 p) on the Bernstein ellipse through the target, at height
// sinh(ln rho).
double near_factor(Eigen::Index points, double tolerance) {
  return std::sinh(-std::log(tolerance) / (2.0 * static_cast<double>(points)));
}

// Both parts of the kernel at the points next to a target: the same room for all targets of a layer.
struct SplitBlocks {
  KernelBlock smooth, logarithmic;
};

// Weights of the panels that hold or touch a target on the curve. The kernel is
// smooth - ln(m1) logarithmic with ln(m1) = ln(gap^2) + a smooth function (ring_kernel.hpp).
const KernelBlock &integrate_self(const RingKernel &kernel, const Targets &targets, Eigen::Index i,
                                  const Curve &curve, const SelfRule::Site &site, SplitBlocks &blocks) {
  const double x0 = targets.x[i];
  const double r0 = targets.r[i];
  const Eigen::Index n = site.logarithm.size();
  const Eigen::Index first = site.first_point;
  const Rings rings = rings_of(curve, first, n);
  Separations apart = separations(x0, r0, rings);
  const Eigen::Index nearest = first + site.nearest;
  const double bend_x = targets.bend_x[i];
  const double bend_r = targets.bend_r[i];
  apart.row(site.nearest) << site.gap * (curve.x_zeta[nearest] - bend_x),
      site.gap * (curve.r_zeta[nearest] - bend_r),
      -site.gap * (bend_x * curve.normal_x[nearest] + bend_r * curve.normal_r[nearest]);

  auto &[smooth, logarithmic] = blocks;
  smooth.resize(components(kernel), n);
  logarithmic.resize(components(kernel), n);
  kernel.split(r0, rings, apart, rows_of(smooth), rows_of(logarithmic));
  const auto dx2 = apart.col(0).array().square();
  const auto dr2 = apart.col(1).array().square();
  const auto sum2 = (curve.r.segment(first, n).array() + r0).square();
  const Eigen::ArrayXd remainder = ((dx2 + dr2) / ((dx2 + sum2) * site.gap_squared.array())).log();
  const Eigen::ArrayXd element = curve.arc.segment(first, n).array() * curve.r.segment(first, n).array();
  const Eigen::ArrayXd plain = curve.weights.segment(first, n).array() * element;
  const Eigen::ArrayXd product = plain * remainder + site.logarithm.array() * element;
  smooth.array().rowwise() *= plain.transpose();
  logarithmic.array().rowwise() *= product.transpose();
  smooth -= logarithmic;
  return smooth;
}

} // namespace

NearRule::NearRule(Eigen::Index points, double tolerance) : factor_(near_factor(points, tolerance)) {
  const GaussRule rule = gauss_legendre(static_cast<int>(points));
  weights_ = rule.weights;
  halves_[0] = lagrange_matrix(rule.nodes, (rule.nodes.array() - 1) / 2);
  halves_[1] = lagrange_matrix(rule.nodes, (rule.nodes.array() + 1) / 2);
}

KernelBlock NearRule::integrate(const RingKernel &kernel, double x0, double r0, const Curve &curve,
                                Eigen::Index first) const {
  const Eigen::Index p = curve.panel_points;
  Geometry panel(p, 4);
  panel << curve.x.segment(first, p), curve.r.segment(first, p), curve.x_zeta.segment(first, p),
      curve.r_zeta.segment(first, p);
  const double half = curve.weights[first] / weights_[0];
  return refine(kernel, x0, r0, panel, half, 0);
}

KernelBlock NearRule::refine(const RingKernel &kernel, double x0, double r0, const Geometry &panel,
                             double half, int depth) const {
  // Below this fraction of a panel nothing is left to integrate: the logarithm's share is at rounding error.
  constexpr int deepest = 46;
  const Eigen::ArrayXd arc = (panel.col(2).array().square() + panel.col(3).array().square()).sqrt();
  const double nearest =
      std::sqrt(((panel.col(0).array() - x0).square() + (panel.col(1).array() - r0).square()).minCoeff());
  if (depth > deepest)
    return KernelBlock::Zero(components(kernel), panel.rows());
  if (nearest < factor_ * half * arc.mean()) {
    KernelBlock sum = KernelBlock::Zero(components(kernel), panel.rows());
    for (const Matrix &child : halves_)
      sum.noalias() += refine(kernel, x0, r0, child * panel, half / 2, depth + 1) * child;
    return sum;
  }
  const Eigen::ArrayXd normal_x = -panel.col(3).array() / arc;
  const Eigen::ArrayXd normal_r = panel.col(2).array() / arc;
  KernelBlock block(components(kernel), panel.rows());
  kernel.plain(x0, r0,
               {static_cast<int>(panel.rows()), panel.col(0).data(), panel.col(1).data(), normal_x.data(),
                normal_r.data()},
               rows_of(block));
  const Eigen::ArrayXd area = half * weights_.array() * arc * panel.col(1).array();
  block.array().rowwise() *= area.transpose();
  return block;
}

FixedNearRule::FixedNearRule(const Curve &curve, double tolerance)
    : curve_(curve), rule_{NearRule(curve.panel_points, tolerance)} {
  const Eigen::Index p = curve.panel_points;
  const Eigen::Index panels = curve.size() / p;
  const GaussRule rule = gauss_legendre(static_cast<int>(p));
  reach_.resize(panels);
  span_.resize(panels);
  for (Eigen::Index k = 0; k < panels; ++k) {
    const double length = curve.weights.segment(k * p, p).dot(curve.arc.segment(k * p, p));
    reach_[k] = rule_[0].reach(length);
    span_[k] = reach_[k] + length;
  }
  for (int level = 1; level <= levels; ++level) {
    const Eigen::Index parts = Eigen::Index{1} << level;
    Vector nodes(parts * p);
    for (Eigen::Index part = 0; part < parts; ++part)
      nodes.segment(part * p, p) =
          (rule.nodes.array() + static_cast<double>(2 * part + 1 - parts)) / static_cast<double>(parts);
    interpolation_.emplace_back(lagrange_matrix(rule.nodes, nodes));
  }
  cuts_.resize(static_cast<std::size_t>(panels * levels));
}

const Curve &FixedNearRule::cut(Eigen::Index panel, int level) const {
  Curve &fine = cuts_[static_cast<std::size_t>(panel * levels + level - 1)];
  if (fine.size() > 0)
    return fine;
  const Eigen::Index p = curve_.panel_points;
  const RowMatrix &interpolation = interpolation_[static_cast<std::size_t>(level) - 1];
  fine.panel_points = p;
  fine.x = interpolation * curve_.x.segment(panel * p, p);
  fine.r = interpolation * curve_.r.segment(panel * p, p);
  fine.x_zeta = interpolation * curve_.x_zeta.segment(panel * p, p);
  fine.r_zeta = interpolation * curve_.r_zeta.segment(panel * p, p);
  const double parts = 1 << level;
  fine.weights = (curve_.weights.segment(panel * p, p) / parts).replicate(1 << level, 1);
  complete(fine);
  return fine;
}

double FixedNearRule::distance_to(Eigen::Index panel, double x0, double r0) const {
  const Eigen::Index first = panel * curve_.panel_points;
  if (squared_distance(x0, r0, curve_, first, 1) > span_[panel] * span_[panel])
    return std::numeric_limits<double>::infinity();
  return std::sqrt(squared_distance(x0, r0, curve_, first, curve_.panel_points));
}

KernelBlock FixedNearRule::integrate(const RingKernel &kernel, double x0, double r0, Eigen::Index panel,
                                     double distance) const {
  const Eigen::Index p = curve_.panel_points;
  // The parts' points may come nearer than those of the panel.
  const double reach = reach_[panel];
  int level = std::max(1, static_cast<int>(std::ceil(std::log2(std::min(reach / distance, 1e6)))));
  const auto too_coarse = [&] {
    const double needed = reach / static_cast<double>(1 << level);
    const Curve &fine = cut(panel, level);
    return squared_distance(x0, r0, fine, 0, fine.size()) < needed * needed;
  };
  while (level <= levels && too_coarse())
    ++level;
  if (level > levels)
    return rule_[0].integrate(kernel, x0, r0, curve_, panel * p);
  const Curve &fine = cut(panel, level);
  const RowMatrix &interpolation = interpolation_[static_cast<std::size_t>(level) - 1];
  const Eigen::Index n = fine.size();
  KernelBlock values(components(kernel), n);
  kernel.plain(x0, r0, rings_of(fine, 0, n), rows_of(values));
  KernelBlock block = KernelBlock::Zero(values.rows(), p);
  for (Eigen::Index component = 0; component < values.rows(); ++component)
    for (Eigen::Index k = 0; k < n; ++k)
      block.row(component) += (values(component, k) * fine.area[k]) * interpolation.row(k);
  return block;
}

void assemble_layer(const RingKernel &kernel, const Targets &targets, const Curve &curve,
                    const SelfRule *self, const NearRule &near, RowMatrix &matrix) {
  const Eigen::Index nt = targets.size();
  const Eigen::Index q = curve.size();
  const Eigen::Index p = curve.panel_points;
  const Eigen::Index dimension = kernel.dimension;
  matrix.resize(dimension * nt, dimension * q);
  // Beyond this distance of a panel's first point all of it is out of reach.
  const Eigen::Index panels = q / p;
  Vector reach(panels);
  Vector sphere(panels);
  for (Eigen::Index k = 0; k < panels; ++k) {
    const double length = curve.weights.segment(k * p, p).dot(curve.arc.segment(k * p, p));
    reach[k] = near.reach(length);
    sphere[k] = reach[k] + length;
  }
  SplitBlocks blocks;
  for (Eigen::Index i = 0; i < nt; ++i) {
    const double x0 = targets.x[i];
    const double r0 = targets.r[i];
    // Where a component of the target's velocity finds one of the densities.
    const auto part = [&](Eigen::Index component) {
      return matrix.row(component / dimension * nt + i).segment(component % dimension * q, q);
    };
    const Eigen::Index parts = components(kernel);
    const auto plainly = [&](Eigen::Index first, Eigen::Index count) {
      const auto at = [&](Eigen::Index component) {
        return component < parts ? part(component).data() + first : nullptr;
      };
      kernel.plain(x0, r0, rings_of(curve, first, count), {at(0), at(1), at(2), at(3)});
      for (Eigen::Index component = 0; component < parts; ++component)
        part(component).segment(first, count).array() *= curve.area.segment(first, count).transpose().array();
    };
    const auto replace = [&](const KernelBlock &block, Eigen::Index first) {
      for (Eigen::Index component = 0; component < parts; ++component)
        part(component).segment(first, block.cols()) = block.row(component);
    };
    Eigen::Index self_begin = 0;
    Eigen::Index self_end = 0;
    if (self != nullptr) {
      const SelfRule::Site &site = self->sites[static_cast<std::size_t>(i)];
      self_begin = site.first_point;
      self_end = site.first_point + site.logarithm.size();
      replace(integrate_self(kernel, targets, i, curve, site, blocks), self_begin);
    }
    plainly(0, self_begin);
    plainly(self_end, q - self_end);
    for (Eigen::Index k = 0; k < panels; ++k) {
      const Eigen::Index first = k * p;
      if (first >= self_begin && first < self_end)
        continue;
      if (squared_distance(x0, r0, curve, first, 1) > sphere[k] * sphere[k])
        continue;
      if (squared_distance(x0, r0, curve, first, p) < reach[k] * reach[k])
        replace(near.integrate(kernel, x0, r0, curve, first), first);
    }
  }
}

} // namespace capsule
