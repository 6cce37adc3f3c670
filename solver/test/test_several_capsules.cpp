// Several capsules in one pore: rigid spheres known from elsewhere as the limit of weak flows, one capsule alone as the
// limit of long distances, quadrature across narrow gaps, and what a case, a march and its files make of them.
#include "base/failure.hpp"
#include "base/json_file.hpp"
#include "case/case_file.hpp"
#include "case/identity.hpp"
#include "compare/run_values.hpp"
#include "extrapolation.hpp"
#include "law/neo_hookean.hpp"
#include "law/skalak.hpp"
#include "motion/dynamics.hpp"
#include "motion/march.hpp"
#include "motion/motion.hpp"
#include "observe/gauge.hpp"
#include "output/checkpoint.hpp"
#include "output/results.hpp"
#include "output/summary.hpp"
#include "random_checkpoint.hpp"
#include "temporary_directory.hpp"
#include <algorithm>
#include <array>
#include <bit>
#include <boost/test/unit_test.hpp>
#include <cmath>

using namespace capsule;

namespace {

// Spheres in a tube that begin at these places.
Case in_a_tube(const MembraneLaw &law, double radius, const std::vector<double> &starts) {
  Case physics;
  physics.membrane.law = law;
  physics.membrane.bending_ratio = 1e-2;
  physics.capsule.radius = radius;
  physics.flow.capillary_number = 0.05;
  physics.pore.shape = PoreShape::tube;
  physics.pore.exit_x = physics.pore.entrance_distance = 8;
  physics.until.time = 0.1;
  for (const double start : starts) {
    Case capsule = physics;
    capsule.capsule.start_x = start;
    if (start == starts.front())
      physics = capsule;
    else
      physics.followers.push_back(capsule);
  }
  return physics;
}

template <class Change>
Case with(Case physics, const Change &change) {
  change(physics);
  for (Case &follower : physics.followers)
    change(follower);
  return physics;
}

// All membranes stretched along the axis, at the same volume.
Vector stretched(const Dynamics &dynamics, double stretch) {
  Vector position = dynamics.scene->start;
  for (const auto &rows : rows_of_capsules(*dynamics.scene)) {
    Vector part = position(rows);
    auto x = part.head(part.size() / 2);
    const double middle = (x.maxCoeff() + x.minCoeff()) / 2;
    x.array() = middle + stretch * (x.array() - middle);
    part.tail(part.size() / 2) /= std::sqrt(stretch);
    position(rows) = part;
  }
  return position;
}

const char *const pair_file =
    "membrane.law = ['skalak', 'neo-hookean']\nmembrane.dilatation = 2\ncapsule.radius = 0.8\n"
    "capsule.start_x = [1, -3]\nflow.capillary_number = [0.05, 0.02]\n";

} // namespace

BOOST_AUTO_TEST_SUITE(several_capsules)

// Speeds and the drop of both, of rigid spheres of radius 0.8 at a gap of 0.2: v 1.2735299, Delta P 14.656457. Equal spheres
// move equally, by reversibility; three in a row: the outer ones faster than the middle one.
BOOST_AUTO_TEST_CASE(rigid_limit) {
  std::array<double, 3> first{}, second{}, drops{};
  double flow = 0.001;
  for (std::size_t k = 0; k < 3; ++k) {
    const Case physics = with(in_a_tube({skalak, {1}}, 0.8, {0.9, -0.9}), [&](Case &capsule) {
      capsule.flow.capillary_number = flow;
      capsule.until.time = 0.16;
      capsule.mesh.membrane = 40;
    });
    const Outcome outcome = march_once(physics, {}, {}, Role::main);
    BOOST_REQUIRE_MESSAGE((outcome.status == Status::reached), outcome.message);
    const SeriesRow &ahead = outcome.last.series.back();
    const SeriesRow &behind = outcome.last.followers.at(0).series.back();
    BOOST_TEST(std::abs(ahead.pressure_share + behind.pressure_share - ahead.pressure_drop) <
               1e-6 * ahead.pressure_drop);
    BOOST_TEST(std::abs(behind.spacing - 1.8) < 2e-3);
    BOOST_TEST(std::abs(behind.min_gap - 0.2) < 2e-3);
    first[k] = ahead.v_g;
    second[k] = behind.v_g;
    drops[k] = ahead.pressure_drop;
    flow /= 2;
  }
  BOOST_TEST(std::abs(extrapolated(first) - 1.2735299) < 1e-6);
  BOOST_TEST(std::abs(extrapolated(second) - extrapolated(first)) < 1e-6);
  BOOST_TEST(std::abs(extrapolated(drops) - 14.656457) < 1e-5 * 14.656457);

  const Case three = with(in_a_tube({skalak, {1}}, 0.8, {1.8, 0, -1.8}), [](Case &c) {
    c.flow.capillary_number = 2e-4;
    c.mesh.membrane = 32;
    c.until.time = 0.05;
  });
  const Outcome outcome = march_once(three, {}, {}, Role::main);
  const double middle = outcome.last.followers.at(0).series.back().v_g;
  BOOST_TEST(outcome.last.series.back().v_g > middle + 1e-5);
  BOOST_TEST(outcome.last.followers.at(1).series.back().v_g > middle + 1e-5);
}

