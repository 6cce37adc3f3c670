// Files of a run: what they say, whose they are, sharing and replacing.
#include "base/atomic_file.hpp"
#include "base/csv.hpp"
#include "base/json_file.hpp"
#include "case/case_file.hpp"
#include "case/identity.hpp"
#include "output/checkpoint.hpp"
#include "output/results.hpp"
#include "output/summary.hpp"
#include "random_checkpoint.hpp"
#include "temporary_directory.hpp"
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

using namespace capsule;
namespace fs = std::filesystem;

namespace {

Case pore_case() {
  Case physics;
  physics.title = "test";
  physics.capsule.radius = 0.9;
  physics.flow.capillary_number = 0.04;
  physics.until.x_g = 11.84;
  return physics;
}

Outcome outcome_with(const Checkpoint &last) {
  Outcome outcome;
  outcome.status = Status::reached;
  outcome.last = last;
  outcome.error_estimate["v_g"] = 1e-5;
  return outcome;
}

std::vector<std::string> lines_of(const fs::path &file) {
  std::vector<std::string> lines;
  std::istringstream stream(content_of(file));
  for (std::string line; std::getline(stream, line);)
    lines.push_back(line);
  return lines;
}

} // namespace

// Each of its bytes counts; what it still says of the other files is known, and nothing is taken for somebody else's.
BOOST_AUTO_TEST_CASE(altered_provenance_is_noticed) {
  const TemporaryDirectory directory;
  const Case physics = pore_case();
  const auto place = directory.path / "run", provenance = place / "run.json";
  make_directories(place);
  write_results(place, physics, outcome_with(random_checkpoint()), {});
  const std::string text = content_of(provenance);
  for (std::size_t k = text.find("\"task\""); k < text.find("\"files\""); k += 7) {
    std::string altered = text;
    altered[k] = altered[k] == 'x' ? 'y' : 'x';
    directory.write("run/run.json", altered);
    BOOST_TEST(!is_finished(place, run_identity(physics)));
    BOOST_TEST(!is_finished_input(place, physics));
    BOOST_TEST(other_results(place, physics) == "results whose run.json was altered");
    BOOST_CHECK_NO_THROW(require_free(place));
  }
  const auto left = [&] {
    std::set<std::string> names;
    for (const auto &entry : fs::directory_iterator(place))
      names.insert(entry.path().filename());
    return names;
  };
  directory.write("run/notes.txt", "mine");
  directory.write("run/series.csv", "altered, too");
  BOOST_TEST(set_aside_altered(place).size() == 2u);
  BOOST_TEST((left() == std::set<std::string>{"notes.txt", "run.json.altered", "series.csv.altered"}));

  // Cut off before it names any file, it vouches for none.
  write_results(place, physics, outcome_with(random_checkpoint()), {});
  for (const std::size_t length : {std::size_t{0}, text.find("\"files\"")}) {
    directory.write("run/run.json", text.substr(0, length));
    BOOST_TEST(failure_of([&] { require_free(place); }).find("whose run.json was altered") !=
               std::string::npos);
  }
  // Somebody else's is no run's.
  for (const char *foreign : {"[]", "3", "{\"name\": 3}", "my notes"}) {
    directory.write("run/run.json", foreign);
    BOOST_TEST(!is_finished(place, run_identity(physics)));
    BOOST_TEST(set_aside_altered(place).empty());
    BOOST_TEST(failure_of([&] { require_free(place); }).find("run.json, series.csv") != std::string::npos);
  }
}

