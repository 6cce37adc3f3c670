// How thin may the film between membrane and wall be? The error of the near-singular quadrature against the film over
// the panel's length, and capsules up to R_eq = 1.3 that nearly plug the tube.
#include "study.hpp"
#include "integrals/layer_potential.hpp"
#include "law/skalak.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numbers>

using namespace capsule;

namespace {

constexpr double pi = std::numbers::pi;
constexpr int points = 12; // of a panel
constexpr int paper_points = 5;
constexpr double plain = 1; // a tolerance with which no panel is near
constexpr double half_length = 1.5, half_width = 0.95;

// A spheroid along the tube, on given panels.
Curve spheroid(const Panels &panels) {
  Curve curve;
  curve.panel_points = panels.rule.size();
  curve.weights = panels.weights;
  const auto &zeta = panels.points.array();
  curve.x = -half_length * zeta.cos();
  curve.r = half_width * zeta.sin();
  curve.x_zeta = half_length * zeta.sin();
  curve.r_zeta = half_width * zeta.cos();
  complete(curve);
  return curve;
}

// A traction or velocity that varies along the membrane: even axial, odd radial component.
Vector density(const Panels &panels) {
  const auto &zeta = panels.points.array();
  Vector values(2 * zeta.size());
  values << 1 + (2 * zeta).cos(), zeta.sin() + 0.5 * (3 * zeta).sin();
  return values;
}

// Velocity at points outside the widest place, at the given distance from the curve and between its points.
Vector velocity(const RingKernel &kernel, const Panels &panels, double film, double tolerance) {
  Targets targets;
  constexpr int places = 9;
  targets.x = Vector::LinSpaced(places, -0.17, 0.23); // across a panel
  targets.r.resize(places);
  for (int k = 0; k < places; ++k) // along the normal
  {
    const double zeta = std::acos(-targets.x[k] / half_length);
    const double normal_x = -half_width * std::cos(zeta);
    const double normal_r = half_length * std::sin(zeta);
    const double length = std::hypot(normal_x, normal_r);
    targets.r[k] = half_width * std::sin(zeta) + film * normal_r / length;
    targets.x[k] += film * normal_x / length;
  }
  RowMatrix matrix;
  const Curve curve = spheroid(panels);
  assemble_layer(kernel, targets, curve, nullptr, NearRule(curve.panel_points, tolerance), matrix);
  return matrix * density(panels);
}

Panels uniform_panels(int count, int on_a_panel = points) {
  return make_panels(Vector::LinSpaced(count + 1, 0, pi), on_a_panel);
}

// So many panels that Gauss's rule alone bears the film.
Vector exact_velocity(const RingKernel &kernel, double film) {
  const int count = std::max(64, static_cast<int>(std::ceil(half_length * pi / film)));
  return velocity(kernel, uniform_panels(count), film, plain);
}

bool quadrature(const std::string &directory) {
  constexpr int panel_count = 16; // as long as with 96 nodes
  const double panel = half_length * pi / panel_count;
  struct Rule {
    int points;
    double tolerance;
  };
  const std::vector<Rule> rules{
      {paper_points, plain}, {points, plain}, {points, 1e-6}, {points, 1e-8}, {points, 1e-10}};
  Table table("layer,points,tolerance,film_over_panel,error");
  double worst = 0;
  double worst_plain = 0;
  const std::vector<std::pair<std::string, RingKernel>> layers{{"single", ring_stokeslet},
                                                               {"double", ring_stresslet}};
  for (const auto &[layer, kernel] : layers)
    for (int k = 0; k < 56; ++k) { // down to a thousandth of a panel
      const double ratio = std::pow(2, 1 - 0.2 * k);
      const double film = ratio * panel;
      const Vector exact = exact_velocity(kernel, film);
      for (const Rule &rule : rules) {
        const Panels panels = uniform_panels(panel_count, rule.points);
        const double error = (velocity(kernel, panels, film, rule.tolerance) - exact).cwiseAbs().maxCoeff() /
                             exact.cwiseAbs().maxCoeff();
        table.add(fmt::format("{},{},{:g},{:.5e},{:.3e}", layer, rule.points, rule.tolerance, ratio,
                              std::max(error, 1e-17)));
        if (rule.tolerance == plain)
          worst_plain = std::max(worst_plain, error);
        else
          worst = std::max(worst, error / rule.tolerance);
      }
    }
  table.write(directory + "/quadrature.csv");
  fmt::print("largest error of the near rule {:.2g} of its tolerance; of Gauss's rule alone {:.2g}\n", worst,
             worst_plain);
  return check(
      worst < 10,
      fmt::format("the near rule's error is below ten times its tolerance for every film (worst {:.1f})",
                  worst));
}

Case plug(double radius, double viscosity_ratio, int nodes) {
  Case physics;
  physics.accuracy = 1e-3;
  physics.pore.exit_x = 8;
  physics.capsule.radius = radius;
  physics.membrane.law = skalak;
  physics.flow.capillary_number = 0.05;
  physics.flow.viscosity_ratio = viscosity_ratio;
  physics.mesh.membrane = nodes;
  physics.until.x_g = 3;
  return physics;
}

struct Plug {
  double radius, viscosity_ratio;
  int nodes;
};

std::vector<Plug> all_plugs() {
  std::vector<Plug> plugs;
  for (const int nodes : {48, 96})
    for (const double radius : {0.9, 1.0, 1.1, 1.2, 1.3})
      for (const double ratio : {1.0, 10.0, 100.0})
        plugs.push_back({radius, ratio, nodes});
  return plugs;
}

// In the longest panels, those in the middle of the membrane.
double film_in_panels(const Summary &summary, int nodes) {
  const double panel = summary.quantities.at("length") * 0.65 * points / nodes * pi / 2;
  return summary.quantities.at("min_film") / panel;
}

// Whether the word for how the march ended is right: the film that is left tells a membrane on the wall.
bool is_right(const Summary &summary, double panels) {
  const bool pressed = panels < 0.02;
  return pressed ? summary.failure == failure_kind::unresolved || summary.failure == failure_kind::touching
                 : summary.status == word_of(Status::reached);
}

bool plugs(const std::string &directory, unsigned jobs) {
  const std::vector<Plug> capsules = all_plugs();
  std::vector<RunInput> inputs;
  for (const auto &[radius, ratio, nodes] : capsules)
    inputs.push_back({fmt::format("radius={},viscosity_ratio={},membrane={}", radius, ratio, nodes),
                      plug(radius, ratio, nodes)});
  const std::vector<StudyRun> runs = run_all(directory, jobs, inputs);
  Table table(
      "radius,viscosity_ratio,nodes,end,x_g,min_film,film_over_panel,v_g,pressure_drop,error,seconds");
  bool right = true, enter = true, agree = true;
  for (std::size_t k = 0; k < runs.size(); ++k) {
    const Summary &summary = runs[k].summary;
    const auto value = [&](const char *name) { return summary.quantities.at(name); };
    const auto error_of = [](const Summary &of) {
      const auto error = of.error_estimate.find("pressure_drop");
      return error == of.error_estimate.end() ? NAN : error->second;
    };
    const auto &[radius, ratio, nodes] = capsules[k];
    const double panels = film_in_panels(summary, nodes);
    const std::string end = summary.failure.empty() ? summary.status : summary.failure;
    right = right && is_right(summary, panels);
    enter = enter && (ratio > 10 || end == "reached");
    if (k >= runs.size() / 2) { // the same capsule on the coarser mesh
      const Summary &coarse = runs[k - runs.size() / 2].summary;
      const double apart = std::abs(value("pressure_drop") - coarse.quantities.at("pressure_drop"));
      agree = agree &&
              (summary.status == word_of(Status::reached)) == (coarse.status == word_of(Status::reached)) &&
              !(apart > error_of(summary) + error_of(coarse)); // none: an end that has no estimate
    }
    table.add(fmt::format("{:g},{:g},{},{},{:.2f},{:.5f},{:.5f},{:.5f},{:.5f},{:.1e},{:.2f}", radius, ratio,
                          nodes, end, value("x_g"), value("min_film"), panels, value("v_g"),
                          value("pressure_drop"), error_of(summary), value("cpu_seconds")));
    fmt::print("R_eq = {:g}, lambda = {:g}, N = {}: {} at x_g = {:.2f}, film {:.4f}, {:.4f} of a panel, v_g "
               "{:.4f}, pressure drop {:.4f} +- {:.0e}, {:.1f} s {}\n",
               radius, ratio, nodes, end, value("x_g"), value("min_film"), panels, value("v_g"),
               value("pressure_drop"), error_of(summary), value("cpu_seconds"), summary.message);
  }
  table.write(directory + "/plugs.csv");
  const bool holds[] = {
      check(enter, "capsules up to R_eq = 1.3 and lambda = 10 enter"),
      check(right, "where the film ends below a fiftieth of a panel, and only there, the march "
                   "is unresolved or touching"),
      check(agree, "two meshes end alike, with pressure drops within both error estimates")};
  return std::ranges::all_of(holds, [](bool each) { return each; });
}

bool study(const std::string &directory, unsigned jobs) {
  make_directories(directory);
  const bool exact = quadrature(directory);
  return plugs(directory, jobs) && exact;
}

} // namespace

int main(int argc, char **argv) {
  return study_main(argc, argv, study);
}
