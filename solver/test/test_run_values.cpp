// What names mean in a run: summary, series, profiles, keys; other runs and cases; errors carried through.
#include "base/failure.hpp"
#include "compare/reference_units.hpp"
#include "compare/run_values.hpp"
#include "law/skalak.hpp"
#include "observe/quantities.hpp"
#include "temporary_directory.hpp"
#include <array>
#include <boost/test/unit_test.hpp>
#include <fmt/format.h>
#include <numbers>

using namespace capsule;

namespace {

// Two runs of the case "here" and one of the case "there".
struct Project : TemporaryDirectory {
  RunTable table;

  RunResult run(double viscosity_ratio, double v_g) const {
    RunResult result;
    result.input.physics.flow.viscosity_ratio = viscosity_ratio;
    result.input.physics.capsule.radius = 0.9;
    result.input.physics.membrane.law = skalak;
    result.directory = path;
    result.summary =
        Summary{"reached", "", "", {{"v_g", v_g}, {"roughness", 0.5}}, {{"v_g", 0.01}, {"v_g@x_g", 0.02}}};
    return result;
  }

  Project() {
    write("series.csv", "time,x_g,v_g\n0,-4,1\n10,-2,3\n20,6,2\n");
    write("profiles.csv", "time,x_g,S,x,r\n0,-4,0,-5,0\n0,-4,1,-4,1\n0,-4,2,-3,0\n"
                          "20,6,0,5,0\n20,6,1,6,0.5\n20,6,2,7,0\n");
    table.add("here", {run(1, 2), run(5, 4)});
    table.add("there", {run(1, 8)});
  }

  double value(const std::string &text, std::size_t which = 0) const {
    return Expression(text).value([&](const Reference &reference) {
      return table.values(reference, "here", &table.runs_of("here").at(which));
    });
  }
  std::string nothing(const std::string &text) const {
    try {
      value(text);
    } catch (const NoValue &reason) {
      return reason.what();
    }
    return "a value";
  }
};

} // namespace

BOOST_FIXTURE_TEST_CASE(of_the_end_and_of_the_input, Project) {
  BOOST_TEST(value("v_g") == 2);
  BOOST_TEST(value("v_g", 1) == 4);
  BOOST_TEST(value("capsule.radius*radius") == 0.81, boost::test_tools::tolerance(1e-14));
  BOOST_TEST(nothing("law") == "no value"); // no number
}

// A misspelt name, of anything that may stand there.
BOOST_FIXTURE_TEST_CASE(a_name_that_was_meant, Project) {
  for (const auto &[text, name, meant] :
       {std::array{"v_h", "v_h", "v_g"},
        {"rougness", "rougness", "roughness"},
        {"radus", "radus", "radius"},
        {"flow.viscosity_rato", "flow.viscosity_rato", "flow.viscosity_ratio"},
        {"v_h@x_g=1", "v_h", "v_g"},
        {"v_g@tim=15", "tim", "time"},
        {"max(x@tim=0)", "tim", "time"}})
    BOOST_TEST(nothing(text) == fmt::format("no value '{}'; did you mean '{}'?", name, meant), text);
  for (const char *name : {"C", "q", "something_else"})
    BOOST_TEST(nothing(name) == fmt::format("no value '{}'", name));
  BOOST_TEST(nothing("roughness@time=3") == "no value 'roughness'"); // of the end only
}

// A run with a physical quantity goes by any spelling of it, and by its name.
BOOST_AUTO_TEST_CASE(quantities_choose_runs) {
  Case physics;
  physics.physical.flow_rate.si = 1e-14;
  for (const char *text :
       {"flow_rate=10 pl/s", "physical.flow_rate=0.01 nL/s", "flow_rate=10pl_per_s", "flow_rate=1e-14"})
    BOOST_TEST(Selector(text).selects(physics), text);
  for (const char *text : {"flow_rate=10 nl/s", "flow_rate=10 pl", "flow_rate=1e-13", "viscosity=1 Pa.s"})
    BOOST_TEST(!Selector(text).selects(physics), text);
}