BOOST_AUTO_TEST_CASE(results_of_a_run) {
  const TemporaryDirectory directory;
  const Case physics = pore_case();
  Checkpoint last = random_checkpoint();
  for (std::size_t i = 0; i < last.series.size(); ++i)
    last.series[i].x_g = static_cast<double>(i);
  last.series.back().max_radial_velocity = std::nan("");
  write_checkpoint(directory.path, run_identity(physics), {last, {}});
  BOOST_TEST(!is_finished(directory.path, run_identity(physics)));
  write_results(directory.path, physics, outcome_with(last), {"2002-01-01T00:00:00Z", 1.5, 2.5});
  BOOST_TEST(is_finished(directory.path, run_identity(physics)));
  BOOST_TEST(!is_finished(directory.path, "another"));
  BOOST_TEST(is_finished_input(directory.path, physics));
  Case longer = physics;
  longer.until.time = 1000;
  BOOST_TEST(!is_finished_input(directory.path, longer));
  BOOST_TEST(!fs::exists(directory.path / "checkpoint.json"));
  BOOST_TEST(!fs::exists(directory.path / "series_physical.csv"));

  const Summary summary = read_summary(directory.path);
  BOOST_TEST(summary.status == "reached");
  BOOST_TEST(summary.failure == "");
  BOOST_TEST(summary.quantities.at("x_g") == 4);
  BOOST_TEST(summary.quantities.at("v_g") == last.series.back().v_g);
  BOOST_TEST(summary.quantities.at("steps") == 1234567);
  BOOST_TEST(summary.quantities.at("wall_seconds") == 2.5);
  BOOST_TEST(summary.quantities.count("max_radial_velocity") == 0u);
  BOOST_TEST(summary.error_estimate.at("v_g") == 1e-5);
  const std::string text = content_of(directory.path / "summary.json");
  for (const char *part : {"\"flow.capillary_number\": 0.04", "\"membrane.law\": \"neo-hookean\"",
                           "\"mesh.wall\": null", "\"max_radial_velocity\": null", "\"failure\": null"})
    BOOST_CHECK_MESSAGE(text.find(part) != std::string::npos, part << " is not in " << text);

  const auto series = lines_of(directory.path / "series.csv");
  BOOST_REQUIRE(series.size() == 6u);
  BOOST_TEST(series[0].starts_with("time,x_g,v_g,pressure_drop,max_stretch,min_film,volume_change"));
  BOOST_TEST(std::stod(series[1]) == last.series[0].time);
  const auto profiles = lines_of(directory.path / "profiles.csv");
  BOOST_REQUIRE(profiles.size() == 1u + 7 + 3);
  BOOST_TEST(profiles[0].starts_with("time,x_g,S,x,r,stretch_meridional,stretch_azimuthal,tension_meridional,"
                                     "tension_azimuthal"));
  BOOST_TEST(read_case(directory.path / "resolved.toml").runs.at(0).physics.capsule.radius == 0.9);
  const std::string collection = content_of(directory.path / "membrane.pvd");
  BOOST_TEST(collection.find("membrane_0001.vtp") != std::string::npos);
  const std::string surface = content_of(directory.path / "membrane_0001.vtp");
  BOOST_TEST(surface.find("NumberOfPoints=\"96\" NumberOfStrips=\"2\"") != std::string::npos);
}

// What a reader sorts by time goes along the branch, also beyond a fold.
BOOST_AUTO_TEST_CASE(surfaces_of_a_branch_are_numbered) {
  const TemporaryDirectory directory;
  Outcome outcome = outcome_with(random_checkpoint());
  outcome.along = "flow.capillary_number";
  outcome.last.profiles[0].time = 0.2;
  outcome.last.profiles[1].time = 0.1;
  write_results(directory.path, pore_case(), outcome, {});
  const std::string collection = content_of(directory.path / "membrane.pvd");
  BOOST_TEST(collection.find("timestep=\"0\" file=\"membrane_0000.vtp\"") != std::string::npos);
  BOOST_TEST(collection.find("timestep=\"1\" file=\"membrane_0001.vtp\"") != std::string::npos);
  BOOST_TEST(content_of(directory.path / "membrane_0001.vtp")
                 .find("Name=\"flow.capillary_number\" NumberOfTuples=\"1\" format=\"ascii\">\n0.1\n") !=
             std::string::npos);
}

