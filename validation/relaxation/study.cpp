// Are the residual velocities of Tables 1 and 2 the relaxation of the capsule in the tube? Slowest small motion about
// Table 2's steady state against the viscosity ratio; and for each row of both tables a march to x_g = 9, whose residual
// velocities all small motions together carry on to where the table was read off, beside marches in a longer tube
// and in the paper's, whose exit is near there.
#include "study.hpp"
#include "compare.hpp"
#include "dynamics.hpp"
#include "steady_state.hpp"
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <sstream>

using namespace capsule;

namespace {

constexpr int nodes = 96;
constexpr double from_x_g = 9;
constexpr double long_tube = 22, paper_tube = 15; // exit_x
constexpr double level = 2.1e-5;                  // of residual velocities that the paper takes for steady
constexpr double allowed =
    0.1; // relative, of what is predicted, where it stands above the noise of the steps
constexpr double noise = 2e-6;

struct Row {
  const char *name, *file;
  double viscosity_ratio, x_g;
  const char *id; // of the published residuals, without -vr and -vx
};
const std::vector<Row> rows{{"Table 1", "cases/table1-mesh", 1, 11.7254, "T1-224"},
                            {"Table 2 0.2", "cases/fig07-viscosity-sphere", 0.2, 11.84, "T2-0.2"},
                            {"Table 2 1", "cases/fig07-viscosity-sphere", 1, 11.84, "T2-1"},
                            {"Table 2 5", "cases/fig07-viscosity-sphere", 5, 11.84, "T2-5"},
                            {"Table 2 10", "cases/fig07-viscosity-sphere", 10, 11.84, "T2-10"}};

Case case_of(const Row &row) {
  Case physics = read_case(row.file).runs.front().physics;
  physics.accuracy = 1e-6;
  physics.mesh.membrane = nodes;
  physics.flow.viscosity_ratio = row.viscosity_ratio;
  physics.output = {};
  return physics;
}

struct Residual {
  double radial = NAN, axial = NAN;
};

// Max |v_r| and max |v_x - v_g| of the paper; NaN: not given.
Residual published_residual(const Row &row) {
  Residual residual;
  for (const Expectation &published : read_expectations("tables/published.csv")) {
    if (published.id == std::string(row.id) + "-vr")
      residual.radial = published.published_value;
    if (published.id == std::string(row.id) + "-vx")
      residual.axial = published.published_value;
  }
  return residual;
}

// The small motions about a steady state, each by itself.
class SmallMotions {
public:
  SmallMotions(const SteadyState &state, double viscosity_ratio)
      : state_(state), gauge_(state.system->scene(), state.system->membrane()),
        eigen_(state.system->small_motion(state.unknowns, viscosity_ratio)),
        inverse_(eigen_.eigenvectors().inverse()) {}

