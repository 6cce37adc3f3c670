#include "motion/march.hpp"
#include "base/decompositions.hpp"
#include "base/failure.hpp"
#include "case/case.hpp"
#include "case/physical.hpp"
#include "geometry/gap.hpp"
#include "motion/dynamics.hpp"
#include "motion/split_bdf.hpp"
#include "motion/stations.hpp"
#include "motion/time_step.hpp"
#include "observe/gauge.hpp"
#include "scene/resolution.hpp"
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <fmt/format.h>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

namespace capsule {
namespace {

constexpr int rows_in_time = 200; // of a march that ends at a time
constexpr int steps_between_film_checks = 250;
constexpr int steps_between_gain_checks = 1000;
constexpr int steps_between_stability_checks = 1000;
constexpr Station end_station{
    .value = 0, .profile = true, .regular = true, .end = true}; // not at a given place
// A march that gains less time in all these steps is given up. Most gain more in one step.
constexpr double least_gain = 1e-2;

// Integrates, records what is due, and stops.
class March {
public:
  March(const Case &input, const Checkpoint &from, const Control &control, Role role, double roughness_limit)
      : input_(input), control_(control), role_(role),
        roughness_limit_(role == Role::main ? roughness_limit : std::numeric_limits<double>::infinity()),
        dynamics_(make_dynamics(input)), rows_(rows_of_capsules(*dynamics_.scene)), record_(from),
        steps_(from.steps) {
    const FlowResolution flow = choose_resolution(input).flow;
    const FlowResolution conductor = role == Role::main ? flow : coarser_conductor(flow);
    for (std::size_t k = 0; k < rows_.size(); ++k)
      gauges_.emplace_back(dynamics_.scene->pore, dynamics_.scene->membrane_of(k),
                           input.output.resistance ? std::optional(conductor) : std::nullopt);
    record_.followers.resize(rows_.size() - 1);
    const UntilSpec &until = input.until;
    const auto profiles_every = input.output.profiles_every;
    // From the place that the case names: the rounding of the shape's centre may lie on either side of a station.
    x_g_stations_ = stations(input.capsule.start_x, row_spacing,
                             until.last_x_g && !until.x_g ? end_of_way(input.pore) : until.x_g,
                             input.output.profiles_at_x_g, until.by_place() ? profiles_every : std::nullopt);
    if (until.last_x_g && !until.x_g)
      for (Station &station : x_g_stations_)
        station.end = false;
    const double end = until.time.value_or(std::numeric_limits<double>::infinity());
    time_stations_ =
        stations(0, until.by_place() ? end : end / rows_in_time, until.time, input.output.profiles_at_time,
                 until.by_place() ? std::nullopt : profiles_every);
  }

  Outcome run() {
    Outcome outcome;
    try {
      if (!started()) {
        record_.position = dynamics_.scene->start;
        record(0, dynamics_.scene->start, flow_of_row(dynamics_.scene->start, true),
               {.value = 0, .profile = true, .regular = true, .end = false});
      }
      outcome.status = input_.time.scheme == Scheme::bdf ? run_bdf() : run_explicit();
    } catch (const NumericsFailure &failure) {
      outcome.status = failure.kind == failure_kind::unbounded ? Status::unbounded
                       : failure.kind == failure_kind::burst   ? Status::burst
                                                               : Status::failed;
      const std::vector<SeriesRow> &series =
          failure.capsule == 0 ? record_.series : record_.followers[failure.capsule - 1].series;
      const SeriesRow last = series.empty() ? SeriesRow{} : series.back();
      outcome.failure = failure.kind;
      outcome.message = fmt::format("{} (after t = {:.6g}, x_g = {:.6g}); {}", failure.what(), last.time,
                                    last.x_g, with_physical_keys(failure.advice, input_));
    }
    if (outcome.status != Status::interrupted) {
      record_.steps = steps_;
      record_.memory = {};
      record_.recycled = {};
    }
    outcome.last = record_;
    if (const auto empty = gauges_[0].empty_resistance())
      outcome.further["empty_resistance"] = *empty;
    return outcome;
  }

private:
  Vector part(const Vector &of_all, std::size_t capsule) const { return of_all(rows_[capsule]); }
  double centre_of(std::size_t capsule, const Vector &position) const {
    return gauges_[capsule].centre(part(position, capsule));
  }
  double smallest_film(const Vector &position) const {
    double film = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < rows_.size(); ++k)
      film = std::min(film, gauges_[k].film(part(position, k)));
    return film;
  }