BOOST_FIXTURE_TEST_CASE(along_the_way, Project) {
  BOOST_TEST(value("x_g@time=15") == 2);
  BOOST_TEST(value("x_g@time=10") == -2);
  BOOST_TEST(value("v_g@x_g=-3") == 2);
  BOOST_TEST(value("time@v_g=2.5") == 7.5); // the first time it passes
  BOOST_TEST(value("max(v_g@x_g=-3..100)") == 3);
  BOOST_TEST(value("min(v_g@x_g=-3..100)") == 2);
  BOOST_TEST(value("min(v_g@x_g=-4..-3)") == 1);
  BOOST_TEST(nothing("max(v_g@x_g=7..8)") == "no value");
  for (const char *text : {"x_g@time=20.1", "v_g@x_g=0@time=1"})
    BOOST_TEST(nothing(text) == "no value", text);
}

BOOST_FIXTURE_TEST_CASE(on_the_meridian, Project) {
  BOOST_TEST(value("max(x)") == 7);
  BOOST_TEST(value("max(x@time=0)") == -3);
  BOOST_TEST(value("r@S=1.5") == 0.25);
  BOOST_TEST(value("r@x_g=-4@S=0.5") == 0.5);
  BOOST_TEST(value("max(x@x_g=-4@S=0..0.5)") == -4.5);
  BOOST_TEST(value("distance(x@time=0, r@time=0, x - 10, r)") == 0.5); // the end is the flatter
  BOOST_TEST(nothing("max(x@time=3)") == "no value");
}

BOOST_FIXTURE_TEST_CASE(of_other_runs, Project) {
  BOOST_TEST(value("v_g{viscosity_ratio=5}/v_g") == 2);
  BOOST_TEST(value("v_g{there: }/v_g") == 4);
  BOOST_TEST(value("v_g{there: viscosity_ratio=1}/v_g{flow.viscosity_ratio=1.0; law=skalak}") == 4);
  BOOST_TEST(value("max(v_g{viscosity_ratio=1|5|10})") == 4);
  BOOST_TEST(value("max(v_g{})") == 4);
  BOOST_TEST(value("error_estimate.v_g") == 0.01);
  BOOST_TEST(value("error_estimate.v_g@x_g=0") == 0.02);
  BOOST_TEST(nothing("error_estimate.roughness") == "no value 'error_estimate.roughness'");
  BOOST_TEST(nothing("v_g{viscosity_ratio=10}") == "no such run");
  BOOST_TEST(nothing("v_g{law=neo-hookean}") == "no such run");
  BOOST_TEST(nothing("v_g{nowhere: }") == "no such run");
  BOOST_TEST(nothing("v_g{}") == "several values");
  BOOST_CHECK_THROW(value("v_g{size=10}"), InputError);
}

// A tube of 5 um and water at a speed of 2 mm/s: pressures in units of 1e-3 * 2e-3/5e-6 = 0.4 Pa.
struct PhysicalProject : Project {
  PhysicalProject() {
    RunResult result = run(1, 2);
    Case &physics = result.input.physics;
    physics.physical.tube_radius.si = 5e-6;
    physics.physical.viscosity.si = 1e-3;
    physics.physical.flow_rate.si = 2e-3 * std::numbers::pi * 25e-12;
    physics.physical.shear_modulus.si = 1e-5;
    result.summary->quantities.insert({{"pressure_drop", 3},
                                       {"peak_pressure_drop", 5},
                                       {"transit_time", 4},
                                       {"largest_tension", 0.5},
                                       {"S_at_largest_tension", 1},
                                       {"resistance", 1},
                                       {"empty_resistance", 2},
                                       {"pressure_drop#2", 6}});
    result.summary->error_estimate["pressure_drop"] = 0.1;
    result.input.physics.followers.push_back(physics);
    table.add("here", {result, run(5, 4)});
  }
};