  double speed() const { return state_.unknowns[2L * nodes]; }
  // After a time, from the nodes' velocity before. Two motions that are none do not count: a displacement along the tube,
  // and a change of volume, which a shape at a small distance from the steady one seems to have, to second order.
  Residual carry(const Vector &velocity, double time) const {
    Vector relative = velocity;
    relative.head(nodes).array() -= speed();
    Eigen::VectorXcd parts = inverse_ * relative;
    Eigen::ArrayXd speeds = eigen_.eigenvalues().cwiseAbs();
    for (int none = 0; none < 2; ++none) {
      Eigen::Index slowest = 0;
      speeds.minCoeff(&slowest);
      parts[slowest] = 0;
      speeds[slowest] = INFINITY;
    }
    const Eigen::VectorXcd later =
        eigen_.eigenvectors() * (parts.array() * (time * eigen_.eigenvalues().array()).exp()).matrix();
    const SeriesRow row = gauge_.row(0, state_.unknowns.head(2L * nodes), later.real());
    return {row.max_radial_velocity, row.max_axial_residual};
  }

private:
  SteadyState state_;
  Gauge gauge_;
  Eigen::EigenSolver<Matrix> eigen_;
  Eigen::MatrixXcd inverse_;
};

Outcome reach(Case physics, double exit_x, double x_g, const Checkpoint &from) {
  physics.pore.exit_x = exit_x;
  physics.until.x_g = x_g;
  Outcome outcome = march(physics, from, {});
  if (outcome.status != Status::reached)
    throw std::runtime_error(outcome.message);
  return outcome;
}

// rate, speed; residuals at from_x_g, at the table's x_g in both tubes, as predicted; x_g from which on all are below
// `level`
std::string row_text(const Row &row) {
  const Case physics = case_of(row);
  const SteadyState state = on_mesh(physics, nodes, find_steady(physics, {}, {}));
  const double rate = state.system->growth_rates(state.unknowns, row.viscosity_ratio)[0].real();
  const SmallMotions motions(state, row.viscosity_ratio);

  const Checkpoint before = reach(physics, long_tube, from_x_g, {}).last;
  Case tube = physics;
  tube.pore.exit_x = long_tube;
  const Vector velocity = make_dynamics(tube).flow(before.position).velocity;
  const Checkpoint free = reach(physics, long_tube, row.x_g, before).last;
  const SeriesRow in_paper = reach(physics, paper_tube, row.x_g, before).last.series.back();
  const SeriesRow &first = before.series.back();
  const SeriesRow &last = free.series.back();
  const Residual predicted = motions.carry(velocity, last.time - first.time);
  const auto is_steady = [&](double time) {
    const Residual later = motions.carry(velocity, time);
    return std::max(later.radial, later.axial) < level;
  };
  constexpr double step = 0.05;
  int steps = 0;
  while (steps < 2000 && !is_steady(step * steps))
    ++steps;
  return fmt::format("{:.6f} {:.6f} {:.4e} {:.4e} {:.4e} {:.4e} {:.4e} {:.4e} {:.4e} {:.4e} {:.3f}", rate,
                     motions.speed(), first.max_radial_velocity, first.max_axial_residual,
                     last.max_radial_velocity, last.max_axial_residual, in_paper.max_radial_velocity,
                     in_paper.max_axial_residual, predicted.radial, predicted.axial,
                     from_x_g + motions.speed() * step * steps);
}

std::string rates_text() {
  const Case physics = case_of(rows[1]);
  const SteadyState state = on_mesh(physics, nodes, find_steady(physics, {}, {}));
  std::string text;
  for (int k = 0; k <= 16; ++k) {
    const double viscosity_ratio = std::pow(10, -2 + 0.25 * k);
    const double rate = state.system->growth_rates(state.unknowns, viscosity_ratio)[0].real();
    text += fmt::format("{:.6g},{:.6f},{:.6f}\n", viscosity_ratio, rate, -state.unknowns[2L * nodes] / rate);
  }
  return text;
}

bool study(const std::string &directory, unsigned jobs) {
  std::vector<TextTask> tasks{{"rates", rates_text}};
  for (const Row &row : rows)
    tasks.push_back({row.name, [=] { return row_text(row); }});
  const std::vector<std::string> texts = make_all(directory, jobs, tasks);
  write_atomically(directory + "/rates.csv", "viscosity_ratio,growth_rate,length\n" + texts[0]);

  Table table("row,viscosity_ratio,x_g,growth_rate,radial_before,axial_before,radial,axial,radial_in_paper,"
              "axial_in_paper,radial_predicted,axial_predicted,radial_published,axial_published,steady_at");
  double worst = 0;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const Row &row = rows[k];
    std::istringstream text(texts[k + 1]);
    double rate = 0, speed = 0, steady_at = 0;
    Residual before, in_long, in_paper, predicted;
    const Residual published = published_residual(row);
    text >> rate >> speed >> before.radial >> before.axial >> in_long.radial >> in_long.axial >>
        in_paper.radial >> in_paper.axial >> predicted.radial >> predicted.axial >> steady_at;
    table.add(fmt::format(
        "{},{},{},{:.6f},{:.4e},{:.4e},{:.4e},{:.4e},{:.4e},{:.4e},{:.4e},{:.4e},{:.3e},{:.3e},{:.3f}",
        row.name, row.viscosity_ratio, row.x_g, rate, before.radial, before.axial, in_long.radial,
        in_long.axial, in_paper.radial, in_paper.axial, predicted.radial, predicted.axial, published.radial,
        published.axial, steady_at));
    const auto verdict = [](double found, double in_table) {
      constexpr double same = 0.3; // the paper's three meshes differ by that much
      return std::isnan(in_table) ? "" : std::abs(found / in_table - 1) <= same ? "agrees" : "differs";
    };
    fmt::print("{}: slowest motion {:.4f}; all below {:.1e} from x_g = {:.2f}; at x_g = {}:\n", row.name,
               rate, level, steady_at, row.x_g);
    const auto compare = [&](const char *name, double Residual::*residual) {
      fmt::print(
          "    {:15}  small motions {:.3e}, march {:.3e}, in the paper's tube {:.3e}, published {:.3e} {}\n",
          name, predicted.*residual, in_long.*residual, in_paper.*residual, published.*residual,
          verdict(predicted.*residual, published.*residual));
    };
    compare("max |v_r|", &Residual::radial);
    compare("max |v_x - v_g|", &Residual::axial);
    for (const auto &[found, said] :
         {std::pair{in_long.radial, predicted.radial}, {in_long.axial, predicted.axial}})
      worst = std::max(worst, (std::abs(found - said) - noise) / said);
  }
  table.write(directory + "/rows.csv");
  return check(
      worst <= allowed,
      fmt::format(
          "the small motions carry the residuals from x_g = {} to the tables' x_g within {:.0f} % of the "
          "march in a longer tube, beyond {:.0e}",
          from_x_g, 100 * std::max(0.0, worst), noise));
}

} // namespace

int main(int argc, char **argv) {
  return study_main(argc, argv, study);
}
