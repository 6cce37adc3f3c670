// The runs of a case with a stand-in for the march: reuse, interruption at any step, sharing, failures.
#include "base/failure.hpp"
#include "case/identity.hpp"
#include "program/case_runs.hpp"
#include "program/run_list.hpp"
#include "temporary_directory.hpp"
#include <array>
#include <atomic>
#include <boost/test/unit_test.hpp>
#include <csignal>
#include <fcntl.h>
#include <functional>
#include <new>
#include <sys/file.h>
#include <system_error>
#include <thread>
#include <unistd.h>

using namespace capsule;
namespace fs = std::filesystem;

namespace {

// A chaotic map instead of a capsule: any lost bit shows. Goes on from every fifth step.
Outcome chaotic_march(const Case &physics, const Checkpoint &from, const Control &control) {
  Checkpoint now = from;
  if (now.position.size() == 0)
    now.position = Vector::Constant(1, 0.1 + 0.01 * physics.flow.viscosity_ratio);
  const long last = 200;
  while (now.steps < last) {
    if (now.steps % 5 == 0)
      control.save(now);
    now.position[0] = 3.99 * now.position[0] * (1 - now.position[0]);
    ++now.steps;
    now.time += 0.1;
    SeriesRow row;
    row.time = now.time;
    row.x_g = physics.capsule.start_x + 0.08 * static_cast<double>(now.steps);
    row.v_g = now.position[0];
    now.series.push_back(row);
    if (now.steps % 100 == 0) {
      Profile profile;
      profile.time = now.time;
      profile.x = profile.r = profile.S = now.position;
      profile.stretch_meridional = profile.stretch_azimuthal = profile.tension_meridional = now.position;
      profile.tension_azimuthal = profile.moment_meridional = profile.moment_azimuthal = now.position;
      profile.curvature_meridional = profile.curvature_azimuthal = now.position;
      profile.velocity_x = profile.velocity_r = now.position;
      now.profiles.push_back(profile);
    }
    control.progress(row, now.steps);
    if (control.interrupted())
      return {Status::interrupted, "", "", now, {}};
  }
  return {Status::reached, "", "", now, {{"v_g", 1e-6}}};
}

CaseInput case_with(const std::vector<double> &viscosity_ratios) {
  CaseInput input{"test", "case.toml", {}};
  for (const double ratio : viscosity_ratios) {
    RunInput run;
    run.physics.capsule.radius = 0.9;
    run.physics.flow.capillary_number = 0.04;
    run.physics.flow.viscosity_ratio = ratio;
    run.physics.until.x_g = 12;
    run.name =
        viscosity_ratios.size() > 1 ? "viscosity_ratio=" + std::to_string(static_cast<int>(ratio)) : "";
    input.runs.push_back(run);
  }
  return input;
}

// The files of a run without what tells of the way: run.json and the seconds.
std::map<std::string, std::string> numbers_in(const fs::path &directory) {
  std::map<std::string, std::string> files;
  for (const auto &entry : fs::directory_iterator(directory))
    if (entry.path().filename() != "run.json") {
      std::istringstream stream(content_of(entry.path()));
      std::string &text = files[entry.path().filename().string()];
      for (std::string line; std::getline(stream, line);)
        if (line.find("_seconds\"") == std::string::npos)
          text += line + "\n";
    }
  return files;
}

// Counts how often a run is computed.
struct Counted {
  std::atomic<int> calls = 0;
  Method method = [this](const Case &physics, const Checkpoint &from, const Control &control) {
    ++calls;
    return chaotic_march(physics, from, control);
  };
};

} // namespace

BOOST_AUTO_TEST_CASE(interrupted_anywhere_and_resumed_is_as_if_never_interrupted) {
  const TemporaryDirectory directory;
  RunOptions straight{.directory = directory.path / "straight"};
  BOOST_REQUIRE(compute(case_with({1}), straight, chaotic_march).at(0).summary);
  const auto expected = numbers_in(straight.directory);
  BOOST_TEST(expected.size() ==
             4u + 1 + 2 + 1); // summary, series, profiles, input; collection, surfaces, wall
  for (const int patience : {2, 63}) {
    RunOptions stopped{.directory = directory.path / std::to_string(patience),
                       .seconds_between_checkpoints = 0};
    int interruptions = 0;
    for (bool finished = false; !finished;) {
      int steps = 0;
      // Below five steps at a time there would be no progress: patience grows.
      stopped.stop = [&] { return ++steps > patience + 3 * interruptions; };
      finished = compute(case_with({1}), stopped, chaotic_march).at(0).summary.has_value();
      interruptions += finished ? 0 : 1;
      BOOST_TEST(fs::exists(stopped.directory / "summary.json") == finished);
      BOOST_TEST(fs::exists(stopped.directory / "checkpoint.json") == !finished);
    }
    BOOST_TEST(interruptions >= 1);
    BOOST_TEST((numbers_in(stopped.directory) == expected));
  }
}

