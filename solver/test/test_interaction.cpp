// Several membranes in one tube, and images of one: rigid spheres known from elsewhere, reciprocity, explicit copies;
// and the flow rate that a constant pressure drives.
#include "flow/flow.hpp"
#include <array>
#include <boost/test/unit_test.hpp>
#include <numbers>
#include <stdexcept>

using namespace capsule;

namespace {

constexpr double wall_beyond = 4.7; // the disturbance has fallen to 1e-9 there

// A tube that reaches as far beyond x = -reach and reach.
Wall tube(double reach) {
  PoreSpec pore;
  pore.shape = PoreShape::tube;
  pore.exit_x = pore.entrance_distance = reach + wall_beyond;
  return {*make_pore(pore), {}};
}

struct Spheroid {
  double centre, a, b; // semi-axes along and across the tube
  int nodes = 48;
};

MembraneMesh mesh_of(const std::vector<Spheroid> &bodies,
                     double near_tolerance = FlowResolution{}.near_tolerance) {
  std::vector<MembraneMesh> meshes;
  for (const Spheroid &body : bodies) {
    FlowResolution resolution;
    resolution.near_tolerance = near_tolerance;
    resolution.membrane_panel = 0.65 * std::numbers::pi * resolution.membrane_panel_points / body.nodes;
    meshes.push_back(make_membrane_mesh(spectral_basis(body.nodes), resolution));
  }
  return join(meshes);
}

Vector position_of(const std::vector<Spheroid> &bodies, const MembraneMesh &mesh) {
  Vector position(2 * mesh.nodes);
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    const auto zeta = mesh.parts[k].basis.nodes.array();
    Vector own(2 * zeta.size());
    own << bodies[k].centre - bodies[k].a * zeta.cos(), bodies[k].b * zeta.sin();
    position(mesh.rows(k)) = own;
  }
  return position;
}

// Smooth, with the parities and no axial resultant; of any membrane, so that k tells them apart.
Vector smooth_load(const MembraneMesh &mesh) {
  Vector load(2 * mesh.nodes);
  for (std::size_t k = 0; k < mesh.parts.size(); ++k) {
    const auto zeta = mesh.parts[k].basis.nodes.array();
    const double strength = 1 + 0.5 * static_cast<double>(k);
    Vector own(2 * zeta.size());
    own << strength * ((2 * zeta).cos() + 1.0 / 3), zeta.sin() * (strength + zeta.cos());
    load(mesh.rows(k)) = own;
  }
  return load;
}

// Rigid bodies without forces: M f - U e_x = -v_e and no resultant on each; f.n is free up to a pressure.
struct FreeBodies {
  std::vector<double> speeds;
  FlowState state;
  double reciprocal;
};
FreeBodies free_bodies(const Flow &flow, const Vector &position) {
  const MembraneMesh &mesh = flow.mesh();
  const Interaction interaction = flow.interact(position);
  const Curve &nodes = interaction.shape().nodes;
  const Eigen::Index n2 = 2 * mesh.nodes, bodies = std::ssize(mesh.parts);
  Recycled recycled, traction;
  Matrix matrix = Matrix::Zero(n2 + bodies, n2 + bodies);
  matrix.topLeftCorner(n2, n2) = flow.mobility(interaction, recycled);
  Vector right = Vector::Zero(n2 + bodies);
  right.head(n2) = -interaction.base_velocity();
  for (Eigen::Index k = 0; k < bodies; ++k) {
    const auto &part = mesh.parts[static_cast<std::size_t>(k)];
    Vector axial = Vector::Zero(n2), normal = Vector::Zero(n2);
    axial.segment(part.first_node, part.nodes()).setOnes();
    normal.segment(part.first_node, part.nodes()) = nodes.normal_x.segment(part.first_node, part.nodes());
    normal.segment(mesh.nodes + part.first_node, part.nodes()) =
        nodes.normal_r.segment(part.first_node, part.nodes());
    const Vector area = nodes.area.replicate(2, 1);
    matrix.topLeftCorner(n2, n2) += normal * normal.cwiseProduct(area).transpose();
    matrix.col(n2 + k).head(n2) = -axial;
    matrix.row(n2 + k).head(n2) = axial.cwiseProduct(area);
  }
  const Vector solution = matrix.partialPivLu().solve(right);
  const Vector f = solution.head(n2);
  FreeBodies result{{solution.begin() + n2, solution.end()}, flow.solve(interaction, f, recycled), 0};
  result.reciprocal = flow.reciprocal_pressure_drops(interaction, f, result.state, traction).sum();
  return result;
}

