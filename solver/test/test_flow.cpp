// The flow around given shapes against exact solutions: the empty pore, drops and spheres.
#include "base/failure.hpp"
#include "case/case.hpp"
#include "motion/dynamics.hpp"
#include "observe/gauge.hpp"
#include "rigid_sphere.hpp"
#include "scene/make_flow.hpp"
#include "scene/resolution.hpp"
#include "spheroid.hpp"
#include <array>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <numbers>

using namespace capsule;

namespace {

constexpr double pi = std::numbers::pi;

Case unbounded_case() {
  Case physics;
  physics.capsule.radius = 1;
  physics.capsule.start_x = 0;
  physics.pore.shape = PoreShape::none;
  physics.flow.type = FlowType::extension;
  physics.flow.capillary_number = 1;
  return physics;
}

// Spheres in one pore, whose wall is inverted once.
class RigidSpheres {
public:
  explicit RigidSpheres(const PoreSpec &pore)
      : flow_(Wall(make_pore(pore).value(), {}), make_membrane_mesh(basis_, {}), {}, 1e-10) {}
  RigidSphere at(double x, double a) const { return rigid_sphere(flow_, basis_, x, a); }

private:
  MeridianBasis basis_ = spectral_basis(48);
  Flow flow_;
};

// The wall of a pore, with a drop of this viscosity ratio in it.
Flow drop_in(const Wall &wall, const MeridianBasis &basis, double viscosity_ratio,
             const FlowResolution &resolution = {}) {
  return {wall,
          make_membrane_mesh(basis, resolution),
          {.viscosity_ratios = {viscosity_ratio}},
          resolution.solver_tolerance};
}

} // namespace

BOOST_AUTO_TEST_SUITE(flow)

// Hadamard and Rybczynski: the load q = x n moves a spherical drop with U = (2/3) a^2 (1 + lambda)/(2 + 3
// lambda) and the slip U sin(theta)/(2 (1 + lambda)).
BOOST_AUTO_TEST_CASE(viscous_drop_translates) {
  const double a = 0.8;
  const MeridianBasis basis = spectral_basis(32);
  const Eigen::Index n = basis.size();
  for (const double lambda : {0.1, 1.0, 5.0, 100.0}) {
    Case physics = unbounded_case();
    physics.flow.viscosity_ratio = lambda;
    const Flow flow = make_flow(make_pore(physics.pore), physics.flow, basis, {});
    const Vector position = sphere(basis, 0, a);
    const Eigen::ArrayXd x = position.head(n);
    const Eigen::ArrayXd r = position.tail(n);
    Vector load(2 * n);
    load << x * x / a, x * r / a;
    const Interaction interaction = flow.interact(position);
    Recycled recycled;
    const Vector velocity = flow.solve(interaction, load, recycled).velocity -
                            flow.solve(interaction, Vector::Zero(2 * n), recycled).velocity;
    const double speed = 2.0 / 3 * a * a * (1 + lambda) / (2 + 3 * lambda);
    const Eigen::ArrayXd normal = velocity.head(n).array() * x / a + velocity.tail(n).array() * r / a;
    BOOST_TEST((normal - speed * x / a).abs().maxCoeff() < 1e-9);
    const Eigen::ArrayXd tangential = velocity.head(n).array() * r / a - velocity.tail(n).array() * x / a;
    // The surface lags behind the drop by its slip.
    BOOST_TEST((tangential - (speed - speed / (2 * (1 + lambda))) * r / a).abs().maxCoeff() < 1e-9);
  }
}

// A force-free rigid sphere on the axis: two independent programs agree on these digits (classical problem of
// Haberman and Sayre).
BOOST_AUTO_TEST_CASE(rigid_sphere_in_a_tube) {
  const RigidSpheres spheres({.shape = PoreShape::tube, .entrance_distance = 2});
  struct Row {
    double a, v_g, pressure_drop;
  };
  for (const Row row : {Row{0.1, 1.98666993, 1.600029e-4}, Row{0.3, 1.88091761, 0.03903349},
                        Row{0.5, 1.67984674, 0.5218392}, Row{0.7, 1.41627863, 3.285772}}) {
    const RigidSphere found = spheres.at(7, row.a);
    BOOST_TEST(std::abs(found.v_g - row.v_g) < 1e-7);
    BOOST_TEST(std::abs(found.pressure_drop - row.pressure_drop) < 1e-6 * (1 + row.pressure_drop));
    BOOST_TEST(std::abs(found.reciprocal - row.pressure_drop) < 1e-6 * (1 + row.pressure_drop));
  }
}

