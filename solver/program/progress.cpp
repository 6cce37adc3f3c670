#include "program/progress.hpp"
#include "case/case.hpp"
#include <algorithm>
#include <cstdio>
#include <fmt/format.h>
#include <limits>

namespace capsule {
std::string duration_text(double seconds) {
  if (seconds < 100)
    return fmt::format("{:.0f} s", seconds);
  if (seconds < 6000)
    return fmt::format("{:.0f} min", seconds / 60);
  return fmt::format("{:.1f} h", seconds / 3600);
}

double fraction_done(const Case &physics, double time, double x_g) {
  double fraction = 0;
  if (physics.until.time)
    fraction = time / *physics.until.time;
  const UntilSpec &until = physics.until;
  if (until.by_place()) { // the last capsule arrives later by about the way between the two
    const double behind = capsules_of(physics).back()->capsule.start_x - physics.capsule.start_x;
    double end = until.x_g.value_or(std::numeric_limits<double>::infinity());
    if (until.last_x_g)
      end = std::min(end, *until.last_x_g - behind);
    fraction = std::max(fraction, (x_g - physics.capsule.start_x) / (end - physics.capsule.start_x));
  }
  return std::clamp(fraction, 0.0, 1.0);
}

void ProgressLine::show(const std::string &run, double part,
                        const std::function<std::string(double seconds_left)> &text) {
  if (!shown)
    return;
  const double fraction = std::min(part, 1.0);
  const Clock::time_point now = Clock::now();
  Run &this_run = runs.try_emplace(run, Run{now, fraction, 0, ""}).first->second;
  const double seconds = std::chrono::duration<double>(now - this_run.began).count();
  const double gained = fraction - this_run.fraction_at_first;
  if (seconds < 1 || gained <= 0)
    return;
  this_run.seconds_left = seconds * (1 - fraction) / gained;
  this_run.text = fmt::format("{}{}{}", run, run.empty() ? "" : "  ", text(this_run.seconds_left));
  show_longest();
}

void ProgressLine::update(const std::string &run, const Case &physics, double time, double x_g, long steps) {
  const double fraction = fraction_done(physics, time, x_g);
  show(run, fraction, [&](double seconds_left) {
    return fmt::format("t {:7.3f}  x_g {:7.3f}  step {:6}  {:3.0f} %  {:>6} left", time, x_g, steps,
                       100 * fraction, duration_text(seconds_left));
  });
}

void ProgressLine::update_search(const std::string &run, double part) {
  const auto text = [](double seconds_left) {
    return fmt::format("searching for a steady state, for {} more at most", duration_text(seconds_left));
  };
  show(run, part, text);
}

void ProgressLine::update_branch(const std::string &run, double part) {
  show(run, part, [](double) { return "following a branch"; });
}

void ProgressLine::show_longest() {
  const Clock::time_point now = Clock::now();
  if (now - last_shown < std::chrono::milliseconds(200))
    return;
  last_shown = now;
  const auto longest =
      std::ranges::max_element(runs, {}, [](const auto &entry) { return entry.second.seconds_left; });
  fmt::print(stderr, "\r{}\033[K", longest->second.text);
  std::fflush(stderr);
  on_screen = true;
}

void ProgressLine::finish(const std::string &run) {
  runs.erase(run);
  clear();
}

void ProgressLine::print(const std::string &line) {
  clear();
  fmt::print("{}\n", line);
  std::fflush(stdout);
}

void ProgressLine::warn(const std::string &lines) {
  clear();
  fmt::print(stderr, "{}", lines);
}

void ProgressLine::clear() {
  if (on_screen)
    fmt::print(stderr, "\r\033[K");
  on_screen = false;
}

} // namespace capsule
