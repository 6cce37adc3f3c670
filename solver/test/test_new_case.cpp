// A new case directory from another: copied whole, refused where it would overwrite or could not be read.
#include "base/failure.hpp"
#include "case/case_file.hpp"
#include "case/new_case.hpp"
#include "compare/expectations.hpp"
#include "temporary_directory.hpp"
#include <boost/test/unit_test.hpp>
#include <fmt/format.h>

using namespace capsule;

namespace {

const std::string sphere = "capsule.radius = 0.9\nmembrane.law = 'skalak'\nflow.capillary_number = 0.04\n";

struct Project : TemporaryDirectory {
  Project() {
    write("cases/common.toml", sphere);
    write("cases/old/case.toml", "# Why?\ninherit = '../common.toml'\nflow.viscosity_ratio = 5\n");
    write("cases/old/figure.gp", "plot x\n");
  }
};

void check_refused(const Project &project, const std::string &id, const std::string &like,
                   const std::string &part) {
  try {
    new_case(project.path, id, project.path / like);
    BOOST_ERROR("accepted: " << id << " like " << like);
  } catch (const InputError &error) {
    BOOST_TEST(std::string(error.what()).find(part) != std::string::npos, error.what());
  }
}

} // namespace

BOOST_AUTO_TEST_CASE(a_copy_is_a_case_of_its_own) {
  const Project project;
  const auto directory = new_case(project.path, "new", project.path / "cases" / "old");
  BOOST_TEST(directory == project.path / "cases" / "new");
  BOOST_TEST(content_of(directory / "figure.gp") == "plot x\n");
  const CaseInput input = read_case(directory);
  BOOST_TEST(input.name == "new");
  BOOST_TEST(input.runs.at(0).physics.flow.viscosity_ratio == 5);
  BOOST_TEST(input.runs.at(0).physics.title == "new");
  BOOST_TEST(own_expectations(input.file, "new").size() == 2u);
}

BOOST_AUTO_TEST_CASE(a_case_of_the_project_goes_by_its_name) {
  const Project project;
  BOOST_TEST(content_of(new_case(project.path, "new", "old") / "figure.gp") == "plot x\n");
}

BOOST_AUTO_TEST_CASE(refused) {
  const Project project;
  check_refused(project, "old", "cases/old", "old:1:1: error: cases/old already exists");
  check_refused(project, "common.toml", "cases/old", "already exists");
  check_refused(project, "../new", "cases/old", "a case's name is made of");
  check_refused(project, "", "cases/old", "a case's name is made of");
  for (const char *name : {"old (copy)", "a&b", "it's", "a\nb", "gr\u00f6\u00dfe", "-x", ".x", "a;b", "a/b"})
    check_refused(project, name, "cases/old", "a case's name is made of");
  check_refused(project, std::string(101, 'x'), "cases/old", "at most 100 characters");
  for (const char *name :
       {"benchmark", "branch", "ledger", "published", "runs", "steady", "table1", "table12", "gallery.md",
        "style.gp", "all", "clean", "test", "help", "install", "figures"})
    check_refused(
        project, name, "cases/old",
        fmt::format("'{}' is taken: by a target of the build, or in results/, figures/ or tables/", name));
  // A study, and results that are stored with a case.
  project.write("validation/study/study.cpp", "");
  project.write("cases/old/mesh.toml", sphere);
  check_refused(project, "study", "cases/old", "validation/study already exists");
  check_refused(project, "old-mesh", "cases/old", "it is the name of 'cases/old/mesh.toml'");
  check_refused(project, "new", "cases/none", "cases/none:1:1: error: is not a case directory");
  check_refused(project, "new", "cases", "cases/case.toml:1:1: error: no such file");
  // From elsewhere the inherited file would be missing: nothing stays behind.
  project.write("far/away/deep/case.toml", "inherit = '../base.toml'\n");
  project.write("far/away/base.toml", sphere);
  check_refused(project, "new", "far/away/deep", "cases/new/case.toml:3:11: error:");
  BOOST_TEST(!std::filesystem::exists(project.path / "cases" / "new"));
}
