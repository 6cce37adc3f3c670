#include "motion/motion.hpp"
#include "case/case.hpp"
#include "flow/wall.hpp"
#include "geometry/pore.hpp"
#include "motion/error_estimate.hpp"
#include "motion/march.hpp"
#include "observe/transit.hpp"
#include "scene/resolution.hpp"
#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <string>
#include <utility>

namespace capsule {
namespace {

// Points of the wall. Panels are whole: with fewer points asked for there may be as many.
Eigen::Index wall_size(const Case &input) {
  const auto pore = make_pore(input.pore);
  return pore ? wall_panels(*pore, choose_resolution(input).flow).points.size() : 0;
}

// The same motion, a little coarser: each kind of error is then two to four times as large. Much coarser ones tell
// less: where convergence is exponential their errors are 10 to 100 times as large, and near an instability they go
// another way.
Case companion(const Case &input) {
  Case coarse = input;
  for (Case &follower : coarse.followers)
    follower = companion(follower);
  const Resolution chosen = choose_resolution(input);
  coarse.mesh.membrane = 9 * chosen.membrane_nodes / 10;
  coarse.mesh.wall = chosen.wall_points;
  do
    coarse.mesh.wall = 9 * coarse.mesh.wall / 10;
  while (wall_size(coarse) == wall_size(input) && 2 * coarse.mesh.wall > chosen.wall_points);
  coarse.time.step = input.time.step / 0.9; // as stable on its nodes as the fine one's
  coarse.time.tolerance = 3.5 * chosen.time_tolerance;
  coarse.output.profiles_at_x_g.clear();
  coarse.output.profiles_at_time.clear();
  coarse.output.profiles_every.reset();
  return coarse;
}

// A march that has reached its end is not repeated.
Outcome march_to_end(const Case &input, const Checkpoint &from, const Control &control,
                     double roughness_limit = wrinkle_roughness) {
  if (from.companion.empty())
    return march_once(input, from, control, Role::main, roughness_limit);
  Outcome outcome;
  outcome.status = Status::reached;
  outcome.last = from;
  outcome.last.companion.clear();
  return outcome;
}

// Meshes on which a march is tried, in nodes of the chosen one.
constexpr std::array meshes{1.0, 1.5, 3.0};

// Failures that may be the mesh's own. On the chosen mesh many kinds may be; on a finer one they are believed. Where
// steps get ever shorter the finest is tried as well: some marches arrive there (methods.md).
bool may_pass_on_finer_mesh(const Outcome &outcome, double mesh) {
  if (outcome.status != Status::failed || mesh == meshes.back())
    return false;
  const bool steps_get_short =
      outcome.failure == failure_kind::unresolved || outcome.failure == failure_kind::step;
  return steps_get_short ||
         (mesh == meshes.front() &&
          (outcome.failure == failure_kind::wrinkled || outcome.failure == failure_kind::touching ||
           outcome.failure == failure_kind::softening || outcome.failure == failure_kind::volume));
}

// The input on a mesh so many times as fine as the chosen one, with shorter steps if it is finer.
Case on_mesh(const Case &input, double mesh) {
  Case finer = input;
  if (mesh == meshes.front())
    return finer;
  const auto refine = [mesh](Case &capsule) {
    capsule.mesh.membrane = static_cast<int>(mesh * choose_resolution(capsule).membrane_nodes);
  };
  refine(finer);
  for (Case &follower : finer.followers)
    refine(follower);
  if (input.time.tolerance == 0)
    finer.time.tolerance = choose_resolution(input).time_tolerance / 30;
  return finer;
}

Eigen::Index nodes_of_all(const Case &input) {
  Eigen::Index nodes = choose_resolution(input).membrane_nodes;
  for (const Case &follower : input.followers)
    nodes += choose_resolution(follower).membrane_nodes;
  return nodes;
}

// The march that is asked for, and the input that it ended with. What fails on a mesh that was chosen from the accuracy
// may fail through that mesh, and buckles amplify errors: then the march begins again on a finer mesh and with
// shorter steps.
struct MainMarch {
  Case input;
  Outcome outcome;
};
MainMarch main_march(const Case &input, const Checkpoint &from, const Control &control) {
  const bool can_refine = input.mesh.membrane == 0 && input.time.scheme == Scheme::bdf;
  if (!can_refine)
    return {input, march_to_end(input, from, control)};
  // A checkpoint goes on on its own mesh.
  const auto has_checkpoint = [&](double mesh) {
    return from.position.size() == 2 * nodes_of_all(on_mesh(input, mesh));
  };
  const auto *mesh = std::ranges::find_if(meshes, has_checkpoint);
  Checkpoint start = from;
  if (mesh == meshes.end())
    mesh = meshes.begin();
  for (;; ++mesh) {
    Case marched = on_mesh(input, *mesh);
    const bool is_finer = mesh != meshes.begin();
    Outcome outcome =
        march_to_end(marched, start, control,
                     is_finer ? wrinkle_roughness : wrinkle_roughness_on_chosen_nodes(input.accuracy));
    if (may_pass_on_finer_mesh(outcome, *mesh)) {
      start = {};
      continue;
    }
    if (is_finer) {
      outcome.membrane_nodes = marched.mesh.membrane;
      for (const Case &follower : marched.followers)
        outcome.nodes_of_followers.push_back(follower.mesh.membrane);
    }
    return {std::move(marched), std::move(outcome)};
  }
}

void add_remark(std::string &message, const std::string &remark) {
  message += (message.empty() ? "" : "; ") + remark;
}

} // namespace

Outcome march(const Case &input, const Checkpoint &from, const Control &control) {
  auto [marched, outcome] = main_march(input, from, control);
  const bool bursts = outcome.status == Status::burst;
  if (outcome.status == Status::reached)
    outcome.message = remark_on_transit(input, outcome.last.series);
  if ((outcome.status != Status::reached && !bursts) || input.numerics == Numerics::paper)
    return outcome;
  Control quiet;
  quiet.interrupted = control.interrupted;
  quiet.wants_checkpoint = control.wants_checkpoint;
  // Of the end a checkpoint has rows and profiles alone: a march that tells more is repeated from before its end.
  if (control.save && !bursts && outcome.further.empty())
    quiet.save = [&, &finished = outcome](const Checkpoint &coarse) {
      Checkpoint both = finished.last;
      both.companion = {coarse};
      control.save(both);
    };
  const Checkpoint start = from.companion.empty() ? Checkpoint{} : from.companion.front();
  const Outcome coarse = march_once(companion(marched), start, quiet, Role::companion);
  if (coarse.status == Status::interrupted)
    outcome.status = Status::interrupted;
  else if (coarse.status == Status::reached || coarse.status == Status::burst) {
    const bool by_x_g = input.until.by_place();
    outcome.error_estimate =
        estimate_errors(outcome.last.series, coarse.last.series, by_x_g, input.time.scheme);
    if (outcome.error_estimate.empty())
      add_remark(outcome.message,
                 fmt::format("no error estimates along the way, because no row of the coarse "
                             "companion is at the same {} as one of this march",
                             by_x_g ? "x_g" : "time"));
    else
      add_errors_of_followers(outcome.last, coarse.last, by_x_g, input.time.scheme, outcome.error_estimate);
    add_errors_of_transit(input, outcome.last.series, coarse.last.series, outcome.error_estimate);
    if ((bursts && coarse.status == Status::burst) || (!bursts && input.until.last_x_g))
      add_errors_of_the_end(outcome.last, coarse.last, input.time.scheme, outcome.error_estimate);
  } else
    add_remark(outcome.message, "no error estimate, because the coarse companion failed: " + coarse.message);
  return outcome;
}

} // namespace capsule