// Between two mouths: the mirror image in the middle of the pore, and there the tube's values.
BOOST_AUTO_TEST_CASE(rigid_sphere_between_two_mouths) {
  constexpr double a = 0.7;
  const RigidSpheres spheres({.shape = PoreShape::two_mouths, .exit_x = 8});
  const RigidSphere middle = spheres.at(4, a);
  BOOST_TEST(std::abs(middle.v_g - 1.41627863) < 1e-6);
  BOOST_TEST(std::abs(middle.pressure_drop - 3.285772) < 1e-5);
  for (const double x : {-3.0, -0.5, 0.1, 1.0}) {
    const RigidSphere before = spheres.at(x, a), behind = spheres.at(8 - x, a);
    BOOST_TEST(std::abs(before.v_g - behind.v_g) < 1e-7);
    BOOST_TEST(std::abs(before.pressure_drop - behind.pressure_drop) < 2e-7);
    BOOST_TEST(std::abs(behind.reciprocal - behind.pressure_drop) < 2e-6);
  }
}

// What a second mouth does to a sphere in a long pore is a sum of Stokes flows that decay along a tube. The slowest one goes
// as Re C exp(-b d), b = 4.466299 + 1.467470 i: of three values at even distances, the third follows from the others, to
// 1.3e-3. Farther on the speed has no digits left: it is good to 2e-9. The reservoirs reach so far that their ends do not
// count.
BOOST_AUTO_TEST_CASE(a_second_mouth_is_felt_less_and_less) {
  constexpr double exit = 8, a = 0.5, step = 0.3;
  const RigidSpheres two_mouths({.shape = PoreShape::two_mouths, .exit_x = exit, .entrance_distance = 300}),
      one_mouth({.exit_x = 2 * exit, .entrance_distance = 300});
  std::array<RigidSphere, 3> with{}, without{};
  for (std::size_t k = 0; k < 3; ++k) {
    const double distance = 2 + static_cast<double>(k) * step;
    with.at(k) = two_mouths.at(exit - distance, a);
    without.at(k) = one_mouth.at(exit - distance, a);
  }
  constexpr double decay = 4.466299, turn = 1.467470;
  const double sum = 2 * std::exp(-decay * step) * std::cos(turn * step),
               product = std::exp(-2 * decay * step);
  for (const auto value : {&RigidSphere::v_g, &RigidSphere::pressure_drop}) {
    const auto felt = [&](std::size_t k) { return with.at(k).*value - without.at(k).*value; };
    BOOST_TEST(std::abs(felt(0)) < 4 * std::exp(-decay * (2 - a))); // from its front on
    BOOST_TEST(std::abs(felt(2) / (sum * felt(1) - product * felt(0)) - 1) < 2e-3);
  }
}

// On few nodes: a drop of an endlessly viscous liquid is the rigid sphere above (radius 0.8 from the same programs), and
// one of a very thin liquid keeps its volume. Rounding errors grow with the ratio: the limit is extrapolated.
BOOST_AUTO_TEST_CASE(extreme_viscosity_ratios) {
  const MeridianBasis basis = spectral_basis(32);
  const Eigen::Index n = basis.size();
  const Vector position = sphere(basis, 7, 0.8);
  const Wall wall(make_pore({.shape = PoreShape::tube, .entrance_distance = 2}).value(), {});
  const auto drop = [&](double lambda) {
    const Flow flow = drop_in(wall, basis, lambda);
    const Interaction interaction = flow.interact(position);
    Recycled recycled;
    FlowState state = flow.solve(interaction, Vector::Zero(2 * n), recycled);
    const Vector &area = interaction.shape().nodes.area;
    const double flux = area.cwiseProduct(interaction.shape().nodes.normal_x).dot(state.velocity.head(n)) +
                        area.cwiseProduct(interaction.shape().nodes.normal_r).dot(state.velocity.tail(n));
    BOOST_TEST(std::abs(flux) < 1e-12);
    return state;
  };
  drop(1e-6);
  const FlowState viscous = drop(5e5),
                  more_viscous = drop(1e6); // they differ from a rigid sphere by c/lambda
  const Vector rigid = 2 * more_viscous.velocity - viscous.velocity;
  BOOST_TEST((rigid.head(n).array() - 1.2754856).abs().maxCoeff() < 2e-6);
  BOOST_TEST(rigid.tail(n).cwiseAbs().maxCoeff() < 2e-6);
  BOOST_TEST(std::abs(2 * more_viscous.pressure_drop - viscous.pressure_drop - 7.735446) < 2e-5);
}

