// What is remarked on runs that were computed.
#include "program/remarks.hpp"
#include "temporary_directory.hpp"
#include <boost/test/unit_test.hpp>
#include <fstream>

using namespace capsule;

BOOST_AUTO_TEST_CASE(marches_that_end_before_they_are_steady_are_remarked) {
  std::vector<RunResult> results;
  for (const double residual : {0.5e-4, 2e-4, 3.4e-2}) {
    RunResult result{{}, "", Summary{}};
    result.input.physics.until.x_g = 12;
    result.summary->status = "reached";
    result.summary->quantities = {
        {"max_axial_residual", residual}, {"max_radial_velocity", 1e-5}, {"x_g", 11.84}};
    results.push_back(result);
  }
  const std::string two = unsteady_remark(results);
  BOOST_TEST(two.find("2 of 3 runs") != std::string::npos);
  BOOST_TEST(two.find("up to 0.034") != std::string::npos);
  BOOST_TEST(two.find("until.x_g") != std::string::npos);
  BOOST_TEST(unsteady_remark({results[0]}) == "");
  results[0].input.physics.accuracy = 1e-5;
  BOOST_TEST(unsteady_remark({results[0]}).find("with 5e-05") != std::string::npos);
  results[1].summary->status = "failed";
  results[2].summary->quantities["x_g"] = -1; // not in the pore yet
  BOOST_TEST(unsteady_remark({results[1], results[2]}) == "");
  // Whatever the rounding of its end; its rear is in the mouth.
  for (const double x_g : {-1e-15, 0.0, 1e-15}) {
    results[2].summary->quantities["x_g"] = x_g;
    results[2].summary->quantities["length"] = 1.6;
    BOOST_TEST(unsteady_remark({results[2]}) == "");
  }
  results[2].summary->quantities["x_g"] = 0.81;
  BOOST_TEST(unsteady_remark({results[2]}) != "");
  // A follower moves, too, but for one in the mouth.
  RunResult pair = results[0];
  pair.input.physics.accuracy = 1e-4;
  pair.input.physics.followers.resize(1);
  pair.summary->quantities["max_axial_residual#2"] = 3e-4;
  pair.summary->quantities["x_g#2"] = -1;
  BOOST_TEST(unsteady_remark({pair}) == "");
  pair.summary->quantities["x_g#2"] = 5;
  BOOST_TEST(unsteady_remark({pair}).find("with 0.0003") != std::string::npos);
  BOOST_TEST(unsteady_remark({results[2]}).find("`capsule steady`") != std::string::npos);
  BOOST_TEST(unsteady_remark({pair}).find("`capsule steady`") == std::string::npos); // which refuses a pair
  // The key that ended the march.
  pair.input.physics.until.x_g.reset();
  pair.input.physics.until.last_x_g = 5;
  pair.input.physics.until.time = 9;
  pair.summary->quantities["time"] = 8.5;
  BOOST_TEST(unsteady_remark({pair}).find("a larger until.last_x_g") != std::string::npos);
  pair.summary->quantities["time"] = 9;
  BOOST_TEST(unsteady_remark({pair}).find("a larger until.time") != std::string::npos);
  results[2].input.physics.pore.shape = PoreShape::none;
  results[2].input.physics.until.x_g.reset();
  results[2].input.physics.until.time = 3;
  BOOST_TEST(unsteady_remark({results[2]}).find("until.time") != std::string::npos);
  results[2].summary.reset(); // interrupted
  BOOST_TEST(unsteady_remark({results[2]}) == "");
}

BOOST_AUTO_TEST_CASE(routes_that_part_at_the_outlet_are_remarked) {
  RunResult result{{}, "", Summary{}};
  result.summary->status = "reached";
  result.summary->quantities = {{"pressure_drop", 20.1}, {"pressure_drop_reciprocal", 20.0}};
  BOOST_TEST(outlet_remark({result}) == "");
  RunResult near = result;
  near.summary->quantities["pressure_drop"] = 60;
  BOOST_TEST(outlet_remark({near}).find("differ by 200 %, of") != std::string::npos);
  BOOST_TEST(outlet_remark({near, result}).find("or less in 1 of 2 runs") != std::string::npos);
  near.summary->quantities.erase("pressure_drop_reciprocal"); // the paper's preset has one route
  BOOST_TEST(outlet_remark({near}) == "");
}