BOOST_AUTO_TEST_CASE(killed_between_checkpoints) {
  const TemporaryDirectory directory;
  RunOptions options{.directory = directory.path / "a", .seconds_between_checkpoints = 0};
  compute(case_with({1}), options, chaotic_march);
  const auto expected = numbers_in(options.directory);
  // Like a killed process: nothing more is written after the exception.
  struct Killed {};
  options.directory = directory.path / "b";
  int steps = 0;
  options.stop = [&]() -> bool {
    if (++steps == 88)
      throw Killed{};
    return false;
  };
  BOOST_CHECK_THROW(compute(case_with({1}), options, chaotic_march), Killed);
  BOOST_TEST(fs::exists(options.directory / "checkpoint.json"));
  const RunState state = state_of(case_with({1}).runs[0], options);
  BOOST_TEST(!state.finished);
  BOOST_TEST(state.fraction == 85 * 0.08 / 16, boost::test_tools::tolerance(1e-12));
  compute(case_with({1}), options, chaotic_march);
  BOOST_TEST((numbers_in(options.directory) == expected));
}

BOOST_AUTO_TEST_CASE(finished_runs_are_used_again) {
  const TemporaryDirectory directory;
  Counted counted;
  RunOptions options{.directory = directory.path / "a"};
  compute(case_with({1, 5}), options, counted.method);
  BOOST_TEST(counted.calls == 2);
  compute(case_with({1, 5}), options, counted.method);
  BOOST_TEST(counted.calls == 2);
  // A process that is killed when only its checkpoint is left to remove has finished.
  const auto checkpoint = directory.write("a/viscosity_ratio=1/checkpoint.json", "{\"identity\":");
  compute(case_with({1, 5}), options, counted.method);
  BOOST_TEST(counted.calls == 2);
  BOOST_TEST(!fs::exists(checkpoint));
  BOOST_TEST(state_of(case_with({1, 5}).runs[1], options).finished);
  // Another physics in the same place replaces it.
  CaseInput changed = case_with({1, 5});
  changed.runs[0].physics.flow.capillary_number = 0.05;
  BOOST_TEST(!state_of(changed.runs[0], options).finished);
  compute(changed, options, counted.method);
  BOOST_TEST(counted.calls == 3);
  options.fresh = true;
  compute(changed, options, counted.method);
  BOOST_TEST(counted.calls == 5);
}

BOOST_AUTO_TEST_CASE(runs_of_another_program_count_only_where_the_user_says) {
  const TemporaryDirectory directory;
  Counted counted;
  const CaseInput input = case_with({1});
  const RunOptions named{.directory = directory.path / "a"};
  const RunOptions pooled{.directory = directory.path / "b", .pool = directory.path / "runs"};
  compute(input, named, counted.method);
  compute(input, pooled, counted.method);
  BOOST_TEST(counted.calls == 2);
  directory.write("a/run.json", "{\"identity\": \"of another program\"}");
  directory.write("runs/" + run_identity(input.runs[0].physics) + "/run.json", "{\"identity\": \"other\"}");
  compute(input, named, counted.method);
  BOOST_TEST(counted.calls == 2);
  compute(input, pooled, counted.method);
  BOOST_TEST(counted.calls == 3);
}

BOOST_AUTO_TEST_CASE(a_fresh_start_forgets_the_checkpoint) {
  const TemporaryDirectory directory;
  RunOptions options{.directory = directory.path, .fresh = true};
  const auto checkpoint = directory.write("checkpoint.json", "{\"identity\": damaged");
  bool there = true;
  const Method method = [&](const Case &physics, const Checkpoint &from, const Control &control) {
    there = fs::exists(checkpoint);
    return chaotic_march(physics, from, control);
  };
  compute(case_with({1}), options, method);
  BOOST_TEST(!there);
}