// The velocity is linear in the load. The wall's inverse has large entries, whose last digits in single precision are
// thousandths of the rough mobility.
BOOST_AUTO_TEST_CASE(mobility_is_the_velocity_of_loads) {
  const MeridianBasis basis = spectral_basis(24);
  const Eigen::Index n = basis.size();
  const Wall wall(make_pore({.shape = PoreShape::two_mouths, .exit_x = 4}).value(), {});
  const Vector position = sphere(basis, 1, 0.7);
  const Vector load = Vector::LinSpaced(2 * n, -1, 2).array().cube();
  for (const double lambda : {1.0, 5.0}) {
    const Flow flow = drop_in(wall, basis, lambda);
    const Interaction interaction = flow.interact(position);
    Recycled recycled;
    const Vector velocity = flow.solve(interaction, load, recycled).velocity -
                            flow.solve(interaction, Vector::Zero(2 * n), recycled).velocity;
    const Matrix mobility = flow.mobility(interaction, recycled);
    BOOST_TEST((mobility * load - velocity).norm() < 1e-8 * velocity.norm());
    BOOST_TEST((flow.rough_mobility(interaction, recycled) - mobility).norm() < 1e-2 * mobility.norm());
  }
}

// With lambda != 1 the two routes to the pressure drop meet through different integrals.
BOOST_AUTO_TEST_CASE(pressure_drop_by_two_routes) {
  const MeridianBasis basis = spectral_basis(40);
  const Eigen::Index n = basis.size();
  for (const PoreSpec &pore : {PoreSpec{.exit_x = 15}, {.shape = PoreShape::two_mouths, .exit_x = 6}}) {
    const Wall wall(make_pore(pore).value(), {});
    for (const double lambda : {0.2, 1.0, 5.0}) {
      const Flow flow = drop_in(wall, basis, lambda);
      for (const double x : {-2.0, -0.3, 5.0, 6.3}) {
        const Vector position = sphere(basis, x, 0.7);
        Vector load(2 * n); // smooth, with the parities and no resultant
        const Eigen::ArrayXd zeta = basis.nodes;
        load << (2 * zeta).cos() + 1.0 / 3, (zeta.sin() * (1 + zeta.cos()));
        const Interaction interaction = flow.interact(position);
        Recycled recycled, traction;
        const FlowState state = flow.solve(interaction, load, recycled);
        BOOST_TEST(std::abs(state.pressure_drop -
                            flow.reciprocal_pressure_drops(interaction, load, state, traction).sum()) <
                   2e-6 * (1 + std::abs(state.pressure_drop)));
      }
    }
  }
}

// In the second mouth a drop of an endlessly viscous liquid goes as a rigid sphere.
BOOST_AUTO_TEST_CASE(viscous_drop_leaves_the_pore) {
  constexpr double a = 0.7;
  const MeridianBasis basis = spectral_basis(48);
  const Wall wall(make_pore({.shape = PoreShape::two_mouths, .exit_x = 6}).value(), {});
  const RigidSphere rigid = rigid_sphere(drop_in(wall, basis, 1), basis, 6.2, a);
  const Flow flow = drop_in(wall, basis, 1e8);
  Recycled recycled;
  const FlowState drop =
      flow.solve(flow.interact(sphere(basis, 6.2, a)), Vector::Zero(2 * basis.size()), recycled);
  BOOST_TEST((drop.velocity.head(basis.size()).array() - rigid.v_g).abs().maxCoeff() < 2e-6);
  BOOST_TEST(drop.velocity.tail(basis.size()).cwiseAbs().maxCoeff() < 2e-6);
  BOOST_TEST(std::abs(drop.pressure_drop - rigid.pressure_drop) < 2e-5);
}