double largest(const Matrix &matrix) {
  return matrix.cwiseAbs().maxCoeff();
}

} // namespace

BOOST_AUTO_TEST_SUITE(interaction)

// Speeds and pressure drops that other programs give to all digits. By reversibility both speeds of a pair are equal.
BOOST_AUTO_TEST_CASE(rigid_pair_in_a_tube) {
  const std::vector<Spheroid> pair{{0.9, 0.8, 0.8, 64}, {-0.9, 0.8, 0.8, 64}}; // the gap is 0.2
  const MembraneMesh mesh = mesh_of(pair);
  const FreeBodies found = free_bodies(Flow(tube(1.7), mesh, {}, 1e-10), position_of(pair, mesh));
  BOOST_TEST(std::abs(found.speeds[0] - 1.2735299) < 2e-7);
  BOOST_TEST(std::abs(found.speeds[1] - found.speeds[0]) < 1e-7);
  BOOST_TEST(std::abs(found.state.pressure_drop - 14.656457) < 2e-5);
  BOOST_TEST(std::abs(found.reciprocal - 14.656457) < 2e-5);
}

// Of three in a row the outer ones, alike, are faster than the middle one, all between one alone and one of a train.
BOOST_AUTO_TEST_CASE(three_rigid_spheres_in_a_row) {
  const std::vector<Spheroid> row{{1.8, 0.8, 0.8}, {0, 0.8, 0.8}, {-1.8, 0.8, 0.8}};
  const MembraneMesh mesh = mesh_of(row);
  const FreeBodies found = free_bodies(Flow(tube(2.6), mesh, {}, 1e-10), position_of(row, mesh));
  BOOST_TEST(std::abs(found.speeds[0] - found.speeds[2]) < 1e-6);
  BOOST_TEST(found.speeds[0] > found.speeds[1] + 1e-4);
  BOOST_TEST(found.speeds[0] < 1.2754856);
  BOOST_TEST(found.speeds[1] > 1.2715607 - 1e-4);
}

// An infinite train, per sphere.
BOOST_AUTO_TEST_CASE(rigid_train_in_a_tube) {
  struct Row {
    double a, gap, speed, pressure_drop;
  };
  for (const Row row : {Row{0.5, 0.25, 1.6626103, 0.450172}, Row{0.8, 0.4, 1.2733693, 7.266524}}) {
    const double period = 2 * row.a + row.gap;
    std::vector<Image> images;
    for (int k = 1; k * period < 6; ++k) // further off they are not felt
      images.insert(images.end(), {{-k * period}, {k * period}});
    const std::vector<Spheroid> one{{0, row.a, row.a, 64}};
    const MembraneMesh mesh = mesh_of(one);
    const Flow flow(tube(6 + row.a), mesh, {.images = images}, 1e-10);
    const FreeBodies found = free_bodies(flow, position_of(one, mesh));
    BOOST_TEST(std::abs(found.speeds[0] - row.speed) < 1e-6);
    BOOST_TEST(std::abs(found.reciprocal - row.pressure_drop) < 3e-6 * (1 + row.pressure_drop));
  }
}

// Smooth forces on one body do as much work with the velocities that forces on the other make as the other way round, to
// the tolerance of the kernels' integrals. So it is under constant pressure, too.
BOOST_AUTO_TEST_CASE(blocks_are_reciprocal) {
  const std::vector<Spheroid> pair{{0.8, 0.5, 0.8, 40}, {-0.7, 0.6, 0.5, 48}};
  const MembraneMesh mesh = mesh_of(pair);
  const auto first = mesh.rows(0), second = mesh.rows(1);
  const Vector f = smooth_load(mesh);
  for (const Drive drive : {Drive{}, Drive{20}}) {
    const Flow flow(tube(1.3), mesh, {.drive = drive}, 1e-10);
    const Interaction interaction = flow.interact(position_of(pair, mesh));
    Recycled recycled;
    const Matrix mobility = flow.mobility(interaction, recycled);
    const Matrix weighted = interaction.shape().nodes.area.replicate(2, 1).asDiagonal() * mobility;
    const double there = f(first).dot(weighted(first, second) * f(second));
    const double back = f(second).dot(weighted(second, first) * f(first));
    BOOST_TEST(std::abs(there) > 1e-5);
    BOOST_TEST(std::abs(there - back) < FlowResolution{}.near_tolerance * std::abs(there));
  }
}