BOOST_AUTO_TEST_CASE(bad_input_of_one_run_stops_no_other) {
  const TemporaryDirectory directory;
  const Method method = [](const Case &physics, const Checkpoint &from, const Control &control) {
    if (physics.flow.viscosity_ratio == 1)
      throw InputError("not this one");
    return chaotic_march(physics, from, control);
  };
  for (const unsigned jobs : {1u, 2u}) {
    const RunOptions options{.directory = directory.path / std::to_string(jobs), .jobs = jobs};
    BOOST_CHECK_EXCEPTION(compute(case_with({1, 2, 3, 4}), options, method), InputError,
                          [](const InputError &error) {
                            return std::string(error.what()) == "error: 1 of 4 runs could not be computed\n";
                          });
    for (const char *other : {"2", "3", "4"})
      BOOST_TEST(fs::exists(options.directory / (std::string("viscosity_ratio=") + other) / "summary.json"));
  }
}

BOOST_AUTO_TEST_CASE(children_are_seen_where_their_signal_was_ignored) {
  const TemporaryDirectory directory;
  std::signal(SIGCHLD, SIG_IGN);
  const RunOptions options{.directory = directory.path, .jobs = 2};
  for (const RunResult &result : compute(case_with({1, 2, 3}), options, chaotic_march))
    BOOST_TEST(result.summary.has_value());
}

BOOST_AUTO_TEST_CASE(cases_share_their_runs) {
  const TemporaryDirectory directory;
  Counted counted;
  const RunOptions first{.directory = directory.path / "one", .pool = directory.path / "runs"};
  const RunOptions second{.directory = directory.path / "two", .pool = directory.path / "runs"};
  compute(case_with({1, 5}), first, counted.method);
  const auto results = compute(case_with({5}), second, counted.method);
  BOOST_TEST(counted.calls == 2);
  BOOST_TEST(results.at(0).summary->status == "reached");
  BOOST_TEST(
      (numbers_in(directory.path / "two") == numbers_in(directory.path / "one" / "viscosity_ratio=5")));
}

BOOST_AUTO_TEST_CASE(the_list_of_runs_is_that_of_the_case) {
  const TemporaryDirectory directory;
  write_run_list(case_with({10, 5, 1}), directory.path / "case");
  write_run_list(case_with({10, 5}), directory.path / "case");
  BOOST_TEST(content_of(directory.path / "case/runs.txt") == "viscosity_ratio=10\nviscosity_ratio=5\n");
  write_run_list(case_with({1}), directory.path / "single");
  BOOST_TEST(content_of(directory.path / "single/runs.txt") == ".\n");
}

BOOST_AUTO_TEST_CASE(runs_side_by_side_are_those_one_after_the_other) {
  const TemporaryDirectory directory;
  const CaseInput input = case_with({1, 2, 3, 4});
  compute(input, {.directory = directory.path / "one", .jobs = 1}, chaotic_march);
  const auto results = compute(input, {.directory = directory.path / "four", .jobs = 4}, chaotic_march);
  BOOST_REQUIRE(results.size() == 4u);
  for (std::size_t i = 0; i < 4; ++i) {
    BOOST_TEST(results[i].input.name == input.runs[i].name);
    BOOST_TEST((numbers_in(results[i].directory) == numbers_in(directory.path / "one" / input.runs[i].name)));
  }
}

BOOST_AUTO_TEST_CASE(a_failed_run_keeps_what_was_computed_and_stops_no_other) {
  const TemporaryDirectory directory;
  const Method method = [](const Case &physics, const Checkpoint &from, const Control &control) {
    Outcome outcome = chaotic_march(physics, from, control);
    if (physics.flow.viscosity_ratio == 2) {
      outcome.status = Status::failed;
      outcome.failure = "wrinkled";
      outcome.message = "the membrane wrinkles at t = 3";
    }
    return outcome;
  };
  const RunOptions options{.directory = directory.path / "a"};
  const auto results = compute(case_with({1, 2, 3}), options, method);
  BOOST_TEST(results[1].summary->status == "failed");
  BOOST_TEST(results[1].summary->failure == "wrinkled");
  BOOST_TEST(results[1].summary->quantities.at("steps") == 200);
  BOOST_TEST(results[2].summary->status == "reached");
}

BOOST_AUTO_TEST_CASE(a_place_that_cannot_be_written) {
  const TemporaryDirectory directory;
  directory.write("file", "");
  const RunOptions options{.directory = directory.path / "file" / "below"};
  BOOST_TEST(failure_of([&] { compute(case_with({1}), options, chaotic_march); }).find("file/below") !=
             std::string::npos);
}

