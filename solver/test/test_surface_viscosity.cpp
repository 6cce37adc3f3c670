// Friction in the membrane: its rates of stretch against differences of the stretches, and where the power goes.
#include "base/decompositions.hpp"
#include "flow/flow.hpp"
#include "geometry/quadrature.hpp"
#include "membrane/load.hpp"
#include "membrane/surface_viscosity.hpp"
#include "membranes.hpp"
#include "scene/make_flow.hpp"
#include <boost/test/unit_test.hpp>
#include <numbers>

using namespace capsule;

namespace {

constexpr double pi = std::numbers::pi;

Vector smooth_velocity(const MeridianBasis &basis) {
  const Eigen::ArrayXd zeta = basis.nodes;
  Vector velocity(2 * basis.size());
  velocity << 0.3 + zeta.cos() - 0.4 * (3 * zeta).cos(), 0.7 * zeta.sin() + 0.2 * (2 * zeta).sin();
  return velocity;
}

// 2 e:e of a flow by differences; u is (u_x, u_r) at (x, r).
double dissipation_density(const std::function<Eigen::Vector2d(double, double)> &u, double x, double r) {
  constexpr double h = 1e-3;
  const auto slope = [&](double dx, double dr) -> Eigen::Vector2d {
    const auto at = [&](double k) { return u(x + k * h * dx, r + k * h * dr); };
    return (8 * (at(1) - at(-1)) - (at(2) - at(-2))) / (12 * h);
  };
  const Eigen::Vector2d along = slope(1, 0), across = slope(0, 1);
  const double hoop = u(x, r)[1] / r, shear = along[1] + across[0];
  return 2 * (along[0] * along[0] + across[1] * across[1] + hoop * hoop) + shear * shear;
}

} // namespace

BOOST_AUTO_TEST_SUITE(surface_viscosity)

BOOST_AUTO_TEST_CASE(power_of_the_rates_of_stretch) {
  const Case physics = capsule_case(0.9, 0.7, skalak, 0);
  const Membrane membrane = spectral_membrane(physics, 40);
  const Vector position = random_position(membrane, 3), velocity = smooth_velocity(membrane.basis);
  const Sampling &at = membrane.sampling;
  const auto logarithms = [&](double time) {
    const MembraneState state = membrane_state(membrane, at, position + time * velocity);
    Matrix both(at.zeta.size(), 2);
    both << state.stretch_meridional.array().log(), state.stretch_azimuthal.array().log();
    return both;
  };
  const Matrix rate = derivative<Matrix>(logarithms, 1e-3);
  const Trace curve = trace(at, position);
  const Eigen::ArrayXd area = 2 * pi * at.weights.array() * curve.r.array() * curve.arc.array();
  const double shear = (area * (rate.col(0) - rate.col(1)).array().square()).sum();
  const double dilatation = (area * (rate.col(0) + rate.col(1)).array().square()).sum();
  for (const auto &[viscosity, power] :
       {std::pair{SurfaceViscosity{2, 0}, 2 * shear}, std::pair{SurfaceViscosity{0, 3}, 3 * dilatation}}) {
    const SurfaceFriction friction(at, nodal_area(membrane, position), position, viscosity);
    const Matrix matrix = friction.dissipation();
    BOOST_TEST(velocity.dot(matrix * velocity) == power, boost::test_tools::tolerance(1e-9));
    BOOST_TEST(largest(friction.load(velocity) - friction.matrix() * velocity) <
               1e-12 * largest(friction.load(velocity)));
    BOOST_TEST((matrix - matrix.transpose()).cwiseAbs().maxCoeff() < 1e-12 * matrix.cwiseAbs().maxCoeff());
    Vector shifted = Vector::Zero(80);
    shifted.head(40).setOnes();
    BOOST_TEST(largest(matrix * shifted) < 1e-10 * matrix.cwiseAbs().maxCoeff());
  }
}

BOOST_AUTO_TEST_CASE(friction_of_other_positions) {
  const Case physics = capsule_case(0.9, 0.7, skalak, 0);
  const Membrane membrane = spectral_membrane(physics, 24);
  const Vector position = random_position(membrane, 3), velocity = smooth_velocity(membrane.basis);
  const SurfaceViscosity viscosity{2, 3};
  const Vector area = nodal_area(membrane, position);
  const Matrix jacobian = friction_jacobian(membrane.sampling, area, position, viscosity, velocity);
  for (const Eigen::Index k : {0, 7, 23, 24, 30, 47}) {
    const auto load = [&](double step) -> Vector {
      return SurfaceFriction(membrane.sampling, area, position + step * Vector::Unit(48, k), viscosity)
          .load(velocity);
    };
    const Vector change = derivative<Vector>(load, 1e-4);
    BOOST_TEST(largest(jacobian.col(k) - change) < 1e-7 * largest(change));
  }
}

