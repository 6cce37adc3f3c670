#include "motion/march.hpp"
#include "base/failure.hpp"
#include "case/case.hpp"
#include "geometry/gap.hpp"
#include "motion/dynamics.hpp"
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
#include <vector>

namespace capsule {
namespace {

constexpr int rows_in_time = 200; // of a march that ends at a time
constexpr int steps_of_a_leg = 250;
constexpr int explicit_steps_of_a_leg = 1000;
constexpr Station end_station{
    .value = 0, .profile = true, .regular = true, .end = true}; // not at a given place
constexpr double shortest_leg = 1e-4; // a march that gains less time than this in one leg is given up

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
    // Not the centre of the start's shape, whose rounding may lie on either side of a place that is asked for.
    const double centre = record_.steps > 0 ? centre_of(0, record_.position) : input.capsule.start_x;
    const UntilSpec &until = input.until;
    const auto profiles_every = input.output.profiles_every;
    x_g_stations_ =
        stations(centre, row_spacing, until.last_x_g && !until.x_g ? end_of_way(input.pore) : until.x_g,
                 input.output.profiles_at_x_g, until.by_place() ? profiles_every : std::nullopt);
    if (until.last_x_g && !until.x_g)
      for (Station &station : x_g_stations_)
        station.end = false;
    const double end = until.time.value_or(std::numeric_limits<double>::infinity());
    time_stations_ =
        stations(record_.time, until.by_place() ? end : end / rows_in_time, until.time,
                 input.output.profiles_at_time, until.by_place() ? std::nullopt : profiles_every);
  }

