// Panels of the membranes, and several membranes as parts of one mesh.
#include "flow/membrane_mesh.hpp"
#include "folded.hpp"
#include "spheroid.hpp"
#include <array>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <numbers>
#include <stdexcept>

using namespace capsule;

namespace {

constexpr double pi = std::numbers::pi;

} // namespace

BOOST_AUTO_TEST_SUITE(membrane_mesh)

// On a circle the tangent turns as the parameter: halving pi twice leaves quarters.
BOOST_AUTO_TEST_CASE(panels_turn_little) {
  const MeridianBasis basis = spectral_basis(30);
  Vector circle(60);
  circle << -basis.nodes.array().cos(), basis.nodes.array().sin();
  Vector ends(2);
  ends << 0, pi;
  const Vector quarters = halved_edges(basis, circle, ends, 0.9);
  BOOST_REQUIRE(quarters.size() == 5);
  for (Eigen::Index k = 0; k < 5; ++k)
    BOOST_TEST(std::abs(quarters[k] - static_cast<double>(k) * pi / 4) < 1e-14);
  BOOST_TEST(halved_edges(basis, circle, ends, 4).size() == 2);
}

// Short ones at the fold only, with the edges that were there.
BOOST_AUTO_TEST_CASE(a_fold_gets_short_panels) {
  const MeridianBasis basis = spectral_basis(200);
  const Vector edges = Vector::LinSpaced(9, 0, pi);
  const Vector halved = halved_edges(basis, folded(basis.nodes), edges, 0.5);
  const Vector lengths = halved.tail(halved.size() - 1) - halved.head(halved.size() - 1);
  Eigen::Index shortest = 0;
  BOOST_TEST(lengths.minCoeff(&shortest) < 0.05);
  BOOST_TEST(std::abs(halved[shortest] - 0.8) < 0.2);
  for (const double edge : edges)
    BOOST_TEST((halved.array() - edge).abs().minCoeff() < 1e-14);
}

// A tip where the tangent turns at once ends the halving all the same.
BOOST_AUTO_TEST_CASE(a_cusp_is_cut_off) {
  const MeridianBasis basis = spectral_basis(60);
  const Eigen::ArrayXd c = basis.nodes.array().cos();
  Vector cusp(120);
  cusp << -(c.square() / 2 - std::cos(1) * c),
      basis.nodes.array().sin() * ((c - std::cos(1)).square() + 1e-3);
  Vector ends(2);
  ends << 0, pi;
  const Vector halved = halved_edges(basis, cusp, ends, 0.5);
  BOOST_TEST(halved.size() > 2);
  BOOST_TEST(halved.size() < 100);
}

// What each membrane's own mesh says of it, its part of the joined one says, and nothing else.
BOOST_AUTO_TEST_CASE(joined_membranes_keep_their_values) {
  const std::array bases{spectral_basis(16), spectral_basis(24)};
  const std::array own{make_membrane_mesh(bases[0], {}),
                       make_membrane_mesh(bases[1], {.membrane_panel = 0.4})};
  const MembraneMesh joined = join(own);
  BOOST_TEST(joined.nodes == 40);
  BOOST_TEST(joined.points == own[0].points + own[1].points);
  Vector position(80);
  for (const std::size_t k : {0, 1})
    position(joined.rows(k)) = sphere(bases[k], 0, k == 0 ? 0.5 : 0.8);
  const MembraneShape shape = shape_at(joined, position);
  const Vector at_panels = joined.at_panels(position);
  // Both radii are those of the circles, everywhere.
  for (Eigen::Index q = 0; q < joined.points; ++q) {
    const double radius = q < own[0].points ? 0.5 : 0.8;
    BOOST_TEST(std::abs(std::hypot(at_panels[q], at_panels[joined.points + q]) - radius) < 1e-12);
    BOOST_TEST(std::abs(std::hypot(shape.panels.x[q], shape.panels.r[q]) - radius) < 1e-12);
    BOOST_TEST(std::abs(shape.panels.arc[q] - radius) < 1e-11);
  }
  // Areas 4 pi a^2 on both rules.
  for (const Curve *curve : {&shape.nodes, &shape.panels})
    BOOST_TEST(std::abs(2 * curve->area.sum() - 4 * (0.25 + 0.64)) < 1e-11);
  // As a matrix on panel vectors the mean of x^2 over the areas, as one on nodal vectors the same of the nodes' x.
  for (const std::size_t k : {0, 1}) {
    const Curve panels = panels_of(joined, shape, k);
    RowMatrix moment(1, 2 * panels.size());
    moment << panels.area.cwiseProduct(panels.x).transpose(), RowMatrix::Zero(1, panels.size());
    const double mean = (joined.parts[k].on_nodes(moment) * position(joined.rows(k)))[0];
    BOOST_TEST(std::abs(2 * mean - 4.0 / 3 * std::pow(k == 0 ? 0.5 : 0.8, 4)) < 1e-11);
  }
}

BOOST_AUTO_TEST_CASE(membranes_of_one_flow_have_panels_of_one_kind) {
  const MeridianBasis basis = spectral_basis(16);
  const std::array meshes{make_membrane_mesh(basis, {}),
                          make_membrane_mesh(basis, {.membrane_panel_points = 8})};
  BOOST_CHECK_THROW(join(meshes), std::invalid_argument);
}

BOOST_AUTO_TEST_SUITE_END()
