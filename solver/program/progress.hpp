#pragma once
// One line on a terminal about the runs under way, and whole lines about those that are done.
#include "case/case.hpp"
#include <chrono>
#include <map>
#include <string>

namespace capsule {

// How much of the way from the start to the nearer end of the case lies behind: 0 ... 1.
double fraction_done(const Case &physics, double time, double x_g);

// "12 s", "3 min", "2.5 h"
std::string duration_text(double seconds);

class ProgressLine {
public:
  explicit ProgressLine(bool on_a_terminal) : shown(on_a_terminal) {}

  // The run that takes longest is the one shown; nothing in a run's first second.
  void update(const std::string &run, const Case &physics, double time, double x_g, long steps);
  void finish(const std::string &run);
  // A whole line on standard output.
  void print(const std::string &line);

private:
  using Clock = std::chrono::steady_clock;
  struct UnderWay {
    Clock::time_point began;
    double fraction_at_first = 0;
    double seconds_left = 0;
    std::string text;
  };

  void clear();

  bool shown;
  bool on_screen = false;
  Clock::time_point last_shown;
  std::map<std::string, UnderWay> runs;
};

} // namespace capsule