// Whatever ends a run but its numerics: the others are computed, and the same command computes what is missing.
BOOST_AUTO_TEST_CASE(a_lost_run_stops_no_other) {
  const std::array<std::function<void()>, 4> losses{
      [] { raise(SIGKILL); }, [] { throw FileError("no room"); }, [] { throw std::bad_alloc(); },
      [] {
        throw std::filesystem::filesystem_error("no room",
                                                std::make_error_code(std::errc::no_space_on_device));
      }};
  for (std::size_t k = 0; k < losses.size(); ++k)
    for (const unsigned jobs : {1u, 2u}) {
      if (k == 0 && jobs == 1)
        continue; // this process itself
      const TemporaryDirectory directory;
      const Method method = [&](const Case &physics, const Checkpoint &from, const Control &control) {
        if (physics.flow.viscosity_ratio == 2)
          losses.at(k)();
        return chaotic_march(physics, from, control);
      };
      const RunOptions options{.directory = directory.path, .jobs = jobs};
      if (k == 2)
        BOOST_CHECK_EXCEPTION(compute(case_with({1, 2, 3, 4}), options, method), std::runtime_error,
                              [](const std::runtime_error &error) {
                                return std::string(error.what()) == "1 of 4 runs could not be computed";
                              });
      else
        BOOST_TEST(failure_of([&] {
                     compute(case_with({1, 2, 3, 4}), options, method);
                   }) == "1 of 4 runs could not be computed; the same command computes what is missing");
      Counted counted;
      for (const RunResult &result : compute(case_with({1, 2, 3, 4}), options, counted.method))
        BOOST_TEST(result.summary.has_value());
      if (jobs == 1)
        BOOST_TEST(counted.calls == 1);
    }
}

BOOST_AUTO_TEST_CASE(a_run_that_is_lost_while_others_are_interrupted) {
  const TemporaryDirectory directory;
  const Method method = [](const Case &physics, const Checkpoint &from, const Control &control) {
    if (physics.flow.viscosity_ratio == 1)
      raise(SIGKILL);
    while (!control.interrupted())
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    return Outcome{Status::interrupted, "", "", from, {}};
  };
  RunOptions options{.directory = directory.path, .jobs = 2};
  const pid_t first = getpid();
  int asked = 0;
  options.stop = [&] { return getpid() == first && ++asked > 20; };
  for (const RunResult &result : compute(case_with({1, 2, 3}), options, method))
    BOOST_TEST(!result.summary);
  BOOST_TEST(fs::exists(directory.path / "viscosity_ratio=2" / "checkpoint.json"));
}

// What lies where a run's files would come is neither overwritten nor removed.
BOOST_AUTO_TEST_CASE(files_of_others_stay) {
  const TemporaryDirectory directory;
  for (const char *name :
       {"series.csv", "run.json", "summary.json", "membrane_0007.vtp", "checkpoint.json"}) {
    const auto file = directory.write("a/" + std::string(name), "mine");
    const std::string failure = failure_of(
        [&] { compute(case_with({1}), {.directory = directory.path / "a", .fresh = true}, chaotic_march); });
    BOOST_TEST(failure.find(name) != std::string::npos);
    BOOST_TEST(content_of(file) == "mine");
    BOOST_TEST(entries_in(directory.path / "a") == 1u);
    fs::remove(file);
  }
  const auto other = directory.write("a/membrane_smoothed.vtp", "mine"),
             list = directory.write("a/runs.txt", "mine\n");
  for (const double ratio : {1.0, 2.0}) {
    compute(case_with({ratio}), {.directory = directory.path / "a"}, chaotic_march);
    BOOST_TEST(content_of(other) == "mine");
  }
  BOOST_TEST(failure_of([&] {
               write_run_list(case_with({1, 2}), directory.path / "a");
             }).find("runs.txt") != std::string::npos);
  BOOST_TEST(content_of(list) == "mine\n");
}