// The first of three equal membranes, with two images in the others' places, feels the same as among them, whatever their
// amplitudes. Images act from their panels, other membranes from their nodes where those are fine enough: the layers are
// equal to the tolerance of the integrals.
BOOST_AUTO_TEST_CASE(images_are_explicit_copies) {
  const double period = 1.3; // membranes so wide and close that near rules are at work everywhere
  const std::vector<Spheroid> one{{0.2, 0.6, 0.93, 40}};
  std::vector<Spheroid> three = one;
  for (const double shift : {-period, period}) {
    three.push_back(one[0]);
    three.back().centre += shift;
  }
  const MembraneMesh single = mesh_of(one), triple = mesh_of(three);
  const auto wall = std::make_shared<const Wall>(tube(2.5));
  const std::array images{Image{-period, -1}, Image{period, 0.7}};
  const Interaction with_images(wall, single, position_of(one, single), Layers::both, images);
  const Interaction explicitly(wall, triple, position_of(three, triple), Layers::both);
  const Vector density = smooth_load(single);
  Vector copies(2 * triple.nodes);
  for (std::size_t k = 0; k < 3; ++k)
    copies(triple.rows(k)) = (k == 0 ? 1 : images[k - 1].amplitude) * density;
  const auto rows = triple.rows(0);
  const auto equal = [&](const Vector &a, const Vector &b, double tolerance) {
    BOOST_TEST(a.norm() > 0.1);
    BOOST_TEST((a - b).cwiseAbs().maxCoeff() < tolerance * a.cwiseAbs().maxCoeff());
  };
  equal(with_images.single_at_wall(density), explicitly.single_at_wall(copies), 1e-12);
  equal(with_images.double_at_wall(density), explicitly.double_at_wall(copies), 1e-12);
  equal(with_images.single_at_wall() * density, explicitly.single_at_wall() * copies, 1e-12);
  equal(with_images.double_at_wall() * density, explicitly.double_at_wall() * copies, 1e-12);
  const Vector at_wall = explicitly.single_at_wall(copies);
  equal(with_images.answer_of_wall(at_wall), explicitly.answer_of_wall(at_wall)(rows), 1e-12);
  const Targets points{Vector{{-0.45, 0.1, 2.9}}, Vector{{0.3, 0.97, 0.5}}};
  equal(with_images.velocity_at(points, density, density), explicitly.velocity_at(points, copies, copies),
        1e-11);
  for (const double tolerance : {1e-8, 1e-11}) {
    const MembraneMesh of_one = mesh_of(one, tolerance), of_three = mesh_of(three, tolerance);
    const Interaction from_panels(wall, of_one, position_of(one, of_one), Layers::both, images);
    const Interaction from_nodes(wall, of_three, position_of(three, of_three), Layers::both);
    equal(from_panels.single_layer(density), from_nodes.single_layer(copies)(rows), 3 * tolerance);
    equal(from_panels.double_layer(density), from_nodes.double_layer(copies)(rows), 3 * tolerance);
    equal(from_panels.single_layer() * density, (from_nodes.single_layer() * copies)(rows), 3 * tolerance);
    equal(from_panels.double_layer() * density, (from_nodes.double_layer() * copies)(rows), 3 * tolerance);
  }
}

// Membranes of different viscosity ratios: both routes to the pressure drop agree when they are close; far apart each
// moves as if it were alone.
BOOST_AUTO_TEST_CASE(each_membrane_has_its_viscosity_ratio) {
  const FlowParameters parameters{.viscosity_ratios = {0.2, 5}};
  for (const double distance : {0.75, 5.0}) {
    const std::vector<Spheroid> pair{{distance, 0.6, 0.8, 40}, {-distance, 0.5, 0.6, 40}};
    const MembraneMesh mesh = mesh_of(pair);
    const Vector position = position_of(pair, mesh), f = smooth_load(mesh);
    const Flow flow(tube(distance + 0.6), mesh, parameters, 1e-10);
    const Interaction interaction = flow.interact(position);
    Recycled recycled, traction;
    const FlowState state = flow.solve(interaction, f, recycled);
    BOOST_TEST(std::abs(state.pressure_drop) > 0.1);
    BOOST_TEST(std::abs(flow.reciprocal_pressure_drops(interaction, f, state, traction).sum() -
                        state.pressure_drop) < 2e-6 * (1 + std::abs(state.pressure_drop)));
    double sum = 0;
    for (const std::size_t k : {0, 1}) {
      const MembraneMesh own = mesh_of({pair[k]});
      const auto rows = mesh.rows(k);
      const Flow alone(tube(distance + 0.6), own, {.viscosity_ratios = {parameters.viscosity_ratios[k]}},
                       1e-10);
      Recycled none;
      const FlowState isolated = alone.solve(alone.interact(position(rows)), f(rows), none);
      const double difference = largest(state.velocity(rows) - isolated.velocity);
      if (distance == 5)
        BOOST_TEST(difference < 1e-8);
      else
        BOOST_TEST(difference > 1e-3);
      sum += isolated.pressure_drop;
    }
    if (distance == 5)
      BOOST_TEST(std::abs(sum - state.pressure_drop) < 1e-8);
  }
}

