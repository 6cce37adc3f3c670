// Cases in physical units: groups and scales by hand, and where contradictions are said.
#include "base/failure.hpp"
#include "case/case_file.hpp"
#include "case/identity.hpp"
#include "case/key_path.hpp"
#include "case/keys.hpp"
#include "case/physical.hpp"
#include "temporary_directory.hpp"
#include <algorithm>
#include <array>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <fstream>
#include <iterator>
#include <numbers>
#include <variant>

using namespace capsule;

namespace {

// A red cell's size and stiffness in a capillary, in the units of a laboratory.
const std::string laboratory = "[physical]\n"
                               "tube_radius = \"5 um\"\n"
                               "viscosity = \"1 mPa.s\"\n"
                               "flow_rate = \"0.1 nl/s\"\n"
                               "shear_modulus = \"0.02 mN/m\"\n"
                               "bending_modulus = \"5 fJ\"\n"
                               "capsule_radius = \"4 um\"\n"
                               "internal_viscosity = \"6 cP\"\n"
                               "[membrane]\n"
                               "law = \"neo-hookean\"\n";

Case only_run(const std::string &text, const std::vector<std::string> &overrides = {}) {
  const TemporaryDirectory directory;
  std::ofstream(directory.path / "case.toml") << text;
  return read_case(directory.path, overrides).runs.at(0).physics;
}

// The message of what is refused.
std::string complaint(const std::string &text, const std::vector<std::string> &overrides = {}) {
  try {
    only_run(text, overrides);
  } catch (const InputError &error) {
    return error.what();
  }
  return "";
}

bool contains(const std::string &text, const std::string &part) {
  return text.find(part) != std::string::npos;
}

std::string replaced(std::string text, const std::string &from, const std::string &to) {
  return text.replace(text.find(from), from.size(), to);
}

std::size_t error_count(const std::string &message) {
  std::size_t count = 0;
  for (std::size_t at = message.find(": error: "); at != std::string::npos;
       at = message.find(": error: ", at + 1))
    ++count;
  return count;
}

const auto tolerance = boost::test_tools::tolerance(1e-12);

} // namespace

// eps = mu Q/(pi R_t^2 G), lambda, delta = D/(G R_t^2), by hand.
BOOST_AUTO_TEST_CASE(dimensionless_groups_follow) {
  const Case physics = only_run(laboratory);
  BOOST_TEST(physics.flow.capillary_number == 1e-3 * 1e-13 / (std::numbers::pi * 25e-12 * 2e-5), tolerance);
  BOOST_TEST(physics.flow.viscosity_ratio == 6);
  BOOST_TEST(physics.membrane.bending_ratio == 5e-15 / (2e-5 * 25e-12), tolerance);
  BOOST_TEST(physics.capsule.radius == 0.8);
}

// mu_s/(mu R_t) and kappa_s/(mu R_t): a red cell's membrane in a pore of 5 um.
BOOST_AUTO_TEST_CASE(surface_viscosities_follow) {
  const Case physics = only_run(
      replaced(laboratory, "5 um", "2.5 um"),
      {"physical.membrane_shear_viscosity=0.5 uN.s/m", "physical.membrane_dilatational_viscosity=1 pN.s/um"});
  BOOST_TEST(physics.membrane.viscosity.shear == 200, tolerance);
  BOOST_TEST(physics.membrane.viscosity.dilatational == 400, tolerance);
}

// A mean velocity turns a length into a time, and Poiseuille's law a velocity into a pressure gradient of 8.
BOOST_AUTO_TEST_CASE(scales_turn_results_back) {
  const Scales scales = physical_scales(only_run(laboratory));
  const double mean_velocity = 1e-13 / (std::numbers::pi * 25e-12);
  BOOST_TEST(scales.length == 5e-6, tolerance);
  BOOST_TEST(scales.velocity == mean_velocity, tolerance);
  BOOST_TEST(scales.time == 5e-6 / mean_velocity, tolerance);
  BOOST_TEST(8 * scales.pressure / scales.length == 8 * 1e-3 * mean_velocity / 25e-12, tolerance);
  BOOST_TEST(scales.tension == 2e-5, tolerance);
  BOOST_TEST(scales.flow_rate == 1e-13, tolerance);
}