// By hand: R_t, Q/(pi R_t^2), mu Q/(pi R_t^3), and of the time R_t over the velocity.
BOOST_AUTO_TEST_CASE(results_in_physical_units) {
  const TemporaryDirectory directory;
  Case physics = pore_case();
  physics.physical.tube_radius = {5e-6};
  physics.physical.viscosity = {1e-3};
  physics.physical.flow_rate = {1e-13};
  physics.physical.shear_modulus = {2e-5};
  physics.physical.resistivity = {0.65};
  Checkpoint last = random_checkpoint();
  physics.followers.assign(last.followers.size(), physics);
  SeriesRow &end = last.series.back();
  end.time = 2;
  end.x_g = 3;
  end.v_g = 1.5;
  end.pressure_drop = 4;
  end.min_film = 0.1;
  end.length = 1.7;
  end.flow_rate = 0.7;
  end.max_tension = 0.3;
  end.max_stretch = 1.3;
  end.max_area_stretch = 1.5;
  end.front_stretch = 1.2;
  end.S_at_max_area_stretch = 0.4;
  end.S_at_max_tension = 0.5;
  end.pressure_share = 2;
  end.spacing = 3;
  end.min_gap = 0.2;
  end.resistance = 1.5;
  end.resistance_long_conductor = 1.2;
  write_results(directory.path, physics, outcome_with(last), {});
  const double velocity = 1e-13 / (std::numbers::pi * 25e-12);
  const std::map<std::string, double> by_hand = {
      {"time [s]", 2 * 5e-6 / velocity},
      {"x_g [m]", 15e-6},
      {"v_g [m/s]", 1.5 * velocity},
      {"pressure_drop [Pa]", 4 * 1e-3 * velocity / 5e-6},
      {"min_film [m]", 0.5e-6},
      {"length [m]", 8.5e-6},
      {"flow_rate [m3/s]", 0.7e-13},
      {"max_tension [N/m]", 0.3 * 2e-5},
      {"max_stretch", 1.3},
      {"max_area_stretch", 1.5},
      {"front_stretch", 1.2},
      {"S_at_max_area_stretch [m]", 2e-6},
      {"S_at_max_tension [m]", 2.5e-6},
      {"resistance [ohm]", 1.5 * 0.65 / (std::numbers::pi * 5e-6)},
      {"resistance_long_conductor [ohm]", 1.2 * 0.65 / (std::numbers::pi * 5e-6)},
      {"pressure_share [Pa]", 2 * 1e-3 * velocity / 5e-6},
      {"spacing [m]", 15e-6},
      {"min_gap [m]", 1e-6}};
  const auto lines = lines_of(directory.path / "series_physical.csv");
  BOOST_REQUIRE(lines.size() == 6u);
  const auto summary = read_json(directory.path / "summary.json").value().at("physical");
  std::istringstream names(lines.front()), values(lines.back());
  std::size_t columns = 0;
  for (std::string name, value; std::getline(names, name, ',') && std::getline(values, value, ',');
       ++columns) {
    BOOST_TEST(std::stod(value) == by_hand.at(name), boost::test_tools::tolerance(1e-14));
    if (name.ends_with("]")) // stretches have no unit, and stand in the summary already
      BOOST_TEST(summary.at(name).get<double>() == std::stod(value));
  }
  BOOST_TEST(columns == by_hand.size());
  BOOST_TEST(summary.at("tension scale [N/m]").get<double>() == 2e-5);
}

