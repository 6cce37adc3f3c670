// Reading case files: what is accepted, what follows from it, and the located message for each kind of
// mistake.
#include "base/failure.hpp"
#include "base/text.hpp"
#include "case/case_file.hpp"
#include "case/identity.hpp"
#include "case/keys.hpp"
#include "case/symbols.hpp"
#include "law/neo_hookean.hpp"
#include "law/skalak.hpp"
#include "temporary_directory.hpp"
#include <array>
#include <boost/test/unit_test.hpp>
#include <cstring>
#include <fmt/format.h>
#include <set>
#include <unistd.h>

using namespace capsule;

namespace {

const std::string sphere = R"(title = "sphere"
[capsule]
radius = 0.9
[membrane]
law = "skalak"
dilatation = 0
[flow]
capillary_number = 0.04
)";

std::string message_of(const std::filesystem::path &path, const std::vector<std::string> &overrides = {}) {
  try {
    read_case(path, overrides);
  } catch (const InputError &error) {
    return error.what();
  }
  return "no error";
}

void check_contains(const std::string &text, const std::string &part) {
  BOOST_CHECK_MESSAGE(text.find(part) != std::string::npos, "'" << part << "' is not in:\n" << text);
}

std::size_t count_of(const std::string &text, const std::string &part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1))
    ++count;
  return count;
}

// A file that holds `content` gives exactly these errors, in this order.
void check_errors(const std::string &content, const std::vector<std::string> &expected) {
  const TemporaryDirectory directory;
  const std::string message = message_of(directory.write("case.toml", content));
  BOOST_CHECK_MESSAGE(count_of(message, "error:") == expected.size(), message);
  std::size_t from = 0;
  for (const std::string &part : expected) {
    const std::size_t at = message.find("case.toml:" + part, from);
    BOOST_CHECK_MESSAGE(at != std::string::npos, "'" << part << "' is not in, or not in order:\n" << message);
    from = at == std::string::npos ? from : at;
  }
}

} // namespace

BOOST_AUTO_TEST_SUITE(good_files)

BOOST_AUTO_TEST_CASE(values_and_the_papers_standard_case) {
  const TemporaryDirectory directory;
  directory.write("fig/case.toml", sphere);
  const CaseInput input = read_case(directory.path / "fig");
  BOOST_TEST(input.name == "fig");
  BOOST_REQUIRE(input.runs.size() == 1u);
  BOOST_TEST(input.runs[0].name == "");
  const Case &c = input.runs[0].physics;
  BOOST_TEST(c.title == "sphere");
  BOOST_TEST(c.capsule.radius == 0.9);
  BOOST_TEST(c.membrane.law.is(skalak));
  BOOST_TEST(c.membrane.law.values()[0] == 0);
  BOOST_TEST(c.flow.capillary_number == 0.04);
  BOOST_TEST(c.flow.viscosity_ratio == 1);
  BOOST_TEST(c.pore.opening_angle_deg == 78.5);
  BOOST_TEST(c.pore.exit_x == 15);
  BOOST_TEST(c.capsule.start_x == -4);
  BOOST_TEST((c.time.scheme == Scheme::bdf));
  BOOST_TEST(c.mesh.membrane == 0);
  BOOST_TEST(c.until.x_g.value() == 11.84);
  BOOST_TEST(!c.until.time);
}

BOOST_AUTO_TEST_CASE(paper_preset_yields_to_given_values) {
  const TemporaryDirectory directory;
  const auto file = directory.write("a.toml", sphere);
  const Case c = read_case(file, {"numerics=paper", "mesh.wall=180"}).runs.at(0).physics;
  BOOST_TEST(c.mesh.membrane == 60);
  BOOST_TEST(c.mesh.wall == 180);
  BOOST_TEST(c.mesh.exit == 30);
  BOOST_TEST((c.time.scheme == Scheme::euler));
  BOOST_TEST(c.time.step == 2.5e-4);
}

BOOST_AUTO_TEST_CASE(extension_has_its_own_defaults) {
  const TemporaryDirectory directory;
  const auto file = directory.write("a.toml", "[membrane]\nlaw='neo-hookean'\n[flow]\ntype='extension'\n"
                                              "capillary_number=0.01\n[until]\ntime=20\n");
  const Case c = read_case(file).runs.at(0).physics;
  BOOST_TEST((c.pore.shape == PoreShape::none));
  BOOST_TEST(c.capsule.radius == 1);
  BOOST_TEST(c.capsule.start_x == 0);
  BOOST_TEST(!c.until.x_g);
}

BOOST_AUTO_TEST_CASE(sweeps_make_every_combination) {
  const TemporaryDirectory directory;
  const auto file = directory.write("a.toml", "capsule.radius = 0.9\nflow.capillary_number = 0.04\n[sweep]\n"
                                              "'flow.viscosity_ratio' = [0.2, 1, 10]\n"
                                              "'membrane.law' = ['skalak', 'neo-hookean']\n");
  const CaseInput input = read_case(file);
  std::vector<std::string> names;
  for (const RunInput &run : input.runs)
    names.push_back(run.name);
  const std::vector<std::string> expected{
      "viscosity_ratio=0.2,law=skalak", "viscosity_ratio=0.2,law=neo-hookean",
      "viscosity_ratio=1,law=skalak",   "viscosity_ratio=1,law=neo-hookean",
      "viscosity_ratio=10,law=skalak",  "viscosity_ratio=10,law=neo-hookean"};
  BOOST_TEST(names == expected, boost::test_tools::per_element());
  BOOST_TEST(input.runs[5].physics.flow.viscosity_ratio == 10);
  BOOST_TEST(input.runs[5].physics.membrane.law.is(neo_hookean));
  // 1 and 1.0 are the same value.
  BOOST_TEST(read_case(file, {"sweep.'flow.viscosity_ratio' = [1.0]"}).runs.at(0).name ==
             "viscosity_ratio=1,law=skalak");
  // A plain value of --set leaves one run, by its name; that of a file that inherits the sweep takes it away.
  const CaseInput one = read_case(file, {"flow.viscosity_ratio=5", "membrane.law=skalak"});
  BOOST_REQUIRE(one.runs.size() == 1u);
  BOOST_TEST(one.runs[0].name == "viscosity_ratio=5,law=skalak");
  BOOST_TEST(one.runs[0].physics.flow.viscosity_ratio == 5);
  directory.write("b.toml", "inherit = 'a.toml'\nflow.viscosity_ratio = 5\nmembrane.law = 'skalak'\n");
  BOOST_TEST(read_case(directory.path / "b.toml").runs.at(0).name == "");
  BOOST_TEST(read_case(directory.path / "b.toml", {"flow.viscosity_ratio=2"}).runs.at(0).name == "");
}

