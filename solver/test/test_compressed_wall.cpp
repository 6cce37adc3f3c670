// Flows with the compressed wall against flows with the whole wall.
#include "flow/compressed_wall.hpp"
#include "flow/flow.hpp"
#include "spheroid.hpp"
#include <boost/test/unit_test.hpp>

using namespace capsule;

namespace {

Wall wall_of(PoreShape shape, double opening_angle, const FlowResolution &resolution) {
  PoreSpec pore;
  pore.shape = shape;
  pore.opening_angle_deg = opening_angle;
  pore.exit_x = 8;
  return {*make_pore(pore), resolution};
}

FlowResolution to(double tolerance) {
  return {.wall_panel_points = 10, .lip_panel = 0.08, .near_tolerance = tolerance};
}

// Between the flows that a smooth load makes of spheres of radius 0.8 with both walls, relative to the flow's largest
// velocity and to its pressure drop.
struct Comparison {
  double velocity, pressure_drop;
  Eigen::Index whole, compressed; // points of the wall
};
Comparison compare(const Wall &wall, const FlowResolution &resolution, const std::vector<double> &centres,
                   double viscosity_ratio) {
  const MeridianBasis basis = spectral_basis(40);
  const std::vector<MembraneMesh> meshes(centres.size(), make_membrane_mesh(basis, resolution));
  const MembraneMesh mesh = join(meshes);
  const Flow flow(wall, mesh, {.viscosity_ratios = std::vector<double>(centres.size(), viscosity_ratio)},
                  1e-12);
  Vector position(2 * mesh.nodes), load(2 * mesh.nodes);
  for (std::size_t k = 0; k < centres.size(); ++k) {
    const std::vector<Eigen::Index> rows = mesh.rows(k);
    const Vector at_origin = sphere(basis, 0, 0.8);
    position(rows) = sphere(basis, centres[k], 0.8);
    Vector own(2 * basis.size());
    own << at_origin.head(basis.size()).array().sin() + 0.3, at_origin.tail(basis.size()).array().square();
    load(rows) = own;
  }
  const Interaction felt = flow.interact(position);
  const Interaction exact(std::make_shared<const Wall>(flow.wall()), mesh, position,
                          viscosity_ratio == 1 ? Layers::single : Layers::both);
  Recycled one, other;
  const FlowState expected = flow.solve(exact, load, one), found = flow.solve(felt, load, other);
  return {(found.velocity - expected.velocity).cwiseAbs().maxCoeff() /
              expected.velocity.cwiseAbs().maxCoeff(),
          std::abs(found.pressure_drop / expected.pressure_drop - 1), exact.wall().curve().size(),
          felt.wall().curve().size()};
}

} // namespace

BOOST_AUTO_TEST_SUITE(compressed_wall)

// Before, in and behind pores of several mouths.
BOOST_AUTO_TEST_CASE(gives_the_flow_with_the_whole_wall) {
  for (const double tolerance : {1e-6, 1e-8})
    for (const auto &[shape, angle] : {std::pair(PoreShape::hyperbolic, 78.5),
                                       {PoreShape::hyperbolic, 30},
                                       {PoreShape::two_mouths, 90},
                                       {PoreShape::tube, 90}}) {
      const Wall wall = wall_of(shape, angle, to(tolerance));
      for (const double x : {-4.0, -1.1, 0.3, 4.2}) {
        BOOST_TEST_CONTEXT("pore " << static_cast<int>(shape) << ", capsule at " << x << ", tolerance "
                                   << tolerance) {
          const Comparison walls = compare(wall, to(tolerance), {x}, 1);
          BOOST_TEST(walls.velocity < tolerance);
          BOOST_TEST(walls.pressure_drop < tolerance);
          BOOST_TEST(walls.compressed < walls.whole);
        }
      }
    }
}

BOOST_AUTO_TEST_CASE(serves_other_liquids_and_several_capsules) {
  const double tolerance = 1e-7;
  const Comparison walls =
      compare(wall_of(PoreShape::two_mouths, 60, to(tolerance)), to(tolerance), {9.5, -1}, 5);
  BOOST_TEST(walls.velocity < tolerance);
  BOOST_TEST(walls.pressure_drop < tolerance);
}

// A capsule that hovers between two places, or changes its size where this joins no other panels.
BOOST_AUTO_TEST_CASE(is_kept_for_two_places) {
  const FlowResolution resolution = to(1e-7);
  const CompressedWall wall(wall_of(PoreShape::two_mouths, 60, resolution));
  const MeridianBasis basis = spectral_basis(40);
  const MembraneMesh mesh = make_membrane_mesh(basis, resolution);
  const auto felt = [&](double x, double radius) { return wall.felt_by(mesh, sphere(basis, x, radius)); };
  const auto first = felt(3.4, 0.8), second = felt(3.6, 0.8);
  BOOST_TEST(first->unknowns() < wall.whole().unknowns());
  BOOST_TEST(first->panels().edges.size() != second->panels().edges.size());
  BOOST_TEST(felt(3.4, 0.8) == first);
  BOOST_TEST(felt(3.6, 0.8) == second);
  BOOST_TEST(felt(-3, 0.8)->unknowns() < second->unknowns()); // a third place
  const auto again = felt(3.4, 0.8);
  BOOST_TEST((again->panels().edges == first->panels().edges));
  BOOST_TEST(felt(3.4, 0.81) == again);
  BOOST_TEST(felt(3.4, 0.8) == again);
}

BOOST_AUTO_TEST_SUITE_END()
