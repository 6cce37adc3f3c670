#include "steady/steady_state.hpp"
#include "base/failure.hpp"
#include "case/key.hpp"
#include "geometry/node_density.hpp"
#include "geometry/quadrature.hpp"
#include "steady/growth_rates.hpp"
#include <algorithm>
#include <cmath>
#include <complex>
#include <fmt/format.h>
#include <limits>
#include <numbers>
#include <utility>

namespace capsule {
namespace {

constexpr double position_tolerance = 1e-9;
constexpr double mesh_growth = 1.35;
constexpr int first_nodes = 48;
constexpr int most_nodes = 420;
// Where no finer mesh leads on behind a fold, so much tells of that, too, if it has grown since.
constexpr double large_stretch = 2;
constexpr double growth_behind_fold = 1.03;

constexpr const char *size_key = "capsule.radius";
constexpr const char *shape_key = "capsule.aspect_ratio";
constexpr const char *flow_key = "flow.capillary_number";
constexpr const char *bending_key = "membrane.bending_ratio";

// Where the way begins, unless the case lies before it.
constexpr double weak_flow = 5e-3;
constexpr double small_radius = 0.6;
constexpr double stiff_bending = 2e-2; // a shell that does not buckle

double &number(const std::string &key, Case &physics) {
  return std::get<Member<double>>(find_key(key)->field).in(physics);
}
double number(const std::string &key, const Case &physics) {
  return std::get<Member<double>>(find_key(key)->field).of(physics);
}

void listen(const Control &control) {
  if (control.interrupted && control.interrupted())
    throw Interrupted{};
}

Resolution resolution_of(const Case &physics, int nodes) {
  Case on_nodes = physics;
  on_nodes.mesh.membrane = nodes;
  Resolution resolution = choose_resolution(on_nodes);
  // Newton's method needs a residual that is smooth where a panel becomes a near one.
  resolution.flow.near_tolerance = std::min(1e-9, resolution.flow.near_tolerance);
  resolution.flow.wall_panel *= std::min(1.0, 80.0 / nodes);
  return resolution;
}

// The first mesh, for shapes with no folds yet.
std::shared_ptr<SteadySystem> first_system(const Case &physics) {
  const int nodes = physics.mesh.membrane > 0 ? std::min(first_nodes, physics.mesh.membrane) : first_nodes;
  return system_on_mesh(physics, spectral_basis(nodes).nodes);
}

} // namespace

KeyPath::KeyPath(std::string key, const Case &from, double to)
    : key_(std::move(key)), start_(from), from_(number(key_, from)), to_(to) {}

double KeyPath::value(double part) const {
  if (part == 0 || part == 1)
    return part == 0 ? from_ : to_;
  if (from_ < 0 || to_ < 0)
    return from_ + part * (to_ - from_);
  constexpr double power = 8;
  const double root = (1 - part) * std::pow(from_, 1 / power) + part * std::pow(to_, 1 / power);
  return std::pow(std::max(root, 0.0), power);
}

Case KeyPath::at(double part) const {
  Case physics = start_;
  number(key_, physics) = value(part);
  return physics;
}

std::string KeyPath::text(double part) const {
  return fmt::format("{} = {:.6g}", key_, value(part));
}

Vector moved_to(const SteadySystem &to, const SteadySystem &from, const Vector &unknowns) {
  const Eigen::Index others = unknowns.size() - 2 * from.nodes();
  Vector moved(2 * to.nodes() + others);
  moved << at_angles(to.membrane().node_angle, from.membrane(), unknowns.head(2 * from.nodes())),
      unknowns.tail(others);
  return moved;
}

int finer_mesh(int nodes) {
  return static_cast<int>(std::ceil(mesh_growth * nodes));
}

std::shared_ptr<SteadySystem> system_on_mesh(const Case &physics, const Vector &node_angle) {
  return std::make_shared<SteadySystem>(physics, resolution_of(physics, static_cast<int>(node_angle.size())),
                                        node_angle);
}

namespace {

// With so many nodes where the shape of a state near by needs them.
std::shared_ptr<SteadySystem> system_on_mesh(const Case &physics, int nodes, const SteadyState &state) {
  constexpr double most_turning = 0.5; // of the tangent in a panel: in a fold kernels vary with it
  const Membrane &membrane = state.system->membrane();
  const Vector position = state.unknowns.head(2 * state.system->nodes());
  const MeridianBasis basis = spectral_basis(nodes);
  const Vector angles = suitable_angles(membrane, position, basis);
  Resolution resolution = resolution_of(physics, nodes);
  resolution.flow.membrane_edges =
      halved_edges(basis, at_angles(angles, membrane, position),
                   even_membrane_edges(basis, resolution.flow.membrane_panel), most_turning);
  return std::make_shared<SteadySystem>(physics, resolution, angles);
}

} // namespace

SteadyState moved_to_mesh(const Case &physics, int nodes, const SteadyState &state) {
  const auto system = system_on_mesh(physics, nodes, state);
  return {system, moved_to(*system, *state.system, state.unknowns)};
}

namespace {

SteadyState straight_to_mesh(const Case &physics, int nodes, const SteadyState &state) {
  SteadyState moved = moved_to_mesh(physics, nodes, state);
  moved.unknowns = solve_steady(*moved.system, moved.unknowns, position_tolerance);
  return moved;
}

// Along a branch to its end on the same mesh.
void follow(const KeyPath &path, SteadyState &state) {
  constexpr Branch::Steps steps{.first = 0.1, .largest = 0.5, .tolerance = 1e-6};
  constexpr int most_steps = 60;
  Branch branch(
      *state.system, [&](double part) { return path.at(part); }, {state.unknowns, 0},
      Branch::upwards(*state.system), steps);
  for (int step = 0; branch.point().parameter < 1; ++step) {
    if (step == most_steps || branch.point().parameter < 0)
      throw NumericsFailure("unresolved", fmt::format("no way to {}", path.text(1)),
                            "try a finer mesh.membrane");
    branch.advance();
  }
  state.unknowns = branch.at_parameter(1).unknowns;
}

} // namespace

// A shape with folds that its mesh hardly resolves is no good guess on another: then the way leads over a
// stiffer membrane, whose folds are wider.
SteadyState on_mesh(const Case &physics, int nodes, const SteadyState &state) {
  try {
    return straight_to_mesh(physics, nodes, state);
  } catch (const NumericsFailure &) {
    const double bending = physics.membrane.bending_ratio;
    for (const double factor : {4, 16, 64})
      try {
        const KeyPath stiffer(bending_key, physics, factor * std::max(bending, 1e-6));
        SteadyState moved{std::make_shared<SteadySystem>(*state.system), state.unknowns};
        follow(stiffer, moved);
        moved = straight_to_mesh(stiffer.at(1), nodes, moved);
        follow(KeyPath(bending_key, stiffer.at(1), bending), moved);
        return moved;
      } catch (const NumericsFailure &) {
        continue;
      }
    throw;
  }
}

namespace {

// The way from a small stiff sphere in a weak flow to a case's capsule.
class Way {
public:
  Way(const Case &physics, const Control &control) : target_(physics), now_(physics), control_(control) {
    number(flow_key, now_) = std::min(weak_flow, physics.flow.capillary_number);
    number(shape_key, now_) = 1;
    number(bending_key, now_) = std::max(stiff_bending, physics.membrane.bending_ratio);
    if (physics.pore.shape != PoreShape::none)
      number(size_key, now_) = std::min(small_radius, physics.capsule.radius);
    state_.system = first_system(now_);
    state_.unknowns = solve_steady(*state_.system, state_.system->undeformed(), position_tolerance);
  }