// Beyond the gap that `show` states each moves as if alone.
BOOST_AUTO_TEST_CASE(far_apart) {
  const double start = 0.7 * 1.1 + gap_without_interaction(1e-6) / 2;
  const Dynamics pair = make_dynamics(in_a_tube(neo_hookean, 0.7, {start, -start}));
  const Dynamics alone = make_dynamics(in_a_tube(neo_hookean, 0.7, {start}));
  const FlowState of_pair = pair.report(stretched(pair, 1.1), true);
  const FlowState of_one = alone.report(stretched(alone, 1.1), true);
  const auto rows = rows_of_capsules(*pair.scene);
  BOOST_TEST((Vector(of_pair.velocity(rows[0])) - of_one.velocity).cwiseAbs().maxCoeff() < 1e-6);
  BOOST_TEST(std::abs(of_pair.pressure_shares[0] - of_one.pressure_drop) < 1e-5);
}

// Across gaps that are much shorter than a panel velocities are those of a mesh twice as fine, on which panels are
// shorter. The velocity of a liquid in a gap is smooth where the membranes' loads are.
BOOST_AUTO_TEST_CASE(narrow_gaps) {
  for (const double gap : {0.2, 0.05, 0.01}) {
    const auto on_mesh = [&](int nodes, double accuracy) {
      const Case physics =
          with(in_a_tube(neo_hookean, 0.7, {0.7 + gap / 2, -0.7 - gap / 2}), [&](Case &capsule) {
            capsule.mesh.membrane = nodes;
            capsule.accuracy = accuracy;
            capsule.pore.exit_x = capsule.pore.entrance_distance = 4; // the same of both meshes
          });
      return make_dynamics(physics);
    };
    const Dynamics usual = on_mesh(0, 1e-4), fine = on_mesh(160, 1e-6);
    const auto speeds_and_shares = [](const Dynamics &dynamics) {
      const Vector position = stretched(dynamics, 0.97);
      const FlowState state = dynamics.report(position, true);
      const auto rows = rows_of_capsules(*dynamics.scene);
      std::vector<double> numbers;
      for (std::size_t k = 0; k < rows.size(); ++k) {
        const Gauge gauge(dynamics.scene->pore, dynamics.scene->membrane_of(k));
        numbers.push_back(gauge.row(0, position(rows[k]), state.velocity(rows[k])).v_g);
        numbers.push_back(state.pressure_shares[static_cast<Eigen::Index>(k)]);
      }
      return numbers;
    };
    const std::vector<double> here = speeds_and_shares(usual), there = speeds_and_shares(fine);
    BOOST_TEST(std::abs(here[0] - here[2]) > 0.01); // they do feel each other
    for (std::size_t k = 0; k < here.size(); ++k)
      BOOST_TEST(std::abs(here[k] - there[k]) < 1e-5, gap << ' ' << k << ": " << here[k] << ' ' << there[k]);
  }
}

// What touches is named.
BOOST_AUTO_TEST_CASE(touching) {
  const Dynamics pair = make_dynamics(in_a_tube(neo_hookean, 0.7, {0.71, -0.71}));
  try {
    pair.flow(stretched(pair, 1.1));
    BOOST_ERROR("capsules that stand in each other have a flow");
  } catch (const NumericsFailure &failure) {
    BOOST_TEST(failure.kind == failure_kind::touching);
    BOOST_TEST(std::string(failure.what()).starts_with("capsules 1 and 2 touch"));
  }
}

// So is the capsule that comes to the wall.
BOOST_AUTO_TEST_CASE(touching_the_wall) {
  const Dynamics pair = make_dynamics(in_a_tube(neo_hookean, 0.7, {2, -2}));
  Vector position = pair.scene->start;
  const std::vector<Eigen::Index> rows = rows_of_capsules(*pair.scene).at(1);
  for (std::size_t i = rows.size() / 2; i < rows.size(); ++i)
    position[rows[i]] *= 1.5;
  try {
    pair.flow(position);
    BOOST_ERROR("a capsule in the wall has a flow");
  } catch (const NumericsFailure &failure) {
    BOOST_TEST(failure.kind == failure_kind::touching);
    BOOST_TEST(failure.capsule == 1u);
    BOOST_TEST(std::string(failure.what()) == "capsule 2: the membrane touches the wall");
  }
}

