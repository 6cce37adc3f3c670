// How long may an explicit step be? The largest step of Euler's, Heun's and Runge and Kutta's scheme with which a
// disturbance of the shape dies away, by bisection, against the eigenvalues of the linearised motion; what the program
// says of a longer step; and how long the steps of the default are.
#include "study.hpp"
#include "base/decompositions.hpp"
#include "base/failure.hpp"
#include "law/skalak.hpp"
#include "motion/dynamics.hpp"
#include "motion/motion.hpp"
#include "motion/time_step.hpp"
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <functional>
#include <random>

using namespace capsule;

namespace {

constexpr double mouth = 0; // x_g of the shapes

// Explicit schemes. The solver does without Heun's (order 2), whose limit is Euler's at twice the cost of a step.
enum class Explicit { euler, heun, runge_kutta };
constexpr std::array all_explicit{Explicit::euler, Explicit::heun, Explicit::runge_kutta};

const char *name_of(Explicit scheme) {
  return scheme == Explicit::euler ? "euler" : scheme == Explicit::heun ? "rk2" : "rk4";
}
double limit_of(Explicit scheme) {
  return stability_limit(scheme == Explicit::runge_kutta ? Scheme::rk4 : Scheme::euler);
}

using Rate = ExplicitIntegrator::Rate;
// Each call gives the state one step later.
std::function<Vector()> stepper(Explicit scheme, const Rate &rate, const Vector &start, double step) {
  if (scheme == Explicit::heun)
    return [=, state = start]() mutable {
      const Vector before = rate(state);
      state += step / 2 * (before + rate(state + step * before));
      return state;
    };
  return
      [integrator = ExplicitIntegrator(scheme == Explicit::euler ? Scheme::euler : Scheme::rk4, rate,
                                       {.time = 0, .state = start, .load = {}, .rate = {}}, step)]() mutable {
        integrator.step();
        return integrator.state_at(integrator.time());
      };
}

struct Setting {
  std::string varied;
  double value;
  Case physics;
};

std::vector<Setting> settings() {
  std::vector<Setting> list;
  const auto add = [&](const std::string &varied, double value, auto &&vary) {
    Case physics = short_entrance(40, mouth);
    vary(physics);
    list.push_back({varied, value, physics});
  };
  for (const int nodes : {28, 40, 64})
    add("nodes", nodes, [&](Case &c) { c.mesh.membrane = nodes; });
  for (const double ratio : {1e-3, 1e-2})
    add("bending_ratio", ratio, [&](Case &c) { c.membrane.bending_ratio = ratio; });
  for (const double number : {0.01, 0.3})
    add("capillary_number", number, [&](Case &c) { c.flow.capillary_number = number; });
  for (const double ratio : {0.1, 10.0, 100.0})
    add("viscosity_ratio", ratio, [&](Case &c) { c.flow.viscosity_ratio = ratio; });
  return list;
}

double fastest(const Matrix &jacobian) {
  return eigenvalues(jacobian).cwiseAbs().maxCoeff();
}

// The whole derivative of the velocity, that of the mobility included, by central differences.
Matrix whole_jacobian(const Dynamics &dynamics, const Vector &position) {
  constexpr double step = 1e-6;
  Matrix jacobian(position.size(), position.size());
  for (Eigen::Index k = 0; k < position.size(); ++k) {
    const auto moved = [&](double by) {
      Vector other = position;
      other[k] += by;
      return dynamics.flow(other).velocity;
    };
    jacobian.col(k) = (moved(step) - moved(-step)) / (2 * step);
  }
  return jacobian;
}

// Size of a displacement's shortest third of waves, where the fastest motions are.
double roughness(const MeridianBasis &basis, const Vector &displacement) {
  const Eigen::Index n = basis.size();
  const Vector even = basis.even_from_nodes * displacement.head(n);
  const Vector odd = basis.odd_from_nodes * displacement.tail(n);
  return std::hypot(even.tail(n / 3).norm(), odd.tail(n / 3).norm());
}

// Two marches side by side, one of them disturbed by noise: whether their difference grows.
bool grows(const Dynamics &dynamics, Explicit scheme, const Vector &shape, double step) {
  const int half = scheme == Explicit::runge_kutta ? 20 : 50;
  constexpr double noise = 1e-8;
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(-noise, noise);
  const Vector seed = Vector::NullaryExpr(shape.size(), [&] { return uniform(random); });
  const auto rate = [&](const Vector &position) { return dynamics.flow(position).velocity; };
  try {
    const auto plain = stepper(scheme, rate, shape, step);
    const auto disturbed = stepper(scheme, rate, shape + seed, step);
    double before = 0;
    double difference = 0;
    for (int k = 1; k <= 2 * half; ++k) {
      const Vector undisturbed = plain();
      difference = roughness(dynamics.scene->membrane.basis, disturbed() - undisturbed);
      if (k == half)
        before = difference;
      if (!(difference < 1e3 * seed.norm()))
        return true;
    }
    return difference > before;
  } catch (const NumericsFailure &) {
    return true;
  }
}

// Bisection between `stable`, which must be, and `unstable`.
double largest_step(const Dynamics &dynamics, Explicit scheme, const Vector &shape, double stable,
                    double unstable) {
  if (grows(dynamics, scheme, shape, stable) || !grows(dynamics, scheme, shape, unstable))
    return NAN;
  while (unstable / stable > 1.02) {
    const double middle = std::sqrt(stable * unstable);
    (grows(dynamics, scheme, shape, middle) ? unstable : stable) = middle;
  }
  return std::sqrt(stable * unstable);
}

// Rates of the shortest waves of a sphere at rest: stretching meets the modulus dT_s/dlambda_s = 4 of a neo-Hookean
// membrane, bending delta k^3, at k = N/R.
double rough_rate(const Case &physics) {
  const double wave = physics.mesh.membrane / physics.capsule.radius;
  const double stretching = 4 * wave;
  const double bending = physics.membrane.bending_ratio * wave * wave * wave;
  return std::max(stretching, bending) /
         (2 * (1 + physics.flow.viscosity_ratio) * physics.flow.capillary_number);
}

struct Range {
  double least = INFINITY;
  double most = 0;
  void add(double value) {
    least = std::min(least, value);
    most = std::max(most, value);
  }
  double ratio() const { return most / least; }
};

// Measured steps against the predictions, and the steps of the default.
bool limits(const std::string &directory) {
  constexpr double frozen_shape = 6e-3; // shorter steps leave the shape much as it is during the test
  Table table("varied,value,scheme,measured,frozen,whole,rough,default");
  double worst = 0;
  double estimate = 0;
  Range explicit_steps;
  Range default_steps;
  for (const Setting &setting : settings()) {
    const Dynamics dynamics = make_dynamics(setting.physics);
    const Outcome way = march(setting.physics, {}, {});
    if (way.status != Status::reached)
      throw NumericsFailure(way.failure, way.message, "");
    const Vector &shape = way.last.position;
    const double frozen = fastest(dynamics.jacobian(shape));
    const double whole = fastest(whole_jacobian(dynamics, shape));
    const double mean_step = way.last.time / static_cast<double>(way.last.steps);
    default_steps.add(mean_step);
    explicit_steps.add(stability_limit(Scheme::euler) / frozen);
    const double ratio = rough_rate(setting.physics) / frozen;
    estimate = std::max({estimate, ratio, 1 / ratio});
    for (const Explicit scheme : all_explicit) {
      const double limit = limit_of(scheme);
      const double predicted = limit / frozen;
      const double measured = largest_step(dynamics, scheme, shape, 0.75 * predicted, 1.25 * predicted);
      if (predicted < frozen_shape) {
        const double error = std::abs(measured / predicted - 1);
        worst = error <= worst ? worst : error; // a NaN stays
      }
      table.add(fmt::format("{},{:g},{},{:.4e},{:.4e},{:.4e},{:.4e},{:.4e}", setting.varied, setting.value,
                            name_of(scheme), measured, predicted, limit / whole,
                            limit / rough_rate(setting.physics), mean_step));
      fmt::print("{} = {:g}, {}: measured {:.3e}, from the program's Jacobian {:.3e}, from the whole one "
                 "{:.3e}, at rest {:.3e}; default's mean step {:.2e}\n",
                 setting.varied, setting.value, name_of(scheme), measured, predicted, limit / whole,
                 limit / rough_rate(setting.physics), mean_step);
    }
  }
  table.write(directory + "/limits.csv");
  const bool agrees =
      check(worst < 0.05, fmt::format("limits below {:g} are as predicted within 5 % (worst {:.1f} %)",
                                      frozen_shape, 100 * worst));
  const bool rough =
      check(estimate < 1.5,
            fmt::format("the rates of a sphere at rest tell the limit within a factor of 1.5 (worst {:.2f})",
                        estimate));
  const bool free =
      check(default_steps.ratio() < 3 && explicit_steps.ratio() > 100,
            fmt::format("the default's mean step changes by less than 3 (by {:.1f}) where Euler's limit "
                        "changes by {:.0f}",
                        default_steps.ratio(), explicit_steps.ratio()));
  return agrees && rough && free;
}

constexpr int few = 28; // nodes

// Euler's limit on the way into the tube.
std::vector<std::pair<double, double>> along_the_way(const std::string &directory) {
  std::vector<std::pair<double, double>> way;
  Table table("x_g,limit");
  const auto add = [&](double x_g, const Dynamics &dynamics, const Vector &position) {
    way.emplace_back(x_g, 2 / fastest(dynamics.jacobian(position)));
    table.add(fmt::format("{:g},{:.4e}", x_g, way.back().second));
    fmt::print("x_g = {:4g}: Euler's limit {:.3e}\n", x_g, way.back().second);
  };
  const Dynamics dynamics = make_dynamics(short_entrance(few, 0));
  add(short_entrance(few, mouth).capsule.start_x, dynamics, dynamics.scene->start);
  Checkpoint from;
  for (const double x_g : {-2.0, -1.0, 0.0, 1.0}) {
    from = march(short_entrance(few, x_g), from, {}).last;
    add(x_g, dynamics, from.position);
  }
  table.write(directory + "/way.csv");
  return way;
}

// A Skalak membrane stiffens where it is stretched: a step that is short enough at the start is too long in the mouth.
bool report_on_the_way() {
  Case physics = short_entrance(few, 0);
  physics.capsule.radius = 1;
  physics.membrane.law = skalak;
  physics.membrane.bending_ratio = 1e-4;
  physics.flow.capillary_number = 0.1;
  physics.time.scheme = Scheme::euler;
  const Dynamics dynamics = make_dynamics(physics);
  physics.time.step =
      0.8 * stability_limit(Scheme::euler) / fastest(dynamics.jacobian(dynamics.scene->start));
  const Outcome outcome = march(physics, {}, {});
  const bool right = outcome.failure == failure_kind::step && outcome.last.series.back().x_g > -2;
  fmt::print("Skalak, R_eq = 1, euler, 0.8 of the limit at the start: {}: {}\n", right ? "right" : "WRONG",
             outcome.failure.empty() ? "reached" : outcome.message);
  return right;
}

// What march says of steps that are too long.
bool reports(const std::string &directory) {
  double least = INFINITY;
  for (const auto &[x_g, limit] : along_the_way(directory))
    least = std::min(least, limit);
  bool right = true;
  for (const Scheme scheme : {Scheme::euler, Scheme::rk4})
    for (const double ratio : {0.95, 1.1, 10.0}) {
      Case physics = short_entrance(few, -1.5);
      physics.time.scheme = scheme;
      physics.time.step = ratio * least * stability_limit(scheme) / 2;
      const Outcome outcome = march(physics, {}, {});
      const bool named = ratio > 1 ? outcome.failure == failure_kind::step &&
                                         outcome.message.find("try time.step") != std::string::npos
                                   : outcome.status == Status::reached;
      right = right && named;
      fmt::print("{}, {:g} of the least limit: {}: {}\n", scheme == Scheme::euler ? "euler" : "rk4", ratio,
                 named ? "right" : "WRONG", outcome.failure.empty() ? "reached" : outcome.message);
    }
  const bool later = report_on_the_way();
  return check(right && later, "a step that is too long is named, with one that is not");
}

bool study(const std::string &directory, unsigned /*jobs*/) {
  make_directories(directory);
  const bool named = reports(directory);
  return limits(directory) && named;
}

} // namespace

int main(int argc, char **argv) {
  return study_main(argc, argv, study);
}