BOOST_AUTO_TEST_CASE(names_of_runs_are_unambiguous) {
  std::set<std::string_view> names;
  for (const Key &key : keys())
    BOOST_CHECK_MESSAGE(names.insert(short_name(key)).second, key.name);
  BOOST_TEST(short_name(*find_key("flow.capillary_number")) == "capillary_number");
  BOOST_TEST(short_name(*find_key("pore.shape")) == "pore.shape");
}

BOOST_AUTO_TEST_CASE(inherit_chains_and_overrides) {
  const TemporaryDirectory directory;
  directory.write("common.toml", sphere);
  directory.write("a/case.toml", "inherit = '../common.toml'\n[flow]\ncapillary_number = 0.09\n[sweep]\n"
                                 "'capsule.radius' = [0.8, 0.9]\n");
  directory.write("b/case.toml",
                  "inherit = '../a'\ncapsule.radius = 0.7\nsweep.'flow.capillary_number' = [0.1]\n");
  const CaseInput input = read_case(directory.path / "b");
  BOOST_REQUIRE(input.runs.size() == 1u);
  BOOST_TEST(input.runs[0].name == "capillary_number=0.1");
  BOOST_TEST(input.runs[0].physics.capsule.radius == 0.7);
  BOOST_TEST(input.runs[0].physics.flow.capillary_number == 0.1);
  BOOST_TEST(input.runs[0].physics.title == "sphere");
}

BOOST_AUTO_TEST_CASE(the_runs_of_several_cases) {
  const TemporaryDirectory directory;
  directory.write("common.toml", sphere);
  directory.write("a/case.toml", "inherit = '../common.toml'\nsweep.'capsule.radius' = [0.8, 0.9]\n");
  directory.write("b/case.toml", "inherit = '../a'\ncapsule.radius = 0.7\n");
  directory.write("c/case.toml", "inherit = ['../a', '../b']\n[flow]\nviscosity_ratio = 5\n");
  const CaseInput input = read_case(directory.path / "c");
  BOOST_REQUIRE(input.runs.size() == 3u);
  BOOST_TEST(input.runs[1].name == "a,radius=0.9");
  BOOST_TEST(input.runs[1].physics.capsule.radius == 0.9);
  BOOST_TEST(input.runs[2].name == "b");
  BOOST_TEST(input.runs[2].physics.capsule.radius == 0.7);
  for (const RunInput &run : input.runs)
    BOOST_TEST(run.physics.flow.viscosity_ratio == 5);
  // Each is the run that the other case would compute itself.
  const CaseInput alone = read_case(directory.path / "b", {"flow.viscosity_ratio=5"});
  BOOST_TEST(run_identity(alone.runs.at(0).physics) == run_identity(input.runs[2].physics));
}

BOOST_AUTO_TEST_CASE(resolved_input_is_a_case_file_of_the_same_run) {
  const TemporaryDirectory directory;
  const auto file = directory.write("a.toml", sphere + "[output]\nprofiles_at_x_g = [3, 0.1, 3]\n");
  for (const std::string numerics : {"standard", "paper"}) {
    const Case c =
        read_case(file, {"numerics=" + numerics, "title=\"a \\\"b\\\" \\u0001\""}).runs.at(0).physics;
    const auto again = directory.write("resolved.toml", resolved_toml(c));
    const Case d = read_case(again).runs.at(0).physics;
    BOOST_TEST(resolved_toml(d) == resolved_toml(c));
    BOOST_TEST(run_identity(d) == run_identity(c));
    BOOST_TEST(d.output.profiles_at_x_g == (std::vector<double>{0.1, 3}), boost::test_tools::per_element());
  }
}

BOOST_AUTO_TEST_CASE(identity_knows_what_counts) {
  const TemporaryDirectory directory;
  const auto file = directory.write("a.toml", sphere);
  const auto identity = [&](const std::vector<std::string> &overrides) {
    return run_identity(read_case(file, overrides).runs.at(0).physics);
  };
  BOOST_TEST(identity({}).size() == 16u);
  BOOST_TEST(identity({}) == identity({"title=other", "paper=Figure 7", "flow.viscosity_ratio=1"}));
  // An accuracy that is inherited means nothing to the paper's preset.
  const auto precise = directory.write("b.toml", "accuracy = 1e-6\n" + sphere);
  BOOST_TEST(run_identity(read_case(precise, {"numerics=paper"}).runs.at(0).physics) ==
             identity({"numerics=paper"}));
  BOOST_TEST(identity({"numerics=paper"}) != identity({"numerics=paper", "mesh.exit=5"}));
  // Every key that is not a title makes another run.
  const std::vector<std::string> changes{"numerics=paper",
                                         "accuracy=1e-5",
                                         "pore.opening_angle_deg=45",
                                         "pore.exit_x=20",
                                         "pore.shape=tube",
                                         "pore.entrance_distance=40",
                                         "capsule.radius=0.8",
                                         "capsule.aspect_ratio=0.9",
                                         "capsule.start_x=-5",
                                         "membrane.law=neo-hookean",
                                         "membrane.law=evans-skalak",
                                         "membrane.dilatation=1",
                                         "membrane.bending_ratio=0",
                                         "flow.capillary_number=0.0400000000000001",
                                         "flow.viscosity_ratio=5",
                                         "mesh.membrane=50",
                                         "mesh.wall=50",
                                         "time.scheme=euler",
                                         "time.tolerance=1e-7",
                                         "until.x_g=3",
                                         "until.time=3",
                                         "output.profiles_at_x_g=[1]",
                                         "output.profiles_at_time=[1]",
                                         "output.profiles_every=0.5"};
  std::set<std::string> identities{identity({})};
  for (const std::string &change : changes)
    BOOST_CHECK_MESSAGE(identities.insert(identity({change})).second, change);
}