BOOST_FIXTURE_TEST_CASE(in_units, PhysicalProject) {
  const std::pair<const char *, double> by_hand[] = {{"pressure_drop [Pa]", 1.2},
                                                     {"pressure_drop [mPa]/1000", 1.2},
                                                     {"peak_pressure_drop [dyn/cm^2]", 20},
                                                     {"pressure_drop#2 [Pa]", 2.4},
                                                     {"transit_time [ms]", 10},
                                                     {"largest_tension [mN/m]", 5e-3},
                                                     {"S_at_largest_tension [um]", 5},
                                                     {"error_estimate.pressure_drop [Pa]", 0.04},
                                                     {"v_g [mm/s]@x_g [um]=-15", 4},
                                                     {"max(v_g [mm/s]@x_g [m]=-15e-6..500e-6)", 6},
                                                     {"time [ms]@v_g [mm/s]=5", 18.75},
                                                     {"v_g [mm/s]{viscosity_ratio=1}@x_g=-3", 4},
                                                     {"x_g[um]@time[ms]=25", -10},
                                                     {"max(x [um])", 35},
                                                     {"r [um]@x_g [um]=-20@S [um]=2.5", 2.5},
                                                     {"physical.viscosity [mPa.s]", 1},
                                                     {"viscosity [cP]", 1},
                                                     {"physical.viscosity", 1e-3}};
  for (const auto &[text, expected] : by_hand)
    BOOST_TEST_CONTEXT(text)
  BOOST_TEST(value(text) == expected, boost::test_tools::tolerance(1e-12));
  BOOST_TEST(nothing("v_g [mm/s]{viscosity_ratio=5}") == "not in physical units");
  BOOST_TEST(nothing("resistance [Mohm]") == "no resistivity");
  const auto error =
      table.error_estimate(Expression("2*pressure_drop [mPa]"), "here", &table.runs_of("here").at(0));
  BOOST_TEST(error.value() == 80, boost::test_tools::tolerance(1e-12));
}

BOOST_AUTO_TEST_CASE(units_are_checked) {
  const auto mistake = [](const std::string &text) -> std::string {
    try {
      for (const Reference &reference : Expression(text).references())
        check_units(reference);
    } catch (const InputError &error) {
      return error.what();
    }
    return "none";
  };
  for (const ReportedQuantity &quantity : reported_quantities())
    if (quantity.unit)
      BOOST_TEST(mistake(name_with_unit(quantity.name, *quantity.unit)) == "none");
  BOOST_TEST(mistake("deformation [m]") == "'deformation' has no unit");
  BOOST_TEST(mistake("v_g@deformation [m]=1") == "'deformation' has no unit");
  BOOST_TEST(mistake("capsule.radius [um]") == "'capsule.radius' has no unit");
  BOOST_TEST(mistake("pressure_drop [m]") == "pressure_drop [m]: '1 m' is a length, not a pressure");
  BOOST_TEST(mistake("v_g [mm/sec]") == "none");
  BOOST_TEST(mistake("pressure_drop [Paa]") ==
             "pressure_drop [Paa]: unknown unit 'Paa' in '1 Paa', did you mean '[Pa]'?");
}

// Each value's own error, added: 0.01/2 + 4 * 0.01/4 for the quotient 4/2 of two runs.
BOOST_FIXTURE_TEST_CASE(errors_add, Project) {
  const auto error = [&](const std::string &text) {
    return table.error_estimate(Expression(text), "here", &table.runs_of("here").at(0));
  };
  BOOST_TEST(error("3*v_g").value() == 0.03, boost::test_tools::tolerance(1e-12));
  BOOST_TEST(error("v_g{viscosity_ratio=5}/v_g").value() == 0.005 + 0.01, boost::test_tools::tolerance(0.01));
  BOOST_TEST(error("v_g - v_g").value() == 0.02, boost::test_tools::tolerance(1e-12));
  BOOST_TEST(error("max(v_g{}) - min(v_g{})").value() == 0.02, boost::test_tools::tolerance(1e-12));
  BOOST_TEST(error("v_g@x_g=0").value() == 0.02, boost::test_tools::tolerance(1e-12));
  BOOST_TEST(error("radius^3").value() == 0);
  BOOST_TEST(!error("roughness"));
  BOOST_TEST(!error("v_g@time=3")); // estimated at equal x_g
  BOOST_TEST(!error("v_g{viscosity_ratio=10}"));
}
