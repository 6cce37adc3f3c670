// A fold that is followed along a second key, against the folds of branches, which know nothing of it.
#include "base/failure.hpp"
#include "case/keys.hpp"
#include "steady/fold_curve.hpp"
#include "steady/steady_state.hpp"
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <vector>

using namespace capsule;

namespace {

Case stiff_case(double bending_ratio, int nodes) {
  Case physics;
  physics.capsule.radius = 0.8;
  physics.membrane.bending_ratio = bending_ratio;
  physics.flow.capillary_number = 0.18;
  physics.mesh.membrane = nodes;
  return physics;
}

struct FoldOfBranch {
  SteadyState state;
  FoldPoint point;
  Vector tangent;
};

FoldOfBranch fold_of_branch(const Case &physics, const KeyPath &path) {
  SteadyState state = find_steady(physics, {}, {});
  Branch branch(*state.system, path, {state.unknowns, 0}, Branch::upwards(*state.system),
                {.first = 0.05, .largest = 0.1, .tolerance = 1e-9});
  while (!branch.turned())
    branch.advance();
  const BranchPoint fold = branch.fold();
  return {{state.system, fold.unknowns},
          {fold.unknowns, fold.parameter, 0},
          branch.tangent_before().head(fold.unknowns.size())};
}

} // namespace

BOOST_AUTO_TEST_SUITE(fold_curve)

// From a stiff membrane to a softer one: there the curve ends at the fold of that one's own branch.
BOOST_AUTO_TEST_CASE(ends_at_the_fold_of_another_branch) {
  const Case stiff = stiff_case(2e-2, 88), soft = stiff_case(1e-2, 88);
  const double farthest = 0.3;
  const KeyPath path(flow_key, stiff, farthest), second(bending_key, stiff, soft.membrane.bending_ratio);
  FoldOfBranch fold = fold_of_branch(stiff, path);
  std::vector<double> bending, flow;
  const FoldPoint end = follow_fold(fold.state, fold.point, fold.tangent, path, second, stiff.mesh.membrane,
                                    {}, [&](const SteadyState &state, const FoldPoint &point) {
                                      BOOST_TEST(state.system->input().membrane.bending_ratio ==
                                                 second.value(point.second_part));
                                      bending.push_back(second.value(point.second_part));
                                      flow.push_back(path.value(point.part));
                                    });
  BOOST_REQUIRE(bending.size() > 3);
  BOOST_TEST(flow.front() == path.value(fold.point.part), boost::test_tools::tolerance(1e-7));
  BOOST_TEST(bending.back() == soft.membrane.bending_ratio);
  BOOST_TEST(end.second_part == 1);
  const KeyPath soft_path(flow_key, soft, farthest);
  const FoldOfBranch other = fold_of_branch(soft, soft_path);
  BOOST_TEST(path.value(end.part) == soft_path.value(other.point.part), boost::test_tools::tolerance(2e-7));
  // Along the branch the place of a fold is less exact than its parameter, which does not change there to first order.
  BOOST_TEST(fold.state.system->largest_stretch(fold.state.unknowns) ==
                 other.state.system->largest_stretch(other.state.unknowns),
             boost::test_tools::tolerance(1e-4));
}

// A mesh that is too coarse is said to be, rather than followed.
BOOST_AUTO_TEST_CASE(more_nodes_than_allowed) {
  const Case stiff = stiff_case(2e-2, 48);
  const KeyPath path(flow_key, stiff, 0.3), second(bending_key, stiff, 1e-5);
  FoldOfBranch fold = fold_of_branch(stiff, path);
  BOOST_CHECK_EXCEPTION(follow_fold(fold.state, fold.point, fold.tangent, path, second, 48, {},
                                    [](const SteadyState & /*state*/, const FoldPoint & /*point*/) {}),
                        NumericsFailure, [](const NumericsFailure &failure) {
                          return std::string(failure.what())
                                     .find("48 nodes do not resolve the fold at "
                                           "membrane.bending_ratio") == 0;
                        });
}

BOOST_AUTO_TEST_SUITE_END()