// Under constant pressure the flow rate follows from two flows of given rate, as everything is linear in rate and load:
//   v = q v_1 + v_f,  q = (R - p_f)/(R + p_1),  with v_1, p_1 those of unit rate without load.
BOOST_AUTO_TEST_CASE(constant_pressure_is_a_closure) {
  const std::vector<Spheroid> pair{{0.75, 0.6, 0.8, 40}, {-0.75, 0.5, 0.6, 40}};
  const MembraneMesh mesh = mesh_of(pair);
  const Vector position = position_of(pair, mesh), f = smooth_load(mesh), none = Vector::Zero(2 * mesh.nodes);
  const double resistance = 20;
  for (const std::vector<double> &ratios : {std::vector<double>{}, std::vector<double>{0.2, 5}}) {
    const Flow given(tube(1.4), mesh, {.viscosity_ratios = ratios}, 1e-11);
    const Flow driven(tube(1.4), mesh, {.viscosity_ratios = ratios, .drive = {resistance}}, 1e-11);
    const auto solved = [&](const Flow &flow, const Vector &load) {
      Recycled recycled;
      return flow.solve(flow.interact(position), load, recycled);
    };
    const FlowState unloaded = solved(given, none), loaded = solved(given, f), state = solved(driven, f);
    const double p_1 = unloaded.pressure_drop, p_f = loaded.pressure_drop - p_1;
    const double q = (resistance - p_f) / (resistance + p_1);
    BOOST_TEST(std::abs(q - 1) > 1e-3);
    BOOST_TEST(std::abs(state.flow_rate - q) < 1e-9);
    BOOST_TEST(std::abs(state.pressure_drop - (q * p_1 + p_f)) < 1e-8);
    BOOST_TEST(largest(state.velocity - q * unloaded.velocity - (loaded.velocity - unloaded.velocity)) <
               1e-8);
    BOOST_TEST(loaded.flow_rate == 1);
    // Its mobility is the derivative: exact, as v is linear in the load.
    Recycled recycled;
    const Interaction interaction = driven.interact(position);
    const Matrix mobility = driven.mobility(interaction, recycled);
    BOOST_TEST(largest(mobility * f - state.velocity + solved(driven, none).velocity) < 1e-8);
    const Matrix rough = driven.rough_mobility(interaction, recycled);
    BOOST_TEST((rough - mobility).cwiseAbs().maxCoeff() < 1e-5 * mobility.cwiseAbs().maxCoeff());
  }
}

// A rigid sphere resists: q = R/(R + Delta P), Delta P its drop at unit flow rate.
BOOST_AUTO_TEST_CASE(rigid_sphere_under_constant_pressure) {
  const std::vector<Spheroid> one{{0, 0.8, 0.8, 64}};
  const MembraneMesh mesh = mesh_of(one);
  const Vector position = position_of(one, mesh);
  const double resistance = 57.849; // of the paper's pore with L_P = 6.6155
  const FreeBodies given = free_bodies(Flow(tube(0.8), mesh, {}, 1e-10), position);
  const FreeBodies driven = free_bodies(Flow(tube(0.8), mesh, {.drive = {resistance}}, 1e-10), position);
  const double q = resistance / (resistance + given.state.pressure_drop);
  BOOST_TEST(std::abs(given.speeds[0] - 1.2754856) < 2e-7);
  BOOST_TEST(std::abs(given.state.pressure_drop - 7.735446) < 1e-5);
  BOOST_TEST(std::abs(driven.state.flow_rate - q) < 1e-9);
  BOOST_TEST(std::abs(q - 0.88206) < 1e-5);
  BOOST_TEST(std::abs(driven.speeds[0] - q * given.speeds[0]) < 1e-8);
  BOOST_TEST(std::abs(driven.reciprocal - q * given.reciprocal) < 1e-6);
}

BOOST_AUTO_TEST_CASE(as_many_viscosity_ratios_as_membranes) {
  const MembraneMesh mesh = make_membrane_mesh(spectral_basis(16), {});
  BOOST_CHECK_THROW(Flow(Wall(), mesh, {.viscosity_ratios = {1, 5}}, 1e-10), std::invalid_argument);
}

BOOST_AUTO_TEST_SUITE_END()