BOOST_AUTO_TEST_CASE(wrinkles_on_the_way_are_remarked) {
  const TemporaryDirectory directory;
  RunResult result{{}, directory.path, Summary{}};
  BOOST_TEST(wrinkle_remark({result}) == ""); // no series
  std::ofstream(directory.path / "series.csv") << "x_g,dents\n1.5,2\n1.55,3\n2,4\n2.05,2\n";
  BOOST_TEST(wrinkle_remark({result}).find("up to 4 dents between x_g = 1.55 and 2;") != std::string::npos);
  RunResult physical = result; // its key is named as the case has it
  physical.input.physics.physical.tube_radius = {5e-6};
  physical.input.physics.physical.viscosity = {1e-3};
  physical.input.physics.physical.shear_modulus = {1e-5};
  physical.input.physics.physical.flow_rate = {1e-13};
  physical.input.physics.physical.bending_modulus = {1e-15};
  BOOST_TEST(wrinkle_remark({result}).find("a larger membrane.bending_ratio smooths it") !=
             std::string::npos);
  BOOST_TEST(wrinkle_remark({physical}).find("a larger physical.bending_modulus smooths it") !=
             std::string::npos);
  BOOST_TEST(wrinkle_remark({result, {{}, "", Summary{}}}).find("in 1 of 2 runs") != std::string::npos);
  BOOST_TEST(wrinkle_remark({result}).find("estimates") == std::string::npos); // there are none
  result.summary->error_estimate = {{"v_g", 1e-4}};
  BOOST_TEST(wrinkle_remark({result}).find("errors there may exceed their estimates") != std::string::npos);
  std::ofstream(directory.path / "series.csv") << "x_g,dents\n1.5,2\n1.55,3\n";
  BOOST_TEST(wrinkle_remark({result}).find("up to 3 dents at x_g = 1.55;") != std::string::npos);
  std::ofstream(directory.path / "series.csv") << "x_g,dents\n1.5,2\n";
  BOOST_TEST(wrinkle_remark({result}) == "");
}

BOOST_AUTO_TEST_CASE(states_beyond_what_the_membrane_bears_are_remarked) {
  const TemporaryDirectory directory;
  RunResult result{{}, directory.path, Summary{}};
  UntilSpec &until = result.input.physics.until;
  until.tension = 0.5;
  BOOST_TEST(bearing_remark({result}) == ""); // no state
  std::ofstream(directory.path / "series.csv") << "max_area_stretch,max_tension\n1.6,0.8\n";
  BOOST_TEST(bearing_remark({result}).find("bears: max_tension = 0.8, until.tension = 0.5;") !=
             std::string::npos);
  BOOST_TEST(bearing_remark({result, {{}, "", Summary{}}}).find("in 1 of 2 runs") != std::string::npos);
  until.area_stretch = 1.2;
  BOOST_TEST(bearing_remark({result}).find("max_area_stretch = 1.6, until.area_stretch = 1.2") !=
             std::string::npos);
  until.area_stretch = 1.7;
  until.tension = 0.9;
  BOOST_TEST(bearing_remark({result}) == "");
  result.summary->along = "capsule.radius"; // where along a branch
  std::ofstream(directory.path / "branch.csv")
      << "capsule.radius,max_area_stretch,max_tension\n0.7,1.6,0.8\n0.75,1.8,0.85\n0.8,1.9,0.95\n";
  BOOST_TEST(bearing_remark({result}).find("max_area_stretch = 1.8 at capsule.radius = 0.75, until") !=
             std::string::npos);
}