  bool started() const { return record_.position.size() > 0; }

  // A new integrator of the march, or one that goes on from where another was; what the flow left behind there is restored
  // after the integrator has computed its matrices.
  template <class Make>
  auto begin(const Make &make) {
    const bool resumed = !record_.memory.past.empty();
    auto integrator = make();
    if (resumed)
      *dynamics_.recycled = std::exchange(record_.recycled, {});
    record_.memory = {};
    return integrator;
  }

  template <class Integrator>
  void save(const Integrator &integrator) {
    if (!control_.save)
      return;
    record_.memory = integrator.memory();
    record_.recycled = *dynamics_.recycled;
    control_.save(record_);
  }

  Status run_explicit() {
    const auto rate = [this](const Vector &position) { return dynamics_.flow(position).velocity; };
    last_accepted_ = record_.position;
    try {
      ExplicitIntegrator integrator = begin([&] {
        const bool resumed = !record_.memory.past.empty();
        return ExplicitIntegrator(input_.time.scheme, rate,
                                  resumed ? record_.memory.past[0]
                                          : StepMemory::Point{record_.time, record_.position, {}, {}},
                                  input_.time.step);
      });
      return run_steps(integrator, [&] {
        if (steps_ % steps_between_stability_checks == 0)
          require_stable_step(record_.position);
        integrator.step();
      });
    } catch (NumericsFailure &failure) {
      require_stable_step(last_accepted_);
      failure.advice += "; a shorter time.step may help, too";
      throw;
    }
  }

  // With explicit steps that are too long the fastest decay grows instead. Its rate is the largest eigenvalue of the
  // Jacobian, which the paper preset does not have.
  void require_stable_step(const Vector &position) const {
    if (!dynamics_.jacobian)
      return;
    const double fastest = eigenvalues(dynamics_.jacobian(position)).cwiseAbs().maxCoeff();
    const double stable = stability_limit(input_.time.scheme) / fastest;
    if (input_.time.step > stable)
      throw NumericsFailure(
          failure_kind::step,
          fmt::format("time.step = {:.3g} is unstable: beyond {:.3g} the fastest decay of the "
                      "membrane, at a rate of {:.3g}, grows",
                      input_.time.step, stable, fastest),
          fmt::format("try time.step = {:.2g}", 0.9 * stable));
  }

  Status run_bdf() {
    const double tolerance = choose_resolution(input_).time_tolerance;
    const SplitEquations equations{.load = dynamics_.load,
                                   .rate = [this](const Vector &position) -> SplitEquations::Rate {
                                     const FlowState flow = flow_of_row(position, true);
                                     return {flow.velocity, further_of(flow)};
                                   },
                                   .mobility = dynamics_.mobility,
                                   .load_jacobian = dynamics_.load_jacobian,
                                   .parts = rows_};
    SplitBdf integrator = begin([&] {
      return record_.memory.past.empty() ? SplitBdf(equations, record_.time, record_.position, tolerance)
                                         : SplitBdf(equations, record_.memory, tolerance);
    });
    return run_steps(integrator, [&] { integrator.step(longest_step()); });
  }

  // Rows are interpolated. In longer steps the velocity that is left at the end errs more (paper-notes/methods.md). The
  // companion's are as long as its error allows, or both would have the same error.
  double longest_step() const {
    constexpr double rows = 3;
    double longest = std::numeric_limits<double>::infinity();
    if (role_ == Role::companion || record_.series.empty()) // begins with a position that is no row
      return longest;
    if (input_.until.time && !input_.until.by_place())
      longest = rows * *input_.until.time / rows_in_time;
    if (const double v_g = record_.series.back().v_g; v_g > 0 && input_.until.by_place())
      longest = rows * row_spacing / v_g;
    return longest;
  }

  // Steps until the end. `advance` makes one.
  template <class Integrator, class Advance>
  Status run_steps(Integrator &integrator, const Advance &advance) {
    for (;;) {
      const bool interrupted = control_.interrupted && control_.interrupted();
      if (interrupted || (control_.wants_checkpoint && control_.wants_checkpoint()))
        save(integrator);
      if (interrupted)
        return Status::interrupted;
      advance();
      ++steps_;
      if (record_due(integrator))
        return Status::reached;
      record_.time = integrator.time();
      record_.position = integrator.state_at(record_.time);
      record_.steps = steps_;
      if (steps_ % steps_between_film_checks == 0)
        check_film();
      if (steps_ % steps_between_gain_checks == 0 && input_.time.scheme == Scheme::bdf)
        check_gain();
    }
  }

