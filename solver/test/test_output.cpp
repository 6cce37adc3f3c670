// Files of a run: exact checkpoints, whole files or none, and what the summary says.
#include "case_file.hpp"
#include "failure.hpp"
#include "output.hpp"
#include "temporary_directory.hpp"
#include <algorithm>
#include <array>
#include <bit>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <csignal>
#include <fcntl.h>
#include <functional>
#include <random>
#include <sys/file.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

using namespace capsule;
namespace fs = std::filesystem;

namespace {

Vector random_vector(Eigen::Index size, std::mt19937 &random) {
  std::normal_distribution<double> normal(0, 1);
  return Vector::NullaryExpr(size, [&] { return normal(random); });
}

Checkpoint random_checkpoint() {
  std::mt19937 random(20);
  std::normal_distribution<double> normal(0, 1);
  const auto number = [&] { return normal(random) * std::pow(10, 20 * normal(random)); };
  Checkpoint checkpoint;
  checkpoint.time = number();
  checkpoint.steps = 1234567;
  checkpoint.position = random_vector(24, random);
  for (int i = 0; i < 5; ++i)
    checkpoint.series.push_back({number(), number(), number(), number(), number(), number(), number(),
                                 number(), number(), number(), number(), number(), number(), number()});
  checkpoint.series[2].min_film = std::numeric_limits<double>::infinity();
  checkpoint.series[3].pressure_drop = -0.0;
  for (const Eigen::Index points : {7, 3}) {
    Profile profile{number(), number(), {}, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}};
    for (const auto field :
         {&Profile::S, &Profile::x, &Profile::r, &Profile::stretch_meridional, &Profile::stretch_azimuthal,
          &Profile::tension_meridional, &Profile::tension_azimuthal, &Profile::moment_meridional,
          &Profile::moment_azimuthal, &Profile::curvature_meridional, &Profile::curvature_azimuthal,
          &Profile::velocity_x, &Profile::velocity_r})
      profile.*field = random_vector(points, random);
    checkpoint.profiles.push_back(profile);
  }
  return checkpoint;
}

// The same bits, also of infinities and signed zeros.
bool same(double a, double b) {
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

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

std::string failure_of(const std::function<void()> &action) {
  try {
    action();
  } catch (const FileError &error) {
    return error.what();
  }
  return "no error";
}

std::size_t files_in(const fs::path &directory) {
  return static_cast<std::size_t>(std::distance(fs::directory_iterator(directory), {}));
}

std::vector<std::string> lines_of(const fs::path &file) {
  std::vector<std::string> lines;
  std::istringstream stream(content_of(file));
  for (std::string line; std::getline(stream, line);)
    lines.push_back(line);
  return lines;
}

} // namespace

BOOST_AUTO_TEST_CASE(checkpoint_comes_back_bit_by_bit) {
  const TemporaryDirectory directory;
  const Checkpoint written = random_checkpoint();
  write_checkpoint(directory.path, "abc", {written, {"2002-01-01T00:00:00Z", 0.1, 0.3}});
  BOOST_TEST(!read_checkpoint(directory.path, "other"));
  const auto saved = read_checkpoint(directory.path, "abc");
  BOOST_REQUIRE(saved);
  BOOST_TEST(saved->effort.started == "2002-01-01T00:00:00Z");
  BOOST_TEST(saved->effort.cpu_seconds == 0.1);
  BOOST_TEST(saved->effort.wall_seconds == 0.3);
  const Checkpoint &read = saved->checkpoint;
  BOOST_TEST(same(read.time, written.time));
  BOOST_TEST(read.steps == written.steps);
  BOOST_TEST((read.position.array() == written.position.array()).all());
  BOOST_REQUIRE(read.series.size() == written.series.size());
  for (std::size_t i = 0; i < read.series.size(); ++i) {
    // Every field, also one that is added to the row later, has to come back.
    using Bits = std::array<std::uint64_t, sizeof(SeriesRow) / sizeof(double)>;
    BOOST_TEST((std::bit_cast<Bits>(read.series[i]) == std::bit_cast<Bits>(written.series[i])));
  }
  BOOST_REQUIRE(read.profiles.size() == written.profiles.size());
  for (std::size_t i = 0; i < read.profiles.size(); ++i) {
    BOOST_TEST(same(read.profiles[i].x_g, written.profiles[i].x_g));
    BOOST_TEST((read.profiles[i].S.array() == written.profiles[i].S.array()).all());
    BOOST_TEST((read.profiles[i].velocity_r.array() == written.profiles[i].velocity_r.array()).all());
  }
}

