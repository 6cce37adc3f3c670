#include "case_file.hpp"
#include "failure.hpp"
#include "physical.hpp"
#include "temporary_directory.hpp"
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <fstream>
#include <numbers>

using namespace capsule;

namespace {

double si(const std::string &text, const Dimension &of) {
  const auto read = read_quantity(text, of);
  BOOST_REQUIRE_MESSAGE(std::holds_alternative<Quantity>(read), text);
  return std::get<Quantity>(read).si;
}

bool refused(const std::string &text, const Dimension &of) {
  return std::holds_alternative<std::string>(read_quantity(text, of));
}

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

const auto tolerance = boost::test_tools::tolerance(1e-12);

} // namespace

BOOST_AUTO_TEST_CASE(units_are_read_in_their_usual_spellings) {
  BOOST_TEST(si("5 um", dimension::length) == 5e-6, tolerance);
  BOOST_TEST(si("5 \u00b5m", dimension::length) == 5e-6, tolerance);
  BOOST_TEST(si("5um", dimension::length) == 5e-6, tolerance);
  BOOST_TEST(si("1.2 mPa.s", dimension::viscosity) == 1.2e-3, tolerance);
  BOOST_TEST(si("1.2 cP", dimension::viscosity) == 1.2e-3, tolerance);
  BOOST_TEST(si("1.2e-3 kg.m-1.s-1", dimension::viscosity) == 1.2e-3, tolerance);
  BOOST_TEST(si("6 ul/min", dimension::flow_rate) == 1e-10, tolerance);
  BOOST_TEST(si("36 cm3/h", dimension::flow_rate) == 1e-8, tolerance);
  BOOST_TEST(si("2 mN/m", dimension::tension) == 2e-3, tolerance);
  BOOST_TEST(si("2 mJ/m2", dimension::tension) == 2e-3, tolerance);
  BOOST_TEST(si("2 g/s2", dimension::tension) == 2e-3, tolerance);
  BOOST_TEST(si("180 aJ", dimension::moment) == 1.8e-16, tolerance);
  BOOST_TEST(si("2 nN.um", dimension::moment) == 2e-15, tolerance);
  BOOST_TEST(si("3 kPa", dimension::pressure) == 3e3, tolerance);
}

BOOST_AUTO_TEST_CASE(what_is_no_quantity_is_refused) {
  for (const char *text :
       {"", "5", "um", "5 feet", "5 um/", "5 um/s/s", "5 um2.", "5 um^2", "5 um2x", "-5 um", "0 um", "nan um",
        "inf um", "5 um um", "1e400 um", "5 kg", "5 mPa.s", "5 /m", "5 ."})
    BOOST_TEST(refused(text, dimension::length), text);
}

BOOST_AUTO_TEST_CASE(a_quantity_reads_back_as_it_was_written) {
  for (const Dimension &of :
       {dimension::length, dimension::viscosity, dimension::flow_rate, dimension::pressure,
        dimension::tension, dimension::moment, dimension::velocity, dimension::time})
    for (const double value : {1.0, 2.5e-12, 1.0 / 3})
      BOOST_TEST(si(quantity_text({value}, of), of) == value);
}

// eps = mu Q/(pi R_t^2 G), lambda, delta = D/(G R_t^2), by hand.
BOOST_AUTO_TEST_CASE(dimensionless_groups_follow) {
  const Case physics = only_run(laboratory);
  BOOST_TEST(physics.flow.capillary_number == 1e-3 * 1e-13 / (std::numbers::pi * 25e-12 * 2e-5), tolerance);
  BOOST_TEST(physics.flow.viscosity_ratio == 6, tolerance);
  BOOST_TEST(physics.membrane.bending_ratio == 5e-15 / (2e-5 * 25e-12), tolerance);
  BOOST_TEST(physics.capsule.radius == 0.8, tolerance);
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
  // Sampson's orifice at 90 degrees: 3 pi in all, half of it before the pore.
  const double eps = only_run(driven, {"pore.opening_angle_deg=90"}).flow.capillary_number;
  const double rate =
      100 * std::numbers::pi * std::pow(5e-6, 3) / (1e-3 * (8 * 1000 + 1.5 * std::numbers::pi));
  BOOST_TEST(eps == 1e-3 * rate / (std::numbers::pi * 25e-12 * 2e-5), tolerance);
}

BOOST_AUTO_TEST_CASE(the_resolved_case_gives_the_same_case_again) {
  const Case physics = only_run(laboratory);
  const std::string resolved = resolved_toml(physics);
  BOOST_TEST(resolved_toml(only_run(resolved)) == resolved);
  BOOST_TEST(run_identity(only_run(resolved)) == run_identity(physics));
}

BOOST_AUTO_TEST_CASE(contradictions_are_located) {
  const std::string twice = complaint(laboratory, {"flow.capillary_number=0.1"});
  BOOST_TEST(contains(twice, "--set:1:"));
  BOOST_TEST(contains(twice, "flow.capillary_number = 0.1, but physical.flow_rate makes it 0.06366"));
  BOOST_TEST(contains(
      complaint("physical.tube_radius = \"5 um\"\ncapsule.radius = 0.8\nmembrane.law = \"skalak\"\n"),
      "case.toml:1:24: error: physical.viscosity is missing"));
  BOOST_TEST(contains(complaint(laboratory, {"physical.pressure=1 Pa"}), "one of physical.flow_rate"));
  BOOST_TEST(contains(complaint(laboratory, {"physical.tube_radius=5 s"}), "wrong dimension, s"));
  BOOST_TEST(contains(complaint(laboratory, {"physical.tube_radius=5"}), "a number with its unit in quotes"));
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
}