  void go(const char *key, double to) {
    const KeyPath leg(key, now_, to);
    const SteadyState begin = state_;
    set_out();
    bool arrived = !leg.needed();
    while (!arrived) {
      try {
        arrived = follow(leg);
      } catch (const NumericsFailure &failure) {
        if (failure.kind == "fold" || !can_refine())
          throw;
      }
      if (place_.part < 0) { // the fold that led here was the coarse mesh's own
        state_ = moved_to_mesh(leg.at(0), next_mesh(), begin);
        set_out();
      } else if (!arrived)
        refine_at(leg.at(place_.part));
    }
    now_ = leg.at(1);
  }

  const SteadyState &state() const { return state_; }

private:
  int most() const { return target_.mesh.membrane > 0 ? target_.mesh.membrane : most_nodes; }
  int next_mesh() const { return std::min(finer_mesh(static_cast<int>(state_.system->nodes())), most()); }
  bool can_refine() const { return state_.system->nodes() < most(); }

  void set_out() {
    place_ = Place{};
    place_.direction = Branch::upwards(*state_.system);
  }

  // To a guess on a finer mesh, from which the branch goes on as it did.
  void refine_at(const Case &physics) {
    const SteadyState coarse = state_;
    state_ = moved_to_mesh(physics, next_mesh(), coarse);
    place_.direction = moved_to(*state_.system, *coarse.system, place_.direction);
  }