BOOST_AUTO_TEST_CASE(name_of_another_file_of_a_case_directory) {
  const TemporaryDirectory directory;
  directory.write("fig/case.toml", sphere);
  BOOST_TEST(read_case(directory.write("fig/paper.toml", sphere)).name == "fig-paper");
  BOOST_TEST(read_case(directory.write("elsewhere/mine.toml", sphere)).name == "mine");
}

BOOST_AUTO_TEST_CASE(characters_as_bytes) {
  for (const std::u32string text : {U"a\u007f\u0080\u07ff\u0800\ud7ff\ue000\uffff\U00010000\U0010ffff", U""})
    BOOST_CHECK(decoded(encoded(text)) == text);
  BOOST_CHECK(decoded("\xc2\xb5\xe6\x97\xa5\xf0\x9f\x98\x80") == U"\u00b5\u65e5\U0001f600");
  // Cut short, too long for what it says, half of a pair, beyond the last, never a beginning, never alone.
  for (const std::string wrong :
       {"\xc3", "\xe6\x97", "\xc1\xbf", "\xe0\x9f\xbf", "\xf0\x8f\xbf\xbf", "\xed\xa0\x80",
        "\xf4\x90\x80\x80", "\xff", "\xf8\x88\x80\x80\x80", "\x80"}) {
    const std::u32string shown = decoded("a" + wrong + "\nb");
    BOOST_CHECK(shown.starts_with(U"a\ufffd") && shown.ends_with(U"\nb"));
    BOOST_CHECK(shown.find_first_not_of(U'\ufffd', 1) == shown.size() - 2);
    BOOST_TEST(encoding_error("\xc2\xb5" + wrong).value().byte == 2u);
  }
  BOOST_CHECK(decoded("\xe6z") == U"\ufffdz");
}

BOOST_AUTO_TEST_CASE(numbers_as_text) {
  BOOST_TEST(number_text(1e-5) == "1e-5");
  BOOST_TEST(number_text(-1e22) == "-1e22");
  BOOST_TEST(number_text(15.0) == "15");
  BOOST_TEST(number_text(0.2) == "0.2");
  BOOST_TEST(std::stod(number_text(0.1 + 0.2)) == 0.1 + 0.2);
  BOOST_TEST(counted(0, "run") == "0 runs");
  BOOST_TEST(counted(1, "run") == "1 run");
}

BOOST_AUTO_TEST_SUITE_END()

BOOST_AUTO_TEST_SUITE(bad_files)

BOOST_AUTO_TEST_CASE(the_message_in_full) {
  const TemporaryDirectory directory;
  const auto file = directory.write("case.toml", sphere + "capilary_number = 0.09 # twice\n");
  BOOST_TEST(message_of(file) == file.string() + ":9:1: error: unknown key 'flow.capilary_number'\n"
                                                 "    9 | capilary_number = 0.09 # twice\n"
                                                 "      | ^\n"
                                                 "did you mean 'capillary_number'?\n");
}

BOOST_AUTO_TEST_CASE(a_quantity_without_quotes) {
  const TemporaryDirectory directory;
  for (const char *value : {"5 um", "5um", "5 \u00b5m", "1e-3 Pa.s"})
    check_contains(message_of(directory.write("case.toml", "physical.tube_radius = " + std::string(value))),
                   "a number with its unit stands in quotes: \"5 um\"");
}

// What Fortran, spreadsheets, other languages and typesetters write.
BOOST_AUTO_TEST_CASE(numbers_in_other_notations) {
  const TemporaryDirectory directory;
  const std::string before = "membrane.law = \"skalak\"\ncapsule.radius = 0.9\n";
  const std::string good = before + "flow.capillary_number = 0.04\n";
  for (const auto &[typed, meant] : std::vector<std::pair<std::string, std::string>>{{"1.0d-3", "1.0e-3"},
                                                                                     {"1d-3", "1e-3"},
                                                                                     {"1.5D+1", "1.5e+1"},
                                                                                     {"0,05", "0.05"},
                                                                                     {"1,000", ""},
                                                                                     {".05", "0.05"},
                                                                                     {"+.05", "0.05"},
                                                                                     {"5.", "5.0"},
                                                                                     {"1.e-3", "1.0e-3"},
                                                                                     {"05", "5"},
                                                                                     {"\u22120.05", "-0.05"},
                                                                                     {"1/3", ""},
                                                                                     {"1 000", ""},
                                                                                     {"5%", ""}}) {
    const std::string hint =
        meant.empty() ? "a number is written as 0.05, 1000 or 1e-3\n" : "write " + meant + "\n";
    const std::string in_file = message_of(
        directory.write("case.toml", before + fmt::format("flow.capillary_number = {} # x\n", typed)));
    BOOST_TEST_CONTEXT(typed) {
      check_contains(in_file, hint);
      if (!meant.empty())
        check_contains(in_file, fmt::format("case.toml:3:25: error: '{}' is not a number", typed));
      const auto file = directory.write("good.toml", good);
      check_contains(message_of(file, {"flow.capillary_number=" + typed}), hint);
      check_contains(message_of(file, {"flow.capillary_number=\"" + typed + "\""}), hint);
      check_contains(message_of(file, {"mesh.wall=\"" + typed + "\""}), hint);
      if (!meant.empty())
        check_contains(
            message_of(directory.write(
                "list.toml", before + fmt::format("sweep.\"flow.capillary_number\" = [0.1, {}]\n", typed))),
            fmt::format("list.toml:3:39: error: '{}' is not a number; {}", typed, hint));
    }
  }
  const auto file = directory.write("good.toml", good);
  check_contains(message_of(file, {"flow.capillary_number=\"0.05\""}),
                 "a number stands without quotes: 0.05");
  check_contains(message_of(file, {"output.profiles_at_x_g=[1, .5]"}),
                 "--set:1:28: error: '.5' is not a number; write 0.5");
  check_contains(message_of(file, {"output.profiles_at_x_g=[1,1d-3]"}),
                 "--set:1:27: error: '1d-3' is not a number");
  // What is wrong there is another thing.
  check_contains(message_of(file, {"output.profiles_at_x_g=[1, 0.5"}), "--set:1:31: error: ");
}