// Some meshes have a node that all but coincides with a quadrature point (64: 1e-3, 224: 3e-4 of the points' distance).
// It sees the layers as well as the nodes of others do (60, 232), on a shape with short waves too: the double layer moves
// a rigid body with half its velocity, and the single layer of the normal is nothing.
BOOST_AUTO_TEST_CASE(nodes_beside_quadrature_points) {
  for (const int nodes : {60, 64, 224, 232}) {
    Case physics = unbounded_case();
    physics.mesh.membrane = nodes;
    physics.accuracy = 1e-6;
    const MeridianBasis basis = spectral_basis(nodes);
    const Flow flow =
        make_flow(make_pore(physics.pore), physics.flow, basis, choose_resolution(physics).flow);
    Vector position = sphere(basis, 10, 0.8);
    position.head(nodes).array() += 0.1 * (2 * basis.nodes.array()).cos();
    position.tail(nodes).array() += 1e-6 * (nodes / 2 * basis.nodes.array()).sin();
    const Interaction interaction = flow.interact(position, Layers::both);
    const Curve &panels = interaction.shape().panels;
    const Eigen::Index q = panels.size();
    Vector uniform = Vector::Zero(2 * q), normal(2 * q);
    uniform.head(q).setOnes();
    normal << panels.normal_x, panels.normal_r;
    Vector moved = interaction.double_from_panels() * uniform;
    moved.head(nodes).array() -= 0.5;
    BOOST_TEST(moved.cwiseAbs().maxCoeff() < 5e-9);
    BOOST_TEST((interaction.single_from_panels() * normal).cwiseAbs().maxCoeff() < 1e-6);
  }
}

// What is reused from shape to shape saves time only: on a path through the mouth, where it stands still and after a
// jump, the flow is the one that is found afresh, to the solver's tolerance.
BOOST_AUTO_TEST_CASE(recycling_changes_nothing) {
  const MeridianBasis basis = spectral_basis(32);
  const Eigen::Index n = basis.size();
  const Wall wall(make_pore({.exit_x = 9}).value(), {});
  for (const double lambda : {0.2, 5.0}) {
    const Flow flow = drop_in(wall, basis, lambda, {.solver_tolerance = 1e-9});
    Recycled carried, carried_traction;
    for (const int k : {0, 1, 2, 3, 4, 5, 5, 5, 5, 5, 5, 60, 60, 1}) {
      Vector position = sphere(basis, -0.5 + 0.12 * k, 0.7);
      position.head(n).array() += 0.02 * (k % 7) * (2 * basis.nodes.array()).cos();
      Vector load(2 * n);
      load << (2 * basis.nodes.array()).cos() + 1.0 / 3 + 0.1 * k,
          basis.nodes.array().sin() * (1 + basis.nodes.array().cos());
      const Interaction interaction = flow.interact(position);
      const FlowState state = flow.solve(interaction, load, carried);
      const double reciprocal =
          flow.reciprocal_pressure_drops(interaction, load, state, carried_traction).sum();
      Recycled none, no_traction;
      const FlowState afresh = flow.solve(interaction, load, none);
      BOOST_TEST(state.velocity.cwiseAbs().maxCoeff() > 0.1);
      BOOST_TEST((state.velocity - afresh.velocity).cwiseAbs().maxCoeff() < 1e-8);
      BOOST_TEST(std::abs(state.pressure_drop - afresh.pressure_drop) < 1e-7);
      BOOST_TEST(
          std::abs(reciprocal - flow.reciprocal_pressure_drops(interaction, load, state, no_traction).sum()) <
          1e-6);
    }
  }
}

