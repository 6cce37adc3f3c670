// What commands remark on the runs that they have computed.
#include "program/commands.hpp"
#include <boost/test/unit_test.hpp>

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
  results[2].input.physics.pore.shape = PoreShape::none;
  results[2].input.physics.until.x_g.reset();
  results[2].input.physics.until.time = 3;
  BOOST_TEST(unsteady_remark({results[2]}).find("until.time") != std::string::npos);
  results[2].summary.reset(); // interrupted
  BOOST_TEST(unsteady_remark({results[2]}) == "");
}