// By hand. The flow rate grows with the capillary number; along another key it stays.
BOOST_AUTO_TEST_CASE(branches_in_physical_units) {
  Case physics = pore_case();
  physics.physical.tube_radius = {5e-6};
  physics.physical.viscosity = {1e-3};
  physics.physical.shear_modulus = {2e-5};
  physics.flow.capillary_number = 0.04;
  physics.physical.flow_rate = {0.04 * std::numbers::pi * 25e-12 * 2e-5 / 1e-3};
  for (const auto &[along, value, velocity] :
       {std::tuple{"flow.capillary_number", 0.1, 2e-3}, {"capsule.radius", 0.7, 0.8e-3}}) {
    const TemporaryDirectory directory;
    Outcome outcome = outcome_with(random_checkpoint());
    outcome.along = along;
    SeriesRow row = outcome.last.series.back();
    row.v_g = 1.5;
    row.pressure_drop = 4;
    row.min_film = 0.1;
    row.length = 1.7;
    row.flow_rate = 0.7;
    row.max_tension = 0.5;
    row.max_stretch = 1.4;
    row.max_area_stretch = 1.6;
    row.front_stretch = 1.2;
    outcome.branch = {{value, row, -0.3}, {value, row, -0.2}};
    outcome.folds = {{value, row, 0}};
    write_results(directory.path, physics, outcome, {});
    std::map<std::string, double> by_hand = {{"v_g [m/s]", 1.5 * velocity},
                                             {"pressure_drop [Pa]", 4e-3 * velocity / 5e-6},
                                             {"min_film [m]", 0.5e-6},
                                             {"length [m]", 8.5e-6},
                                             {"flow_rate [m3/s]", 0.7 * velocity * std::numbers::pi * 25e-12},
                                             {"max_tension [N/m]", 0.5 * 2e-5},
                                             {"max_stretch", 1.4},
                                             {"max_area_stretch", 1.6},
                                             {"front_stretch", 1.2},
                                             {"growth_rate [s-1]", -0.2 * velocity / 5e-6}};
    if (std::string(along) == "flow.capillary_number")
      by_hand["physical.flow_rate [m3/s]"] = velocity * std::numbers::pi * 25e-12;
    const Columns columns = read_columns(directory.path / "branch_physical.csv");
    const auto fold = read_json(directory.path / "summary.json").value().at("folds").at(0).at("physical");
    BOOST_TEST(columns.at(along).at(1) == value);
    for (const auto &[name, expected] : by_hand) {
      BOOST_TEST_CONTEXT(name) {
        BOOST_TEST(columns.at(name).at(1) == expected, boost::test_tools::tolerance(1e-14));
        if (name != "growth_rate [s-1]") // 0 at a fold
          BOOST_TEST(fold.at(name).get<double>() == expected, boost::test_tools::tolerance(1e-14));
      }
    }
    BOOST_TEST(!fs::exists(directory.path / "series_physical.csv"));
  }
}

// Rates of steady states have units, too.
BOOST_AUTO_TEST_CASE(steady_states_in_physical_units) {
  const TemporaryDirectory directory;
  Case physics = pore_case();
  physics.physical.tube_radius = {5e-6};
  physics.physical.viscosity = {1e-3};
  physics.physical.flow_rate = {2e-3 * std::numbers::pi * 25e-12};
  physics.physical.shear_modulus = {2e-5};
  Outcome outcome = outcome_with(random_checkpoint());
  outcome.status = Status::steady;
  outcome.further = {{"growth_rate", -0.5}, {"growth_per_length", -0.2}, {"apparent_viscosity", 1.3}};
  physics.followers.assign(outcome.last.followers.size(), physics);
  write_results(directory.path, physics, outcome, {});
  const auto physical = read_json(directory.path / "summary.json").value().at("physical");
  for (const auto &[name, expected] : {std::pair{"growth_rate [s-1]", -200.},
                                       {"growth_per_length [m-1]", -4e4},
                                       {"apparent_viscosity [Pa.s]", 1.3e-3}})
    BOOST_TEST(physical.at(name).get<double>() == expected, boost::test_tools::tolerance(1e-14));
}