  void check_film() {
    for_each_capsule(*dynamics_.scene, [&](std::size_t k) {
      SeriesRow here; // only the film is measured between rows
      here.min_film = gauges_[k].film(part(record_.position, k));
      throw_if_stopped({.row = here});
    });
  }

  void check_gain() {
    const double gain = record_.time - std::exchange(record_.checked, record_.time);
    if (gain >= least_gain)
      return;
    const double film = smallest_film(record_.position); // infinite without a wall
    throw NumericsFailure(
        failure_kind::unresolved,
        fmt::format("the last {} steps add {:.1g} to the time{}", steps_between_gain_checks, gain,
                    std::isfinite(film) ? fmt::format(", with a film of {:.2g}", film) : ""),
        "try a finer mesh.membrane");
  }

  // When the membrane came to what it bears in the last step, if it did.
  template <class Integrator>
  double burst_time(const Integrator &integrator) const {
    const UntilSpec &until = input_.until;
    const auto beyond = [&](double time) {
      const Vector position = integrator.state_at(time);
      return beyond_bearing_of(most_strained(position), position);
    };
    return until.area_stretch || until.tension ? crossing_in_step(beyond, integrator)
                                               : std::numeric_limits<double>::infinity();
  }

  // When the last capsule came to where it ends the march in the last step, if it did.
  template <class Integrator>
  double arrival_of_last(const Integrator &integrator) const {
    if (!input_.until.last_x_g)
      return std::numeric_limits<double>::infinity();
    const auto ahead = [&](double time) {
      return centre_of(rows_.size() - 1, integrator.state_at(time)) - *input_.until.last_x_g;
    };
    return crossing_in_step(ahead, integrator);
  }

  // Records the rows that fall into the last step, in order of time; true at the end.
  template <class Integrator>
  bool record_due(const Integrator &integrator) {
    const double now = integrator.time(), before = integrator.previous_time();
    const double burst = burst_time(integrator), last = arrival_of_last(integrator);
    const auto x_g = [&](double time) { return centre_of(0, integrator.state_at(time)); };
    const double x_g_now = x_g(now);
    const bool passes_station =
        record_.next_x_g < x_g_stations_.size() && x_g_now >= x_g_stations_[record_.next_x_g].value;
    const double x_g_before = passes_station ? x_g(before) : x_g_now;
    for (;;) {
      double due = std::numeric_limits<double>::infinity();
      const Station *station = nullptr;
      bool in_time = false;
      if (record_.next_time < time_stations_.size() && time_stations_[record_.next_time].value <= now) {
        station = &time_stations_[record_.next_time];
        due = station->value;
        in_time = true;
      }
      if (record_.next_x_g < x_g_stations_.size()) {
        const Station &next = x_g_stations_[record_.next_x_g];
        const double crossing = crossing_time([&](double time) { return x_g(time) - next.value; },
                                              {before, x_g_before - next.value}, {now, x_g_now - next.value});
        if (crossing < due) {
          station = &next;
          due = crossing;
          in_time = false;
        }
      }
      if (last <= now && last <= due) {
        station = &end_station;
        due = last;
      }
      const bool bursts = burst <= now && burst <= due;
      if (bursts) {
        station = &end_station;
        due = burst;
      }
      if (station == nullptr)
        return false;
      const Vector position = integrator.state_at(due);
      record(due, position, flow_at(integrator, due, station->regular), *station, bursts);
      if (bursts)
        return true;
      ++(in_time ? record_.next_time : record_.next_x_g);
      if (station->end) {
        record_.time = due;
        record_.position = position;
        return true;
      }
    }
  }

  // When a function rises through zero in the last step.
  template <class Function, class Integrator>
  static double crossing_in_step(const Function &ahead, const Integrator &integrator) {
    const double now = integrator.time(), before = integrator.previous_time();
    const double value = ahead(now);
    return value >= 0 ? crossing_time(ahead, {before, ahead(before)}, {now, value})
                      : std::numeric_limits<double>::infinity();
  }

