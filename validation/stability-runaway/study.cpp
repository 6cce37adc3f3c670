// How fast does a capsule run away beyond its fold? Marches in an endless tube just below and just above the fold of a
// neo-Hookean sphere, and through the paper's pore.
#include "law/neo_hookean.hpp"
#include "motion/motion.hpp"
#include "steady/mesh_change.hpp"
#include "steady/refinement.hpp"
#include "steady/steady_state.hpp"
#include "steady_folds.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numbers>
#include <sstream>

using namespace capsule;

namespace {

constexpr double radius = 0.7, bending_ratio = 1e-2;
constexpr int nodes = 80;
constexpr double widest = 0.016;   // distance from the fold, in eps
constexpr int distances = 5;       // each a quarter of the one before
constexpr int distances_below = 2; // nearer to the fold a march to rest takes too long
constexpr double far_stretch = 3;  // and 4, where the program says unbounded
constexpr double rest = 1e-5;      // max |v_r| of a capsule that has come to rest
constexpr double relaxed = 12;     // times the slowest motion's
constexpr double longest = 2000;   // time
constexpr double half_segment = 5; // of the way after which the capsule is put back
constexpr double half_tube = 11;
constexpr double allowed_exponent = 0.02, allowed_factor = 0.03, allowed_stretch = 1e-4,
                 allowed_volume = 1e-5;

Case sphere(double capillary_number) {
  Case physics;
  physics.accuracy = 1e-5;
  physics.mesh.membrane = nodes;
  physics.capsule.radius = radius;
  physics.membrane.law = neo_hookean;
  physics.membrane.bending_ratio = bending_ratio;
  physics.flow.capillary_number = capillary_number;
  return physics;
}

struct Ghost {
  double capillary_number, stretch; // at the fold
  double slowness; // |growth rate| of the stable state at a small distance, over the distance's square root
};

Ghost find_ghost() {
  constexpr const char *key = "flow.capillary_number";
  constexpr double near = 0.25, strong = 0.5, small = 1e-3;
  const Case physics = sphere(near);
  const SteadyState start = on_mesh(physics, nodes, find_steady(physics, {}, {}));
  const FoldSearch search = find_fold(physics, start, key, strong, 0.1);
  if (!search.fold)
    throw std::runtime_error("no fold: " + search.end);
  const SteadyPoint fold = search.fold->point;
  // Linear in the square root of the distance: two points lead to the fold itself.
  const auto slowness = [&](double distance) {
    const FoldSearch state = find_fold(physics, start, key, fold.value - distance, 0.04);
    if (state.end != "end of the path" || !(state.last.growth_rate < 0))
      throw std::runtime_error("no stable state before the fold: " + state.end);
    return -state.last.growth_rate / std::sqrt(distance);
  };
  return {fold.value, fold.row.max_stretch, 2 * slowness(small / 4) - slowness(small)};
}

struct Way {
  std::string status;
  std::vector<SeriesRow> rows; // time from the start, x_g along the endless tube
};

// A march in a tube without ends: the capsule, at a distance from both, is put back again and again. Until the time is
// over or the march ends by itself.
Way march_on(double capillary_number, double end) {
  Case physics = sphere(capillary_number);
  physics.pore.shape = PoreShape::tube;
  physics.pore.exit_x = physics.pore.entrance_distance = half_tube;
  physics.capsule.start_x = -half_segment;
  physics.until.x_g = half_segment;
  Way way;
  Checkpoint from;
  for (double gone = half_segment;; gone += 2 * half_segment) {
    const Outcome outcome = march(physics, from, {});
    for (SeriesRow row : outcome.last.series) {
      row.x_g += gone;
      way.rows.push_back(row);
    }
    const SeriesRow &last = way.rows.back();
    if (outcome.status != Status::reached || last.time > end) {
      way.status = outcome.status == Status::unbounded ? "unbounded"
                   : outcome.status == Status::failed  ? outcome.failure
                   : last.max_radial_velocity < rest   ? "rest"
                                                       : "moving";
      return way;
    }
    from = {.time = outcome.last.time,
            .position = outcome.last.position,
            .steps = 0,
            .series = {},
            .profiles = {}};
    from.position.head(nodes).array() -= 2 * half_segment;
  }
}

// When the stretch is first reached; NaN if it is not.
double time_to(double stretch, const std::vector<SeriesRow> &rows) {
  for (std::size_t k = 1; k < rows.size(); ++k)
    if (rows[k].max_stretch >= stretch && rows[k - 1].max_stretch < stretch)
      return std::lerp(rows[k - 1].time, rows[k].time,
                       (stretch - rows[k - 1].max_stretch) / (rows[k].max_stretch - rows[k - 1].max_stretch));
  return NAN;
}

SteadyRecord steady_record(double capillary_number) {
  const Case physics = sphere(capillary_number);
  return record_steady(on_mesh(physics, nodes, find_steady(physics, {}, {})));
}

std::string tube_text(double capillary_number, bool below) {
  const double end = below ? relaxed / -steady_record(capillary_number).further.at("growth_rate") : longest;
  const Way way = march_on(capillary_number, end);
  std::string text =
      fmt::format("{} {:.6f} {:.9f} {:.3f} {:.2e}\n", way.status, time_to(far_stretch, way.rows),
                  way.rows.back().max_stretch, way.rows.back().time, way.rows.back().volume_change);
  double due = 0;
  for (const SeriesRow &row : way.rows)
    if (row.time >= due || &row == &way.rows.back()) {
      text += fmt::format("{:.9f},{:.4f},{:.6f}\n", capillary_number, row.time, row.max_stretch);
      due = row.time + way.rows.back().time / 300;
    }
  return text;
}

// The same capsule through the paper's mouth, as far as its steady values are taken.
std::string pore_text(double capillary_number) {
  Case physics = sphere(capillary_number);
  physics.until.x_g = 11.8;
  const Outcome outcome = march(physics, {}, {});
  const SeriesRow &last = outcome.last.series.back();
  return fmt::format("{} {:.4f} {:.6f} {:.4f}",
                     outcome.status == Status::reached     ? "reached"
                     : outcome.status == Status::unbounded ? "unbounded"
                                                           : outcome.failure,
                     last.x_g, last.max_stretch, last.v_g);
}

// Whether `capsule steady` names the fold: below it finds the state, above it fails as "fold" and says where that is.
std::string steady_text(double capillary_number) {
  const Outcome outcome = steady(sphere(capillary_number), {}, {});
  return outcome.status == Status::steady ? "steady" : outcome.failure + " " + outcome.message;
}

bool fold_is_named(const std::vector<double> &distances_from_it, const std::vector<std::string> &texts,
                   double capillary_number) {
  bool right = true;
  for (std::size_t k = 0; k < texts.size(); ++k) {
    fmt::print("steady, eps = fold {:+.3f}: {}\n", distances_from_it[k], texts[k]);
    const bool named = texts[k].starts_with("fold ") &&
                       texts[k].find(fmt::format("{:.4f}", capillary_number)) != std::string::npos;
    right = right && (distances_from_it[k] > 0 ? named : texts[k] == "steady");
  }
  return right;
}

// t = factor/distance^exponent + offset at the last three of times at distances that fall by four: the offset, what lies
// on both sides of the passage, falls out of differences. The factor is that of the exponent 1/2.
struct PowerLaw {
  double exponent, factor, offset;
};
PowerLaw law_of(const std::vector<double> &times, double nearest) {
  const std::size_t last = times.size() - 1;
  const double near = times[last] - times[last - 1];
  const double far = times[last - 1] - times[last - 2];
  const double factor = 2 * near * std::sqrt(nearest);
  return {std::log(near / far) / std::log(4), factor, times[last] - factor / std::sqrt(nearest)};
}

void write_pore(const std::vector<double> &through, const std::vector<std::string> &texts,
                const std::string &directory) {
  Table pore("distance,status,x_g,max_stretch,v_g");
  for (std::size_t k = 0; k < through.size(); ++k) {
    std::istringstream text(texts[k]);
    std::string status, x_g, stretch, v_g;
    text >> status >> x_g >> stretch >> v_g;
    pore.add(fmt::format("{:.6f},{},{},{},{}", through[k], status, x_g, stretch, v_g));
    fmt::print("through the pore, eps = fold {:+.3f}: {} at x_g = {}, stretch {}\n", through[k], status, x_g,
               stretch);
  }
  pore.write(directory + "/pore.csv");
}

bool study(const std::string &directory, unsigned jobs) {
  const Ghost ghost = find_ghost();
  fmt::print(
      "fold at eps = {:.7f}, stretch {:.4f}; the stable state before it relaxes at {:.4f} sqrt(distance)\n",
      ghost.capillary_number, ghost.stretch, ghost.slowness);
  const double passage = 2 * std::numbers::pi / ghost.slowness; // over the distance's square root

  std::vector<double> at;
  for (int k = 0; k < distances; ++k)
    at.push_back(widest / std::pow(4, k));
  for (int k = 0; k < distances_below; ++k)
    at.push_back(-widest / std::pow(4, k));
  std::vector<TextTask> tasks;
  for (const double distance : at)
    tasks.push_back({fmt::format("tube {:.8f}", distance),
                     [=] { return tube_text(ghost.capillary_number + distance, distance < 0); }});
  const std::vector<double> through_the_pore{-widest, widest, 2 * widest, 4 * widest};
  for (const double distance : through_the_pore)
    tasks.push_back(
        {fmt::format("pore {:.8f}", distance), [=] { return pore_text(ghost.capillary_number + distance); }});
  for (const double distance : through_the_pore)
    tasks.push_back({fmt::format("steady {:.8f}", distance),
                     [=] { return steady_text(ghost.capillary_number + distance); }});
  const std::vector<std::string> texts = make_all(directory, jobs, tasks);

  Table marches("distance,status,time,end,predicted,max_stretch,volume_change,steady_stretch");
  std::string histories = "capillary_number,time,max_stretch\n";
  std::vector<double> times, ends;
  bool named = true, steady = true;
  for (std::size_t k = 0; k < at.size(); ++k) {
    std::istringstream text(texts[k]);
    std::string status, time, rest_of_line;
    double stretch = NAN, end = NAN, volume = NAN, state = NAN;
    text >> status >> time >> stretch >> end >> volume;
    std::getline(text, rest_of_line);
    histories.append(std::istreambuf_iterator<char>(text), {});
    if (at[k] > 0) {
      times.push_back(std::stod(time));
      ends.push_back(end);
      named = named && status == "unbounded" && std::abs(volume) < allowed_volume;
    } else {
      state = steady_record(ghost.capillary_number + at[k]).row.max_stretch;
      steady = steady && status == "rest" && std::abs(stretch / state - 1) < allowed_stretch;
    }
    marches.add(fmt::format("{:.9f},{},{},{:.3f},{:.4f},{:.6f},{:.2e},{:.6f}", at[k], status, time, end,
                            passage / std::sqrt(std::abs(at[k])), stretch, volume, state));
    fmt::print("eps = fold {:+.2e}: {} at t = {:.1f}, stretch {:.5f}, volume {:.0e}; {} at t = {}; steady "
               "state {:.5f}\n",
               at[k], status, end, stretch, volume, far_stretch, time, state);
  }
  marches.write(directory + "/marches.csv");
  write_atomically(directory + "/histories.csv", histories);
  const auto pore = texts.begin() + std::ssize(at);
  const auto without_marching = pore + std::ssize(through_the_pore);
  write_pore(through_the_pore, {pore, without_marching}, directory);
  const bool fold = fold_is_named(through_the_pore, {without_marching, texts.end()}, ghost.capillary_number);

  const double nearest = at[distances - 1];
  const PowerLaw three = law_of(times, nearest), four = law_of(ends, nearest);
  Table fit("exponent,factor,offset,exponent_to_3,offset_to_3,predicted_factor,fold,fold_stretch");
  fit.add(fmt::format("{:.6f},{:.6f},{:.4f},{:.6f},{:.4f},{:.6f},{:.8f},{:.5f}", -four.exponent, four.factor,
                      four.offset, -three.exponent, three.offset, passage, ghost.capillary_number,
                      ghost.stretch));
  fit.write(directory + "/fit.csv");
  fmt::print("time to a stretch of {}: like distance^-{:.4f}\n", far_stretch, three.exponent);
  const bool holds[] = {
      check(named, "every march above the fold is stopped as unbounded, its volume kept"),
      check(steady,
            fmt::format("every march below comes to rest at the steady state, its stretch within {:.0e}",
                        allowed_stretch)),
      check(fold,
            "`capsule steady` fails above the fold, says so and where it is, and finds the state below"),
      check(std::abs(four.exponent - 0.5) <= allowed_exponent,
            fmt::format("time until it is unbounded (a stretch of 4): like distance^-{:.4f}", four.exponent)),
      check(std::abs(four.factor / passage - 1) <= allowed_factor,
            fmt::format("by {:.3f}/sqrt(distance); the eigenvalue before the fold says {:.3f}", four.factor,
                        passage))};
  return std::ranges::all_of(holds, [](bool each) { return each; });
}

} // namespace

int main(int argc, char **argv) {
  return study_main(argc, argv, study);
}