// In a long tube the mouth counts for little and Poiseuille's law gives the flow rate; a longer tube halves it.
BOOST_AUTO_TEST_CASE(a_pressure_drives_the_flow) {
  const std::string driven = "physical.tube_radius = \"5 um\"\nphysical.viscosity = \"1 mPa.s\"\n"
                             "physical.pressure = \"100 Pa\"\nphysical.pore_length = \"5 mm\"\n"
                             "physical.young_modulus = \"0.06 mN/m\"\ncapsule.radius = 0.8\n"
                             "membrane.law = \"neo-hookean\"\n";
  const double poiseuille = std::numbers::pi * 100 * std::pow(5e-6, 4) / (8 * 1e-3 * 5e-3);
  const Scales scales = physical_scales(only_run(driven));
  BOOST_TEST(scales.velocity == poiseuille / (std::numbers::pi * 25e-12), boost::test_tools::tolerance(1e-3));
  BOOST_TEST(scales.velocity < poiseuille / (std::numbers::pi * 25e-12)); // the mouth costs something
  BOOST_TEST(scales.tension == 2e-5, tolerance);
}

// mu Q/(pi R_t^3) P_empty, with the loss of a mouth by another program (scenes.md): once, or twice between two mouths.
BOOST_AUTO_TEST_CASE(the_empty_pore_sets_the_flow_rate) {
  constexpr double mouth = 4.924572;
  const std::string driven = "physical.tube_radius = \"12.5 um\"\nphysical.viscosity = \"1 mPa.s\"\n"
                             "physical.pressure = \"500 Pa\"\nphysical.shear_modulus = \"2 mN/m\"\n"
                             "capsule.radius = 0.8\nmembrane.law = \"neo-hookean\"\n";
  const auto drop = [&](const std::vector<std::string> &overrides) {
    const Case physics = only_run(driven, overrides);
    return 500 / physical_scales(physics).pressure;
  };
  const auto close = boost::test_tools::tolerance(2e-7);
  BOOST_TEST(drop({"pore.shape=two-mouths", "physical.pore_length=75 um"}) == 8 * 6 + 2 * mouth, close);
  BOOST_TEST(drop({"pore.shape=two-mouths", "pore.exit_x=6"}) == 8 * 6 + 2 * mouth, close);
  BOOST_TEST(drop({"flow.drive=pressure"}) == 8 * 15 + mouth, close);
  BOOST_TEST(drop({"physical.pore_length=75 um"}) == 8 * 6 + mouth, close);
  BOOST_TEST(drop({"pore.shape=tube", "flow.drive=pressure", "capsule.start_x=1"}) == 8 * (15 + 30), close);
}

// The length of a pore whose pressure stays constant, or with two mouths, is that of the pore that is computed.
BOOST_AUTO_TEST_CASE(the_length_of_the_whole_pore) {
  std::string driven = replaced(laboratory, "flow_rate = \"0.1 nl/s\"", "pressure = \"20 Pa\"");
  driven = replaced(driven, "viscosity", "pore_length = \"100 um\"\nviscosity");
  BOOST_TEST(only_run(driven).pore.exit_x == 15);
  BOOST_TEST(only_run(driven, {"flow.drive=pressure"}).pore.exit_x == 20);
  BOOST_TEST(only_run(driven, {"pore.shape=two-mouths"}).pore.exit_x == 20);
  BOOST_TEST(only_run(driven, {"pore.shape=tube", "flow.drive=pressure", "pore.entrance_distance=5",
                               "capsule.start_x=2"})
                 .pore.exit_x == 15);
  BOOST_TEST(contains(complaint(driven, {"pore.shape=two-mouths", "pore.exit_x=15"}),
                      "pore.exit_x = 15, but physical.pore_length makes it 20"));
  BOOST_TEST(contains(complaint(replaced(driven, "100 um", "8 um")),
                      "physical.pressure sets no flow rate in a pore of 1.6 radii"));
  const Case physics = only_run(driven);
  BOOST_TEST(contains(flow_rate_text(physics, physics.flow.capillary_number), "e-14 m3/s"));
}

