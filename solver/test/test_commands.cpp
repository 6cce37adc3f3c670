// What commands remark on the runs that they are to compute.
#include "program/computation.hpp"
#include <boost/test/unit_test.hpp>

using namespace capsule;

BOOST_AUTO_TEST_CASE(flows_that_no_membrane_resists_are_remarked) {
  CaseInput input{"capsule", "", std::vector<RunInput>(2)};
  input.runs[0].physics.flow.capillary_number = 1;
  input.runs[1].physics.flow.capillary_number = 0.05;
  BOOST_TEST(strong_flow_remark(input) == "");
  input.runs[1].physics.flow.capillary_number = 5e7;
  BOOST_TEST(strong_flow_remark(input).find("flow.capillary_number = 5e+07: ") == 0u);
}
