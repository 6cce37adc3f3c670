#include "motion/motion.hpp"
#include "base/failure.hpp"
#include "motion/dynamics.hpp"
#include "motion/error_estimate.hpp"
#include "motion/time_step.hpp"
#include "observe/gauge.hpp"
#include "scene/resolution.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace capsule {
namespace {

constexpr int rows_in_time = 200; // where time tells the progress
constexpr int steps_between_checkpoints = 250;
// Of time: so many steps of the default that lead on by less are not going to arrive.
constexpr double shortest_leg = 1e-4;
constexpr double volume_drift_bound = 1e-2;
// Buckles that the mesh cannot resolve: dents of the meridian, most of whose bending is in the shortest
// waves.
constexpr int wrinkle_dents = 3;
constexpr double wrinkle_roughness = 0.4;

// On nodes that were chosen from the accuracy buckles have to be resolved to it.
double roughness_on_chosen_nodes(double accuracy) {
  return std::min(wrinkle_roughness, std::cbrt(accuracy));
}

// A value of x_g or of time at which a row is due.
struct Station {
  double value;
  bool profile;
  bool regular; // whatever profiles are asked for
  bool end;
};

std::vector<Station> stations(double from, double spacing, std::optional<double> end,
                              const std::vector<double> &profiles) {
  std::vector<Station> list;
  for (const double value : profiles)
    if (value > from && (!end || value <= *end))
      list.push_back({value, true, false, false});
  if (end) {
    const auto first = static_cast<long>(std::floor(from / spacing + 1e-9)) + 1;
    for (long k = first; static_cast<double>(k) * spacing < *end; ++k)
      list.push_back({static_cast<double>(k) * spacing, false, true, false});
    list.push_back({*end, true, true, true});
  }
  std::sort(list.begin(), list.end(), [](const Station &a, const Station &b) { return a.value < b.value; });
  const double same = end ? 1e-6 * spacing : 0; // without an end there is no grid
  std::vector<Station> merged;
  for (const Station &station : list) {
    if (merged.empty() || station.value - merged.back().value > same)
      merged.push_back(station);
    else // what was asked for tells the value, not the grid
      merged.back() = {station.profile ? station.value : merged.back().value,
                       merged.back().profile || station.profile, merged.back().regular || station.regular,
                       merged.back().end || station.end};
  }
  return merged;
}

// The march that is asked for, or its coarse companion, which may wrinkle where the other does not.
enum class Part { leading, companion };

// The march of one case: integrates, records what is due, and stops.
class March {
public:
  // roughest: with wrinkle_dents dents the march ends as wrinkled beyond this roughness.
  March(const Case &physics, const Checkpoint &from, const Control &control, Part part,
        double roughest = wrinkle_roughness)
      : physics_(physics), control_(control), part_(part), roughest_(roughest),
        dynamics_(make_dynamics(physics)), gauge_(dynamics_.scene->pore, dynamics_.scene->membrane),
        record_(from) {
    const Vector &start = started() ? record_.position : dynamics_.scene->start;
    const bool by_position = physics.until.x_g.has_value();
    by_x_g_ = stations(gauge_.centre(start), row_spacing, physics.until.x_g, physics.output.profiles_at_x_g);
    const double end = physics.until.time.value_or(std::numeric_limits<double>::infinity());
    by_time_ = stations(record_.time, by_position ? end : end / rows_in_time, physics.until.time,
                        physics.output.profiles_at_time);
  }

  Outcome run() {
    Outcome outcome;
    try {
      if (!started()) {
        record_.position = dynamics_.scene->start;
        record(0, dynamics_.scene->start, {.value = 0, .profile = true, .regular = true, .end = false});
      }
      outcome.status = physics_.time.scheme == Scheme::bdf ? run_bdf() : run_explicit();
    } catch (const NumericsFailure &failure) {
      outcome.status = failure.kind == "unbounded" ? Status::unbounded : Status::failed;
      const SeriesRow last = record_.series.empty() ? SeriesRow{} : record_.series.back();
      outcome.failure = failure.kind;
      outcome.message = fmt::format("{} (after t = {:.6g}, x_g = {:.6g}); {}", failure.what(), last.time,
                                    last.x_g, failure.advice);
    }
    outcome.last = record_;
    return outcome;
  }

private:
  bool started() const { return record_.position.size() > 0; }

  Status run_explicit() {
    const auto rate = [this](const Vector &position) { return dynamics_.flow(position).velocity; };
    sound_ = record_.position;
    for (;;) {
      dynamics_.forget();
      require_stable_step(record_.position);
      try {
        ExplicitIntegrator integrator(physics_.time.scheme, rate, record_.time, record_.position,
                                      physics_.time.step);
        if (const auto status = run_leg(integrator, 1000))
          return *status;
      } catch (const NumericsFailure &failure) {
        require_stable_step(sound_);
        throw NumericsFailure(failure.kind, failure.what(), failure.advice + ", or a shorter time.step");
      }
    }
  }