// Also of a case whose flow was made weaker, as on the way to a steady state.
BOOST_AUTO_TEST_CASE(the_flow_rate_at_a_capillary_number) {
  Case physics = only_run(laboratory);
  const double own = physics.flow.capillary_number;
  BOOST_TEST(flow_rate_text(physics, 2 * own) == "0.2 nl/s");
  physics.flow.capillary_number = own / 4;
  BOOST_TEST(flow_rate_text(physics, 2 * own) == "0.2 nl/s");
  physics.physical.shear_modulus = {};
  BOOST_TEST(flow_rate_text(physics, 2 * own).empty());
}

// rho/(pi R_t), of a pore radius of empty tube.
// What is derived from it, and back, in the unit in which the case has it.
BOOST_AUTO_TEST_CASE(quantities_of_a_dimensionless_key) {
  const Case physics = only_run(laboratory);
  const auto check = [&](const Case &input, const char *key, const char *name, double si, const char *text) {
    const std::vector<Physical> all = physical_of(input, key, 2 * number(key, input));
    BOOST_REQUIRE(!all.empty());
    BOOST_TEST(all.back().key == name);
    BOOST_TEST(all.back().si == 2 * si, tolerance);
    BOOST_TEST(all.back().text == text);
  };
  check(physics, "flow.capillary_number", "physical.flow_rate", 1e-13, "0.2 nl/s");
  check(physics, "capsule.radius", "physical.capsule_radius", 4e-6, "8 um");
  check(physics, "membrane.bending_ratio", "physical.bending_modulus", 5e-15, "10 fJ");
  BOOST_TEST(physical_of(physics, "flow.viscosity_ratio", 1).empty());
  BOOST_TEST(physical_keys_of("flow.viscosity_ratio").empty());
  std::vector<std::string> of_parameters; // branches go along what these are keys of
  for (const std::string &key : parameters_of_steady_states())
    std::ranges::copy(physical_keys_of(key), std::back_inserter(of_parameters));
  std::vector<std::string> all = physical_keys();
  std::ranges::sort(of_parameters);
  std::ranges::sort(all);
  BOOST_TEST(all == of_parameters, boost::test_tools::per_element());
  for (const std::string &name : all)
    BOOST_TEST(std::holds_alternative<Measured>(find_key(name)->field), name);
  const Case driven = only_run(
      replaced(laboratory, "flow_rate = \"0.1 nl/s\"", "pressure = \"20 Pa\"\npore_length = \"100 um\""));
  check(driven, "flow.capillary_number", "physical.pressure", 20, "40 Pa");
}

// Advice names what stands in the case.
BOOST_AUTO_TEST_CASE(advice_names_the_keys_of_the_case) {
  const std::string advice =
      "a larger membrane.bending_ratio, a smaller flow.capillary_number or capsule.radius";
  BOOST_TEST(with_physical_keys(advice, only_run(laboratory)) ==
             "a larger physical.bending_modulus, a smaller physical.flow_rate or physical.capsule_radius");
  BOOST_TEST(with_physical_keys(advice, only_run(replaced(laboratory, "bending_modulus = \"5 fJ\"\n", ""))) ==
             "a larger membrane.bending_ratio, a smaller physical.flow_rate or physical.capsule_radius");
  BOOST_TEST(with_physical_keys(advice, Case{}) == advice);
}

BOOST_AUTO_TEST_CASE(the_liquid_s_resistivity_is_the_scale_of_resistances) {
  BOOST_TEST(physical_scales(only_run(laboratory)).resistance == 0); // unknown
  const std::string conducting = "output.resistance = true\n" + laboratory;
  BOOST_TEST(physical_scales(only_run(conducting, {"physical.resistivity=65 ohm.cm"})).resistance ==
                 0.65 / (std::numbers::pi * 5e-6),
             tolerance);
  BOOST_TEST(contains(complaint(laboratory, {"physical.resistivity=0.65 ohm.m"}),
                      "--set:1:22: error: physical.resistivity means nothing without output.resistance"));
}