BOOST_AUTO_TEST_CASE(damaged_checkpoint_is_named) {
  const TemporaryDirectory directory;
  BOOST_TEST(!read_checkpoint(directory.path, "abc"));
  const auto file = directory.write("checkpoint.json", "{\"identity\": \"abc\", \"time\": ");
  BOOST_TEST(failure_of([&] { read_checkpoint(directory.path, "abc"); }).find(file.string()) !=
             std::string::npos);
  directory.write("checkpoint.json", "{\"identity\": \"abc\"}");
  BOOST_TEST(failure_of([&] { read_checkpoint(directory.path, "abc"); }).find("--fresh") !=
             std::string::npos);
}

BOOST_AUTO_TEST_CASE(damaged_provenance_is_named) {
  const TemporaryDirectory directory;
  directory.write("summary.json", "{}");
  for (const char *damaged : {"[]", "3", "{\"identity\": 3}"}) {
    const auto file = directory.write("run.json", damaged);
    BOOST_TEST(failure_of([&] { is_finished(directory.path, "abc"); }).find(file.string()) !=
               std::string::npos);
  }
}

BOOST_AUTO_TEST_CASE(files_are_whole_or_not_there) {
  const TemporaryDirectory directory;
  const fs::path file = directory.path / "a.txt";
  write_atomically(file, "first");
  write_atomically(file, "second");
  BOOST_TEST(content_of(file) == "second");
  BOOST_TEST(files_in(directory.path) == 1u);

  BOOST_TEST(failure_of([&] { write_atomically(directory.path / "none" / "a.txt", "x"); }) ==
             "cannot write '" + (directory.path / "none" / "a.txt").string() +
                 "': No such file or directory");
  // A directory stands where the file should go: nothing is left behind.
  fs::create_directories(directory.path / "taken" / "b.txt" / "c");
  BOOST_TEST(failure_of([&] { write_atomically(directory.path / "taken" / "b.txt", "x"); }) != "no error");
  BOOST_TEST(files_in(directory.path / "taken") == 1u);
  BOOST_TEST(failure_of([&] { make_directories(file / "below"); }).find("a.txt/below") != std::string::npos);
  BOOST_TEST(failure_of([&] { write_atomically("/proc/self/a.txt", "x"); }).find("/proc/self/a.txt") !=
             std::string::npos);
}

BOOST_AUTO_TEST_CASE(what_a_killed_writer_leaves_is_overwritten) {
  const TemporaryDirectory directory;
  const fs::path file = directory.path / "a.txt", left = directory.path / ".writing-a.txt";
  std::ofstream(left) << "longer than what comes";
  write_atomically(file, "whole");
  BOOST_TEST(content_of(file) == "whole");
  BOOST_TEST(files_in(directory.path) == 1u);

  // A writer that lives keeps its own.
  std::ofstream(left) << "of another";
  const int other = open(left.c_str(), O_RDONLY | O_CLOEXEC);
  BOOST_REQUIRE(flock(other, LOCK_EX) == 0);
  write_atomically(file, "once more");
  BOOST_TEST(content_of(file) == "once more");
  BOOST_TEST(content_of(left) == "of another");
  BOOST_TEST(files_in(directory.path) == 2u);
  close(other);
}

