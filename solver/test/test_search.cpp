// Steady states that no undeformed capsule relaxes to: a flat one that a march finds, and flows that are too strong.
#include "base/failure.hpp"
#include "law/neo_hookean.hpp"
#include "membranes.hpp"
#include "motion/to_rest.hpp"
#include "steady/search.hpp"
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <string>

using namespace capsule;

namespace {

// On so many nodes, which are enough for the digits that are compared.
Case neo_hookean_capsule(double radius, double aspect_ratio, double flow, double bending_ratio, int nodes) {
  Case physics = capsule_case(radius, aspect_ratio, neo_hookean, bending_ratio);
  physics.flow.capillary_number = flow;
  physics.mesh.membrane = nodes;
  physics.accuracy = 1e-3;
  return physics;
}

} // namespace

BOOST_AUTO_TEST_SUITE(search)

// Wider than the tube, in a weak flow: a march folds it in the mouth. The state moves as the march's end does.
BOOST_AUTO_TEST_CASE(a_flat_capsule_wider_than_the_tube) {
  const Case flat = neo_hookean_capsule(0.7508, 0.3055, 0.00477, 6.85e-5, 48);
  std::optional<Profile> marched;
  const SteadyState state =
      search_steady(flat, {}, [&](const Case &input, MarchLength length, const Control &control) {
        BOOST_TEST((length == MarchLength::into_tube));
        return marched = march_to_rest(input, length, control);
      });
  const Eigen::Index n = state.system->nodes();
  BOOST_REQUIRE(marched.has_value());
  BOOST_TEST(state.unknowns[2 * n] == marched->velocity_x.mean(), boost::test_tools::tolerance(2e-3));
  BOOST_TEST(state.unknowns.segment(n, n).maxCoeff() == marched->r.maxCoeff(),
             boost::test_tools::tolerance(2e-3));
}

// Its film is too thin for a march in the mouth. The way from a small sphere leads to the state of a branch that comes from
// four times the flow, where the capsule relaxes.
BOOST_AUTO_TEST_CASE(a_flat_capsule_that_a_march_leaves_in_the_mouth) {
  const SteadyState state = search_steady(neo_hookean_capsule(0.9, 0.3, 0.005, 1e-3, 80), {});
  const Vector position = state.unknowns.head(2 * state.system->nodes());
  BOOST_TEST(state.system->flow(position).pressure_drop == 67.007, boost::test_tools::tolerance(2e-3));
}

// The ellipsoid of Figures 16 and 18 with ten times their bending stiffness, whose way from a small sphere is long. Its march
// has v_g = 1.2145 at x_g = 11.84 (validation/delta-search), and still relaxes there.
BOOST_AUTO_TEST_CASE(the_papers_ellipsoid) {
  const SteadyState state = search_steady(neo_hookean_capsule(0.9, 0.28, 0.09, 1e-4, 100), {});
  BOOST_TEST(state.unknowns[2 * state.system->nodes()] == 1.2145, boost::test_tools::tolerance(1e-3));
}

// The fold of this sphere's branch lies at 0.181867. A little beyond it a stiff membrane still has a state, far beyond it has
// none: both lead to the fold.
BOOST_AUTO_TEST_CASE(a_flow_that_is_too_strong_is_told_the_critical_one) {
  const auto told = [](double flow) -> std::string {
    try {
      search_steady(neo_hookean_capsule(0.8, 1, flow, 3e-3, 64), {}, march_to_rest);
    } catch (const NumericsFailure &failure) {
      return failure.kind == failure_kind::fold ? failure.what() : "";
    }
    return "";
  };
  const std::string beyond = told(0.19), far_beyond = told(0.25);
  BOOST_TEST(beyond.find("fold at flow.capillary_number = 0.18186") != std::string::npos);
  BOOST_TEST(far_beyond.find("fold near flow.capillary_number = 0.1") != std::string::npos);
  for (const std::string &text : {beyond, far_beyond})
    BOOST_TEST(text.find(", the critical capillary number") != std::string::npos);
}

BOOST_AUTO_TEST_SUITE_END()