// The caret stands below the character that is meant, also in a line that is too long to be shown.
BOOST_AUTO_TEST_CASE(characters_of_the_excerpt) {
  const TemporaryDirectory directory;
  const auto excerpt = [&](const std::string &line) {
    const std::string message = message_of(directory.write("case.toml", line + "\n" + sphere));
    return message.substr(message.find('\n') + 1);
  };
  check_contains(excerpt("title = '\u00b5\u65e5' \u03bc"),
                 "    1 | title = '\u00b5\u65e5' \u03bc\n      |              ^\n");
  check_contains(excerpt("paper = '\xc2\x9b\u202e\t' x"),
                 "    1 | paper = '??\t' x\n      |            \t  ^\n");
  check_contains(excerpt("pore = {'\u00b5' = 1}"), "    1 | pore = {'\u00b5' = 1}\n      |         ^\n");
  const std::string longer = excerpt("title = '" + std::string(300, 'a') + "' x");
  const std::size_t end = longer.find('\n');
  BOOST_TEST(longer.find('^', end) - end - 1 == longer.find('x'));
}

BOOST_AUTO_TEST_CASE(unknown_keys) {
  check_errors("flow.capilary_number = 0.1\n" + sphere.substr(0, sphere.find("[flow]")),
               {"1:1: error: unknown key 'flow.capilary_number'"});
  check_errors("radius = 0.5\n" + sphere, {"1:1: error: unknown key 'radius'"});
  check_errors(sphere + "[floww]\nx = 1\n",
               {"9:1: error: unknown section 'floww'", "10:1: error: unknown key 'flow.x'"});
  check_errors(sphere + "viscosity_ratio = []\n",
               {"9:19: error: flow.viscosity_ratio has no value for any capsule"});
  check_errors(sphere + "[floww]\n", {"9:1: error: unknown section 'floww'"});
  check_errors("[elsewhere]\nx = 1\n" + sphere.substr(sphere.find('\n') + 1),
               {"2:1: error: unknown key 'elsewhere.x'"});
  check_errors(
      "capsul.radius = 0.9\nmembrane.law = 'skalak'\nflw.capillary_number = 1\nflow.viscosity_ratio = 1\n"
      "flow.capillary_number = 1",
      {"1:1: error: unknown section 'capsul'", "3:1: error: unknown section 'flw'",
       "5:1: error: 'flow.capillary_number' stands here again"});
  check_errors("flow = 3\n" + sphere.substr(0, sphere.find("[flow]")),
               {"1:1: error: 'flow' is a section", "1:1: error: missing key 'flow.capillary_number'"});
  check_errors(sphere + "sweeps.'flow.viscosity_ratio' = [1]\n", {"9:1: error: unknown key 'flow.sweeps"});
}

BOOST_AUTO_TEST_CASE(wrong_types) {
  check_errors(sphere + "viscosity_ratio = \"1\"\n",
               {"9:19: error: flow.viscosity_ratio must be a number, not the"});
  check_errors(sphere + "viscosity_ratio = true\n",
               {"9:19: error: flow.viscosity_ratio must be a number, not true"});
  check_errors(sphere + "viscosity_ratio = [1, 2]\n",
               {"9:19: error: capsules 1 and 2 start at the same place"});
  check_errors("accuracy = [1e-3, 1e-4]\n" + sphere, {"1:12: error: accuracy must be a number, not a list"});
  check_errors(sphere + "viscosity_ratio = 2002-10-01\n",
               {"9:19: error: flow.viscosity_ratio must be a number, not"});
  check_errors(sphere + "type = 1\n", {"9:8: error: flow.type must be one of 'pore', 'extension', not 1"});
  check_errors(sphere + "[mesh]\nwall = 60.0\n", {});
  check_errors(sphere + "[mesh]\nwall = 60.5\n", {"10:8: error: mesh.wall must be a whole number, not 60.5"});
  check_errors(sphere + "[output]\nprofiles_at_x_g = [1, 'a']\n",
               {"10:19: error: output.profiles_at_x_g must be a"});
  check_errors("inherit = 3\n" + sphere, {"1:11: error: inherit must be"});
  check_errors("inherit = ['a', 3]\n" + sphere, {"1:11: error: inherit must be"});
}

BOOST_AUTO_TEST_CASE(out_of_range) {
  const auto changed = [](const std::string &from, const std::string &to) {
    std::string content = sphere;
    return content.replace(content.find(from), from.size(), to);
  };
  check_errors(changed("0.04", "-0.04"), {"8:20: error: flow.capillary_number = -0.04 is out of range"});
  check_errors(changed("0.04", "nan"),
               {"8:20: error: flow.capillary_number must be a finite number, not nan"});
  check_errors(changed("0.04", "-inf"),
               {"8:20: error: flow.capillary_number must be a finite number, not -inf"});
  check_errors(changed("0.9", "0.9\naspect_ratio = 0"),
               {"4:16: error: capsule.aspect_ratio = 0 is out of range"});
  check_errors("accuracy = 1e-9\n" + sphere, {"1:12: error: accuracy = 1e-9 is out of range"});
  check_errors(sphere + "[pore]\nopening_angle_deg = 90.01",
               {"10:21: error: pore.opening_angle_deg = 90.01 is out"});
  check_errors(sphere + "[pore]\nentrance_distance = 1",
               {"10:21: error: pore.entrance_distance = 1 is out of range"});
  check_errors(sphere + "viscosity_ratio = 1.1e4", {"9:19: error: flow.viscosity_ratio = 11000 is out of"});
  check_errors(sphere + "viscosity_ratio = 0", {"9:19: error: flow.viscosity_ratio = 0 is out of range"});
  check_errors(sphere + "[mesh]\nwall = 99999999999",
               {"10:8: error: mesh.wall = 99999999999 is out of range"});
  check_errors(changed("law", "bending_ratio = -1e-300\nlaw"),
               {"5:17: error: membrane.bending_ratio = -1e-300 is"});

  const TemporaryDirectory directory;
  check_contains(message_of(directory.write("a.toml", "accuracy = 1\n" + sphere)),
                 "allowed: 1e-8 <= value <= 0.01");
}