  Outcome run() {
    Outcome outcome;
    try {
      if (!started()) {
        record_.position = dynamics_.scene->start;
        record(0, dynamics_.scene->start, {.value = 0, .profile = true, .regular = true, .end = false});
        record_.leg = {};
      }
      outcome.status = input_.time.scheme == Scheme::bdf ? run_bdf() : run_explicit();
    } catch (const NumericsFailure &failure) {
      outcome.status = failure.kind == failure_kind::unbounded ? Status::unbounded
                       : failure.kind == failure_kind::burst   ? Status::burst
                                                               : Status::failed;
      const SeriesRow last = record_.series.empty() ? SeriesRow{} : record_.series.back();
      outcome.failure = failure.kind;
      outcome.message = fmt::format("{} (after t = {:.6g}, x_g = {:.6g}); {}", failure.what(), last.time,
                                    last.x_g, failure.advice);
    }
    if (outcome.status != Status::interrupted)
      record_.steps = steps_;
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

  void begin_leg() {
    *dynamics_.recycled = {};
    asked_ = 0;
    repeats_ = !record_.leg.answers.empty();
    repeated_rows_ = record_.leg.rows;
  }

  // What the integrator asks for: while it repeats a leg what it was answered before, then what is computed.
  template <class Compute>
  Vector answer(const Compute &compute) {
    std::vector<Vector> &answers = record_.leg.answers;
    if (asked_ == answers.size()) {
      if (repeats_)
        *dynamics_.recycled = record_.leg.recycled;
      repeats_ = false;
      answers.push_back(compute());
    }
    return answers[asked_++];
  }

  // The same of the flow, or nothing, and why.
  template <class Compute>
  Vector answer_if_any(const Compute &compute) {
    return answer([&]() -> Vector {
      try {
        return compute();
      } catch (const NumericsFailure &failure) {
        cause_.emplace(failure);
        return {};
      }
    });
  }

  // While a leg is repeated only the Jacobian that is in use at its end is computed: no correction needs the others.
  bool jacobian_at(const Vector &position, Matrix &jacobian) {
    if (repeats_ && asked_ < record_.leg.answers.size())
      jacobian = asked_ == record_.leg.jacobian ? dynamics_.jacobian(position)
                                                : Matrix::Zero(position.size(), position.size());
    const Vector found = answer_if_any([&]() -> Vector {
      jacobian = dynamics_.jacobian(position);
      if (!jacobian.allFinite())
        return {};
      record_.leg.jacobian = asked_;
      return Vector::Ones(1);
    });
    return found.size() > 0;
  }

  void save() {
    if (!repeats_)
      record_.leg.recycled = *dynamics_.recycled;
    if (control_.save)
      control_.save(record_);
  }

  Status run_explicit() {
    const auto rate = [this](const Vector &position) {
      return answer([&] { return dynamics_.flow(position).velocity; });
    };
    last_accepted_ = record_.position;
    for (;;) {
      begin_leg();
      require_stable_step(record_.position);
      try {
        ExplicitIntegrator integrator(input_.time.scheme, rate, record_.time, record_.position,
                                      input_.time.step);
        if (const auto status = run_leg(integrator, explicit_steps_of_a_leg))
          return *status;
      } catch (const NumericsFailure &failure) {
        require_stable_step(last_accepted_);
        throw NumericsFailure(failure.kind, failure.what(), failure.advice + ", or a shorter time.step");
      }
    }
  }

  // With explicit steps that are too long the fastest decay grows instead. Its rate is the largest eigenvalue of the
  // Jacobian, which the paper preset does not have.
  void require_stable_step(const Vector &position) const {
    if (!dynamics_.jacobian)
      return;
    const double fastest = dynamics_.jacobian(position).eigenvalues().cwiseAbs().maxCoeff();
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
    const Equations equations{
        [&](const Vector &position, Vector &rate) {
          rate = answer_if_any([&] { return dynamics_.flow(position).velocity; });
          return rate.size() > 0;
        },
        [&](const Vector &position, Matrix &jacobian) { return jacobian_at(position, jacobian); },
        [&](const std::function<Vector()> &solve) { return answer(solve); }};
    for (;;) {
      begin_leg();
      try {
        BdfIntegrator integrator(equations, record_.time, record_.position, tolerance);
        if (const auto status = run_leg(integrator, steps_of_a_leg))
          return *status;
      } catch (const NumericsFailure &failure) {
        if (failure.kind == failure_kind::step && cause_)
          throw NumericsFailure(*cause_);
        throw;
      }
    }
  }

  // One leg of steps. The integrator starts afresh with each. Empty: not at the end yet.
  template <class Integrator>
  std::optional<Status> run_leg(Integrator &integrator, int steps) {
    for (int k = 0; k < steps; ++k) {
      const bool interrupted = control_.interrupted && control_.interrupted();
      if (interrupted || (control_.wants_checkpoint && control_.wants_checkpoint()))
        save();
      if (interrupted)
        return Status::interrupted;
      cause_.reset();
      integrator.step();
      ++steps_;
      if (record_due(integrator))
        return Status::reached;
    }
    const double gone = integrator.time() - record_.time;
    record_.time = integrator.time();
    record_.position = integrator.state_at(integrator.time());
    record_.steps = steps_;
    record_.leg = {};
    SeriesRow here; // only the film is measured between rows
    here.min_film = smallest_film(record_.position);
    throw_if_stopped({.row = here});
    if (input_.time.scheme == Scheme::bdf && gone < shortest_leg)
      throw NumericsFailure(failure_kind::unresolved,
                            fmt::format("the last {} steps lead on by {:.1g} only, with a film of {:.2g}",
                                        steps, gone, here.min_film),
                            "try a finer mesh.membrane");
    if (control_.save)
      control_.save(record_);
    return std::nullopt;
  }

  // When the membrane came to what it bears in the last step, if it did.
  template <class Integrator>
  double burst_time(const Integrator &integrator) const {
    const UntilSpec &until = input_.until;
    const auto beyond = [&](double time) {
      const Vector position = integrator.state_at(time);
      return beyond_bearing_of(most_strained(position), position);
    };
    const double now = integrator.time();
    return (until.area_stretch || until.tension) && beyond(now) >= 0
               ? crossing_time(beyond, integrator.previous_time(), now)
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
    const double now = integrator.time();
    return ahead(now) >= 0 ? crossing_time(ahead, integrator.previous_time(), now)
                           : std::numeric_limits<double>::infinity();
  }

  // Records the rows that fall into the last step, in order of time; true at the end.
  template <class Integrator>
  bool record_due(const Integrator &integrator) {
    const double now = integrator.time(), before = integrator.previous_time();
    const double burst = burst_time(integrator), last = arrival_of_last(integrator);
    for (;;) {
      double due = std::numeric_limits<double>::infinity();
      const Station *station = nullptr;
      bool in_time = false;
      if (next_time_ < time_stations_.size() && time_stations_[next_time_].value <= now) {
        station = &time_stations_[next_time_];
        due = station->value;
        in_time = true;
      }
      if (next_x_g_ < x_g_stations_.size()) {
        const auto ahead = [&](double time) {
          return centre_of(0, integrator.state_at(time)) - x_g_stations_[next_x_g_].value;
        };
        if (ahead(now) >= 0) {
          const double crossing = crossing_time(ahead, before, now);
          if (crossing < due) {
            station = &x_g_stations_[next_x_g_];
            due = crossing;
            in_time = false;
          }
        }
      }
      if (last <= now && last <= due) {
        station = &end_station;
        due = last;
      }
      if (burst <= now && burst <= due) {
        record(burst, integrator.state_at(burst), end_station, true);
        return true;
      }
      if (station == nullptr)
        return false;
      record(due, integrator.state_at(due), *station);
      ++(in_time ? next_time_ : next_x_g_);
      if (station->end) {
        record_.time = due;
        record_.position = integrator.state_at(due);
        return true;
      }
    }
  }

  // Root of a function that rises in a step. x_g is nearly linear there: the secant rule needs about three values;
  // halving guards it.
  template <class Function>
  static double crossing_time(const Function &ahead, double since, double now) {
    double low = since, high = now;
    double before = low, time = high;
    double at_before = ahead(before), at_time = ahead(time);
    if (at_before >= 0)
      return since;
    for (int k = 0; k < 100 && std::abs(at_time) > 1e-13; ++k) {
      const double secant = time - at_time * (time - before) / (at_time - at_before);
      before = time;
      at_before = at_time;
      time = secant > low && secant < high ? secant : (low + high) / 2;
      at_time = ahead(time);
      (at_time < 0 ? low : high) = time;
    }
    return time;
  }

  void record(double time, const Vector &position, const Station &station, bool bursts = false) {
    if (repeated_rows_ > 0) { // it is in the series
      --repeated_rows_;
      last_accepted_ = position;
      return;
    }
    // Nobody looks at the companion's second pressure drop, but at each capsule's share of it.
    const bool alone = rows_.size() == 1;
    const FlowState state = role_ == Role::companion && alone ? dynamics_.flow(position)
                                                              : dynamics_.report(position, station.regular);
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
    ++record_.leg.rows;
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
  long steps_;                           // with those of the present leg
  bool repeats_ = false;                 // the present leg, from its beginning to where it was saved
  std::size_t asked_ = 0;                // by the integrator, in the present leg
  std::size_t repeated_rows_ = 0;        // that are still to come
  Vector last_accepted_;                 // position of the last row at which nothing stopped the march
  std::optional<NumericsFailure> cause_; // why a shape that the present step tried has no flow
  std::vector<Station> x_g_stations_, time_stations_;
  std::size_t next_x_g_ = 0, next_time_ = 0;
};

} // namespace

Outcome march_once(const Case &input, const Checkpoint &from, const Control &control, Role role,
                   double roughness_limit) {
  return March(input, from, control, role, roughness_limit).run();
}

} // namespace capsule