BOOST_AUTO_TEST_CASE(an_alteration_is_noticed_and_reaches_no_other_case) {
  const TemporaryDirectory directory;
  Counted counted;
  const auto options = [&](const char *name) {
    return RunOptions{.directory = directory.path / name, .pool = directory.path / "runs"};
  };
  compute(case_with({1}), options("a"), counted.method);
  const auto expected = numbers_in(directory.path / "a");
  const fs::path pooled = directory.path / "runs" / run_identity(case_with({1}).runs[0].physics);
  std::ofstream(directory.path / "a/series.csv") << "altered in place";
  compute(case_with({1}), options("b"), counted.method);
  BOOST_TEST((numbers_in(directory.path / "b") == expected));
  compute(case_with({1}), options("a"), counted.method);
  BOOST_TEST(content_of(directory.path / "a/series.csv.altered") == "altered in place");
  BOOST_TEST(content_of(directory.path / "a/series.csv") == content_of(pooled / "series.csv"));
  BOOST_TEST(counted.calls == 1);
  // In the pool, too: then the run is computed again; so it is where a file is missing.
  std::ofstream(pooled / "series.csv") << "altered in place";
  compute(case_with({1}), options("b"), counted.method);
  BOOST_TEST(counted.calls == 2);
  fs::remove(pooled / "profiles.csv");
  compute(case_with({1}), options("b"), counted.method);
  BOOST_TEST(counted.calls == 3);
  BOOST_TEST((numbers_in(directory.path / "b") == expected));
}

BOOST_AUTO_TEST_CASE(a_damaged_checkpoint_is_begun_again) {
  const TemporaryDirectory directory;
  RunOptions options{.directory = directory.path / "a", .seconds_between_checkpoints = 0};
  compute(case_with({1}), options, chaotic_march);
  const auto expected = numbers_in(options.directory);
  options.directory = directory.path / "b";
  int steps = 0;
  options.stop = [&] { return ++steps > 60; };
  compute(case_with({1}), options, chaotic_march);
  options.stop = [] { return false; };
  std::string text = content_of(options.directory / "checkpoint.json");
  const std::size_t at = text.find("\"position\":[") + 12;
  text.replace(at, text.find(']', at) - at, "\"nan\"");
  directory.write("b/checkpoint.json", text);
  compute(case_with({1}), options, chaotic_march);
  BOOST_TEST((numbers_in(options.directory) == expected));
}

BOOST_AUTO_TEST_CASE(a_stop_reaches_every_process) {
  const TemporaryDirectory directory;
  RunOptions options{.directory = directory.path, .jobs = 2};
  const Method method = [](const Case &, const Checkpoint &from, const Control &control) {
    while (!control.interrupted())
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    return Outcome{Status::interrupted, "", "", from, {}};
  };
  const pid_t first = getpid();
  int asked = 0;
  options.stop = [&] { return getpid() == first && ++asked > 5; };
  const auto results = compute(case_with({1, 2, 3}), options, method);
  BOOST_REQUIRE(results.size() == 3u);
  for (const RunResult &result : results)
    BOOST_TEST(!result.summary);
}

BOOST_AUTO_TEST_CASE(two_processes_do_not_compute_one_run) {
  const TemporaryDirectory directory;
  Counted counted;
  RunOptions options{.directory = directory.path};
  const int other = open(directory.path.c_str(), O_RDONLY | O_DIRECTORY);
  BOOST_REQUIRE(flock(other, LOCK_EX) == 0);
  int asked = 0;
  options.stop = [&] { return ++asked > 3; };
  BOOST_TEST(!compute(case_with({1}), options, counted.method).at(0).summary);
  BOOST_TEST(counted.calls == 0);
  options.stop = [] { return false; };
  std::jthread release([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(150));
    close(other);
  });
  BOOST_TEST(compute(case_with({1}), options, counted.method).at(0).summary.has_value());
  BOOST_TEST(counted.calls == 1);
}

BOOST_AUTO_TEST_CASE(seconds_add_up_over_interruptions) {
  const TemporaryDirectory directory;
  RunOptions options{.directory = directory.path, .seconds_between_checkpoints = 0};
  for (int times = 0; times < 2; ++times) {
    int asked = 0;
    options.stop = [&] {
      std::this_thread::sleep_for(std::chrono::milliseconds(asked * 60));
      return ++asked > 1; // once before the run begins
    };
    BOOST_TEST(!compute(case_with({1}), options, chaotic_march).at(0).summary);
  }
  options.stop = [] { return false; };
  const auto results = compute(case_with({1}), options, chaotic_march);
  BOOST_TEST(results.at(0).summary->quantities.at("wall_seconds") >= 0.12);
  BOOST_TEST(results.at(0).summary->quantities.at("cpu_seconds") > 0);
  BOOST_TEST(results.at(0).summary->quantities.at("cpu_seconds") < 0.12);
}
