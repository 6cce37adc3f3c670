// Layer potentials against integrals that are known in closed form.
#include "geometry/meridian.hpp"
#include "integrals/layer_potential.hpp"
#include <boost/test/unit_test.hpp>
#include <numbers>

using namespace capsule;

namespace {

constexpr double pi = std::numbers::pi;

// A spheroid of semi-axes a (axial) and b on graded panels, and its nodes.
struct Spheroid {
  MeridianBasis basis;
  Panels panels;
  Curve curve;
  Targets nodes;
  SelfRule self;
};

void put_targets(Spheroid &s, double a, double b, const Vector &zeta) {
  s.self = make_self_rule(s.panels, zeta);
  s.nodes = {-a * zeta.array().cos(), b * zeta.array().sin(),
             bend(s.self, [&](const Vector &at) -> Matrix { return a * at.array().cos(); }),
             bend(s.self, [&](const Vector &at) -> Matrix { return -b * at.array().sin(); })};
}

Spheroid spheroid(double a, double b, int nodes, int panel_points = 12) {
  Spheroid s;
  s.basis = spectral_basis(nodes);
  const double largest = 0.65 * pi * panel_points / nodes;
  s.panels = make_panels(graded_edges(0, pi, 0.75 * s.basis.nodes[0], largest, Graded::both), panel_points);
  const Eigen::ArrayXd zeta = s.panels.points;
  s.curve.panel_points = panel_points;
  s.curve.weights = s.panels.weights;
  s.curve.x = -a * zeta.cos();
  s.curve.r = b * zeta.sin();
  s.curve.x_zeta = a * zeta.sin();
  s.curve.r_zeta = b * zeta.cos();
  complete(s.curve);
  put_targets(s, a, b, s.basis.nodes);
  return s;
}

Vector normal_density(const Curve &curve) {
  Vector density(2 * curve.size());
  density << curve.normal_x, curve.normal_r;
  return density;
}

Vector uniform_axial(Eigen::Index n) {
  Vector field = Vector::Zero(2 * n);
  field.head(n).setOnes();
  return field;
}

RowMatrix assemble(const RingKernel &kernel, const Targets &targets, const Spheroid &s, bool on_surface) {
  RowMatrix matrix;
  assemble_layer(kernel, targets, s.curve, on_surface ? &s.self : nullptr,
                 NearRule(s.curve.panel_points, 1e-12), matrix);
  return matrix;
}

// Targets at a distance from the surface, along its normal, at the nodes.
Targets shifted(const Spheroid &s, double a, double b, double distance) {
  const Eigen::ArrayXd zeta = s.basis.nodes;
  const Eigen::ArrayXd norm = (a * a * zeta.sin().square() + b * b * zeta.cos().square()).sqrt();
  return {s.nodes.x.array() - distance * b * zeta.cos() / norm,
          s.nodes.r.array() + distance * a * zeta.sin() / norm};
}

} // namespace

BOOST_AUTO_TEST_SUITE(layer_potential)

BOOST_AUTO_TEST_CASE(single_layer_of_the_normal_vanishes_everywhere) {
  for (const double a : {0.8, 0.385}) {
    const double b = a == 0.8 ? 0.8 : 1.3757;
    const Spheroid s = spheroid(a, b, 64);
    const Vector normal = normal_density(s.curve);
    BOOST_TEST((assemble(ring_stokeslet, s.nodes, s, true) * normal).cwiseAbs().maxCoeff() < 1e-10);
    for (const double distance : {-0.05, 1e-3, 1e-5, 0.3, 3.0}) {
      const Targets off = shifted(s, a, b, distance);
      BOOST_TEST((assemble(ring_stokeslet, off, s, false) * normal).cwiseAbs().maxCoeff() < 1e-10);
    }
  }
}