// The softer one behind bursts, and the message says where it is.
BOOST_AUTO_TEST_CASE(the_capsule_that_bursts_tells_its_place) {
  Case physics = with(in_a_tube(neo_hookean, 0.6, {1, -1}), [](Case &c) {
    c.accuracy = 1e-2;
    c.mesh.membrane = 16;
    c.until.time = 1;
    c.until.tension = 0.02;
  });
  physics.followers[0].flow.capillary_number = 0.2;
  const Outcome outcome = march(physics, {}, {});
  BOOST_REQUIRE_MESSAGE((outcome.status == Status::burst), outcome.message);
  const SeriesRow &row = outcome.last.followers.at(0).series.back();
  BOOST_TEST(row.max_tension == 0.02, boost::test_tools::tolerance(1e-9));
  BOOST_TEST(outcome.message.starts_with("capsule 2: the membrane bursts"), outcome.message);
  BOOST_TEST(outcome.message.find(fmt::format("x_g = {:.6g})", row.x_g)) != std::string::npos,
             outcome.message);
}

// Interrupted after every few steps, and in the companion, a march of two ends with the same bits.
BOOST_AUTO_TEST_CASE(an_interrupted_march_is_the_same) {
  Case physics = with(in_a_tube(neo_hookean, 0.6, {1, -1}), [](Case &c) {
    c.accuracy = 1e-2;
    c.mesh.membrane = 16;
  });
  physics.followers[0].flow.viscosity_ratio = 3;
  const Outcome whole = march(physics, {}, {});
  BOOST_REQUIRE_MESSAGE((whole.status == Status::reached), whole.message);
  Checkpoint saved;
  Outcome last;
  int calls = 0;
  do {
    int asked = 0;
    Control control;
    control.interrupted = [&] { return ++asked > 12 + 4 * calls; };
    control.save = [&](const Checkpoint &checkpoint) { saved = checkpoint; };
    last = march(physics, saved, control);
    BOOST_REQUIRE(++calls < 60);
  } while (last.status == Status::interrupted);
  BOOST_TEST(calls > 2);
  BOOST_TEST((last.error_estimate == whole.error_estimate));
  BOOST_TEST(whole.error_estimate.contains("v_g#2@time"));
  BOOST_TEST(whole.error_estimate.contains("min_gap#2"));
  using Bits = std::array<std::uint64_t, sizeof(SeriesRow) / sizeof(double)>;
  const auto &series = last.last.followers.at(0).series, &expected = whole.last.followers.at(0).series;
  BOOST_REQUIRE(series.size() == expected.size());
  for (std::size_t k = 0; k < series.size(); ++k)
    BOOST_TEST((std::bit_cast<Bits>(series[k]) == std::bit_cast<Bits>(expected[k])));
}

BOOST_AUTO_TEST_CASE(lists_of_a_case) {
  const TemporaryDirectory directory;
  const Case physics = read_case(directory.write("pair.toml", pair_file)).runs.at(0).physics;
  BOOST_REQUIRE(physics.followers.size() == 1u);
  const Case &second = physics.followers[0];
  BOOST_TEST(physics.capsule.start_x == 1);
  BOOST_TEST(second.capsule.start_x == -3);
  BOOST_TEST(second.capsule.radius == 0.8);
  BOOST_TEST(second.flow.capillary_number == 0.02);
  BOOST_TEST(second.membrane.law.is(neo_hookean));
  BOOST_TEST(physics.until.x_g.value() == 11.84);
  // What is written of it is the same case; another distance is another one.
  const std::string resolved = resolved_toml(physics);
  const Case again = read_case(directory.write("again.toml", resolved)).runs.at(0).physics;
  BOOST_TEST(resolved_toml(again) == resolved);
  BOOST_TEST(run_identity(again, {}) == run_identity(physics, {}));
  Case nearer = physics;
  nearer.followers[0].capsule.start_x = -2.9;
  BOOST_TEST(run_identity(nearer, {}) != run_identity(physics, {}));

  // Lists are swept as a whole, and name runs.
  const CaseInput sweep =
      read_case(directory.path / "pair.toml", {"sweep.\"capsule.start_x\" = [[1, -3], [1, -4]]"});
  BOOST_REQUIRE(sweep.runs.size() == 2u);
  BOOST_TEST(sweep.runs[1].name == "start_x=1_-4");
  BOOST_TEST(sweep.runs[1].physics.followers.at(0).capsule.start_x == -4);
  BOOST_TEST(Selector("start_x=1_-4").selects(sweep.runs[1].physics));
  BOOST_TEST(!Selector("start_x=1_-3").selects(sweep.runs[1].physics));
}