BOOST_AUTO_TEST_CASE(symbols_of_the_field) {
  const TemporaryDirectory directory;
  for (const auto &[typed, meant] : {std::array{"membrane.C", "membrane.dilatation"},
                                     {"C", "membrane.dilatation"},
                                     {"flow.C", "membrane.dilatation"},
                                     {"flow.Ca", "flow.capillary_number"},
                                     {"eps", "flow.capillary_number"},
                                     {"membrane.lambda", "flow.viscosity_ratio"},
                                     {"delta", "membrane.bending_ratio"},
                                     {"Req", "capsule.radius"},
                                     {"flow.Q", "physical.flow_rate"},
                                     {"physical.G", "physical.shear_modulus"},
                                     {"capsule_radius", "physical.capsule_radius"},
                                     {"membrane.laws", "membrane.law"}}) {
    const std::string message = message_of(directory.write("case.toml", sphere), {std::string(typed) + "=1"});
    check_contains(message, fmt::format("did you mean '{}'?", meant));
  }
  // There are radii only.
  for (const auto &[typed, meant] :
       std::map<std::string, std::string>{{"physical.tube_diameter", "physical.tube_radius"},
                                          {"capsule_diameter", "physical.capsule_radius"},
                                          {"capsule.diameter", "capsule.radius"}})
    check_contains(message_of(directory.write("case.toml", sphere), {typed + "=1"}),
                   fmt::format("did you mean '{}', half of it?", meant));
  BOOST_TEST(nearest_key("tube_diameter") == "physical.tube_radius");
  // No letter is near to another one.
  for (const char *typed : {"membrane.Z", "membrane.x", "q_q", "rho", "a", "g", "membrane.c"})
    check_contains(message_of(directory.write("case.toml", sphere), {std::string(typed) + "=1"}),
                   "`capsule keys` lists them all");
  // What is called by a symbol is called so only once.
  std::set<std::string> symbols;
  for (const Key &key : keys())
    for (const std::string &symbol : symbols_of(key)) {
      BOOST_TEST(nearest_key(symbol) == key.name);
      BOOST_TEST(symbols.insert(symbol).second, symbol);
    }
  BOOST_TEST(symbols.size() > 20u);
}

BOOST_AUTO_TEST_CASE(a_unit_where_none_belongs) {
  std::string measured = sphere;
  measured.replace(measured.find("0.9"), 3, "'6 mm'");
  check_errors(measured, {"3:10: error: capsule.radius must be a number, not the text '6 mm'"});
  const TemporaryDirectory directory;
  for (const char *typed :
       {"capsule.radius=6 mm", "pore.exit_x='6um'", "capsule.start_x=-6 µm", "mesh.membrane=60 nodes"})
    check_contains(message_of(directory.write("case.toml", sphere), {typed}),
                   "write a number without a unit: lengths in tube radii; the keys of [physical] take units");
  check_contains(message_of(directory.write("case.toml", sphere), {"capsule.radius=large"}),
                 "a number is written as 0.05");
}

BOOST_AUTO_TEST_CASE(unknown_law) {
  const TemporaryDirectory directory;
  const auto file = directory.write("case.toml", "membrane.law = 'neo-hokean'\ncapsule.radius = 1\n"
                                                 "flow.capillary_number = 1\n");
  const std::string message = message_of(file);
  check_contains(message, "case.toml:1:16: error: unknown membrane.law 'neo-hokean'");
  check_contains(message, "did you mean 'neo-hookean'? allowed: 'neo-hookean', 'skalak'");
}

BOOST_AUTO_TEST_CASE(missing) {
  check_errors("[capsule]\nradius = 0.9\n[membrane]\nlaw = 'skalak'\n",
               {"1:1: error: missing key 'flow.capillary_number'"});
  check_errors("# a comment\n\n[capsule]\n[membrane]\nlaw = 'skalak'\n[flow]\ncapillary_number = 0.1",
               {"3:1: error: missing key 'capsule.radius'"});
}

BOOST_AUTO_TEST_CASE(all_errors_at_once_in_order_of_position) {
  check_errors("accuracy = 'high'\n[flow]\nviscosity_ratio = -1\ntyp = 'pore'\n[membrane]\nlaw = "
               "'mooney'\n[capsule]\n",
               {"1:12: error: accuracy must be", "2:1: error: missing key 'flow.capillary_number'",
                "3:19: error: flow.viscosity_ratio = -1 is out", "4:1: error: unknown key 'flow.typ'",
                "6:7: error: unknown membrane.law 'mooney'", "7:1: error: missing key 'capsule.radius'"});
}

BOOST_AUTO_TEST_CASE(not_toml) {
  check_errors(sphere + "viscosity_ratio = \n", {"9:19: error:"});
  check_errors(sphere + "capillary_number = 0.05\n", {"9:"});
  check_errors(sphere + "[flow]\nviscosity_ratio = 2\n", {"9:"});
  check_errors(sphere + "[mesh\n", {"9:"});
  check_errors("paper = \"\xc3\xa9\xff\"\n" + sphere, {"1:11: error: not UTF-8: byte 0xff"});
  check_errors("\xef\xbb\xbfpaper = \"\xc3\n" + sphere, {"1:10: error: not UTF-8: byte 0xc3"});
  for (const char *mark : {"\xff\xfe", "\xfe\xff"})
    check_errors(mark + std::string("t\0=\0", 4), {"1:1: error: the text is in UTF-16; save it in UTF-8"});
  // What the parser cannot be trusted with.
  check_errors(sphere + "viscosity_ratio = 5 um\n", {"9:21: error:"});
  check_errors(sphere + "viscosity_ratio = 5 \u00b5m\n", {"9:21: error:"});
  check_errors(sphere + "viscosity_ratio = 5um\n", {"9:20: error:"});
  check_errors("r\xc3\xa9 = 1\n" + sphere,
               {"1:2: error: Error while parsing key-value pair: expected '=', saw '\u00e9'"});
  check_errors("accuracy =-\"\xc3\xa9\n" + sphere, {"1:"});
  check_errors("paper = \"\"\"a \\\n \xc3\xa9\"\"\"\n" + sphere, {"2:2: error: a joined line"});
  check_errors("accuracy = \"\\u001b[2J\"\n" + sphere,
               {R"(1:12: error: accuracy must be a number, not the text '\u001b[2J')"});
  check_errors(std::string("\x7f"
                           "ELF\n\0\0\x01",
                           8),
               {"2:1: error: not a text file"});
  check_errors("", {"1:1: error: the file holds no keys", "1:1: error: missing", "1:1: error: missing",
                    "1:1: error: missing"});
}

