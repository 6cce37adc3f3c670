// The checks of a pore with two mouths, of constant pressure and of the electric resistance that no run makes by itself:
// mirror symmetry and the classical motion of rigid spheres, the balance of energy, a replay at the flow rate that a
// constant pressure has driven, and what the resistance's accuracy costs.
#include "study.hpp"
#include "electric/conductor.hpp"
#include "geometry/quadrature.hpp"
#include "law/neo_hookean.hpp"
#include "membrane/load.hpp"
#include "motion/dynamics.hpp"
#include "motion/motion.hpp"
#include "motion/split_bdf.hpp"
#include "scene/make_flow.hpp"
#include "scene/resolution.hpp"
#include "test/rigid_sphere.hpp"
#include <algorithm>
#include <array>
#include <boost/math/tools/roots.hpp>
#include <cmath>
#include <fmt/format.h>
#include <functional>
#include <numbers>

using namespace capsule;

namespace {

constexpr double pi = std::numbers::pi;
constexpr double second_mouth = 6;

Case short_pore() {
  Case physics;
  physics.pore.shape = PoreShape::two_mouths;
  physics.pore.exit_x = second_mouth;
  physics.flow.capillary_number = 0.05;
  physics.membrane.law = neo_hookean;
  physics.membrane.bending_ratio = 1e-3;
  physics.capsule.radius = 0.8;
  return physics;
}

// Force-free rigid spheres all along the pore, at constant flow rate and at constant pressure, and what they add to the
// resistance (Frank and Hochmuth, 1987).
bool spheres(const std::string &directory) {
  constexpr double decay =
      4.466; // of a disturbance along the tube, from the tips of the largest that is known
  const Case physics = short_pore();
  const Pore pore = make_pore(physics.pore).value();
  const MeridianBasis basis = spectral_basis(48);
  const Flow flow = make_flow(pore, physics.flow, basis, {});
  const FlowResolution of_conductor = conductor_resolution({});
  const Conductor conductor(pore, of_conductor);
  const MembraneMesh mesh = make_membrane_mesh(basis, of_conductor);
  const double empty = flow.wall().base_pressure_drop();
  // In a tube without end, by two other programs; 0: not known to so many digits.
  struct Sphere {
    double radius, v_g, pressure_drop, resistance;
  };
  Table table("radius,x,v_g,pressure_drop,flow_rate,resistance");
  double asymmetry = 0, electric_asymmetry = 0, off_the_tube = 0, flow_rate_off = 0;
  for (const Sphere &sphere : {Sphere{0.3, 1.88091761, 0.03903349, 1.021987},
                               {0.5, 1.67984674, 0.5218392, 1.110694},
                               {0.7, 1.41627863, 3.285772, 1.379503},
                               {0.8, 0, 0, 1.710194},
                               {0.9, 0, 0, 0}}) {
    const double volume = 2 * std::pow(sphere.radius, 3);
    std::vector<RigidSphere> motions;
    std::vector<double> resistances;
    const int steps = 64;
    for (int k = 0; k <= steps; ++k) {
      const double x = -5 + (second_mouth + 10) * k / steps;
      motions.push_back(rigid_sphere(flow, basis, x, sphere.radius));
      resistances.push_back(conductor.change(mesh, capsule::sphere(basis, x, sphere.radius)));
      const double rate = empty / (empty + motions.back().pressure_drop);
      table.add(fmt::format("{},{},{:.9g},{:.9g},{:.9g},{:.9g}", sphere.radius, x, motions.back().v_g,
                            motions.back().pressure_drop, rate, resistances.back()));
      if (sphere.radius == 0.8 && 2 * k == steps)
        flow_rate_off = std::abs(rate - 0.88206);
    }
    for (std::size_t k = 0; 2 * k < motions.size(); ++k) {
      const RigidSphere &here = motions[k], &there = motions[motions.size() - 1 - k];
      asymmetry = std::max({asymmetry, std::abs(here.v_g / there.v_g - 1),
                            std::abs(here.pressure_drop - there.pressure_drop) / empty});
      electric_asymmetry =
          std::max(electric_asymmetry, std::abs(resistances[k] - resistances[resistances.size() - 1 - k]) /
                                           conductor.empty_resistance());
    }
    const RigidSphere &middle = motions[steps / 2];
    if (sphere.v_g > 0)
      off_the_tube = std::max({off_the_tube, std::abs(middle.v_g - sphere.v_g),
                               std::abs(middle.pressure_drop - sphere.pressure_drop) / empty});
    if (sphere.resistance > 0)
      off_the_tube = std::max(off_the_tube, std::abs(resistances[steps / 2] / volume - sphere.resistance));
  }
  table.write(directory + "/spheres.csv");
  const bool claims[] = {
      check(asymmetry < 1e-6, fmt::format("mirror images go alike to {:.1e}", asymmetry)),
      check(electric_asymmetry < 1e-7,
            fmt::format("and add the same resistance to {:.1e}", electric_asymmetry)),
      check(off_the_tube < std::exp(-decay * (second_mouth / 2 - 0.8)),
            fmt::format("in the middle all is that of a tube to {:.1e}", off_the_tube)),
      check(flow_rate_off < 1e-4,
            fmt::format("at constant pressure a sphere of 0.8 leaves the flow rate 0.88206 to {:.1e}",
                        flow_rate_off))};
  return std::ranges::all_of(claims, std::identity());
}

// Points of the meridian plane that a volume is integrated by, each with a length in which nothing is in its way.
struct Volume {
  std::vector<double> x, r, weight, room;
  void add(double at_x, double at_r, double area, double free) {
    x.push_back(at_x);
    r.push_back(at_r);
    weight.push_back(2 * pi * at_r * area);
    room.push_back(free);
  }
  // A piece of a column, from one boundary to another.
  void add_column(double at_x, double width, double from, double to) {
    const Panels panels = make_panels(from + (to - from) * Vector{{0, 0.1, 0.5, 0.9, 1}}.array(), 8);
    for (Eigen::Index i = 0; i < panels.points.size(); ++i)
      add(at_x, panels.points[i], width * panels.weights[i],
          std::min(panels.points[i] - from, to - panels.points[i]));
  }
};

// Gauss points of intervals between these places; at a pole the depth of a column grows like a root.
struct Places {
  std::vector<double> x, weight;
  void add(double from, double to, bool from_pole = false, bool to_pole = false) {
    const Panels panels = make_panels(Vector{{0, 0.5, 1}}, 10);
    for (Eigen::Index i = 0; i < panels.points.size(); ++i) {
      const double s = panels.points[i], w = panels.weights[i] * (to - from);
      x.push_back(from_pole ? from + (to - from) * s * s
                  : to_pole ? to - (to - from) * s * s
                            : from + (to - from) * s);
      weight.push_back(from_pole || to_pole ? 2 * s * w : w);
    }
  }
};

// The liquid inside and outside of a membrane that is a function r(x) between its poles: columns up to spheres of radius 3
// around both lips' planes, shells of the reservoirs beyond.
Volume volume_of(const Pore &pore, const MeridianBasis &basis, const Vector &position) {
  constexpr double near = 3, far = 24;
  const Vector x = position.head(basis.size()), r = position.tail(basis.size());
  const auto at = [&](double zeta) { return basis.even(Vector::Constant(1, zeta), 0, x)[0]; };
  const double rear = at(0), front = at(pi);
  const double rim = pore.cosine * std::sqrt(near * near - 1); // where the sphere meets the wall
  std::vector<double> edges = {-near, -2, -rim, -0.3, -0.1, -0.03, 0, 0.03, 0.1, 0.3, 0.6, 1};
  for (std::size_t k = edges.size(); k-- > 0;)
    edges.push_back(second_mouth - edges[k]);
  edges.insert(edges.end(), {2, 3, 4, rear, front, rear + 0.1, front - 0.1});
  std::ranges::sort(edges);
  Volume volume;
  for (std::size_t k = 0; k + 1 < edges.size(); ++k) {
    Places places;
    places.add(edges[k], edges[k + 1], edges[k] == rear || edges[k] == -near,
               edges[k + 1] == front || edges[k + 1] == second_mouth + near);
    for (std::size_t i = 0; i < places.x.size(); ++i) {
      const double place = places.x[i], width = places.weight[i];
      const double outside = std::max(-place, place - second_mouth);
      const double depth =
          outside > rim ? std::sqrt(near * near - outside * outside) : wall_radius(pore, place);
      if (place <= rear || place >= front) {
        volume.add_column(place, width, 0, depth);
        continue;
      }
      const auto [low, high] = boost::math::tools::bisect([&](double zeta) { return at(zeta) - place; }, 0.0,
                                                          pi, boost::math::tools::eps_tolerance<double>(48));
      const double edge = basis.odd(Vector::Constant(1, (low + high) / 2), 0, r)[0];
      volume.add_column(place, width, 0, edge);
      volume.add_column(place, width, edge, depth);
    }
  }
  const Panels radii = make_panels(Vector{{near, 4, 6, 9, 14, far}}, 8);
  for (Eigen::Index i = 0; i < radii.points.size(); ++i) {
    const double radius = radii.points[i], at_wall = pore.cosine * std::sqrt(radius * radius - 1) / radius;
    const Panels cosines = make_panels(at_wall + (1 - at_wall) * Vector{{0, 0.1, 0.4, 1}}.array(), 8);
    for (Eigen::Index j = 0; j < cosines.points.size(); ++j) {
      const double cosine = cosines.points[j], sine = std::sqrt(1 - cosine * cosine);
      const double area = radii.weights[i] * cosines.weights[j] * radius / sine;
      const double room = std::min(radius * (cosine - at_wall), radius * sine);
      volume.add(-radius * cosine, radius * sine, area, room);
      volume.add(second_mouth + radius * cosine, radius * sine, area, room);
    }
  }
  return volume;
}

// int 2 e:e dV by differences of the velocity.
template <class Velocity>
double dissipation(const Volume &volume, const Velocity &velocity) {
  constexpr std::size_t together = 400;
  double sum = 0;
  for (std::size_t first = 0; first < volume.x.size(); first += together) {
    const auto n = static_cast<Eigen::Index>(std::min(together, volume.x.size() - first));
    const Eigen::Map<const Eigen::ArrayXd> x(&volume.x[first], n), r(&volume.r[first], n),
        weight(&volume.weight[first], n), room(&volume.room[first], n);
    const Eigen::ArrayXd step = (0.2 * room).min(2e-3);
    Targets around{Vector(4 * n), Vector(4 * n)};
    around.x << x + step, x - step, x, x;
    around.r << r, r, r + step, r - step;
    const Vector v = velocity(around);
    const auto part = [&](Eigen::Index component, Eigen::Index k) -> Eigen::ArrayXd {
      return v.segment((4 * component + k) * n, n);
    };
    const Eigen::ArrayXd xx = (part(0, 0) - part(0, 1)) / (2 * step),
                         rr = (part(1, 2) - part(1, 3)) / (2 * step);
    const Eigen::ArrayXd xr = ((part(0, 2) - part(0, 3)) + (part(1, 0) - part(1, 1))) / (4 * step);
    const Eigen::ArrayXd around_axis = (part(1, 0) + part(1, 1)) / (2 * r);
    sum += (2 * weight * (xx.square() + rr.square() + around_axis.square() + 2 * xr.square())).sum();
  }
  return sum;
}

// What becomes heat in a viscous membrane, from the rates of its stretches by differences.
double dissipation_in_membrane(const Membrane &membrane, const SurfaceViscosity &viscosity,
                               const Vector &position, const Vector &velocity) {
  const Panels panels = make_panels(Vector::LinSpaced(41, 0, pi), 12);
  const Sampling points = sample(membrane.basis, panels.points, panels.weights);
  constexpr double instant = 1e-5;
  const MembraneState now = membrane_state(membrane, points, position),
                      before = membrane_state(membrane, points, position - instant * velocity),
                      after = membrane_state(membrane, points, position + instant * velocity);
  const auto rate = [&](Vector MembraneState::*stretch) -> Eigen::ArrayXd {
    return ((after.*stretch).array() / (before.*stretch).array()).log() / (2 * instant);
  };
  const Eigen::ArrayXd meridional = rate(&MembraneState::stretch_meridional),
                       azimuthal = rate(&MembraneState::stretch_azimuthal);
  return (2 * pi * points.weights.array() * now.r.array() * now.arc.array() *
          (viscosity.shear * (meridional - azimuthal).square() +
           viscosity.dilatational * (meridional + azimuthal).square()))
      .sum();
}

// P Q = dissipation + dW/dt of a capsule in the first mouth at constant pressure, lambda = 1: what the liquid dissipates is
// integrated over its volume, what the membrane stores is its energy's change.
bool energy(const SurfaceViscosity &of_membrane) {
  Case physics = short_pore();
  physics.membrane.viscosity = of_membrane;
  physics.accuracy = 1e-5;
  physics.flow.drive = DriveBy::pressure;
  physics.capsule.start_x = -2;
  physics.until.x_g = -0.1;
  const Vector position = march(physics, {}, {}).last.position;
  const Scene scene = make_scene(physics);
  const double epsilon = physics.flow.capillary_number;
  const Flow flow =
      make_flow(scene.pore, physics.flow, scene.membrane.basis, choose_resolution(physics).flow, of_membrane);
  const Interaction interaction = flow.interact(position);
  const Vector load = membrane_load(scene.membrane, position) / epsilon;
  Recycled recycled;
  const FlowState state = flow.solve(interaction, load, recycled);
  const double pressure = state.flow_rate * flow.wall().base_pressure_drop() + state.pressure_drop;
  const double power = pi * state.flow_rate * pressure;
  constexpr double instant = 1e-4;
  const double stored = (elastic_energy(scene.membrane, position + instant * state.velocity) -
                         elastic_energy(scene.membrane, position - instant * state.velocity)) /
                        (2 * instant * epsilon);
  const double dissipated =
      dissipation(volume_of(*scene.pore, scene.membrane.basis, position), [&](const Targets &points) {
        return flow.outer_velocity(points, interaction, load, state);
      });
  const double in_membrane = dissipation_in_membrane(scene.membrane, of_membrane, position, state.velocity);
  fmt::print("power {:.6f}, of it stored {:.6f}, dissipated {:.6f} in the liquid, {:.6f} in the membrane\n",
             power, stored, dissipated, in_membrane);
  const double missing = std::abs(power - stored - dissipated - in_membrane) / power;
  const bool is_constant =
      check(std::abs(pressure / flow.wall().base_pressure_drop() - 1) < 1e-12, "the pressure is constant");
  const bool is_balanced = check(missing < 1e-4, fmt::format("energy is balanced to {:.1e}", missing));
  return is_constant && is_balanced;
}

// The flow rate at a time, by the polynomial through six rows.
double flow_rate_at(const std::vector<SeriesRow> &series, double time) {
  constexpr std::ptrdiff_t points = 6;
  const auto after = std::ranges::find_if(series, [&](const SeriesRow &row) { return row.time >= time; });
  const auto first = series.begin() + std::clamp<std::ptrdiff_t>(after - series.begin() - points / 2, 0,
                                                                 std::ssize(series) - points);
  double sum = 0;
  for (auto row = first; row != first + points; ++row) {
    double weight = 1;
    for (auto other = first; other != first + points; ++other)
      if (other != row)
        weight *= (time - other->time) / (row->time - other->time);
    sum += weight * row->flow_rate;
  }
  return sum;
}

// A march at constant pressure, and one at the flow rate that it has had at each time: at the flow rate q, in its own
// scales, a capsule is q times as soft and q times as fast.
bool replay() {
  Case physics = short_pore();
  physics.flow.drive = DriveBy::pressure;
  physics.capsule.radius = 0.9;
  physics.capsule.start_x = -2;
  physics.until.x_g = 2;
  for (int k = 1; k <= 60; ++k) // rows while the sphere takes its first shape
    physics.output.profiles_at_time.push_back(0.005 * k);
  const Outcome outcome = march(physics, {}, {});
  const std::vector<SeriesRow> &series = outcome.last.series;

  Case given = physics;
  given.flow.drive = DriveBy::flow_rate;
  const Scene scene = make_scene(given);
  const Resolution chosen = choose_resolution(given);
  const Flow flow = make_flow(scene.pore, given.flow, scene.membrane.basis, chosen.flow);
  const double epsilon = given.flow.capillary_number;
  const Eigen::Index n2 = scene.start.size();
  Recycled recycled;
  const auto load = [&](const Vector &state) { // of the position and of the time itself
    Vector all = Vector::Zero(n2 + 1);
    all.head(n2) = membrane_load(scene.membrane, state.head(n2)) / epsilon;
    return all;
  };
  const SplitEquations equations{
      .load = load,
      .rate = [&](const Vector &state) -> SplitEquations::Rate {
        const double q = flow_rate_at(series, state[n2]);
        Vector rate(n2 + 1);
        rate << q * flow.solve(flow.interact(state.head(n2)), load(state).head(n2) / q, recycled).velocity, 1;
        return {rate};
      },
      .mobility =
          [&](const Vector &state) {
            Matrix all = Matrix::Zero(n2 + 1, n2 + 1);
            all.topLeftCorner(n2, n2) = flow.mobility(flow.interact(state.head(n2)), recycled);
            return all;
          },
      .load_jacobian =
          [&](const Vector &state) {
            Matrix all = Matrix::Zero(n2 + 1, n2 + 1);
            all.topLeftCorner(n2, n2) = frozen_load_jacobian(scene.membrane, state.head(n2), epsilon);
            return all;
          }};
  Vector state(n2 + 1);
  state << scene.start, 0;
  SplitBdf integrator(equations, 0, state, chosen.time_tolerance);
  const double end = series.back().time;
  while (integrator.time() < end)
    integrator.step();
  const double off = (integrator.state_at(end).head(n2) - outcome.last.position).cwiseAbs().maxCoeff();
  const double lowest = std::ranges::min(series, {}, &SeriesRow::flow_rate).flow_rate;
  return check(
      lowest < 0.9 && off < physics.accuracy,
      fmt::format("a replay of Q(t), which falls to {:.3f}, ends in the same shape to {:.1e}", lowest, off));
}

// Error and cost of a row's resistance: a sphere in the mouth, against a fine resolution.
bool resistance(const std::string &directory) {
  const Case base = short_pore();
  const Pore pore = make_pore(base.pore).value();
  const std::array places{-1.0, 0.0, 1.0};
  const auto measure = [&](const FlowResolution &resolution, int nodes) {
    const Conductor conductor(pore, resolution);
    const MeridianBasis basis = spectral_basis(nodes);
    const MembraneMesh mesh = make_membrane_mesh(basis, resolution);
    std::vector<double> changes;
    const double began = cpu_seconds();
    constexpr int repetitions = 20;
    for (int k = 0; k < repetitions; ++k) {
      changes.clear();
      for (const double x : places)
        changes.push_back(conductor.change(mesh, sphere(basis, x, base.capsule.radius)));
    }
    changes.push_back(1e3 * (cpu_seconds() - began) / (repetitions * places.size()));
    return changes;
  };
  const std::vector<double> exact = measure({.wall_panel = 0.4, .near_tolerance = 1e-11}, 100);
  Table table("accuracy,error,milliseconds");
  bool holds = true;
  for (const double accuracy : {1e-2, 1e-3, 1e-4, 1e-5, 1e-6}) {
    Case physics = base;
    physics.accuracy = accuracy;
    const Resolution chosen = choose_resolution(physics);
    const std::vector<double> found = measure(conductor_resolution(chosen.flow), chosen.membrane_nodes);
    double error = 0;
    for (std::size_t k = 0; k < places.size(); ++k)
      error = std::max(error, std::abs(found[k] / exact[k] - 1));
    table.add(fmt::format("{},{:.3e},{:.3f}", accuracy, error, found.back()));
    holds = check(error < accuracy,
                  fmt::format("asked for {:.0e}: the resistance errs by {:.1e} and takes {:.1f} ms", accuracy,
                              error, found.back())) &&
            holds;
  }
  table.write(directory + "/resistance.csv");
  return holds;
}

bool study(const std::string &directory, unsigned /*jobs*/) {
  make_directories(directory);
  bool holds = true;
  for (const bool part : {spheres(directory), energy({}), energy({.shear = 200, .dilatational = 50}),
                          replay(), resistance(directory)})
    holds = holds && part;
  return holds;
}

} // namespace

int main(int argc, char **argv) {
  return study_main(argc, argv, study);
}