// A kept inverse that is no use costs time only; what has no solution is a failure, whatever it comes from.
BOOST_AUTO_TEST_CASE(what_cannot_be_solved_is_a_failure) {
  const MeridianBasis basis = spectral_basis(24);
  const Eigen::Index n = basis.size();
  const Vector position = sphere(basis, 0, 0.8);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  Vector load(2 * n);
  load << (2 * basis.nodes.array()).cos(), basis.nodes.array().sin();
  for (const double lambda : {1.0, 5.0}) {
    Case physics = unbounded_case();
    physics.flow.viscosity_ratio = lambda;
    const Flow flow = make_flow(make_pore(physics.pore), physics.flow, basis, {});
    const Interaction interaction = flow.interact(position);
    Recycled none;
    const Vector velocity = flow.solve(interaction, load, none).velocity;
    for (const double entry : {0.0, nan}) { // beside the solution, and afresh
      Recycled recycled = none;
      recycled.inverse.setZero(2 * n, 2 * n);
      recycled.inverse(5, 3) = entry;
      recycled.inverse(0, 0) = 1;
      BOOST_TEST((flow.solve(interaction, load, recycled).velocity - velocity).norm() < 1e-8);
      BOOST_TEST((flow.solve(interaction, 2 * load, recycled).velocity - velocity).norm() > 0.1);
    }
    const std::string kind = lambda == 1 ? "not-a-number" : "unresolved";
    const auto expected = [&](const NumericsFailure &failure) { return failure.kind == kind; };
    Vector no_load = load;
    no_load[3] = nan;
    Recycled recycled;
    BOOST_CHECK_EXCEPTION(flow.solve(interaction, no_load, recycled), NumericsFailure, expected);
    BOOST_TEST((flow.solve(interaction, load, recycled).velocity - velocity).cwiseAbs().maxCoeff() < 1e-8);
    Vector broken = position;
    broken[3] = nan;
    Recycled empty;
    BOOST_CHECK_EXCEPTION(flow.solve(flow.interact(broken), load, empty), NumericsFailure, expected);
    if (lambda != 1)
      BOOST_CHECK_EXCEPTION(flow.mobility(flow.interact(broken), empty), NumericsFailure, expected);
  }
}

// The liquid around a capsule sticks to the wall, moves with the membrane, and carries the flux pi through every
// section that misses the capsule.
BOOST_AUTO_TEST_CASE(velocity_around_a_capsule) {
  const MeridianBasis basis = spectral_basis(40);
  const Eigen::Index n = basis.size();
  const Wall wall_of_pore(make_pore({}).value(), {});
  for (const double lambda : {1.0, 5.0}) {
    const Flow flow = drop_in(wall_of_pore, basis, lambda);
    Vector load(2 * n); // as above
    const Eigen::ArrayXd zeta = basis.nodes;
    load << (2 * zeta).cos() + 1.0 / 3, (zeta.sin() * (1 + zeta.cos()));
    const Interaction interaction = flow.interact(sphere(basis, 5, 0.7));
    Recycled recycled;
    const FlowState state = flow.solve(interaction, load, recycled);
    const GaussRule rule = gauss_legendre(24);
    for (const double x : {-0.5, 3.5, 6.2}) {
      const double wall = x < 0 ? std::sqrt(1 + x * x * std::pow(std::tan(78.5 * pi / 180), 2)) : 1;
      const Vector r = wall / 2 * (1 + rule.nodes.array());
      const Vector velocity = flow.outer_velocity({Vector::Constant(24, x), r}, interaction, load, state);
      const double flux =
          2 * pi * wall / 2 * rule.weights.dot((velocity.head(24).array() * r.array()).matrix());
      BOOST_TEST(std::abs(flux - pi) < 1e-5);
    }
    const Eigen::Index k = n / 3;
    const double out = 1 + 1e-6 / 0.7; // a millionth of a radius above the membrane
    const Targets points{Vector{{5 - 0.7 * out * std::cos(basis.nodes[k]), 5.5}},
                         Vector{{0.7 * out * std::sin(basis.nodes[k]), 1 - 1e-6}}};
    const Vector velocity = flow.outer_velocity(points, interaction, load, state);
    BOOST_TEST(std::abs(velocity[0] - state.velocity[k]) < 1e-4);
    BOOST_TEST(std::abs(velocity[2] - state.velocity[n + k]) < 1e-4);
    BOOST_TEST(std::abs(velocity[1]) < 1e-4);
    BOOST_TEST(std::abs(velocity[3]) < 1e-4);
  }
}

BOOST_AUTO_TEST_SUITE_END()
