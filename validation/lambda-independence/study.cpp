// Does the steady state forget the viscosity of the inner liquid, and how fast? Table 2's capsules in tubes so long
// that they settle.
#include "study.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <iterator>

using namespace capsule;

namespace {

// A viscous capsule needs a long tube; the exit section is farther away than it can be felt.
RunInput long_tube(double viscosity_ratio) {
  RunInput run = read_case("cases/fig07-viscosity-sphere").runs.front();
  run.name = fmt::format("viscosity_ratio={}", viscosity_ratio);
  run.physics.flow.viscosity_ratio = viscosity_ratio;
  run.physics.until.x_g = 20 + 3.5 * viscosity_ratio;
  run.physics.pore.exit_x = *run.physics.until.x_g + 8;
  run.physics.output.profiles_at_x_g.clear();
  run.physics.output.profiles_at_time.clear();
  return run;
}

// The residual velocity max |v_x - v_g| decays as amplitude exp(-rate x_g): least squares from where it falls below
// 1e-3, faster modes having gone, to where it meets the noise of the time steps.
struct Decay {
  double rate = 0;
  double amplitude = 0;
};
Decay fit_decay(const History &history) {
  constexpr double high = 1e-3, low = 2e-5;
  const std::vector<double> &x = history.at("x_g");
  const std::vector<double> &residual = history.at("max_axial_residual");
  std::size_t first = x.size();
  while (first > 0 && residual[first - 1] < high)
    --first;
  double n = 0, sx = 0, sy = 0, sxx = 0, sxy = 0;
  for (std::size_t i = first; i < x.size() && residual[i] > low; ++i) {
    const double y = std::log(residual[i]);
    n += 1;
    sx += x[i];
    sy += y;
    sxx += x[i] * x[i];
    sxy += x[i] * y;
  }
  const double slope = (n * sxy - sx * sy) / (n * sxx - sx * sx);
  return {-slope, std::exp((sy - slope * sx) / n)};
}

double at_table2(const History &history, const char *quantity) {
  const std::vector<double> &x = history.at("x_g");
  const auto nearest = std::ranges::min_element(x, {}, [](double value) { return std::abs(value - 11.84); });
  return history.at(quantity)[static_cast<std::size_t>(nearest - x.begin())];
}

bool study(const std::string &directory, unsigned jobs) {
  const std::vector<double> viscosity_ratios{0.2, 1, 5, 10};
  std::vector<RunInput> inputs;
  std::ranges::transform(viscosity_ratios, std::back_inserter(inputs), long_tube);
  const std::vector<StudyRun> runs = run_all(directory, jobs, inputs);

  Table table("viscosity_ratio,rate,amplitude,x_g,v_g,v_g_error,pressure_drop,pressure_drop_error,residual,"
              "residual_at_table2,settled_at");
  bool agree = true, slower = true;
  double rate_before = INFINITY;
  const Summary &reference = runs[1].summary;
  for (std::size_t k = 0; k < runs.size(); ++k) {
    const Summary &summary = runs[k].summary;
    const Decay decay = fit_decay(runs[k].history);
    slower = slower && decay.rate < rate_before;
    rate_before = decay.rate;
    const auto value = [&](const char *quantity) { return summary.quantities.at(quantity); };
    const auto error = [&](const char *quantity) { return summary.error_estimate.at(quantity); };
    for (const char *quantity : {"v_g", "pressure_drop", "max_stretch", "min_film"}) {
      const double apart = std::abs(value(quantity) - reference.quantities.at(quantity));
      const double allowed = error(quantity) + reference.error_estimate.at(quantity);
      agree = agree && apart <= allowed;
      fmt::print("lambda = {:4}: {} {:.6f}, {:.1e} from that of lambda = 1, errors {:.1e}\n",
                 viscosity_ratios[k], quantity, value(quantity), apart, allowed);
    }
    const double settled_at = std::log(decay.amplitude / 1e-5) / decay.rate;
    fmt::print("lambda = {:4}: the residual velocity decays as exp(-{:.3f} x_g), to 1e-5 at x_g = {:.1f}\n",
               viscosity_ratios[k], decay.rate, settled_at);
    std::string row = fmt::format("{}", viscosity_ratios[k]);
    for (const double number : {decay.rate, decay.amplitude, value("x_g"), value("v_g"), error("v_g"),
                                value("pressure_drop"), error("pressure_drop"), value("max_axial_residual"),
                                at_table2(runs[k].history, "max_axial_residual"), settled_at})
      row += fmt::format(",{:.8g}", number);
    table.add(row);
  }
  table.write(directory + "/relaxation.csv");
  fmt::print("lambda-independence: {}: the steady values agree within their errors; {}: the relaxation slows "
             "down with "
             "lambda\n",
             agree ? "HOLDS" : "FAILS", slower ? "HOLDS" : "FAILS");
  return agree && slower;
}

} // namespace

int main(int argc, char **argv) {
  return study_main(argc, argv, study);
}
