// Branches of steady states: both ends, the fold between, and what cannot be asked for.
#include "base/failure.hpp"
#include "case/key_path.hpp"
#include "case/keys.hpp"
#include "case/physical.hpp"
#include "law/skalak.hpp"
#include "steady/branch.hpp"
#include "steady/continuation.hpp"
#include "steady/refinement.hpp"
#include "steady/steady_state.hpp"
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <fmt/format.h>

using namespace capsule;

namespace {

Case neo_hookean_case(int nodes) {
  Case physics;
  physics.capsule.radius = 0.8;
  physics.membrane.bending_ratio = 1e-2;
  physics.flow.capillary_number = 0.2;
  physics.accuracy = 1e-6;
  physics.mesh.membrane = nodes;
  return physics;
}

// However near to a fold, there is a stable state on its near side: the way to the fold grows like the root of what the
// parameter lacks.
void check_near_side(Case physics, const BranchRow &fold) {
  std::vector<double> ways;
  for (const double share : {4e-5, 4e-4, 2e-3}) {
    physics.flow.capillary_number = (1 - share) * fold.parameter;
    const SteadyRecord near =
        record_steady(on_mesh(physics, physics.mesh.membrane, find_steady(physics, {}, {})));
    BOOST_TEST(near.further.at("growth_rate") < 0);
    ways.push_back((fold.row.max_stretch - near.row.max_stretch) / std::sqrt(share));
    BOOST_TEST(std::abs(ways.back() / ways.front() - 1) < 3 * std::sqrt(share));
  }
  BOOST_TEST(ways.front() > 0);
}

} // namespace

BOOST_AUTO_TEST_SUITE(branch)

// The fold of a neo-Hookean capsule is the same on two meshes, within its estimated error; small motions neither grow nor
// decay there.
BOOST_AUTO_TEST_CASE(fold_of_a_neo_hookean_capsule) {
  BranchRow folds[2];
  for (const int k : {0, 1}) {
    const Outcome outcome =
        follow_branch(neo_hookean_case(k == 0 ? 64 : 80), {"flow.capillary_number", 0.3}, {});
    BOOST_TEST((outcome.status == Status::unbounded));
    BOOST_REQUIRE(outcome.folds.size() == 1);
    const BranchRow &fold = outcome.folds[0];
    folds[k] = fold;
    const double before = outcome.branch.front().growth_rate;
    BOOST_TEST(before < -0.05);
    BOOST_TEST(outcome.branch.back().growth_rate > 0);
    BOOST_TEST(std::abs(fold.growth_rate) < 1e-6 * std::abs(before));
    for (const BranchRow &point : outcome.branch)
      BOOST_TEST(point.parameter < fold.parameter);
    if (k == 0)
      check_near_side(neo_hookean_case(48), fold);
  }
  const BranchRow &coarse = folds[0], &fine = folds[1];
  BOOST_TEST(std::abs(coarse.parameter - fine.parameter) < 1e-6 * fine.parameter);
  constexpr double loose = 1e-4; // of the value
  const auto check = [&](const char *name, double value, double better) {
    const double estimate = coarse.error_estimate.at(name), error = std::abs(value - better);
    BOOST_TEST(estimate > error);
    BOOST_TEST(estimate < loose * value);
  };
  check(flow_key, coarse.parameter, fine.parameter);
  check("pressure_drop", coarse.row.pressure_drop, fine.row.pressure_drop);
  check("max_stretch", coarse.row.max_stretch, fine.row.max_stretch);
}

// The rear of a capsule snaps through at one fold and back at the other; the least stable motion is at rest at both.
BOOST_AUTO_TEST_CASE(folds_of_a_rear_that_snaps_through) {
  Case physics = neo_hookean_case(56);
  physics.capsule.radius = 0.9;
  physics.membrane.bending_ratio = 1e-3;
  physics.flow.capillary_number = 5e-3;
  const Outcome outcome = follow_branch(physics, {"flow.capillary_number", 0.015}, {});
  BOOST_TEST((outcome.status == Status::reached));
  BOOST_REQUIRE(outcome.folds.size() == 2);
  BOOST_TEST(outcome.folds[1].parameter < outcome.folds[0].parameter);
  for (const BranchRow &fold : outcome.folds)
    BOOST_TEST(std::abs(fold.growth_rate) < 1e-8);
}