// No run of a sweep gets lost: values that only a follower has a use for, and quantities in which followers differ.
BOOST_AUTO_TEST_CASE(names_of_swept_lists) {
  const TemporaryDirectory directory;
  const auto file =
      directory.write("pair.toml", "membrane.law = ['neo-hookean', 'skalak']\ncapsule.radius = 0.8\n"
                                   "capsule.start_x = [1, -3]\nflow.capillary_number = 0.05\n"
                                   "sweep.'membrane.dilatation' = [1, 5, 10]\n");
  const CaseInput laws = read_case(file);
  BOOST_REQUIRE(laws.runs.size() == 3u);
  BOOST_TEST(laws.runs[2].name == "dilatation=10");
  const auto physical = directory.write(
      "physical.toml",
      "membrane.law = 'skalak'\ncapsule.start_x = [1, -3]\n[physical]\ntube_radius = '5 um'\ncapsule_radius "
      "= '4 um'\n"
      "viscosity = '1 mPa.s'\nflow_rate = '0.1 nl/s'\n[sweep]\n"
      "'physical.shear_modulus' = [['20 uN/m', '30 uN/m'], ['20 uN/m', '50 uN/m'], '20 uN/m']\n");
  const CaseInput moduli = read_case(physical);
  BOOST_REQUIRE(moduli.runs.size() == 3u);
  BOOST_TEST(moduli.runs[1].name == "shear_modulus=20uN_per_m_50uN_per_m");
  BOOST_TEST(moduli.runs[2].name == "shear_modulus=20uN_per_m");
}

BOOST_AUTO_TEST_CASE(files_and_expressions) {
  const TemporaryDirectory directory;
  Case physics = with(in_a_tube(neo_hookean, 0.6, {1, -1}), [](Case &c) {
    c.physical.tube_radius = {5e-6};
    c.physical.viscosity = {1e-3};
    c.physical.flow_rate = {1e-13};
    c.physical.shear_modulus = {2e-5};
  });
  physics.followers[0].physical.shear_modulus = {3e-5};
  Outcome outcome;
  outcome.status = Status::reached;
  SeriesRow ahead, behind;
  ahead.pressure_share = 3;
  behind.x_g = -2;
  behind.spacing = 2.5;
  behind.max_tension = 0.1;
  outcome.last.series = {ahead};
  const Profile shape = random_checkpoint().profiles.at(0);
  outcome.last.followers = {{{behind}, {shape}}};
  write_results(directory.path, physics, outcome, {"2002-01-01T00:00:00Z", 1, 1});
  for (const char *name : {"series.csv", "series-2.csv", "profiles-2.csv", "membrane-2_0000.vtp"})
    BOOST_TEST(std::filesystem::exists(directory.path / name), name);
  RunResult result;
  result.directory = directory.path;
  result.input.physics = physics;
  result.summary = read_summary(directory.path);
  RunTable table;
  table.add("here", {result});
  const auto value = [&](const char *text) {
    return Expression(text).value([&](const Reference &reference) {
      return table.values(reference, "here", &table.runs_of("here").at(0));
    });
  };
  BOOST_TEST(value("x_g#2") == -2);
  BOOST_TEST(value("spacing#2@time=0") == 2.5);
  BOOST_TEST(value("pressure_share") == 3);
  BOOST_CHECK_EXCEPTION(value("x_g#3"), NoValue, [](const NoValue &reason) {
    return reason.what() == std::string("the run has 2 capsules");
  });
  BOOST_TEST(std::abs(value("mean(x#2)") - shape.x.mean()) < 1e-12);
  const auto summary = read_json(directory.path / "summary.json").value();
  const auto &in_si = summary.at("capsules").at("2").at("physical");
  BOOST_TEST(in_si.at("max_tension [N/m]").get<double>() == 3e-6, boost::test_tools::tolerance(1e-12));
  BOOST_TEST(in_si.at("x_g [m]").get<double>() == -1e-5, boost::test_tools::tolerance(1e-12));
  // All of it is the run's own, and goes with it.
  require_free(directory.path);
  remove_results(directory.path);
  BOOST_TEST(std::filesystem::is_empty(directory.path));
}

BOOST_AUTO_TEST_SUITE_END()