// While many processes write one file, whoever reads finds one text or the other, whole.
BOOST_AUTO_TEST_CASE(writers_at_once) {
  const TemporaryDirectory directory;
  const fs::path file = directory.path / "a.txt";
  const std::array texts{std::string(3000, 'a'), std::string(5, 'b'), std::string(70000, 'c')};
  write_atomically(file, texts[0]);
  std::vector<pid_t> writers;
  for (const std::string &text : texts) {
    const pid_t writer = fork();
    if (writer == 0) {
      try {
        for (int i = 0; i < 50; ++i)
          write_atomically(file, text);
        _exit(0);
      } catch (const FileError &) {
        _exit(1);
      }
    }
    writers.push_back(writer);
  }
  for (int i = 0; i < 50; ++i) {
    const std::string seen = content_of(file);
    BOOST_TEST((std::ranges::find(texts, seen) != texts.end()));
  }
  for (const pid_t writer : writers) {
    int status = 0;
    BOOST_TEST(waitpid(writer, &status, 0) == writer);
    BOOST_TEST(status == 0);
  }
  BOOST_TEST(files_in(directory.path) == 1u);
}

BOOST_AUTO_TEST_CASE(a_file_size_limit_leaves_nothing_half_written) {
  const TemporaryDirectory directory;
  const fs::path file = directory.path / "a.txt";
  write_atomically(file, "old");
  rlimit before{};
  BOOST_REQUIRE(getrlimit(RLIMIT_FSIZE, &before) == 0);
  const rlimit small{4096, before.rlim_max};
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  BOOST_REQUIRE(setrlimit(RLIMIT_FSIZE, &small) == 0);
  const std::string failure = failure_of([&] { write_atomically(file, std::string(10000, 'x')); });
  BOOST_REQUIRE(setrlimit(RLIMIT_FSIZE, &before) == 0);
  std::signal(SIGXFSZ, handler);
  BOOST_TEST(failure == "cannot write '" + file.string() + "': File too large");
  BOOST_TEST(content_of(file) == "old");
  BOOST_TEST(files_in(directory.path) == 1u);
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
  changed.until = {.x_g = {}, .time = 3};
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
  BOOST_TEST(files_in(two) == files_in(one));
  BOOST_TEST(content_of(two / "summary.json") == content_of(one / "summary.json"));
  BOOST_TEST(fs::hard_link_count(two / "summary.json") == 2u);
  share_results(one, two);
  BOOST_TEST(files_in(two) == files_in(one));

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
  for (const char *left : {".writing-summary.json.123", ".writing-summary.json", ".writing-checkpoint.json"})
    std::ofstream(two / left) << "{";
  remove_results(two);
  BOOST_TEST(files_in(two) == 1u);
}

BOOST_AUTO_TEST_CASE(entry_peak_of_a_pulse) {
  // Rises to a peak between two rows, dips, and goes on to a higher plateau with ripples below a thousandth.
  std::vector<SeriesRow> series;
  const double peak_at = 0.123;
  for (int i = 0; i <= 300; ++i) {
    SeriesRow row;
    row.x_g = -4 + 0.05 * i + 0.004 * std::sin(i); // uneven
    const double entry = 6 * std::exp(-std::pow((row.x_g - peak_at) / 0.8, 2));
    const double plateau = 14 / (1 + std::exp(-4 * (row.x_g - 4)));
    row.pressure_drop = entry + plateau + 0.001 * std::sin(3 * i);
    series.push_back(row);
  }
  const auto peak = entry_peak(series);
  BOOST_REQUIRE(peak);
  BOOST_TEST(std::abs(peak->x_g - peak_at) < 0.05);
  BOOST_TEST(std::abs(peak->pressure_drop - 6) < 0.01);

  // A parabola is met exactly, wherever the rows are.
  std::vector<SeriesRow> parabola(4);
  for (std::size_t i = 0; i < 4; ++i) {
    parabola[i].x_g = std::array{0.0, 0.7, 1.1, 2.0}.at(i);
    parabola[i].pressure_drop = 3 - std::pow(parabola[i].x_g - 0.8, 2);
  }
  BOOST_TEST(entry_peak(parabola)->x_g == 0.8, boost::test_tools::tolerance(1e-14));
  BOOST_TEST(entry_peak(parabola)->pressure_drop == 3, boost::test_tools::tolerance(1e-14));

  // Without a fall: the largest value.
  parabola.resize(2);
  BOOST_TEST(entry_peak(parabola)->pressure_drop == parabola[1].pressure_drop);
  BOOST_TEST(!entry_peak({}));
}