// Skalak's law with C = 0 softens at the rim of a dent. Behind that every mesh has an end of its own.
BOOST_AUTO_TEST_CASE(a_branch_ends_where_the_law_softens) {
  Case physics = neo_hookean_case(0);
  physics.membrane.law = {skalak, {0}};
  physics.membrane.bending_ratio = 9e-3;
  physics.capsule.radius = 0.89;
  physics.capsule.aspect_ratio = 0.68;
  physics.flow.capillary_number = 0.2;
  double last[2];
  for (const int k : {0, 1}) {
    physics.mesh.membrane = k == 0 ? 56 : 72;
    const Outcome outcome = follow_branch(physics, {"flow.capillary_number", 0.25}, {});
    BOOST_TEST(outcome.failure == "softening");
    last[k] = outcome.branch.back().parameter;
  }
  BOOST_TEST(last[0] == last[1], boost::test_tools::tolerance(0.03));
}

// A branch that is begun again between a fold and the next point, as on another mesh, finds the fold.
BOOST_AUTO_TEST_CASE(a_fold_just_before_the_start) {
  Case physics = neo_hookean_case(48);
  physics.membrane.bending_ratio = 2e-2;
  physics.flow.capillary_number = 0.25;
  const Branch::Steps steps{.first = 0.05, .largest = 0.1, .tolerance = 1e-9};
  const KeyPath path(flow_key, physics, 0.3);
  const SteadyState state = find_steady(physics, {}, {});
  Branch branch(*state.system, path, {state.unknowns, 0}, Branch::upwards(*state.system), steps);
  while (!branch.turned())
    branch.advance();
  BOOST_TEST(branch.tangent_has_turned());
  Branch again(*state.system, path, branch.point(), branch.tangent(), steps, Branch::Trend::grows);
  again.advance();
  BOOST_TEST(again.turned());
  BOOST_TEST(std::abs(again.fold().parameter - branch.fold().parameter) < 1e-9);
}

// As a capsule stretches its pressure drop falls: under constant pressure the flow grows, and the same states turn earlier.
// Small motions know it: they neither grow nor decay at that fold, where the state is stable at its constant flow rate.
BOOST_AUTO_TEST_CASE(fold_under_constant_pressure) {
  Case physics = neo_hookean_case(48);
  physics.pore.exit_x = 3;
  physics.flow.drive = DriveBy::pressure;
  const Outcome outcome = follow_branch(physics, {"flow.capillary_number", 0.3}, {});
  BOOST_REQUIRE(outcome.folds.size() == 1);
  const BranchRow &fold = outcome.folds[0];
  BOOST_TEST(std::abs(fold.growth_rate) < 1e-6);
  physics.flow.drive = DriveBy::flow_rate;
  physics.flow.capillary_number = fold.row.flow_rate * fold.parameter;
  const Outcome given = steady(physics, {}, {});
  BOOST_REQUIRE((given.status == Status::steady));
  BOOST_TEST(given.further.at("growth_rate") < -0.01);
  BOOST_TEST(std::abs(given.last.series[0].max_stretch - fold.row.max_stretch) < 1e-5);
  BOOST_TEST(std::abs(fold.row.flow_rate * given.last.series[0].v_g - fold.row.v_g) < 1e-6);
}

// Where a branch ends, nothing tells from which side it came.
BOOST_AUTO_TEST_CASE(the_end_of_a_branch_is_a_steady_state) {
  Case physics = neo_hookean_case(36);
  physics.output.resistance = true;
  const Outcome outcome = follow_branch(physics, {"capsule.radius", 0.76}, {});
  BOOST_TEST((outcome.status == Status::reached));
  BOOST_TEST(outcome.folds.empty());
  BOOST_TEST(outcome.branch.back().parameter == 0.76);
  physics.capsule.radius = 0.76;
  const Outcome alone = steady(physics, {}, {});
  const SeriesRow direct = alone.last.series.at(0), end = outcome.branch.back().row;
  BOOST_TEST(std::abs(end.pressure_drop - direct.pressure_drop) < 1e-6);
  BOOST_TEST(std::abs(end.resistance - direct.resistance) < 1e-6);
  BOOST_TEST(end.resistance > 1);
  // Of the tube of 15 radii and its mouth (scenes.md, another program).
  BOOST_TEST(std::abs(outcome.further.at("empty_resistance") - 15.9773755) < 1e-6);
  BOOST_TEST(std::abs(alone.further.at("empty_resistance") - 15.9773755) < 1e-6);
}