  // Explicit steps that are too long for the fastest decay let it grow instead. Its rate is the largest
  // eigenvalue of the Jacobian, which the paper preset does not have.
  void require_stable_step(const Vector &position) const {
    if (!dynamics_.jacobian)
      return;
    const double fastest = dynamics_.jacobian(position).eigenvalues().cwiseAbs().maxCoeff();
    const double stable = stability_limit(physics_.time.scheme) / fastest;
    if (physics_.time.step > stable)
      throw NumericsFailure(
          "step",
          fmt::format("time.step = {:.3g} is unstable: beyond {:.3g} the fastest decay of the "
                      "membrane, at a rate of {:.3g}, grows",
                      physics_.time.step, stable, fastest),
          fmt::format("try time.step = {:.2g}", 0.9 * stable));
  }

  Status run_bdf() {
    const double tolerance = choose_resolution(physics_).time_tolerance;
    const Equations equations{[&](const Vector &position, Vector &rate) {
                                try {
                                  rate = dynamics_.flow(position).velocity;
                                  return true;
                                } catch (const NumericsFailure &failure) {
                                  cause_.emplace(failure);
                                  return false;
                                }
                              },
                              [&](const Vector &position, Matrix &jacobian) {
                                try {
                                  jacobian = dynamics_.jacobian(position);
                                  return jacobian.allFinite();
                                } catch (const NumericsFailure &failure) {
                                  cause_.emplace(failure);
                                  return false;
                                }
                              }};
    for (;;) {
      dynamics_.forget();
      try {
        BdfIntegrator integrator(equations, record_.time, record_.position, tolerance);
        if (const auto status = run_leg(integrator, steps_between_checkpoints))
          return *status;
      } catch (const NumericsFailure &failure) {
        if (failure.kind == "step" && cause_)
          throw NumericsFailure(*cause_);
        throw;
      }
    }
  }

  // Steps from one checkpoint to the next: the integrator starts afresh from each, so that an interrupted
  // march goes on just as this one does. Empty: not at the end yet.
  template <class Integrator>
  std::optional<Status> run_leg(Integrator &integrator, int steps) {
    for (int k = 0; k < steps; ++k) {
      if (control_.interrupted && control_.interrupted())
        return Status::interrupted;
      cause_.reset();
      integrator.step();
      ++record_.steps;
      if (record_due(integrator))
        return Status::reached;
    }
    const double gone = integrator.time() - record_.time;
    record_.time = integrator.time();
    record_.position = integrator.state_at(integrator.time());
    const double film = gauge_.film(record_.position);
    require_film(film);
    if (physics_.time.scheme == Scheme::bdf && gone < shortest_leg)
      throw NumericsFailure(
          "unresolved",
          fmt::format("the last {} steps lead on by {:.1g} only, with a film of {:.2g}", steps, gone, film),
          "try a finer mesh.membrane");
    if (control_.save)
      control_.save(record_);
    return std::nullopt;
  }