  // Follows the branch, through folds if it comes to that, to its end (true) or to where a finer mesh is called for.
  // What was reached stays in state_ and place_ when it fails.
  bool follow(const KeyPath &leg) {
    const Branch::Steps steps{.first = place_.first_step, .largest = 0.7, .tolerance = 1e-6};
    constexpr int most_steps = 200;
    constexpr double first_part = -1; // as far as a branch that has turned is followed
    Branch branch(
        *state_.system, [&](double part) { return leg.at(part); }, {state_.unknowns, place_.part},
        place_.direction, steps);
    for (int step = 0; step < most_steps; ++step) {
      listen(control_);
      state_.unknowns = branch.point().unknowns;
      place_.part = branch.point().parameter;
      place_.direction = branch.tangent();
      place_.first_step = branch.plain_step();
      try {
        branch.advance();
      } catch (const NumericsFailure &failure) {
        if (!place_.turned_at.empty() && !can_refine())
          break; // behind the fold, as far as this mesh goes
        throw NumericsFailure(
            failure.kind, fmt::format("{} beyond {}", failure.what(), leg.text(place_.part)), failure.advice);
      }
      if (branch.wants_a_finer_mesh() && can_refine())
        return false;
      const BranchPoint &now = branch.point();
      if (branch.turned() && now.parameter < branch.point_before().parameter) {
        const BranchPoint fold = branch.fold();
        if (fold.parameter >= 1) { // the step has gone past the end of the leg, and back
          state_.unknowns = branch.before_fold(fold, 1).unknowns;
          return true;
        }
        if (place_.turned_at.empty() || fold.parameter > place_.farthest)
          place_.farthest = fold.parameter;
        place_.turned_at = leg.text(place_.farthest);
        place_.stretch_at_fold = state_.system->largest_stretch(fold.unknowns);
      }
      if (now.parameter > place_.farthest) // it has come back
        place_.turned_at.clear();
      if (now.parameter < first_part ||
          (!place_.turned_at.empty() && state_.system->largest_stretch(now.unknowns) > runaway_stretch))
        break;
      if (now.parameter >= 1) {
        state_.unknowns = branch.at_parameter(1).unknowns;
        return true;
      }
    }
    if (place_.turned_at.empty())
      throw NumericsFailure("unresolved",
                            fmt::format("the branch does not end beyond {}", leg.text(place_.part)),
                            "try a finer mesh.membrane or a larger membrane.bending_ratio");
    const double stretch = state_.system->largest_stretch(branch.point().unknowns);
    if (stretch < large_stretch || stretch < growth_behind_fold * place_.stretch_at_fold)
      throw NumericsFailure(
          "unresolved", fmt::format("the branch turns at {} and is not seen to come back", place_.turned_at),
          "begin with a profile of a march (--from)");
    throw NumericsFailure("fold", fmt::format("fold at {}", place_.turned_at), "stay on the near side of it");
  }

  // On a leg: the part of it, where the branch goes on and how far at first, and the farthest fold, if any; the
  // stretch at the last one.
  struct Place {
    double part = 0;
    Vector direction;
    double first_step = 0.2;
    std::string turned_at;
    double farthest = 0, stretch_at_fold = 0;
  };