// What was found is kept, the last point with its profile.
BOOST_AUTO_TEST_CASE(a_branch_that_breaks_off) {
  Control control;
  int asked = 0;
  control.interrupted = [&]() -> bool {
    if (++asked > 20)
      throw NumericsFailure("unresolved", "no way on", "none");
    return false;
  };
  const Outcome outcome = follow_branch(neo_hookean_case(24), {"capsule.radius", 0.5}, control);
  BOOST_TEST((outcome.status == Status::failed));
  BOOST_TEST(outcome.message.find("no way on (after capsule.radius = 0.") != std::string::npos);
  BOOST_REQUIRE(outcome.branch.size() > 1);
  BOOST_REQUIRE(outcome.last.series.size() == 2);
  BOOST_TEST(outcome.last.series[0].time == 0.8);
  BOOST_TEST(outcome.last.series[1].time == outcome.branch.back().parameter);
  BOOST_TEST(outcome.last.series[1].v_g == outcome.branch.back().row.v_g);
  BOOST_REQUIRE(outcome.last.profiles.size() == 2);
  BOOST_TEST(outcome.last.profiles[1].time == outcome.branch.back().parameter);
}

// A physical key that changes one dimensionless key alone leads along that one.
BOOST_AUTO_TEST_CASE(ends_in_physical_units) {
  Case physics = neo_hookean_case(44);
  physics.physical.tube_radius = {5e-6, "5 um"};
  physics.physical.viscosity = {1e-3};
  physics.physical.shear_modulus = {2e-5};
  physics.physical.capsule_radius = {4e-6};
  const double rate = 0.2 * 3.14159265358979 * 25e-12 * 2e-5 / 1e-3; // at the case's capillary number
  physics.physical.flow_rate = {rate};
  const auto check = [](const BranchEnd &end, const char *key, double value) {
    BOOST_TEST(end.key == key);
    BOOST_TEST(end.value == value, boost::test_tools::tolerance(1e-12));
  };
  check(end_of_branch(physics, "physical.flow_rate", fmt::format("{} m3/s", 2 * rate)), flow_key, 0.4);
  check(end_of_branch(physics, "physical.capsule_radius", "3 um"), "capsule.radius", 0.6);
  check(end_of_branch(physics, "physical.bending_modulus", "5 aJ"), bending_key, 1e-2);
  const auto message = [&](const char *key, const char *to) -> std::string {
    try {
      end_of_branch(physics, key, to);
    } catch (const InputError &error) {
      return error.what();
    }
    return "";
  };
  const auto says = [&](const char *key, const char *to, const char *part) {
    BOOST_TEST(message(key, to).find(part) != std::string::npos, message(key, to));
  };
  says("physical.pressure", "20 Pa", "physical.pressure needs physical.pore_length");
  says("physical.shear_modulus", "1 mN/m", "changes flow.capillary_number and the scales");
  says("physical.tube_radius", "6 um", "changes flow.capillary_number, capsule.radius and the scales");
  says("physical.internal_viscosity", "6 cP", "steady states do not depend on it");
  says("physical.capsule_velocity", "1 mm/s", "a key of `capsule fit`");
  says("physical.capsule_radius", "3", "has no unit");
  // The flow grows with the pressure.
  physics.physical.flow_rate = {};
  physics.physical.pressure = {20};
  physics.physical.pore_length = {1e-4};
  physics.flow.capillary_number = derived_values(physics).front().value;
  check(end_of_branch(physics, "physical.pressure", "50 Pa"), flow_key, 2.5 * physics.flow.capillary_number);
  says("physical.bending_modulus", "5 Pa", "physical.bending_modulus: ");
}

BOOST_AUTO_TEST_CASE(no_branch_there) {
  const Case physics = neo_hookean_case(44);
  BOOST_CHECK_THROW(require_branch(physics, {"flow.viscosity_ratio", 2}), InputError);
  BOOST_CHECK_THROW(require_branch(physics, {"flow.capilary_number", 2}), InputError);
  BOOST_CHECK_THROW(require_branch(physics, {"flow.capillary_number", -1}), InputError);
  BOOST_CHECK_THROW(require_branch(physics, {"flow.capillary_number", 0.2}), InputError);
  const auto names = [](const char *option) {
    return
        [=](const InputError &error) { return std::string(error.what()).find(option) != std::string::npos; };
  };
  const BranchEnd own_radius{"capsule.radius", physics.capsule.radius};
  BOOST_CHECK_EXCEPTION(require_branch(physics, own_radius), InputError, names("error: --to: "));
  BOOST_CHECK_EXCEPTION(require_branch(physics, {"flow.capillary_number", 0.3}, own_radius), InputError,
                        names("error: --fold-to: "));
}

BOOST_AUTO_TEST_SUITE_END()