BOOST_AUTO_TEST_CASE(the_resolved_case_gives_the_same_case_again) {
  const Case physics = only_run(laboratory);
  const std::string resolved = resolved_toml(physics);
  BOOST_TEST(resolved_toml(only_run(resolved)) == resolved);
  BOOST_TEST(run_identity(only_run(resolved)) == run_identity(physics));
}

// Shown as it was typed; another spelling is no other run.
BOOST_AUTO_TEST_CASE(a_spelling_is_kept_and_makes_no_difference) {
  const Case physics = only_run(laboratory), again = only_run(replaced(laboratory, "5 um", "5e-3 mm"));
  BOOST_TEST(contains(resolved_toml(physics), "tube_radius = \"5 um\"\n"));
  BOOST_TEST(contains(resolved_toml(again), "tube_radius = \"5e-3 mm\"\n"));
  BOOST_TEST(run_identity(again) == run_identity(physics));
  BOOST_TEST(run_identity(only_run(replaced(laboratory, "5 um", "6 um"))) != run_identity(physics));
}

// A group that stands beside what it follows from may be rounded to four digits; what follows is taken.
BOOST_AUTO_TEST_CASE(a_rounded_group_agrees) {
  const double exact = only_run(laboratory).flow.capillary_number; // 0.0636619...
  BOOST_TEST(only_run(laboratory, {"flow.capillary_number=0.06366"}).flow.capillary_number == exact);
  BOOST_TEST(only_run(laboratory, {"capsule.radius=0.8003"}).capsule.radius == 0.8);
  BOOST_TEST(
      contains(complaint(laboratory, {"flow.capillary_number=0.0636"}), "let them agree to four digits"));
}

// rho Q/(pi R_t mu): 1000 1e-13/(pi 5e-6 1e-3) with water, ten times the flow rate and three of the density beyond 0.1.
BOOST_AUTO_TEST_CASE(the_reynolds_number_of_the_outer_liquid) {
  const double of_water = 1000 * 1e-13 / (std::numbers::pi * 5e-6 * 1e-3);
  BOOST_TEST(reynolds_number(only_run(laboratory)) == of_water, tolerance);
  BOOST_TEST(reynolds_text(only_run(laboratory)) ==
             "the Reynolds number is 0.0064 (of a liquid of 1000 kg/m3)");
  BOOST_TEST(is_inertia_small(only_run(laboratory)));
  const Case heavy = only_run(laboratory, {"physical.flow_rate=1 nl/s", "physical.density=3 g/ml"});
  BOOST_TEST(reynolds_number(heavy) == 30 * of_water, tolerance);
  BOOST_TEST(!is_inertia_small(heavy));
  BOOST_TEST(contains(reynolds_text(heavy), "0.19 (of a liquid of 3 g/ml): not small"));
  BOOST_TEST(
      contains(complaint("capsule.radius = 0.8\nmembrane.law = \"skalak\"\nflow.capillary_number = 0.1\n"
                         "physical.density = \"1 g/cm3\"\n"),
               "missing key 'physical.tube_radius'"));
}

BOOST_AUTO_TEST_CASE(contradictions_are_located) {
  const std::string twice = complaint(laboratory, {"flow.capillary_number=0.1"});
  BOOST_TEST(contains(twice, "--set:1:"));
  BOOST_TEST(contains(twice, "flow.capillary_number = 0.1, but physical.flow_rate makes it 0.06366"));
  BOOST_TEST(contains(complaint(laboratory, {"physical.pressure=1 Pa"}),
                      "--set:1:19: error: physical.flow_rate and physical.pressure exclude each other"));
  BOOST_TEST(contains(complaint(laboratory, {"physical.pressure=1 Pa"}),
                      "--set:1:19: error: physical.pressure needs physical.pore_length"));
  BOOST_TEST(contains(complaint(laboratory, {"physical.pore_length=1 mm"}),
                      "--set:1:22: error: physical.pore_length means nothing without physical.pressure"));
  BOOST_TEST(contains(complaint(laboratory, {"physical.tube_radius=5 s"}), "'5 s' is a time, not a length"));
  BOOST_TEST(contains(complaint(laboratory, {"physical.tube_radius=5"}), "a number with its unit in quotes"));
}

