// From a case to its objects: both presets describe the same capsule in the same pore, and positions that are no
// capsule in it are told apart.
#include "base/failure.hpp"
#include "scene/scene.hpp"
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <numbers>

using namespace capsule;

namespace {

Case mouth_case() {
  Case physics;
  physics.capsule.radius = 0.8;
  physics.capsule.aspect_ratio = 0.6;
  physics.capsule.start_x = -3;
  physics.accuracy = 1e-3;
  return physics;
}

// The kind of failure and the advice that goes with it.
std::string failure_of(const std::optional<Pore> &pore, const Vector &position) {
  try {
    require_capsule(pore, position, {.at_the_wall = "shrink", .at_the_end = "go back"});
  } catch (const NumericsFailure &failure) {
    return failure.kind + ": " + failure.advice;
  }
  return "";
}

} // namespace

BOOST_AUTO_TEST_SUITE(scene)

// The start is the spheroid at its place, on the nodes of either preset.
BOOST_AUTO_TEST_CASE(presets_describe_the_same_capsule) {
  Case physics = mouth_case();
  for (const Numerics numerics : {Numerics::standard, Numerics::paper}) {
    physics.numerics = numerics;
    physics.mesh.membrane = 60;
    const Scene scene = make_scene(physics);
    BOOST_REQUIRE(scene.pore);
    BOOST_TEST(scene.pore->exit_x == physics.pore.exit_x);
    const auto [half_length, half_width] = extent(physics.capsule);
    const Eigen::Index n = scene.membrane.basis.size();
    BOOST_TEST(n == (numerics == Numerics::paper ? 61 : 60));
    const Eigen::ArrayXd x = scene.start.head(n).array() + 3, r = scene.start.tail(n).array();
    BOOST_TEST(((x / half_length).square() + (r / half_width).square() - 1).abs().maxCoeff() < 1e-12);
    BOOST_TEST(elastic_energy(scene.membrane, scene.start) < 1e-20);
  }
  physics = mouth_case();
  physics.flow.type = FlowType::extension;
  physics.pore.shape = PoreShape::none;
  BOOST_TEST(!make_scene(physics).pore);
}

BOOST_AUTO_TEST_CASE(the_centre_of_an_extension_moves_with_the_capsule) {
  const Vector position = Eigen::Vector<double, 6>(1, 2, 6, 0.5, 0.6, 0.4);
  BOOST_TEST((place_in_flow(FlowType::pore, position) - position).norm() == 0);
  const Vector placed = place_in_flow(FlowType::extension, position);
  BOOST_TEST((placed - Eigen::Vector<double, 6>(-2, -1, 3, 0.5, 0.6, 0.4)).norm() < 1e-15);
}

BOOST_AUTO_TEST_CASE(what_is_no_capsule_in_the_pore) {
  const Scene scene = make_scene(mouth_case());
  const Eigen::Index n = scene.membrane.basis.size();
  const auto moved = [&](double dx) {
    Vector position = scene.start;
    position.head(n).array() += dx;
    return position;
  };
  const auto widened = [&](double dx, double factor) {
    Vector position = moved(dx);
    position.tail(n) *= factor;
    return position;
  };
  BOOST_TEST(failure_of(scene.pore, scene.start) == "");
  BOOST_TEST(failure_of(scene.pore, moved(18)) == "exit: go back");
  BOOST_TEST(failure_of(scene.pore, widened(5, 1.1)) == "touching: shrink");
  BOOST_TEST(failure_of(scene.pore, widened(0, 1.1)) == ""); // the mouth is wider
  BOOST_TEST(failure_of(scene.pore, widened(0, -1)) == "folded: try a larger membrane.bending_ratio");
  BOOST_TEST(failure_of(scene.pore, moved(NAN)) == "not-a-number: try a finer mesh.membrane");
  BOOST_TEST(failure_of(std::nullopt, widened(100, 30)) == "");
  // A tube ends upstream, too.
  PoreSpec tube = mouth_case().pore;
  tube.shape = PoreShape::tube;
  BOOST_TEST(failure_of(make_pore(tube), moved(-tube.entrance_distance)) == "exit: go back");
}

BOOST_AUTO_TEST_SUITE_END()
