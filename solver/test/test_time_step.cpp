// Orders of the explicit schemes on a real capsule, their interpolants, and their limits of stability.
#include "base/decompositions.hpp"
#include "motion/dynamics.hpp"
#include "motion/march.hpp"
#include "motion/motion.hpp"
#include "motion/time_step.hpp"
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <map>

using namespace capsule;

namespace {

Case stretched_capsule(double viscosity_ratio) {
  Case physics;
  physics.pore.shape = PoreShape::none;
  physics.flow.type = FlowType::extension;
  physics.flow.capillary_number = 0.1;
  physics.flow.viscosity_ratio = viscosity_ratio;
  physics.capsule.radius = 1;
  physics.capsule.start_x = 0;
  physics.membrane.bending_ratio = 1e-3;
  physics.mesh.membrane = 12;
  return physics;
}

// The shape at time 1 after so many steps.
Vector final_shape(Case physics, Scheme scheme, int steps) {
  physics.time.scheme = scheme;
  physics.time.step = 1.0 / steps;
  physics.until.time = 1;
  const Outcome outcome = march_once(physics, {}, {}, Role::main);
  BOOST_REQUIRE_MESSAGE((outcome.status == Status::reached), outcome.message);
  return outcome.last.position;
}

// Of four times the steps of those whose order is observed.
const Vector &exact_shape(double viscosity_ratio) {
  static std::map<double, Vector> shapes;
  Vector &shape = shapes[viscosity_ratio];
  if (shape.size() == 0)
    shape = final_shape(stretched_capsule(viscosity_ratio), Scheme::rk4, 800);
  return shape;
}

double observed_order(double viscosity_ratio, Scheme scheme, int steps) {
  const auto error = [&](int count) {
    return (final_shape(stretched_capsule(viscosity_ratio), scheme, count) - exact_shape(viscosity_ratio))
        .cwiseAbs()
        .maxCoeff();
  };
  return std::log2(error(steps) / error(2 * steps));
}

// y1' = y2, y2' = -y1.
Vector rotation_rate(const Vector &state) {
  return Vector{{state[1], -state[0]}};
}

} // namespace

BOOST_AUTO_TEST_SUITE(time_step)

BOOST_AUTO_TEST_CASE(orders_on_a_capsule) {
  BOOST_TEST(std::abs(observed_order(1, Scheme::euler, 100) - 1) < 0.1);
  BOOST_TEST(std::abs(observed_order(1, Scheme::rk4, 100) - 4) < 0.2);
  BOOST_TEST(std::abs(observed_order(5, Scheme::rk4, 100) - 4) < 0.2);
}

// The scheme with error control comes to the same shape, to its tolerance.
BOOST_AUTO_TEST_CASE(error_control_on_a_capsule) {
  for (const double viscosity_ratio : {1.0, 5.0}) {
    const auto error = [&](double tolerance) {
      Case physics = stretched_capsule(viscosity_ratio);
      physics.time.tolerance = tolerance;
      return (final_shape(physics, Scheme::bdf, 1) - exact_shape(viscosity_ratio)).cwiseAbs().maxCoeff();
    };
    BOOST_TEST(error(1e-6) < 1e-4);
    BOOST_TEST(error(1e-9) < 1e-7);
  }
}

BOOST_AUTO_TEST_CASE(the_interpolants_keep_their_orders) {
  const auto error = [](Scheme scheme, double step) {
    ExplicitIntegrator integrator(scheme, rotation_rate, {0, Vector{{0, 1}}, {}, {}}, step);
    integrator.step();
    const double time = 0.3 * step;
    return std::hypot(integrator.state_at(time)[0] - std::sin(time),
                      integrator.state_at(time)[1] - std::cos(time));
  };
  BOOST_TEST(std::abs(std::log2(error(Scheme::euler, 0.02) / error(Scheme::euler, 0.01)) - 2) < 0.1);
  BOOST_TEST(std::abs(std::log2(error(Scheme::rk4, 0.2) / error(Scheme::rk4, 0.1)) - 4) < 0.1);
}

// On y' = -y a step of exactly the limit neither grows nor decays.
BOOST_AUTO_TEST_CASE(limits_of_stability) {
  for (const Scheme scheme : {Scheme::euler, Scheme::rk4}) {
    ExplicitIntegrator integrator(
        scheme, [](const Vector &state) -> Vector { return -state; }, {0, Vector{{1}}, {}, {}},
        stability_limit(scheme));
    integrator.step();
    BOOST_TEST(std::abs(std::abs(integrator.state_at(integrator.time())[0]) - 1) < 1e-12);
  }
}

// A march whose step is too long fails and says which one is not; that one then reaches the end.
BOOST_AUTO_TEST_CASE(a_step_beyond_stability_is_a_failure) {
  for (const Scheme scheme : {Scheme::euler, Scheme::rk4}) {
    Case physics = stretched_capsule(1);
    const double fastest =
        eigenvalues(make_dynamics(physics).jacobian(make_scene(physics).start)).cwiseAbs().maxCoeff();
    physics.time.scheme = scheme;
    physics.time.step = 1.05 * stability_limit(scheme) / fastest;
    physics.until.time = 1;
    const Outcome outcome = march(physics, {}, {});
    BOOST_TEST((outcome.status == Status::failed));
    BOOST_TEST(outcome.failure == "step");
    const std::string advice = "try time.step = ";
    const std::size_t place = outcome.message.find(advice);
    BOOST_REQUIRE(place != std::string::npos);
    physics.time.step = std::stod(outcome.message.substr(place + advice.size()));
    const Outcome stable = march(physics, {}, {});
    BOOST_TEST((stable.status == Status::reached));
    BOOST_TEST(!stable.error_estimate.empty());
  }
}

BOOST_AUTO_TEST_SUITE_END()