// All that is missing is told at once, and nothing that would have followed from it.
BOOST_AUTO_TEST_CASE(what_is_missing_is_located) {
  const std::string told = complaint(
      "physical.tube_radius = \"5 um\"\nphysical.capsule_radius = \"4 um\"\nmembrane.law = \"skalak\"\n");
  for (const char *key : {"'physical.viscosity'", "'physical.flow_rate', or 'physical.pressure'",
                          "'physical.shear_modulus', or 'physical.young_modulus'"})
    BOOST_TEST(contains(told, std::string("case.toml:1:24: error: missing key ") + key), told);
  BOOST_TEST(error_count(told) == 3);
}

// One mistake, one error, and every mistake has its own.
BOOST_AUTO_TEST_CASE(what_would_follow_from_a_wrong_quantity_is_not_missed) {
  for (const auto &[from, to, message] :
       {std::array{"5 um", "5 umm", "2:15: error: physical.tube_radius: unknown unit 'umm' in '5 umm'"},
        std::array{"nl/s", "nl",
                   "4:13: error: physical.flow_rate: '0.1 nl' is a quantity in m3, not a flow rate"},
        std::array{"mN/m", "mN/", "5:17: error: physical.shear_modulus: a unit is missing in '0.02 mN/'"},
        std::array{"4 um", "64 um",
                   "7:18: error: physical.capsule_radius makes capsule.radius = 12.8 tube radii, which is "
                   "out of range"},
        std::array{"capsule_radius", "capsule_radus", "7:1: error: unknown key 'physical.capsule_radus'"},
        std::array{"[membrane]\n", "[membrane]\nyoung_modulus = \"1 N/m\"\n",
                   "10:1: error: unknown key 'membrane.young_modulus'"}, // which excludes nothing
        std::array{"flow_rate", "flow_rat", "4:1: error: unknown key 'physical.flow_rat'"},
        std::array{"[physical]", "[phyiscal]", "1:1: error: unknown section 'phyiscal'"},
        std::array{"\"1 mPa.s\"", "1e-3",
                   "3:13: error: physical.viscosity must be a number with its unit"}}) {
    const std::string told = complaint(replaced(laboratory, from, to));
    BOOST_TEST(contains(told, std::string("case.toml:") + message), told);
    BOOST_TEST(error_count(told) == 1, told);
  }
  const std::string both = complaint(replaced(replaced(laboratory, "mPa.s", "mPas"), "nl/s", "nl/ss"));
  BOOST_TEST(contains(both, "did you mean '1 mPa.s'? allowed: a viscosity such as '1 mPa.s' (or "));
  BOOST_TEST(contains(both, "did you mean '0.1 nl/s'? allowed: a flow rate such as "));
  BOOST_TEST(error_count(both) == 2);
}

BOOST_AUTO_TEST_CASE(a_sweep_of_quantities_makes_runs_with_names_for_directories) {
  const TemporaryDirectory directory;
  std::ofstream(directory.path / "case.toml")
      << laboratory << "[sweep]\n\"physical.flow_rate\" = [\"0.1 nl/s\", \"0.2 nl/s\"]\n";
  // The sweep of a key stands beside its value: one of them is enough.
  BOOST_CHECK_THROW(read_case(directory.path), InputError);
  std::string swept = laboratory;
  swept.erase(swept.find("flow_rate"), std::string("flow_rate = \"0.1 nl/s\"\n").size());
  std::ofstream(directory.path / "case.toml")
      << swept << "[sweep]\n\"physical.flow_rate\" = [\"0.1 nl/s\", \"0.2 nl/s\"]\n";
  const CaseInput input = read_case(directory.path);
  BOOST_REQUIRE(input.runs.size() == 2);
  BOOST_TEST(input.runs[1].name.find_first_of(" /") == std::string::npos);
  BOOST_TEST(input.runs[1].physics.flow.capillary_number == 2 * input.runs[0].physics.flow.capillary_number,
             tolerance);
  BOOST_TEST(contains(complaint(swept, {"sweep.physical.flow_rate=[\"0.1 nl/s\", \"100 pL/s\"]"}),
                      "--set:1:39: error: physical.flow_rate = \"1e-13 m3/s\" stands twice in the sweep"));
}
