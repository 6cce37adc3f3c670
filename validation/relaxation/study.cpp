// How slowly does a capsule relax in the tube? Slowest eigenvalue of the small motions about the steady state of Table 2
// against the viscosity ratio, and the decay of the residual velocities in marches.
#include "steady_folds.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

using namespace capsule;

namespace {

constexpr int nodes = 96;
constexpr double from_x_g = 9;   // where only the slowest motion is left
constexpr double level = 2.1e-5; // of residual velocities that the paper takes for steady
constexpr double allowed = 0.3;  // relative, of the residual that the eigenvalue predicts
constexpr double slow = 1; // viscosity ratios from which on residuals stand above the noise of the time steps

struct Decay {
  double rate, first, last,
      predicted; // of max |v_r|, at from_x_g and in the end, and as the eigenvalue predicts it
};

Decay decay_of(const History &march, double eigenvalue) {
  const std::vector<double> &x_g = march.at("x_g");
  const std::vector<double> &time = march.at("time");
  const std::vector<double> &residual = march.at("max_radial_velocity");
  const std::size_t k =
      static_cast<std::size_t>(std::ranges::lower_bound(x_g, from_x_g - 1e-9) - x_g.begin());
  const double duration = time.back() - time[k];
  return {std::log(residual.back() / residual[k]) / duration, residual[k], residual.back(),
          residual[k] * std::exp(eigenvalue * duration)};
}

bool study(const std::string &directory, unsigned jobs) {
  const std::vector<RunInput> inputs = read_case("cases/fig07-viscosity-sphere").runs;
  const Case &physics = inputs.front().physics;
  const SteadyState state = on_mesh(physics, nodes, find_steady(physics, {}, {}));
  const double speed = record_steady(state, 1).row.v_g;
  const auto eigenvalue = [&](double viscosity_ratio) {
    return state.system->growth_rates(state.unknowns, viscosity_ratio)[0].real();
  };

  Table rates("viscosity_ratio,growth_rate,length");
  for (int k = 0; k <= 16; ++k) {
    const double viscosity_ratio = std::pow(10, -2 + 0.25 * k);
    const double rate = eigenvalue(viscosity_ratio);
    rates.add(fmt::format("{:.6g},{:.6f},{:.6f}", viscosity_ratio, rate, -speed / rate));
  }
  rates.write(directory + "/rates.csv");

  const std::vector<StudyRun> marches = run_all(directory, jobs, inputs);
  Table table("viscosity_ratio,growth_rate,measured,residual_before,residual,predicted,steady_at");
  double worst = 0;
  for (std::size_t k = 0; k < marches.size(); ++k) {
    const double viscosity_ratio = inputs[k].physics.flow.viscosity_ratio;
    const double rate = eigenvalue(viscosity_ratio);
    const Decay decay = decay_of(marches[k].history, rate);
    const double end = marches[k].history.at("x_g").back();
    const double steady_at = end + speed * std::max(0.0, std::log(decay.last / level) / -rate);
    table.add(fmt::format("{},{:.6f},{:.6f},{:.4e},{:.4e},{:.4e},{:.3f}", viscosity_ratio, rate, decay.rate,
                          decay.first, decay.last, decay.predicted, steady_at));
    if (viscosity_ratio >= slow)
      worst = std::max(worst, std::abs(decay.predicted / decay.last - 1));
    fmt::print("lambda = {:4}: eigenvalue {:.4f}, decay in the march {:.4f}; max|v_r| at x_g = {:.2f}: "
               "{:.2e}, predicted "
               "from x_g = {}: {:.2e}; {:.1e} from x_g = {:.1f} on\n",
               viscosity_ratio, rate, decay.rate, end, decay.last, from_x_g, decay.predicted, level,
               steady_at);
  }
  table.write(directory + "/marches.csv");
  const bool holds = worst <= allowed;
  fmt::print("relaxation: {}: from lambda = {} on the eigenvalue predicts the last residual of the march "
             "from that at "
             "x_g = {} within {:.0f} %\n",
             holds ? "HOLDS" : "FAILS", slow, from_x_g, 100 * worst);
  return holds;
}

} // namespace

int main(int argc, char **argv) {
  return study_main(argc, argv, study);
}
