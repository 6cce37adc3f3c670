// The line about runs under way: when it is shown, which run it speaks of, and what it expects.
#include "case/case.hpp"
#include "program/progress.hpp"
#include "temporary_directory.hpp"
#include <boost/test/unit_test.hpp>
#include <cstdio>
#include <fcntl.h>
#include <fmt/format.h>
#include <functional>
#include <sstream>
#include <thread>

using namespace capsule;

namespace {

Case half_a_way() {
  Case physics;
  physics.capsule.start_x = -4;
  physics.until.x_g = 12;
  return physics;
}

// What the process writes to one of its streams meanwhile.
std::string written_to(int stream, const std::function<void()> &meanwhile) {
  const TemporaryDirectory directory;
  const std::filesystem::path name = directory.path / "stream";
  const int before = dup(stream), file = open(name.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0600);
  std::fflush(nullptr);
  dup2(file, stream);
  meanwhile();
  dup2(before, stream);
  close(before);
  close(file);
  return content_of(name);
}

struct Shown {
  std::string run; // empty: nothing is shown any more
  double time = 0, x_g = 0;
  int step = 0, percent = 0;
  double seconds_left = 0;
};

// All that a terminal's one line has shown, one after the other.
std::vector<Shown> read_shown(const std::string &text) {
  std::vector<Shown> all;
  std::istringstream stream(text);
  std::string line;
  std::getline(stream, line, '\r');
  BOOST_TEST(line == "");
  while (std::getline(stream, line, '\r')) {
    BOOST_REQUIRE(line.ends_with("\033[K")); // and the rest of the line is empty
    Shown shown;
    std::string t, x_g, step, percent, s, left;
    std::istringstream words(line.substr(0, line.size() - 3));
    if (words >> shown.run) {
      words >> t >> shown.time >> x_g >> shown.x_g >> step >> shown.step >> shown.percent >> percent >>
          shown.seconds_left >> s >> left;
      BOOST_TEST(fmt::format("{} {} {} {} {} {}", t, x_g, step, percent, s, left) == "t x_g step % s left");
      BOOST_TEST(!(words >> left));
    }
    all.push_back(shown);
  }
  return all;
}

double seconds_since(std::chrono::steady_clock::time_point begin) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

} // namespace

BOOST_AUTO_TEST_SUITE(progress)

BOOST_AUTO_TEST_CASE(durations_in_words) {
  BOOST_TEST(duration_text(0.4) == "0 s");
  BOOST_TEST(duration_text(99.4) == "99 s");
  BOOST_TEST(duration_text(150) == "2 min");
  BOOST_TEST(duration_text(5940) == "99 min");
  BOOST_TEST(duration_text(9000) == "2.5 h");
}

BOOST_AUTO_TEST_CASE(fraction_of_the_way) {
  Case physics = half_a_way();
  BOOST_TEST(fraction_done(physics, 10, 4) == 0.5);
  physics.until.time = 12.5;
  BOOST_TEST(fraction_done(physics, 10, 4) == 0.8);
  physics.until.x_g.reset();
  BOOST_TEST(fraction_done(physics, 100, 4) == 1);
}

// A search tells how long it may still take, and nothing in its first second.
BOOST_AUTO_TEST_CASE(a_search_is_shown) {
  ProgressLine line(true);
  const std::string text = written_to(STDERR_FILENO, [&] {
    line.update_search("capsule", 0.1);
    std::this_thread::sleep_for(std::chrono::milliseconds(1010));
    line.update_search("capsule", 0.6);
  });
  BOOST_TEST(text.find("capsule  searching for a steady state, for 1 s more at most") != std::string::npos);
  std::this_thread::sleep_for(std::chrono::milliseconds(210)); // the line is written at most so often
  const std::string of_branch = written_to(STDERR_FILENO, [&] { line.update_branch("capsule", 0.8); });
  BOOST_TEST(of_branch.find("capsule  following a branch") != std::string::npos);
  BOOST_TEST(written_to(STDERR_FILENO, [&] { line.finish("capsule"); }) == "\r\033[K");
}

// Of two runs as old as each other the one with less behind it is shown, with the time that its pace lets expect.
BOOST_AUTO_TEST_CASE(the_longest_run_is_shown) {
  const Case physics = half_a_way();
  ProgressLine line(true);
  const auto begin = std::chrono::steady_clock::now();
  const std::string at_first = written_to(STDERR_FILENO, [&] {
    line.update("slow", physics, 0, -4, 1);
    line.update("fast", physics, 0, -4, 1);
    line.finish("of another time");
  });
  BOOST_TEST(at_first == "");
  double before = 0, after = 0;
  const std::string text = written_to(STDERR_FILENO, [&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(1010));
    before = seconds_since(begin);
    line.update("slow", physics, 6, 0, 70);
    after = seconds_since(begin);
    line.update("fast", physics, 16, 8, 200); // too soon to be shown
    std::this_thread::sleep_for(std::chrono::milliseconds(210));
    line.update("fast", physics, 18, 10, 220);
    line.finish("slow");
    std::this_thread::sleep_for(std::chrono::milliseconds(210));
    line.update("fast", physics, 20, 11, 240);
    line.finish("fast");
  });

  // Each is written over the one before; what stays in the end is an empty line.
  const std::vector<Shown> shown = read_shown(text);
  BOOST_REQUIRE(shown.size() == 5u);
  for (const std::size_t i : {0u, 1u}) { // of the run that has not moved since
    BOOST_TEST(shown[i].run == "slow");
    BOOST_TEST(shown[i].time == 6);
    BOOST_TEST(shown[i].x_g == 0);
    BOOST_TEST(shown[i].step == 70);
    BOOST_TEST(shown[i].percent == 25); // and so three times as long to go
    BOOST_TEST(shown[i].seconds_left >= 3 * before - 0.5);
    BOOST_TEST(shown[i].seconds_left <= 3 * after + 0.5);
  }
  BOOST_TEST(shown[2].run == "");
  BOOST_TEST(shown[3].run == "fast");
  BOOST_TEST(shown[3].percent == 94);
  BOOST_TEST(shown[4].run == "");
}

BOOST_AUTO_TEST_CASE(lines_are_whole) {
  std::string on_screen;
  const std::string output = written_to(STDOUT_FILENO, [&] {
    on_screen = written_to(STDERR_FILENO, [] {
      ProgressLine shown(true), silent(false);
      shown.print("first");
      silent.update("run", half_a_way(), 0, -4, 1);
      std::this_thread::sleep_for(std::chrono::milliseconds(1010));
      silent.update("run", half_a_way(), 6, 0, 70);
      silent.finish("run");
      silent.print("second");
    });
  });
  BOOST_TEST(output == "first\nsecond\n");
  BOOST_TEST(on_screen == "");
}

BOOST_AUTO_TEST_SUITE_END()