BOOST_AUTO_TEST_CASE(characters_beyond_ascii) {
  const TemporaryDirectory directory;
  const std::string title = "\xc3\xa9 \xe2\x80\xa8 \xf0\x9f\x98\x80";
  const CaseInput input =
      read_case(directory.write("case.toml", "\xef\xbb\xbfpaper = \"" + title + "\" # \xc3\xa9\n" + sphere),
                {"title=\xc3\xa9"});
  BOOST_TEST(input.runs.at(0).physics.paper == title);
  BOOST_TEST(input.runs.at(0).physics.title == "\xc3\xa9");
}

BOOST_AUTO_TEST_CASE(no_such_file) {
  const TemporaryDirectory directory;
  const std::string path = directory.path.string();
  check_contains(message_of(path + "/nothing"), path + "/nothing:1:1: error: no such file");
  check_contains(message_of(directory.path), path + "/case.toml:1:1: error: no such file");
  const std::string file = directory.write("case.toml", sphere).string();
  check_contains(message_of(file + "/below"), file + "/below:1:1: error: no such file");
  check_contains(message_of("/dev/null"), "/dev/null:1:1: error: is not a regular file");
  std::filesystem::create_directories(directory.path / "odd" / "case.toml");
  check_contains(message_of(directory.path / "odd"), "/odd/case.toml:1:1: error: is a directory");
}

BOOST_AUTO_TEST_CASE(unreadable) {
  const TemporaryDirectory directory;
  const auto file = directory.write("case.toml", sphere);
  std::filesystem::permissions(file, std::filesystem::perms::none);
  // The superuser may read anything, so the test steps down to nobody.
  const bool superuser = geteuid() == 0;
  std::filesystem::permissions(directory.path, std::filesystem::perms::all);
  BOOST_REQUIRE(!superuser || seteuid(65534) == 0);
  const std::string message = message_of(file);
  BOOST_REQUIRE(!superuser || seteuid(0) == 0);
  check_contains(message, "case.toml:1:1: error: cannot be read: Permission denied");
}

BOOST_AUTO_TEST_CASE(inherit_goes_wrong) {
  const TemporaryDirectory directory;
  directory.write("a.toml", "inherit = 'b.toml'\n");
  directory.write("b.toml", "inherit = 'c.toml'\n");
  directory.write("c.toml", "\ninherit = './a.toml'\n");
  check_contains(message_of(directory.path / "a.toml"), "c.toml:2:11: error:");
  check_contains(message_of(directory.path / "a.toml"), "a.toml' inherits from itself");
  check_contains(message_of(directory.write("d.toml", "inherit = 'nothing.toml'\n" + sphere)),
                 "d.toml:1:11: error: '" + (directory.path / "nothing.toml").string() + "': no such file");
  directory.write("good.toml", sphere);
  check_contains(message_of(directory.write("f.toml", "inherit = ['good.toml', 'good.toml']\n")),
                 "f.toml:1:11: error: 'good' stands twice in inherit");
  check_contains(message_of(directory.write("f.toml", "inherit = ['good.toml', 'nothing.toml']\n")),
                 "nothing.toml': no such file");
  directory.write("several.toml", "inherit = ['good.toml']\n");
  check_contains(message_of(directory.write("f.toml", "inherit = ['good.toml', 'several.toml']\n")),
                 "several.toml:1:11: error: only one of a case's files can inherit from several");
  // A mistake in the inherited file is shown there, beside those of the file that inherits.
  directory.write("bad.toml", sphere + "viscosity_ratio = -2\n");
  const std::string both = message_of(directory.write("e.toml", "inherit = 'bad.toml'\nacuracy = 1e-3\n"));
  check_contains(both, "e.toml:2:1: error: unknown key 'acuracy'");
  check_contains(both, "bad.toml:9:19: error: flow.viscosity_ratio = -2");
}

BOOST_AUTO_TEST_CASE(sweeps_go_wrong) {
  check_errors(sphere + "[sweep]\n'flow.viscosty_ratio' = [1]\n",
               {"10:1: error: unknown key 'flow.viscosty_ratio' in sweep"});
  check_errors(
      sphere + "[sweep]\n'flow.viscosity_ratio' = [1, 'a', -1]\n",
      {"10:30: error: flow.viscosity_ratio must be a number", "10:35: error: flow.viscosity_ratio = -1 is"});
  check_errors(sphere + "[sweep]\n'flow.viscosity_ratio' = 1\n",
               {"10:26: error: the sweep of flow.viscosity_ratio"});
  check_errors(sphere + "[sweep]\n'flow.viscosity_ratio' = []\n",
               {"10:26: error: the sweep of flow.viscosity_ratio"});
  check_errors(sphere + "[sweep]\n'flow.viscosity_ratio' = [1, 5, 1.0]\n",
               {"10:33: error: flow.viscosity_ratio = 1 stands twice"});
  check_errors(sphere + "[sweep]\n'flow.capillary_number' = [1]\n",
               {"10:1: error: 'flow.capillary_number' is both set and swept"});
  check_errors(sphere + "[sweep]\n'title' = ['a']\n", {"10:1: error: 'title' cannot be swept"});
  check_errors("sweep = 3\n" + sphere, {"1:1: error: 'sweep' is a section"});
  // One bad run among good ones, told once and at its value.
  check_errors(sphere.substr(0, sphere.find("radius")) + sphere.substr(sphere.find("[membrane]")) +
                   "[sweep]\n'capsule.start_x' = [-4, -29.5, -5]\n'capsule.radius' = [0.8, 0.9]\n",
               {"9:26: error: capsule outside the reservoir: it begins at x = -30.3",
                "9:26: error: capsule outside the reservoir: it begins at x = -30.4"});
  std::string many = "[1";
  for (int i = 2; i <= 101; ++i)
    many.append(",").append(std::to_string(i));
  check_errors(sphere + "[sweep]\n'flow.viscosity_ratio' = " + many +
                   "]\n'membrane.bending_ratio' = " + many + "]\n",
               {"1:1: error: the sweeps make more than 10000 runs"});
}