BOOST_AUTO_TEST_CASE(what_another_input_has_left_is_named) {
  const TemporaryDirectory directory;
  const Case physics = pore_case();
  const Task steady{.motion = false, .name = "steady --from there"};
  const auto other = [&](const Case &asked, const Task &task = {}) {
    return other_results(directory.path, asked, task);
  };
  BOOST_TEST(other(physics) == "");
  write_checkpoint(directory.path, run_identity(physics), {random_checkpoint(), {}});
  BOOST_TEST(other(physics) == "");
  BOOST_TEST(other(physics, steady) == "an interrupted run");
  write_results(directory.path, physics, outcome_with(random_checkpoint()), {});
  BOOST_TEST(other(physics) == "");
  BOOST_TEST(other(physics, steady) == "the results of `capsule run`");
  Case changed = physics;
  changed.title = "other words";
  BOOST_TEST(other(changed) == "");
  changed.flow.viscosity_ratio = 5;
  changed.until.x_g.reset();
  changed.until.time = 3;
  BOOST_TEST(other(changed) == "a run with flow.viscosity_ratio = 1, until.x_g = 11.84, no until.time");
  write_results(directory.path, physics, outcome_with(random_checkpoint()), {}, steady);
  BOOST_TEST(other(physics, steady) == "");
  BOOST_TEST(other(physics) == "the results of `capsule steady --from there`");
  directory.write("run.json", "{}"); // of an earlier version
  directory.write("resolved.toml", "capsule.radius = -1");
  BOOST_TEST(other(physics) == "results that cannot be read any more");
  directory.write("run.json", "{");
  BOOST_TEST(other(physics) == "results that cannot be read any more");
}

BOOST_AUTO_TEST_CASE(what_belongs_to_the_pore_is_null_without_one) {
  const TemporaryDirectory directory;
  Case physics = pore_case();
  physics.flow.type = FlowType::extension;
  write_results(directory.path, physics, outcome_with(random_checkpoint()), {});
  const Summary summary = read_summary(directory.path);
  for (const char *name : {"pressure_drop", "peak_pressure_drop", "x_g_at_peak", "min_film"})
    BOOST_TEST(summary.quantities.count(name) == 0u);
  BOOST_TEST(summary.quantities.count("deformation") == 1u);
}

// What a status says is not said twice.
BOOST_AUTO_TEST_CASE(the_reason_of_an_end) {
  BOOST_TEST((Summary{"failed", "fold", "", {}, {}}.reason()) == "fold");
  BOOST_TEST((Summary{"unbounded", "unbounded", "", {}, {}}.reason()) == "");
}

BOOST_AUTO_TEST_CASE(a_run_that_failed_at_once) {
  const TemporaryDirectory directory;
  Outcome outcome;
  outcome.failure = "touching";
  outcome.message = "at t = 0";
  write_results(directory.path, pore_case(), outcome, {});
  const Summary summary = read_summary(directory.path);
  BOOST_TEST(summary.status == "failed");
  BOOST_TEST(summary.failure == "touching");
  BOOST_TEST(summary.message == "at t = 0");
  BOOST_TEST(summary.quantities.count("v_g") == 0u);
  BOOST_TEST(lines_of(directory.path / "series.csv").size() == 1u);
}

BOOST_AUTO_TEST_CASE(results_are_shared_and_replaced) {
  const TemporaryDirectory directory;
  const fs::path one = directory.path / "one", two = directory.path / "two", other = directory.path / "other";
  make_directories(one);
  make_directories(other);
  write_results(one, pore_case(), outcome_with(random_checkpoint()), {});
  share_results(one, two);
  BOOST_TEST(entries_in(two) == entries_in(one));
  BOOST_TEST(content_of(two / "summary.json") == content_of(one / "summary.json"));
  BOOST_TEST(fs::hard_link_count(two / "summary.json") == 1u);
  share_results(one, two);
  BOOST_TEST(entries_in(two) == entries_in(one));

  // Another run with fewer profiles leaves nothing of the first.
  Checkpoint shorter = random_checkpoint();
  shorter.profiles.pop_back();
  write_results(other, pore_case(), outcome_with(shorter), {});
  const auto keep = two / "notes.txt";
  std::ofstream(keep) << "mine";
  share_results(other, two);
  BOOST_TEST(!fs::exists(two / "membrane_0001.vtp"));
  BOOST_TEST(fs::exists(keep));
  BOOST_TEST(content_of(two / "series.csv") == content_of(other / "series.csv"));
  BOOST_TEST(is_complete(two));
  BOOST_TEST(set_aside_altered(two).empty());
  for (const char *left : {".writing-summary.json.123", ".writing-summary.json", ".writing-checkpoint.json"})
    std::ofstream(two / left) << "{";
  remove_results(two);
  BOOST_TEST(entries_in(two) == 1u);
}