  // Records the rows that fall into the last step, in order of time; true at the end.
  template <class Integrator>
  bool record_due(const Integrator &integrator) {
    const double now = integrator.time(), before = integrator.previous_time();
    for (;;) {
      double due = std::numeric_limits<double>::infinity();
      const Station *station = nullptr;
      bool in_time = false;
      if (next_time_ < by_time_.size() && by_time_[next_time_].value <= now) {
        station = &by_time_[next_time_];
        due = station->value;
        in_time = true;
      }
      if (next_x_g_ < by_x_g_.size()) {
        const auto ahead = [&](double time) {
          return gauge_.centre(integrator.state_at(time)) - by_x_g_[next_x_g_].value;
        };
        if (ahead(now) >= 0) {
          const double crossing = crossing_time(ahead, before, now);
          if (crossing < due) {
            station = &by_x_g_[next_x_g_];
            due = crossing;
            in_time = false;
          }
        }
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

  // x_g is nearly linear in a step: the secant rule needs about three values; halving guards it.
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

  // The equations look at the nodes. Between them a thin film may be gone, and then they go on in ever shorter steps.
  static void require_film(double film) {
    if (film <= 0)
      throw NumericsFailure("touching", "the membrane touches the wall between its nodes",
                            "try a smaller accuracy or a finer mesh.membrane");
  }

  void record(double time, const Vector &position, const Station &station) {
    // The companion's second route to the pressure drop is not looked at.
    const FlowState state =
        part_ == Part::companion ? dynamics_.flow(position) : dynamics_.report(position, station.regular);
    SeriesRow row = gauge_.row(time, position, state.velocity);
    row.pressure_drop = state.pressure_drop;
    row.pressure_drop_reciprocal = state.pressure_drop_reciprocal;
    record_.series.push_back(row);
    if (station.profile)
      record_.profiles.push_back(gauge_.profile(time, position, state.velocity));
    if (control_.progress)
      control_.progress(row, record_.steps);
    require_film(row.min_film);
    if (gauge_.crosses_itself(position))
      throw NumericsFailure("self-contact", "the membrane crosses itself",
                            "raise membrane.bending_ratio or refine mesh.membrane");
    if (std::abs(row.volume_change) > volume_drift_bound)
      throw NumericsFailure("volume",
                            fmt::format("the volume has drifted by {:.2g} %", 100 * row.volume_change),
                            "try a smaller accuracy (or time.tolerance) or a finer mesh.membrane");
    if (part_ == Part::leading && row.dents >= wrinkle_dents && row.roughness > roughest_)
      throw NumericsFailure(
          "wrinkled",
          fmt::format("the membrane has wrinkled: {} dents, most of their bending in waves that the "
                      "mesh barely resolves",
                      row.dents),
          "raise membrane.bending_ratio, or mesh.membrane until it resolves the wrinkles");
    if (row.max_stretch > runaway_stretch)
      throw NumericsFailure(
          "unbounded", fmt::format("the membrane is stretched beyond {} and still growing", runaway_stretch),
          "no steady state need exist: lower flow.capillary_number");
    sound_ = position;
  }

  const Case &physics_;
  const Control &control_;
  Part part_;
  double roughest_;
  Dynamics dynamics_;
  Gauge gauge_;
  Checkpoint record_;
  Vector sound_;                         // the last recorded position that had nothing to be stopped for
  std::optional<NumericsFailure> cause_; // why a shape that the present step tried is no capsule in the pore
  std::vector<Station> by_x_g_, by_time_;
  std::size_t next_x_g_ = 0, next_time_ = 0;
};

// The same motion, a little coarser: each kind of error is then about three times as large. Much coarser ones tell
// less: where convergence is exponential their errors are 10 to 100 times as large, and near an instability they go
// another way.
Case companion(const Case &physics) {
  Case coarse = physics;
  const Resolution chosen = choose_resolution(physics);
  coarse.mesh.membrane = 9 * chosen.membrane_nodes / 10;
  coarse.mesh.wall = 9 * chosen.wall_points / 10;
  coarse.time.step = physics.time.step / 0.9; // as stable on its nodes as the fine one's
  coarse.time.tolerance = 5 * chosen.time_tolerance;
  coarse.output = {};
  return coarse;
}

// The march that is asked for, with the mesh and tolerance that it ended with. Wrinkles on a mesh that was chosen from
// the accuracy may be the mesh's own, and buckles amplify errors: then the march begins again on a finer one and with
// shorter steps, once, and what it shows there is believed.
struct Lead {
  Case physics;
  Outcome outcome;
};
Lead lead(const Case &physics, const Checkpoint &from, const Control &control) {
  const bool can_refine = physics.mesh.membrane == 0 && physics.time.scheme == Scheme::bdf;
  if (!can_refine)
    return {physics, March(physics, from, control, Part::leading).run()};
  const Resolution chosen = choose_resolution(physics);
  Case finer = physics;
  finer.mesh.membrane = 3 * chosen.membrane_nodes / 2;
  if (physics.time.tolerance == 0)
    finer.time.tolerance = chosen.time_tolerance / 30;
  const bool goes_on_finer = from.position.size() == Eigen::Index{2} * finer.mesh.membrane;
  if (!goes_on_finer) {
    Outcome outcome =
        March(physics, from, control, Part::leading, roughness_on_chosen_nodes(physics.accuracy)).run();
    if (outcome.failure != "wrinkled")
      return {physics, std::move(outcome)};
  }
  Outcome outcome = March(finer, goes_on_finer ? from : Checkpoint{}, control, Part::leading).run();
  outcome.membrane_nodes = finer.mesh.membrane;
  return {finer, std::move(outcome)};
}

} // namespace

Outcome march(const Case &physics, const Checkpoint &from, const Control &control) {
  auto [marched, outcome] = lead(physics, from, control);
  if (outcome.status != Status::reached || physics.numerics == Numerics::paper)
    return outcome;
  Control quiet;
  quiet.interrupted = control.interrupted;
  const Case coarse = companion(marched);
  const Outcome second = March(coarse, {}, quiet, Part::companion).run();
  if (second.status == Status::interrupted)
    outcome.status = Status::interrupted;
  else if (second.status == Status::reached) {
    outcome.error_estimate = estimate_errors(outcome.last.series, second.last.series,
                                             physics.until.x_g.has_value(), physics.time.scheme);
    outcome.error_estimate["volume_change"] =
        std::abs(outcome.last.series.back().volume_change); // exactly none
  } else
    outcome.message = "no error estimate, because the coarse companion failed: " + second.message;
  return outcome;
}

} // namespace capsule