BOOST_AUTO_TEST_CASE(bad_overrides) {
  const TemporaryDirectory directory;
  const auto file = directory.write("case.toml", sphere);
  check_contains(message_of(file, {"flow.viscosity_ratio"}), "--set:1:1: error: expected key=value");
  check_contains(message_of(file, {"flow.viscosity=2"}), "--set:1:1: error: unknown key 'flow.viscosity'\n"
                                                         "    1 | flow.viscosity=2\n      | ^\ndid you mean");
  check_contains(message_of(file, {"flow.viscosity_ratio=high"}),
                 "--set:1:22: error: flow.viscosity_ratio must be a number, not the text 'high'");
  check_contains(message_of(file, {"flow.viscosity_ratio=[1,"}),
                 "--set:1:25: error: Error while parsing array");
  check_contains(message_of(file, {"=1"}), "--set:1:1: error:");
  check_contains(message_of(file, {"inherit=b.toml"}), "--set:1:1: error: unknown key 'inherit'");
  const std::string two = message_of(file, {"accuracy=1", "membrane.law=x"});
  check_contains(two, "accuracy = 1 is out of range");
  check_contains(two, "unknown membrane.law 'x'");
}

BOOST_AUTO_TEST_CASE(geometry_that_cannot_be) {
  const TemporaryDirectory directory;
  const auto file = directory.write("case.toml", sphere);
  const auto message = [&](const std::vector<std::string> &overrides) { return message_of(file, overrides); };
  const std::string too_large = "capsule larger than the pore's entrance at its start";
  check_contains(message({"capsule.start_x=-29.2"}), "--set:1:17: error: capsule outside the reservoir");
  check_contains(message({"capsule.start_x=14.5"}), "--set:1:17: error: capsule beyond the exit");
  // A sphere of radius 1.1 passes far upstream and not at the mouth; 0.9 fits everywhere.
  BOOST_TEST(message({"capsule.radius=1.1"}) == "no error");
  BOOST_TEST(message({"capsule.start_x=-0.1"}) == "no error");
  BOOST_TEST(message({"capsule.start_x=1"}) == "no error");
  check_contains(message({"capsule.radius=1.1", "capsule.start_x=0"}), too_large);
  check_contains(message({"capsule.radius=1.1", "capsule.start_x=2"}), too_large);
  check_contains(message({"capsule.radius=1.1", "pore.shape=tube"}), "--set:1:16: error: " + too_large);
  // A sphere of radius a whose centre is d upstream touches the wall of a 45 degree mouth when a^2 = 1 +
  // d^2/2.
  const std::vector<std::string> mouth{"pore.opening_angle_deg=45", "capsule.start_x=-2"};
  BOOST_TEST(message({mouth[0], mouth[1], "capsule.radius=1.7320"}) == "no error");
  check_contains(message({mouth[0], mouth[1], "capsule.radius=1.7321"}), too_large);
  // The orifice in a plane wall: only its rim at x = 0 is in the way.
  const std::vector<std::string> plane{"pore.opening_angle_deg=90", "capsule.start_x=-2"};
  BOOST_TEST(message({plane[0], plane[1], "capsule.radius=1.999"}) == "no error");

  check_contains(message({"until.x_g=-4"}), "--set:1:11: error: until.x_g = -4 lies upstream of the start");
  check_contains(message({"until.area_stretch=1"}),
                 "--set:1:20: error: until.area_stretch = 1 is out of range");
  check_contains(message({"until.tension=0"}), "--set:1:15: error: until.tension = 0 is out of range");
  check_contains(message({"until.area_stretch=1.1", "capsule.inflation=0.05"}),
                 "--set:1:20: error: the area stretch is 1.1025 before the flow");
  check_contains(message({"until.tension=0.05", "capsule.inflation=0.05"}), "before the flow");
  check_contains(message({"until.x_g=14.1"}),
                 "--set:1:11: error: at until.x_g = 14.1 the capsule would cross");
  check_contains(message({"output.profiles_at_x_g=[1, 12]"}),
                 "--set:1:24: error: the capsule never comes to x_g = 12");
  check_contains(message({"until.time=3", "output.profiles_at_time=[2,4]"}), "time 4 comes after the end");
  check_contains(message({"pore.shape=none"}), "--set:1:12: error: a pore flow needs a pore");
  check_contains(message({"time.step=1e-3"}),
                 "--set:1:11: error: time.step means nothing to time.scheme = \"bdf\"");
  check_contains(message({"time.scheme=rk4"}), "--set:1:13: error: time.scheme = \"rk4\" needs a time.step");
  check_contains(message({"time.scheme=rk4", "time.step=1e-3", "time.tolerance=1e-7"}),
                 "--set:1:16: error: time.tolerance means nothing to time.scheme = \"rk4\"");
  check_contains(message({"mesh.exit=20"}),
                 "--set:1:11: error: mesh.exit means nothing to numerics = \"standard\"");
  check_contains(message({"numerics=paper", "time.scheme=bdf"}),
                 "--set:1:13: error: numerics = \"paper\" marches with Euler's scheme only");
  check_contains(message({"numerics=paper", "pore.shape=tube"}),
                 "--set:1:12: error: numerics = \"paper\" has the hyperbolic pore only");
  check_contains(message({"numerics=paper", "flow.type=extension", "until.time=1"}),
                 "--set:1:11: error: numerics = \"paper\" computes no unbounded liquid");
  check_contains(message({"numerics=paper", "flow.drive=pressure"}),
                 "--set:1:12: error: numerics = \"paper\" has a given flow rate only");
  check_contains(message({"flow.type=extension"}), "--set:1:11: error: an extension needs until.time");
  check_contains(message({"flow.type=extension", "until.time=1", "capsule.radius=0.9"}),
                 "--set:1:16: error: in an extension lengths are scaled");
}

