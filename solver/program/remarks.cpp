#include "program/remarks.hpp"
#include "base/csv.hpp"
#include "base/text.hpp"
#include "case/case.hpp"
#include "case/keys.hpp"
#include "case/physical.hpp"
#include "motion/stops.hpp"
#include "observe/outcome.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <map>
#include <optional>

namespace capsule {
namespace {

namespace fs = std::filesystem;

// The key that ended a march.
std::string what_ended(const UntilSpec &until, const std::map<std::string, double> &quantities) {
  const auto came_to = [&](const char *name, const std::optional<double> &end) {
    constexpr double rounding = 1e-9;
    const auto found = quantities.find(name);
    return end && found != quantities.end() && found->second >= *end - rounding;
  };
  if (!until.by_place() || came_to("time", until.time))
    return "until.time";
  const bool by_last = until.last_x_g && !came_to("x_g", until.x_g);
  return fmt::format("{} (with pore.exit_x)", by_last ? "until.last_x_g" : "until.x_g");
}

// "in 2 of 3 runs"; empty where there is one.
std::string of_runs(const char *before, std::size_t some, const std::vector<RunResult> &results) {
  return results.size() == 1 ? "" : fmt::format("{}{} of {}", before, some, counted(results.size(), "run"));
}

} // namespace

std::string unsteady_remark(const std::vector<RunResult> &results) {
  std::size_t unsteady = 0;
  double fastest = 0;
  std::string later;     // of the first one
  bool is_of_one = true; // `capsule steady` has one capsule
  for (const auto &[input, directory, summary] : results) {
    if (!summary || summary->status != word_of(Status::reached))
      continue;
    const PoreShape shape = input.physics.pore.shape;
    double moving = 0;
    for (std::size_t k = 0; k <= input.physics.followers.size(); ++k) {
      const auto at_the_end = [&, &quantities = summary->quantities](const char *name) {
        const auto found = quantities.find(name + capsule_mark(k));
        return found == quantities.end() ? 0 : found->second;
      };
      const bool in_the_mouth =
          shape == PoreShape::hyperbolic && at_the_end("x_g") < at_the_end("length") / 2;
      if (!in_the_mouth)
        moving = std::max({moving, at_the_end("max_axial_residual"), at_the_end("max_radial_velocity")});
    }
    if (moving <= input.physics.accuracy || shape == PoreShape::two_mouths)
      continue;
    ++unsteady;
    fastest = std::max(fastest, moving);
    if (later.empty())
      later = with_physical_keys(what_ended(input.physics.until, summary->quantities), input.physics);
    is_of_one = is_of_one && input.physics.followers.empty();
  }
  if (unsteady == 0)
    return "";
  return fmt::format(
      "not steady yet{}: the membrane still moves with {}{:.2g} relative to its centre; a larger {} leads "
      "nearer{}",
      of_runs(", ", unsteady, results), unsteady == 1 ? "" : "up to ", fastest, later,
      is_of_one ? ", `capsule steady` tells whether there is a steady state" : "");
}

std::string outlet_remark(const std::vector<RunResult> &results) {
  constexpr double too_much = 1e-2;
  std::size_t runs = 0;
  double largest = 0;
  for (const RunResult &result : results) {
    if (!result.summary || result.summary->status != word_of(Status::reached))
      continue;
    const auto &quantities = result.summary->quantities;
    const auto one = quantities.find("pressure_drop"), other = quantities.find("pressure_drop_reciprocal");
    if (one == quantities.end() || other == quantities.end())
      continue;
    const double difference = std::abs(one->second - other->second) / std::max(1.0, std::abs(other->second));
    if (difference > too_much)
      ++runs;
    largest = std::max(largest, difference);
  }
  if (runs == 0)
    return "";
  const Case &physics = results.front().input.physics;
  return fmt::format(
      "the two routes to the pressure drop differ by {:.0f} %{}, of which the estimate says nothing: the "
      "end of the pore may be too near; a larger {} moves it away{}",
      100 * largest, of_runs(" or less in ", runs, results), with_physical_keys("pore.exit_x", physics),
      physics.mesh.wall > 0 ? "; or mesh.wall may be too small: leave it out" : "");
}

std::string wrinkle_remark(const std::vector<RunResult> &results) {
  std::size_t runs = 0;
  double most = 0, from = std::numeric_limits<double>::infinity(), to = -from;
  bool estimated = false;
  for (const RunResult &result : results) {
    if (!result.summary || !fs::exists(result.directory / "series.csv"))
      continue;
    Columns series = read_columns(result.directory / "series.csv");
    const std::vector<double> &dents = series["dents"], &x_g = series["x_g"];
    bool has_wrinkled = false;
    for (std::size_t row = 0; row < std::min(dents.size(), x_g.size()); ++row)
      if (dents[row] >= dents_of_wrinkles) {
        has_wrinkled = true;
        most = std::max(most, dents[row]);
        from = std::min(from, x_g[row]);
        to = std::max(to, x_g[row]);
      }
    runs += has_wrinkled ? 1 : 0;
    estimated |= has_wrinkled && !result.summary->error_estimate.empty();
  }
  if (runs == 0)
    return "";
  return fmt::format(
      "the membrane wrinkled{}: up to {:.0f} dents {}; a larger {} smooths it{}",
      of_runs(" in ", runs, results), most,
      from < to ? fmt::format("between x_g = {:.4g} and {:.4g}", from, to)
                : fmt::format("at x_g = {:.4g}", from),
      with_physical_keys(bending_key, results.front().input.physics),
      estimated ? "; small disturbances decide when it wrinkles, and errors there may exceed their estimates"
                : "");
}

std::string bearing_remark(const std::vector<RunResult> &results) {
  std::size_t runs = 0;
  std::string first;
  for (const RunResult &result : results) {
    const UntilSpec &until = result.input.physics.until;
    if (!result.summary)
      continue;
    const std::string &along = result.summary->along;
    const fs::path file = result.directory / (along.empty() ? "series.csv" : "branch.csv");
    if (!fs::exists(file))
      continue;
    Columns states = read_columns(file);
    const auto beyond = [&](const char *column, const std::optional<double> &bears, const char *key) {
      const std::vector<double> &values = states[column];
      const auto found = std::ranges::find_if(values, [&](double value) { return bears && value >= *bears; });
      if (found == values.end())
        return std::string();
      const auto row = static_cast<std::size_t>(found - values.begin());
      const std::string place =
          along.empty() ? "" : fmt::format(" at {} = {:.6g}", along, states[along].at(row));
      return fmt::format("{} = {:.6g}{}, {} = {}", column, *found, place, key, number_text(*bears));
    };
    std::string strain = beyond("max_area_stretch", until.area_stretch, "until.area_stretch");
    if (strain.empty())
      strain = beyond("max_tension", until.tension, "until.tension");
    runs += strain.empty() ? 0 : 1;
    if (first.empty())
      first = strain;
  }
  if (runs == 0)
    return "";
  return fmt::format("strained beyond what the membrane bears{}: {}; only a march ends where it bursts",
                     of_runs(" in ", runs, results), first);
}

} // namespace capsule
