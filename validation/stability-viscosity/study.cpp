// How do the membrane's system and its cost behave for viscosity ratios from 0.001 to 1000? Its smallest singular and
// eigenvalues against what is known exactly, the corrections that one shape's inverse leaves to the next, short
// entrances, and the pressure drop of one shape that no longer changes.
#include "study.hpp"
#include "base/decompositions.hpp"
#include "membrane/load.hpp"
#include "motion/dynamics.hpp"
#include "motion/motion.hpp"
#include "scene/make_flow.hpp"
#include "scene/resolution.hpp"
#include <Eigen/SVD>
#include <cmath>
#include <fmt/format.h>

using namespace capsule;

namespace {

const std::vector<double> ratios{0.001, 0.01, 0.1, 0.5, 1, 2, 10, 100, 1000};
constexpr double last_x_g = 1;

Case entrance(double viscosity_ratio) {
  Case physics = short_entrance(64, last_x_g);
  physics.flow.viscosity_ratio = viscosity_ratio;
  return physics;
}

// One shape with its load, ready to make flows of any viscosity ratio.
struct Shape {
  MeridianBasis basis;
  FlowResolution resolution;
  Membrane membrane;
};

Shape shape_of(const Case &physics) {
  const Resolution chosen = choose_resolution(physics);
  return {spectral_basis(chosen.membrane_nodes), chosen.flow, make_scene(physics).membrane};
}

// What the first velocity leaves for later ones is the operator's own inverse.
Matrix inverse_at(const Flow &flow, const Shape &shape, const Vector &position) {
  Recycled recycled;
  flow.solve(flow.interact(position), membrane_load(shape.membrane, position), recycled);
  return recycled.inverse;
}

struct Condition {
  double number;              // of the operator, in the 2-norm
  double smallest_eigenvalue; // of the operator
  double contraction;         // of a correction with the inverse of a shape before
};

Condition condition(const Flow &flow, const Shape &shape, const Vector &position, const Vector &before) {
  const Matrix own = inverse_at(flow, shape, position), earlier = inverse_at(flow, shape, before);
  const Eigen::JacobiSVD<Matrix> singular(own);
  const Matrix change =
      Matrix::Identity(own.rows(), own.cols()) - own.partialPivLu().solve(earlier); // I - A A_before^(-1)
  return {singular.singularValues()[0] / singular.singularValues()[own.rows() - 1],
          1 / eigenvalues(own).cwiseAbs().maxCoeff(), eigenvalues(change).cwiseAbs().maxCoeff()};
}

// Rigid motion of the liquid inside has no stress: eigenvalue 1. A flow through the membrane has no pressure to
// resist it if the liquid inside has no viscosity: eigenvalue lambda. The smaller is the operator's smallest.
double exact_eigenvalue(double viscosity_ratio) {
  return std::min(1.0, viscosity_ratio);
}

bool systems(const std::string &directory, const Vector &position, const Vector &before) {
  Table table("viscosity_ratio,condition,eigenvalue,deviation,contraction,corrections");
  double worst = 0;
  double product = 0;
  for (const double ratio : ratios) {
    if (ratio == 1) // no system
      continue;
    const Case physics = entrance(ratio);
    const Shape shape = shape_of(physics);
    const Flow flow = make_flow(make_pore(physics.pore), physics.flow, shape.basis, shape.resolution);
    const Condition found = condition(flow, shape, position, before);
    const double exact = exact_eigenvalue(ratio);
    const double deviation = std::abs(found.smallest_eigenvalue / exact - 1);
    worst = std::max(worst, deviation);
    product = std::max(product, found.number * std::min(ratio, 1 / ratio));
    const double corrections = std::ceil(std::log(1e-10) / std::log(found.contraction));
    table.add(fmt::format("{:g},{:.4e},{:.6e},{:.1e},{:.3e},{:g}", ratio, found.number,
                          found.smallest_eigenvalue, deviation, found.contraction, corrections));
    fmt::print("lambda = {:g}: condition {:.3g}, smallest eigenvalue {:.6g} (exact {:g}), a correction "
               "leaves {:.1e}: {:g} "
               "for ten digits\n",
               ratio, found.number, found.smallest_eigenvalue, exact, found.contraction, corrections);
  }
  table.write(directory + "/systems.csv");
  const bool eigenvalue = check(
      worst < 1e-4, fmt::format("the smallest eigenvalue is min(1, lambda) to 1e-4 (worst {:.1e})", worst));
  const bool bounded = check(
      product < 20,
      fmt::format("the condition number is below 20 max(lambda, 1/lambda) (largest factor {:.1f})", product));
  return eigenvalue && bounded;
}

bool entrances(const std::string &directory, unsigned jobs) {
  std::vector<RunInput> inputs;
  for (const double ratio : ratios)
    inputs.push_back({fmt::format("{:g}", ratio), entrance(ratio)});
  const std::vector<StudyRun> runs = run_all(directory, jobs, inputs);
  Table table("viscosity_ratio,reached,time,steps,seconds,volume_change,peak");
  bool all = true;
  double drift = 0;
  for (std::size_t k = 0; k < runs.size(); ++k) {
    const Summary &summary = runs[k].summary;
    const auto value = [&](const char *name) { return summary.quantities.at(name); };
    const bool reached = summary.status == word_of(Status::reached);
    all = all && reached;
    double volume = 0;
    for (const double change : runs[k].history.at("volume_change"))
      volume = std::max(volume, std::abs(change));
    drift = std::max(drift, volume);
    double peak = 0;
    for (const double drop : runs[k].history.at("pressure_drop"))
      peak = std::max(peak, drop);
    table.add(fmt::format("{},{:d},{:.6f},{:g},{:.3f},{:.3e},{:.5f}", inputs[k].name, reached, value("time"),
                          value("steps"), value("cpu_seconds"), volume, peak));
    fmt::print("lambda = {}: {} at t = {:.3f} after {:g} steps, {:.2f} s; volume within {:.1e}; largest "
               "pressure drop "
               "{:.4f} {}\n",
               inputs[k].name, summary.status, value("time"), value("steps"), value("cpu_seconds"), volume,
               peak, summary.message);
  }
  table.write(directory + "/entrances.csv");
  const bool reached = check(all, "every entrance reaches its end");
  const bool kept =
      check(drift < 1e-4, fmt::format("the volume keeps within 1e-4 (largest drift {:.1e})", drift));
  return reached && kept;
}

// A shape at rest in its own frame carries its liquid along rigidly: nothing depends on the liquid's viscosity. What
// does is the motion that is left, and the quadrature's net flow through the membrane, which 1/lambda multiplies.
bool steady_state(const std::string &directory) {
  Case physics = entrance(1);
  physics.accuracy = 1e-5;
  physics.mesh.membrane = 96;
  physics.pore.exit_x = 16;
  physics.until.x_g = 11;
  const Outcome way = march(physics, {}, {});
  if (way.status != Status::reached)
    return check(false, way.message);
  const SeriesRow &row = way.last.series.back();
  const double residual = std::max(row.max_axial_residual, row.max_radial_velocity) / row.v_g;
  fmt::print("residual velocity {:.2e} of v_g\n", residual);

  Table table("accuracy,viscosity_ratio,pressure_drop,difference,residual");
  double worst = 0;
  for (const double accuracy : {1e-3, 1e-5, 1e-7}) {
    const auto drop = [&](double viscosity_ratio) {
      physics.accuracy = accuracy;
      physics.flow.viscosity_ratio = viscosity_ratio;
      return make_dynamics(physics).flow(way.last.position).pressure_drop;
    };
    const double at_one = drop(1);
    worst = 0;
    for (const double ratio : ratios) {
      const double now = drop(ratio);
      const double difference = std::abs(now / at_one - 1);
      worst = std::max(worst, difference);
      table.add(fmt::format("{:g},{:g},{:.8f},{:.3e},{:.3e}", accuracy, ratio, now, difference, residual));
      fmt::print("accuracy {:g}, lambda = {:g}: pressure drop {:.7f}, {:.1e} from lambda = 1\n", accuracy,
                 ratio, now, difference);
    }
  }
  table.write(directory + "/steady.csv");
  return check(
      worst < 5 * residual,
      fmt::format("the steady pressure drop depends on lambda by less than five times the residual velocity "
                  "{:.1e} (by {:.1e})",
                  residual, worst));
}

bool study(const std::string &directory, unsigned jobs) {
  const bool marches = entrances(directory, jobs);
  Case half = entrance(1);
  half.until.x_g = 0.02; // a shape about one step of the default ahead of the other
  const Vector position = march(half, {}, {}).last.position;
  half.until.x_g = 0;
  const Vector before = march(half, {}, {}).last.position;
  const bool conditions = systems(directory, position, before);
  const bool independent = steady_state(directory);
  return marches && conditions && independent;
}

} // namespace

int main(int argc, char **argv) {
  return study_main(argc, argv, study);
}
