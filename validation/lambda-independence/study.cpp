// Does the steady state forget the viscosity of the inner liquid, and how fast? Table 2's capsules in tubes so long
// that they settle.
#include "study.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

using namespace capsule;

namespace {

const std::vector<double> viscosity_ratios{0.2, 1, 5, 10};
constexpr std::size_t reference = 1; // of them, to which the others are compared
// Relative errors asked for. A steady value may be as far from that of lambda = 1, ten times as far if it is a local one.
constexpr double coarse = 2e-5, fine = 2e-6;
struct Compared {
  const char *quantity;
  double times_accuracy;
};
const std::vector<Compared> compared{{"v_g", 1}, {"pressure_drop", 1}, {"max_stretch", 10}, {"min_film", 10}};

// A viscous capsule needs a long tube; the exit section is farther away than it can be felt.
RunInput long_tube(double viscosity_ratio, double accuracy) {
  RunInput run{fmt::format("viscosity_ratio={}", viscosity_ratio), physics_of("fig07-viscosity-sphere")};
  if (accuracy != fine)
    run.name += fmt::format(",accuracy={:g}", accuracy);
  run.physics.accuracy = accuracy;
  run.physics.flow.viscosity_ratio = viscosity_ratio;
  run.physics.until.x_g = 20 + 3.5 * viscosity_ratio;
  run.physics.pore.exit_x = *run.physics.until.x_g + 8;
  run.physics.output = {};
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

// Whether the steady values of an accuracy's runs agree as closely as that asks for.
bool agree(const std::vector<StudyRun> &runs, double accuracy, Table &table) {
  double worst = 0; // of what is allowed
  for (const auto &[quantity, times] : compared) {
    const double of_reference = runs[reference].summary.quantities.at(quantity);
    for (std::size_t k = 0; k < runs.size(); ++k) {
      const double value = runs[k].summary.quantities.at(quantity);
      const double apart = std::abs(value / of_reference - 1);
      worst = std::max(worst, apart / (times * accuracy));
      table.add(fmt::format("{:g},{},{},{:.8g},{:.2e},{:.2e}", accuracy, quantity, viscosity_ratios[k], value,
                            apart, times * accuracy));
      fmt::print("accuracy {:g}, lambda = {:4}: {} {:.7f}, {:.1e} from that of lambda = 1\n", accuracy,
                 viscosity_ratios[k], quantity, value, apart);
    }
  }
  return check(worst <= 1,
               fmt::format("at accuracy {:g} the steady values agree within that, ten times that for "
                           "stretch and film (at most {:.2f} of it)",
                           accuracy, worst));
}

bool study(const std::string &directory, unsigned jobs) {
  std::vector<RunInput> inputs;
  for (const double accuracy : {fine, coarse})
    for (const double ratio : viscosity_ratios)
      inputs.push_back(long_tube(ratio, accuracy));
  const std::vector<StudyRun> all = run_all(directory, jobs, inputs);
  const auto middle = all.begin() + std::ssize(viscosity_ratios);
  const std::vector<StudyRun> runs(all.begin(), middle);
  Table values("accuracy,quantity,viscosity_ratio,value,apart,allowed");
  const bool finely = agree(runs, fine, values);
  const bool coarsely = agree({middle, all.end()}, coarse, values);
  values.write(directory + "/values.csv");

  Table table("viscosity_ratio,rate,amplitude,x_g,v_g,pressure_drop,residual,residual_at_table2,settled_at");
  bool slower = true;
  double rate_before = INFINITY;
  for (std::size_t k = 0; k < runs.size(); ++k) {
    const Decay decay = fit_decay(runs[k].history);
    slower = slower && decay.rate < rate_before;
    rate_before = decay.rate;
    const auto value = [&](const char *quantity) { return runs[k].summary.quantities.at(quantity); };
    const double settled_at = std::log(decay.amplitude / 1e-5) / decay.rate;
    fmt::print("lambda = {:4}: the residual velocity decays as exp(-{:.3f} x_g), to 1e-5 at x_g = {:.1f}\n",
               viscosity_ratios[k], decay.rate, settled_at);
    std::string row = fmt::format("{}", viscosity_ratios[k]);
    for (const double number :
         {decay.rate, decay.amplitude, value("x_g"), value("v_g"), value("pressure_drop"),
          value("max_axial_residual"), at_table2(runs[k].history, "max_axial_residual"), settled_at})
      row += fmt::format(",{:.8g}", number);
    table.add(row);
  }
  table.write(directory + "/relaxation.csv");
  return check(slower, "the relaxation slows down with lambda") && finely && coarsely;
}

} // namespace

int main(int argc, char **argv) {
  return study_main(argc, argv, study);
}