// A value that could make no difference would make a new name for the same run.
BOOST_AUTO_TEST_CASE(keys_that_mean_nothing) {
  const TemporaryDirectory directory;
  const auto file = directory.write("case.toml", sphere);
  const auto message = [&](const std::vector<std::string> &overrides) { return message_of(file, overrides); };
  struct Scene {
    std::vector<std::string> set;
    std::vector<std::pair<std::string, std::string>> refused; // the key, and what it means nothing to
  };
  for (const Scene &scene :
       {Scene{{"pore.shape=tube"}, {{"pore.opening_angle_deg=45", "pore.shape = \"tube\""}}},
        Scene{{"flow.type=extension", "until.time=1"},
              {{"pore.opening_angle_deg=45", "pore.shape = \"none\""},
               {"pore.exit_x=20", "flow.type = \"extension\""},
               {"pore.entrance_distance=20", "flow.type = \"extension\""},
               {"mesh.wall=100", "flow.type = \"extension\""},
               {"until.x_g=3", "flow.type = \"extension\""},
               {"flow.drive=pressure", "flow.type = \"extension\""},
               {"output.profiles_at_x_g=[1]", "flow.type = \"extension\""},
               {"physical.tube_radius='5 um'", "flow.type = \"extension\""}}},
        Scene{{"membrane.law=neo-hookean"},
              {{"membrane.dilatation=1", "membrane.law = \"neo-hookean\""},
               {"membrane.psi=0.5", "membrane.law = \"neo-hookean\""}}},
        Scene{{"membrane.law=mooney-rivlin"},
              {{"membrane.dilatation=1", "membrane.law = \"mooney-rivlin\""}}},
        Scene{{"numerics=paper"},
              {{"accuracy=1e-3", "numerics = \"paper\""},
               {"time.tolerance=1e-7", "time.scheme = \"euler\""}}}}) {
    BOOST_TEST(message(scene.set) == "no error");
    for (const auto &[value, to] : scene.refused) {
      std::vector<std::string> set = scene.set;
      set.push_back(value);
      const std::string key = value.substr(0, value.find('='));
      check_contains(message(set),
                     fmt::format("--set:1:{}: error: {} means nothing to {}", key.size() + 2, key, to));
      BOOST_TEST(count_of(message(set), "error:") == 1u);
    }
  }
}

BOOST_AUTO_TEST_CASE(inherited_values_that_mean_nothing) {
  const TemporaryDirectory directory;
  directory.write("common.toml", sphere +
                                     "[pore]\nshape = 'hyperbolic'\nopening_angle_deg = 45\nexit_x = 20\n"
                                     "[until]\nx_g = 3\n[output]\nprofiles_at_x_g = [1]\n");
  const auto identity = [&](const std::string &content, const std::vector<std::string> &overrides = {}) {
    const auto file = directory.write("case.toml", content);
    return run_identity(read_case(file, overrides).runs.at(0).physics);
  };
  const std::string common = "inherit = 'common.toml'\n";
  const std::string rubber =
      "capsule.radius = 0.9\nmembrane.law = 'neo-hookean'\nflow.capillary_number = 0.04\n";
  // The shape, the law and the flow are the file's own: what it inherits for others is left out.
  BOOST_TEST(
      identity(common + "pore.shape = 'tube'\n") ==
      identity(sphere +
               "[pore]\nshape = 'tube'\nexit_x = 20\n[until]\nx_g = 3\n[output]\nprofiles_at_x_g = [1]\n"));
  BOOST_TEST(identity(common + "membrane.law = 'neo-hookean'\n") ==
             identity(rubber + "pore.opening_angle_deg = 45\npore.exit_x = 20\nuntil.x_g = 3\n"
                               "output.profiles_at_x_g = [1]\n"));
  const std::string extension = "flow.type = 'extension'\nuntil.time = 1\n";
  BOOST_TEST(identity(common + extension) ==
             identity("membrane.law = 'skalak'\nmembrane.dilatation = 0\nflow.capillary_number = 0.04\n" +
                      extension));
  // Its own values are refused, also where the law is inherited.
  check_contains(message_of(directory.write("case.toml", common + "membrane.psi = 0.5\n")),
                 "case.toml:2:16: error: membrane.psi means nothing to membrane.law = \"skalak\"");
  // What stands above a file in --set is no better than in the file.
  check_contains(
      message_of(directory.write("case.toml", common), {"membrane.dilatation=2", "membrane.law=neo-hookean"}),
      "--set:1:21: error: membrane.dilatation means nothing");
}

// The directory of a run is called as its quantity was typed.
BOOST_AUTO_TEST_CASE(names_of_runs_in_physical_units) {
  const TemporaryDirectory directory;
  const auto file = directory.write(
      "case.toml", "membrane.law = 'skalak'\n[physical]\ntube_radius = '50 um'\n"
                   "capsule_radius = '40 um'\nviscosity = '1 Pa.s'\n"
                   "shear_modulus = '0.05 N/m'\n[sweep]\n"
                   "'physical.flow_rate' = ['5 uL/min', '0.5 \u00b5L/min', '1e-3 mm^3 s^-1']\n");
  const CaseInput input = read_case(file);
  BOOST_REQUIRE(input.runs.size() == 3u);
  BOOST_TEST(input.runs[0].name == "flow_rate=5uL_per_min");
  BOOST_TEST(input.runs[1].name == "flow_rate=0.5uL_per_min");
  BOOST_TEST(input.runs[2].name == "flow_rate=1e-3mm3s-1");
}

BOOST_AUTO_TEST_CASE(values_that_serve_some_of_the_runs) {
  const TemporaryDirectory directory;
  const std::string radius = "capsule.radius = 0.9\nflow.capillary_number = 0.04\n";
  const std::string laws = "sweep.'membrane.law' = ['neo-hookean', 'skalak', 'mooney-rivlin']\n";
  const auto names = [&](const std::string &content, const Task &task = {}) {
    std::string all;
    for (const RunInput &run : read_case(directory.write("case.toml", radius + content), {}, task).runs)
      all += run.name + ";";
    return all;
  };
  BOOST_TEST(names(laws + "membrane.dilatation = 2\n") == "law=neo-hookean;law=skalak;law=mooney-rivlin;");
  // A swept value makes a run of those laws that know it only.
  BOOST_TEST(names(laws + "sweep.'membrane.dilatation' = [0, 1]\n") ==
             "law=neo-hookean;law=skalak,dilatation=0;law=skalak,dilatation=1;law=mooney-rivlin;");
  check_contains(
      message_of(directory.write("case.toml", radius + laws + "membrane.area_modulus = 2\n")),
      "case.toml:4:25: error: membrane.area_modulus means nothing to membrane.law = \"neo-hookean\"");
  // Where a motion starts makes no second steady state.
  const std::string starts = "membrane.law = 'skalak'\nsweep.'capsule.start_x' = [-4, -5]\n";
  BOOST_TEST(names(starts) == "start_x=-4;start_x=-5;");
  BOOST_TEST(names(starts, {.motion = false, .name = "steady"}) == ";");
}

BOOST_AUTO_TEST_SUITE_END()