// int J_ij dA = (16 pi a/3) delta_ij on and inside a sphere: its traction when it translates is uniform.
BOOST_AUTO_TEST_CASE(uniform_density_on_a_sphere_translates_it) {
  const double a = 0.7;
  const Spheroid s = spheroid(a, a, 48);
  const Vector velocity = assemble(ring_stokeslet, s.nodes, s, true) * uniform_axial(s.curve.size());
  BOOST_TEST((velocity - 16 * pi * a / 3 * uniform_axial(s.nodes.size())).cwiseAbs().maxCoeff() < 1e-10);
}

// Traction of a translating spheroid, F/(4 pi A B^2)/sqrt(x^2/A^4 + r^2/B^4), F the drag 6 pi B U K: its
// single layer is the uniform velocity 8 pi U on and inside.
BOOST_AUTO_TEST_CASE(drag_of_a_spheroid) {
  const double b = 1.3757;
  const double a = 0.28 * b;
  const double p = a / b;
  const double shape = (8.0 / 3) / (2 * p / (1 - p * p) + 2 * (1 - 2 * p * p) / std::pow(1 - p * p, 1.5) *
                                                              std::atan(std::sqrt(1 - p * p) / p));
  const Spheroid s = spheroid(a, b, 96);
  const Eigen::ArrayXd x = s.curve.x;
  const Eigen::ArrayXd r = s.curve.r;
  Vector traction = Vector::Zero(2 * s.curve.size());
  traction.head(s.curve.size()) = 6 * pi * b * shape / (4 * pi * a * b * b) /
                                  (x.square() / std::pow(a, 4) + r.square() / std::pow(b, 4)).sqrt();
  const Vector velocity = assemble(ring_stokeslet, s.nodes, s, true) * traction / (8 * pi);
  BOOST_TEST((velocity - uniform_axial(s.nodes.size())).cwiseAbs().maxCoeff() < 1e-9);
}

// int K_ijk n_k dA = delta_ij times 1 inside, 1/2 on, 0 outside.
BOOST_AUTO_TEST_CASE(gauss_identity_of_the_stresslet) {
  const double a = 0.385;
  const double b = 1.3757;
  const Spheroid s = spheroid(a, b, 96);
  const Vector uniform = uniform_axial(s.curve.size());
  const Vector expected = uniform_axial(s.nodes.size());
  BOOST_TEST((assemble(ring_stresslet, s.nodes, s, true) * uniform - 0.5 * expected).cwiseAbs().maxCoeff() <
             1e-9);
  for (const double distance : {1e-4, 0.02, 0.5})
    BOOST_TEST(
        (assemble(ring_stresslet, shifted(s, a, b, distance), s, false) * uniform).cwiseAbs().maxCoeff() <
        1e-9);
  for (const double depth : {1e-4, 0.02})
    BOOST_TEST((assemble(ring_stresslet, shifted(s, a, b, -depth), s, false) * uniform - expected)
                   .cwiseAbs()
                   .maxCoeff() < 1e-9);
}

// The same on the surface of a slender spheroid, with targets on or almost on points of the rule.
BOOST_AUTO_TEST_CASE(targets_beside_a_point_of_the_rule) {
  const double a = 1.5;
  const double b = 0.8;
  Spheroid s = spheroid(a, b, 96);
  for (const double gap : {0.0, 1e-15, 1e-12, 1e-9, 4e-8, 1e-6, 1e-5, 1e-4, 1e-3}) {
    constexpr Eigen::Index polar = 3; // panels without nodes, and their neighbours
    Vector zeta(s.panels.count() - 2 * polar);
    for (Eigen::Index k = 0; k < zeta.size(); ++k)
      zeta[k] = s.panels.points[12 * (polar + k) + k % 12] + gap;
    put_targets(s, a, b, zeta);
    const Vector moved = assemble(ring_stresslet, s.nodes, s, true) * uniform_axial(s.curve.size());
    BOOST_TEST((moved - 0.5 * uniform_axial(zeta.size())).cwiseAbs().maxCoeff() < 1e-11);
    BOOST_TEST((assemble(ring_stokeslet, s.nodes, s, true) * normal_density(s.curve)).cwiseAbs().maxCoeff() <
               1e-10);
  }
}