  // What an integrator interpolates of a flow beside the velocity, and back.
  static Vector further_of(const FlowState &flow) {
    Vector further(3 + flow.pressure_shares.size());
    further.head<3>() << flow.pressure_drop, flow.flow_rate, flow.pressure_drop_reciprocal;
    further.tail(flow.pressure_shares.size()) = flow.pressure_shares;
    return further;
  }
  static FlowState flow_at(const SplitBdf &integrator, double time, bool /*regular*/) {
    const Vector further = integrator.further_at(time);
    return {.velocity = integrator.rate_at(time),
            .pressure_drop = further[0],
            .flow_rate = further[1],
            .pressure_drop_reciprocal = further[2],
            .pressure_shares = further.tail(further.size() - 3)};
  }
  FlowState flow_at(const ExplicitIntegrator &integrator, double time, bool regular) const {
    return flow_of_row(integrator.state_at(time), regular);
  }

  // Nobody looks at the companion's second pressure drop, but at each capsule's share of it.
  FlowState flow_of_row(const Vector &position, bool regular) const {
    return role_ == Role::companion && rows_.size() == 1 ? dynamics_.flow(position)
                                                         : dynamics_.report(position, regular);
  }

  void record(double time, const Vector &position, const FlowState &state, const Station &station,
              bool bursts = false) {
    const bool alone = rows_.size() == 1;
    std::vector<SeriesRow> rows;
    for (std::size_t k = 0; k < rows_.size(); ++k) {
      const Vector here = part(position, k), velocity = part(state.velocity, k);
      SeriesRow row = gauges_[k].row(time, here, velocity);
      row.pressure_drop = state.pressure_drop;
      row.pressure_drop_reciprocal = state.pressure_drop_reciprocal;
      row.flow_rate = state.flow_rate;
      if (!alone)
        row.pressure_share = state.pressure_shares[static_cast<Eigen::Index>(k)];
      if (k > 0) {
        row.spacing = rows[k - 1].x_g - row.x_g;
        row.min_gap = gap_to_leader(k, position);
      }
      rows.push_back(row);
      CapsuleRecord *follower = k > 0 ? &record_.followers[k - 1] : nullptr;
      (follower ? follower->series : record_.series).push_back(row);
      if (station.profile)
        (follower ? follower->profiles : record_.profiles)
            .push_back(gauges_[k].profile(time, here, velocity));
    }
    if (control_.progress)
      control_.progress(rows[0], steps_);
    for_each_capsule(*dynamics_.scene, [&](std::size_t k) {
      const Vector here = part(position, k);
      throw_if_stopped({.row = rows[k],
                        .crosses_itself = gauges_[k].crosses_itself(here),
                        .roughness_limit = roughness_limit_,
                        .bursts = bursts && k == most_strained(position),
                        .softest = softest_if_elastic(capsules_of(input_)[k]->membrane,
                                                      dynamics_.scene->membrane_of(k), here)});
    });
    last_accepted_ = position;
  }

  // Of one capsule and the one before it.
  double gap_to_leader(std::size_t capsule, const Vector &position) const {
    constexpr int chords = 8;
    const Scene &scene = *dynamics_.scene;
    return gap_between(scene.membrane_of(capsule - 1).basis, part(position, capsule - 1),
                       scene.membrane_of(capsule).basis, part(position, capsule), chords)
        .width;
  }

  double beyond_bearing_of(std::size_t capsule, const Vector &position) const {
    return beyond_bearing(input_.until, gauges_[capsule].largest_strain(part(position, capsule)));
  }
  // The capsule that is nearest to what it bears, or beyond.
  std::size_t most_strained(const Vector &position) const {
    std::size_t most = 0;
    for (std::size_t k = 1; k < rows_.size(); ++k)
      if (beyond_bearing_of(k, position) > beyond_bearing_of(most, position))
        most = k;
    return most;
  }

  const Case &input_;
  const Control &control_;
  Role role_;
  double roughness_limit_;
  Dynamics dynamics_;
  std::vector<std::vector<Eigen::Index>> rows_; // of each capsule in a position
  std::vector<Gauge> gauges_;
  Checkpoint record_;
  long steps_;           // with those since the last checkpoint
  Vector last_accepted_; // position of the last row at which nothing stopped the march
  std::vector<Station> x_g_stations_, time_stations_;
};

} // namespace

Outcome march_once(const Case &input, const Checkpoint &from, const Control &control, Role role,
                   double roughness_limit) {
  return March(input, from, control, role, roughness_limit).run();
}

} // namespace capsule
