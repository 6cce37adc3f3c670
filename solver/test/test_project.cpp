// Cases of the project by their names.
#include "case/project.hpp"
#include "temporary_directory.hpp"
#include <boost/test/unit_test.hpp>

using namespace capsule;

BOOST_AUTO_TEST_CASE(cases_by_their_names) {
  const TemporaryDirectory root;
  const auto sphere = root.write("cases/fig07-sphere/case.toml", "").parent_path();
  const auto stored =
      root.write("cases/fig07-sphere/paper-mesh/a/summary.json", "").parent_path().parent_path();
  const auto mesh = root.write("cases/fig07-sphere/paper-mesh.toml", "");
  const auto start = root.write("validation/start/case.toml", "").parent_path();
  root.write("validation/a-study/study.cpp", "");
  BOOST_TEST(find_project_case(root.path, "fig07-sphere")->file == sphere);
  BOOST_TEST(find_project_case(root.path, "fig07-sphere")->stored == "");
  BOOST_TEST(find_project_case(root.path, "fig07-sphere-paper-mesh")->file == mesh);
  BOOST_TEST(find_project_case(root.path, "fig07-sphere-paper-mesh")->stored == stored);
  BOOST_TEST(!find_project_case(root.path, "a-study"));
  BOOST_TEST(nearest_project_case(root.path, "fig07-sphere") == sphere);
  BOOST_TEST(nearest_project_case(root.path, "fig07-shpere") == sphere);
  BOOST_TEST(nearest_project_case(root.path, "strat") == start);
  BOOST_TEST(nearest_project_case(root.path, "a-study") == "");
  BOOST_TEST(nearest_project_case(root.path / "nowhere", "start") == "");
}