// The panels cut beforehand do the same, from a film of 1/3 to one of 1/2000 of a panel.
BOOST_AUTO_TEST_CASE(fixed_near_rule_keeps_the_single_layer_of_the_normal_at_zero) {
  const double a = 0.385;
  const double b = 1.3757;
  const Spheroid s = spheroid(a, b, 64);
  const Eigen::Index p = s.curve.panel_points;
  const Eigen::Index q = s.curve.size();
  const FixedNearRule fixed(s.curve, 1e-12);
  const NearRule never(p, 1.0);
  const double panel = s.curve.weights.segment(q / 2, p).dot(s.curve.arc.segment(q / 2, p));
  for (const double share : {1.0 / 3, 1.0 / 20, 1.0 / 200, 1.0 / 2000}) {
    const Targets off = shifted(s, a, b, share * panel);
    RowMatrix matrix;
    assemble_layer(ring_stokeslet, off, s.curve, nullptr, never, matrix);
    for (Eigen::Index i = 0; i < off.size(); ++i)
      fixed.at_near_panels(ring_stokeslet, off.x[i], off.r[i],
                           [&](Eigen::Index first, const KernelBlock &block) {
                             matrix.row(i).segment(first, p) = block.row(0);
                             matrix.row(i).segment(q + first, p) = block.row(1);
                             matrix.row(off.size() + i).segment(first, p) = block.row(2);
                             matrix.row(off.size() + i).segment(q + first, p) = block.row(3);
                           });
    BOOST_TEST((matrix * normal_density(s.curve)).cwiseAbs().maxCoeff() < 1e-10);
  }
}

// The near rule keeps its accuracy down to a film of 1/1000 of a panel, for the same density from near and
// self.
BOOST_AUTO_TEST_CASE(near_rule_meets_the_surface) {
  const double a = 0.8;
  const Spheroid s = spheroid(a, a, 48);
  Vector density(2 * s.curve.size());
  density << s.curve.x.array().cube(), (s.curve.x.array().square() * s.curve.r.array());
  const Vector on = assemble(ring_stokeslet, s.nodes, s, true) * density;
  const Vector off = assemble(ring_stokeslet, shifted(s, a, a, 1e-10), s, false) * density;
  BOOST_TEST((on - off).cwiseAbs().maxCoeff() < 1e-8);
}

// int e.n/(4 pi |e|^3) dA = 1 inside, 1/2 on, 0 outside.
BOOST_AUTO_TEST_CASE(gauss_identity_of_the_dipole) {
  const double a = 0.385, b = 1.3757;
  const Spheroid s = spheroid(a, b, 96);
  const Vector one = Vector::Ones(s.curve.size());
  const auto furthest_from = [&](double expected, const Targets &targets, bool on_surface) {
    return ((assemble(ring_dipole, targets, s, on_surface) * one).array() - expected).abs().maxCoeff();
  };
  BOOST_TEST(furthest_from(0.5, s.nodes, true) < 1e-9);
  for (const double distance : {1e-4, 0.02, 0.5})
    BOOST_TEST(furthest_from(0, shifted(s, a, b, distance), false) < 1e-9);
  for (const double depth : {1e-4, 0.02})
    BOOST_TEST(furthest_from(1, shifted(s, a, b, -depth), false) < 1e-9);
}

// A sphere with an even charge has the potential a on and inside.
BOOST_AUTO_TEST_CASE(charged_sphere) {
  const double a = 0.7;
  const Spheroid s = spheroid(a, a, 48);
  const Vector one = Vector::Ones(s.curve.size());
  for (const double depth : {0.0, 0.02, 0.3}) {
    const bool on_surface = depth == 0;
    const Targets targets = on_surface ? s.nodes : shifted(s, a, a, -depth);
    BOOST_TEST(((assemble(ring_source, targets, s, on_surface) * one).array() - a).abs().maxCoeff() < 1e-10);
  }
}

BOOST_AUTO_TEST_SUITE_END()