// What the elastic energy loses, the liquids and the membrane turn into heat: in an unbounded liquid at rest, the liquids'
// part from the gradients of the velocity in all of the space.
BOOST_AUTO_TEST_CASE(energy_becomes_heat) {
  Case physics = capsule_case(1, 1, skalak, 1e-2);
  physics.pore.shape = PoreShape::none;
  const Membrane membrane = spectral_membrane(physics, 32);
  const Eigen::Index n = membrane.basis.size();
  Vector position = membrane.reference;
  position.head(n) *= 1.2;
  position.tail(n) /= std::sqrt(1.2);
  const Eigen::ArrayXd zeta = membrane.basis.nodes;
  position.head(n).array() += 0.05 * (2 * zeta).cos();
  FlowResolution resolution;
  resolution.near_tolerance = 1e-9;
  const SurfaceViscosity viscosity{1.5, 0.7};
  const Flow flow = make_flow(std::nullopt, physics.flow, membrane.basis, resolution, viscosity);
  const Interaction interaction = flow.interact(position);
  const Vector load = membrane_load(membrane, position);
  Recycled recycled;
  const FlowState state = flow.solve(interaction, load, recycled);
  const double lost = -energy_gradient(membrane, position).dot(state.velocity);
  const double in_membrane = state.velocity.dot(
      SurfaceFriction(membrane.sampling, nodal_area(membrane, position), position, viscosity).dissipation() *
      state.velocity);

  const auto velocity_at = [&](double x, double r) {
    const Targets point{Vector::Constant(1, x), Vector::Constant(1, r), {}, {}};
    const Vector u = flow.outer_velocity(point, interaction, load, state);
    return Eigen::Vector2d(u[0], u[1]);
  };
  // Shells of the membrane's shape about a point inside, out to infinity.
  const Panels angles = make_panels(Vector::LinSpaced(3, 0, pi), 8);
  const Panels shells = make_panels(Vector::LinSpaced(2, 0, 1), 8);
  const Sampling at = sample(membrane.basis, angles.points, angles.weights);
  const Trace curve = trace(at, position);
  double in_liquids = 0;
  for (Eigen::Index i = 0; i < curve.x.size(); ++i)
    for (Eigen::Index k = 0; k < shells.points.size(); ++k) {
      const double t = shells.points[k];
      // (x, r) = s (X, R): dV = 2 pi r s (X R' - R X') ds dzeta
      const double cross = curve.x[i] * curve.r_zeta[i] - curve.r[i] * curve.x_zeta[i];
      for (const auto &[s, ds] : {std::pair{t, 1.0}, std::pair{1 / t, 1 / (t * t)}})
        in_liquids += shells.weights[k] * angles.weights[i] * 2 * pi * s * s * curve.r[i] * std::abs(cross) *
                      ds * dissipation_density(velocity_at, s * curve.x[i], s * curve.r[i]);
    }
  BOOST_TEST(in_membrane > 0.2 * lost);
  BOOST_TEST(in_liquids > 0.2 * lost);
  BOOST_TEST(in_liquids + in_membrane == lost, boost::test_tools::tolerance(1e-5));
}

// On folded shapes too a very viscous membrane only slows the motion down: all eigenvalues of what multiplies the velocity
// are larger than 1.
BOOST_AUTO_TEST_CASE(friction_resists_every_motion) {
  Case physics = capsule_case(0.8, 0.6, skalak, 0);
  physics.pore.shape = PoreShape::none;
  for (const int nodes : {32, 64}) {
    const Membrane membrane = spectral_membrane(physics, nodes);
    FlowResolution resolution;
    resolution.membrane_panel = 0.65 * pi * resolution.membrane_panel_points / nodes;
    const Flow flow = make_flow(std::nullopt, physics.flow, membrane.basis, resolution);
    const Vector position = random_position(membrane, 5);
    const Interaction interaction = flow.interact(position);
    const Matrix friction =
        SurfaceFriction(flow.mesh().parts[0].at_panels, nodal_area(membrane, position), position, {1, 1})
            .matrix();
    const Eigen::VectorXcd values =
        eigenvalues(nodal_layers(flow.interact(position, Layers::both)).single_with_wall() * friction);
    BOOST_TEST(values.real().minCoeff() > -1e-6);
    BOOST_TEST(values.imag().cwiseAbs().maxCoeff() < 1e-3 * values.real().maxCoeff());
  }
}

BOOST_AUTO_TEST_SUITE_END()