  Case target_, now_;
  const Control &control_;
  SteadyState state_;
  Place place_;
};

// Size, shape and bending stiffness in a flow of given strength: where it is not too weak, a shell gets
// thin without buckling.
Way by_way_of(double strength, const Case &physics, const Control &control) {
  Way way(physics, control);
  way.go(flow_key, strength);
  for (const char *key : {size_key, shape_key, bending_key})
    way.go(key, number(key, physics));
  return way;
}

// Values at ascending `at` from values f at ascending S, by the cubic through the four nearest points.
Vector interpolated(const Vector &S, const Vector &f, const Vector &at) {
  Vector result(at.size());
  for (Eigen::Index i = 0; i < at.size(); ++i) {
    const Eigen::Index above = std::upper_bound(S.begin(), S.end(), at[i]) - S.begin();
    const Eigen::Index first = std::clamp<Eigen::Index>(above - 2, 0, S.size() - 4);
    const Vector four = S.segment(first, 4);
    result[i] = (lagrange_matrix(four, Vector::Constant(1, at[i])) * f.segment(first, 4)).value();
  }
  return result;
}

// A profile's shape on the nodes, point by point of the undeformed membrane.
Vector nodes_on(const Profile &profile, const Membrane &membrane) {
  const Eigen::Index n = membrane.basis.size();
  if (profile.S.size() < 4)
    throw InputError("error: a profile of at least four points is needed to begin with\n");
  // Undeformed arc length of the nodes, by chords much shorter than the distance of the nodes.
  const Vector zeta = Vector::LinSpaced(64 * n + 1, 0, std::numbers::pi);
  const Vector x = membrane.basis.even(zeta, 0) * membrane.reference.head(n);
  const Vector r = membrane.basis.odd(zeta, 0) * membrane.reference.tail(n);
  Vector arc = Vector::Zero(zeta.size());
  for (Eigen::Index k = 1; k < zeta.size(); ++k)
    arc[k] = arc[k - 1] + std::hypot(x[k] - x[k - 1], r[k] - r[k - 1]);
  const Vector S = interpolated(zeta, arc, membrane.basis.nodes) *
                   ((profile.S[profile.S.size() - 1] - profile.S[0]) / arc[zeta.size() - 1]);
  Vector unknowns = Vector::Zero(2 * n + 2);
  unknowns.head(n) = interpolated(profile.S, profile.x, S).array() - profile.x_g;
  unknowns.segment(n, n) = interpolated(profile.S, profile.r, S);
  unknowns[2 * n] = profile.velocity_x.mean();
  return unknowns;
}

// From a shape that is too far off for Newton's method, by the way that it takes itself with equal viscosities: implicit
// steps in time, which get longer as the motion dies away, until they are Newton's.
Vector relaxed(SteadySystem &system, Vector shape, const Control &control) {
  constexpr int most_steps = 100;
  constexpr double first_step = 0.1, shortest_step = 1e-5, long_step = 100;
  constexpr double intended = 0.2, too_much = 0.6; // of the motion, other than by its linearisation
  const Eigen::Index n2 = 2 * system.nodes();
  shape.head(n2 / 2).array() -= system.residual(shape)[n2]; // its centre to where the equations want it
  system.fit_tube(shape);
  SteadySystem::Linearisation linear = system.linearise(shape);
  double step = first_step;
  for (int k = 0; k < most_steps && step > shortest_step; ++k) {
    listen(control);
    Matrix implicit = linear.jacobian;
    implicit.diagonal().head(n2).array() -= 1 / step;
    const Vector change = implicit.partialPivLu().solve(-linear.residual);
    double error = std::numeric_limits<double>::infinity();
    std::optional<SteadySystem::Linearisation> next;
    if (system.admissible_step(shape, change) == 1)
      try {
        system.fit_tube(shape + change);
        next = system.linearise(shape + change);
        error = (next->residual - change / step).head(n2).cwiseAbs().maxCoeff() /
                linear.residual.head(n2).cwiseAbs().maxCoeff();
      } catch (const NumericsFailure &) { // no capsule: a step that is too long
      }
    if (error < too_much) {
      shape += change;
      linear = std::move(*next);
      if (step > long_step)
        return shape;
    }
    step *= std::clamp(std::sqrt(intended / error), 0.25, 3.0);
  }
  throw NumericsFailure("unresolved", "the profile to begin with does not come to rest in the tube",
                        "leave --from away, or begin with a profile of a later x_g");
}

// On as many nodes as the profile may have been computed with, where its shape needs them.
SteadyState near_profile(const Case &physics, const Profile &profile, const Control &control) {
  const int nodes = std::clamp(static_cast<int>(profile.S.size() / 4), first_nodes, most_nodes);
  const auto drawn = [&](std::shared_ptr<SteadySystem> system) -> SteadyState {
    const Vector unknowns = nodes_on(profile, system->membrane());
    return {std::move(system), unknowns};
  };
  SteadyState state =
      drawn(system_on_mesh(physics, nodes, drawn(system_on_mesh(physics, spectral_basis(nodes).nodes))));
  try {
    state.unknowns = solve_steady(*state.system, state.unknowns, position_tolerance);
  } catch (const NumericsFailure &) {
    state.unknowns =
        solve_steady(*state.system, relaxed(*state.system, state.unknowns, control), position_tolerance);
  }
  return state;
}

// Errors from a mesh and a coarser one: what they differ by, and the quadrature's error, which they may have in
// common and of which the two pressure drops tell.
std::map<std::string, double> errors_of(const SeriesRow &fine, const SeriesRow &coarse) {
  const double quadrature = std::abs(fine.pressure_drop - fine.pressure_drop_reciprocal);
  const double relative = quadrature / std::max(std::abs(fine.pressure_drop), 1.0);
  const auto error = [&](double SeriesRow::*quantity, double common) {
    return std::abs(fine.*quantity - coarse.*quantity) + common;
  };
  return {{"v_g", error(&SeriesRow::v_g, relative)},
          {"pressure_drop", error(&SeriesRow::pressure_drop, quadrature)},
          {"max_stretch", error(&SeriesRow::max_stretch, relative)},
          {"front_stretch", error(&SeriesRow::front_stretch, relative)},
          {"min_film", error(&SeriesRow::min_film, relative)},
          {"length", error(&SeriesRow::length, relative)},
          {"deformation", error(&SeriesRow::deformation, relative)},
          {"volume_change", std::abs(fine.volume_change)}};
}

// Whether two meshes agree: in what all of the membrane makes to a tenth of the accuracy; the stretches, which
// are local, to the accuracy itself. The finer mesh is closer to the truth by an order or more.
bool agree(const SeriesRow &a, const SeriesRow &b, double accuracy) {
  const auto near = [&](double SeriesRow::*quantity, double scale, double share) {
    return std::abs(a.*quantity - b.*quantity) <= share * accuracy * scale;
  };
  return near(&SeriesRow::v_g, 1, 0.1) && near(&SeriesRow::pressure_drop, std::abs(a.pressure_drop), 0.1) &&
         near(&SeriesRow::length, a.length, 0.1) && near(&SeriesRow::deformation, 1, 0.1) &&
         near(&SeriesRow::max_stretch, a.max_stretch, 1) &&
         near(&SeriesRow::front_stretch, a.front_stretch, 1);
}

std::string poorly_resolved(int nodes) {
  return fmt::format("meshes up to {} nodes differ by more than the accuracy asked for; a larger "
                     "membrane.bending_ratio has smoother shapes",
                     nodes);
}

// What a state looks like with its centre at x = 0.
struct Portrait {
  SeriesRow row;
  Profile profile;
};
Portrait portray(const SteadyState &state) {
  const SteadySystem &system = *state.system;
  const Gauge gauge(system.scene(), system.membrane());
  Vector position = state.unknowns.head(2 * system.nodes());
  position.head(system.nodes()).array() -= gauge.centre(position);
  const FlowState flow = system.flow(position);
  Portrait portrait{gauge.row(0, position, flow.velocity), gauge.profile(0, position, flow.velocity)};
  portrait.row.x_g = 0; // what rounding leaves of it
  portrait.profile.x_g = 0;
  portrait.row.pressure_drop = flow.pressure_drop;
  portrait.row.pressure_drop_reciprocal = flow.pressure_drop_reciprocal;
  return portrait;
}

} // namespace

SteadyState find_steady(const Case &physics, const std::optional<Profile> &from, const Control &control) {
  if (from)
    return near_profile(physics, *from, control);
  std::optional<NumericsFailure> first;
  const double flow = physics.flow.capillary_number;
  const double weakest = physics.flow.type == FlowType::extension ? 0 : 0.03; // only a tube squeezes
  for (const double strength : {std::clamp(flow, weakest, 0.06), 0.02, 0.12}) {
    bool stronger = false; // only the flow is left to grow
    try {
      Way way = by_way_of(strength, physics, control);
      stronger = flow > strength;
      way.go(flow_key, flow);
      return way.state();
    } catch (const NumericsFailure &failure) {
      if (stronger && failure.kind == "fold")
        throw NumericsFailure("fold", fmt::format("no steady state: {}", failure.what()), failure.advice);
      if (!first)
        first = failure;
    }
  }
  throw NumericsFailure(first->kind == "fold" ? "unresolved" : first->kind,
                        fmt::format("no way found from a small stiff sphere: {}", first->what()),
                        first->kind == "fold" ? "try a larger membrane.bending_ratio" : first->advice);
}

RefinedState refine(const Case &physics, const SteadyState &state, const Control &control) {
  const bool given = physics.mesh.membrane > 0;
  RefinedState refined{given ? on_mesh(physics, physics.mesh.membrane, state) : state, {}, ""};
  auto nodes = static_cast<int>(refined.state.system->nodes());
  SeriesRow row = portray(refined.state).row;
  if (given || finer_mesh(nodes) > most_nodes) { // the finest, of which a coarser one tells the error
    const SeriesRow coarse = portray(on_mesh(physics, std::max(3, 3 * nodes / 4), refined.state)).row;
    refined.error_estimate = errors_of(row, coarse);
    if (!given && !agree(row, coarse, physics.accuracy))
      refined.warning = poorly_resolved(nodes);
    return refined;
  }
  for (;;) {
    listen(control);
    nodes = finer_mesh(nodes);
    refined.state = on_mesh(physics, nodes, refined.state);
    const SeriesRow before = row;
    row = portray(refined.state).row;
    refined.error_estimate = errors_of(row, before);
    if (agree(row, before, physics.accuracy))
      return refined;
    if (finer_mesh(nodes) > most_nodes) {
      refined.warning = poorly_resolved(nodes);
      return refined;
    }
  }
}

SteadyRecord record_steady(const SteadyState &state, double viscosity_ratio) {
  const SteadySystem &system = *state.system;
  Portrait portrait = portray(state);
  SteadyRecord record{portrait.row, std::move(portrait.profile), {}};
  const std::complex<double> slowest = growth_rates(system, state.unknowns, viscosity_ratio)[0];
  record.rates = {{"growth_rate", slowest.real()}, {"oscillation_rate", std::abs(slowest.imag())}};
  if (system.scene().flow.type == FlowType::pore)
    record.rates["growth_per_length"] = slowest.real() / record.row.v_g;
  return record;
}

Outcome steady(const Case &physics, const std::optional<Profile> &from, const Control &control) {
  Outcome outcome;
  try {
    const RefinedState refined = refine(physics, find_steady(physics, from, control), control);
    const SteadyRecord record = record_steady(refined.state, physics.flow.viscosity_ratio);
    outcome.status = Status::steady;
    outcome.message = refined.warning;
    if (record.rates.at("growth_rate") > 0)
      outcome.message += fmt::format("{}this steady state is unstable", outcome.message.empty() ? "" : "; ");
    outcome.error_estimate = refined.error_estimate;
    outcome.further = record.rates;
    outcome.membrane_nodes = static_cast<int>(refined.state.system->nodes());
    outcome.last.series = {record.row};
    outcome.last.profiles = {record.profile};
  } catch (const NumericsFailure &failure) {
    outcome.status = Status::failed;
    outcome.failure = failure.kind;
    outcome.message = fmt::format("{}; {}", failure.what(), failure.advice);
  } catch (const Interrupted &) {
    outcome.status = Status::interrupted;
  }
  return outcome;
}

} // namespace capsule
