#pragma once
// Messages about the runs of a case: one line on a terminal that changes while they are computed, and lines that stay. Throws
// nothing.
#include <chrono>
#include <functional>
#include <map>
#include <string>

namespace capsule {

struct Case;

// The part of a run that is done, 0 to 1: of its time or its way, whichever ends sooner.
double fraction_done(const Case &physics, double time, double x_g);

// "12 s", "3 min", "2.5 h"
std::string duration_text(double seconds);

class ProgressLine {
public:
  explicit ProgressLine(bool on_a_terminal) : shown(on_a_terminal) {}

  // Shows the run that will take longest. Nothing is shown in a run's first second.
  void update(const std::string &run, const Case &physics, double time, double x_g, long steps);
  // The same of a search for a steady state, which has done this part of what it may cost; most end long before.
  void update_search(const std::string &run, double part);
  // Of a branch nobody knows the end.
  void update_branch(const std::string &run, double part);
  void finish(const std::string &run);
  // Prints a line that stays, on standard output.
  void print(const std::string &line);
  // Prints lines that stay, with their ends, on standard error.
  void warn(const std::string &lines);

private:
  using Clock = std::chrono::steady_clock;
  struct Run {
    Clock::time_point began;
    double fraction_at_first = 0;
    double seconds_left = 0;
    std::string text;
  };

  // Of a run that has something to tell: it is longer than a second under way.
  void show(const std::string &run, double part, const std::function<std::string(double seconds_left)> &text);
  void show_longest();
  void clear();

  bool shown;
  bool on_screen = false;
  Clock::time_point last_shown;
  std::map<std::string, Run> runs;
};

} // namespace capsule
