#pragma once
// The steady shape of a case without marching in time, from nothing or from a profile: branches
// (continuation.hpp) lead from a small stiff sphere to the case's capsule, one key after the other in a
// flow of some strength, the capillary number last, and the mesh is refined until two agree.
#include "motion/motion.hpp"
#include "steady/continuation.hpp"
#include <map>
#include <memory>
#include <optional>
#include <string>

namespace capsule {

// A number among the keys of a case, on the way from the value it has there to another; in steps that suit
// values of any magnitude, zero too.
class KeyPath {
public:
  KeyPath(std::string key, const Case &from, double to);
  bool needed() const { return from_ != to_; }
  double value(double part) const; // from `from` at 0 to `to` at 1
  Case at(double part) const;
  std::string text(double part) const; // "flow.capillary_number = 0.05"

private:
  std::string key_;
  Case start_;
  double from_, to_;
};

struct SteadyState {
  std::shared_ptr<SteadySystem> system; // that has taken the state's case
  Vector unknowns;
};

// A case's steady state on a first mesh; `from` is any shape of the same capsule near to it, or one that relaxes to it
// with equal viscosities. Throws NumericsFailure, of the kind "fold" when there is none because the branch of growing
// capillary numbers turns back and the membrane runs away behind the fold: the text says where. Any other turn is no
// statement about the case, and "unresolved".
SteadyState find_steady(const Case &physics, const std::optional<Profile> &from, const Control &control);

struct RefinedState {
  SteadyState state;
  std::map<std::string, double> error_estimate; // by the mesh before and the two pressure drops
  std::string warning;                          // when they are larger than asked for
};
// The same on finer and finer meshes, until the last two agree to the accuracy asked for, in the pressure drop
// and other integrals to a tenth of it; with a given mesh.membrane, on that mesh and on one of three quarters
// of its nodes.
RefinedState refine(const Case &physics, const SteadyState &state, const Control &control);

// At time 0 and x_g = 0.
struct SteadyRecord {
  SeriesRow row;
  Profile profile;
  std::map<std::string, double> rates; // growth_rate, oscillation_rate, growth_per_length
};
SteadyRecord record_steady(const SteadyState &state, double viscosity_ratio);

// The equations of a case with a node at each of these angles.
std::shared_ptr<SteadySystem> system_on_mesh(const Case &physics, const Vector &node_angle);
// A state near by, as a guess on so many nodes where its shape needs them.
SteadyState moved_to_mesh(const Case &physics, int nodes, const SteadyState &state);
// The state on such a mesh. Throws NumericsFailure("unresolved").
SteadyState on_mesh(const Case &physics, int nodes, const SteadyState &state);
// Unknowns, or changes of them, on another system's nodes; what follows the positions stays: speed, slack, and of a
// branch the parameter.
Vector moved_to(const SteadySystem &to, const SteadySystem &from, const Vector &unknowns);
int finer_mesh(int nodes);

// Thrown where the caller asks to stop.
struct Interrupted {};

// status: steady, or failed. Series and profiles of the outcome hold one entry. Nothing is saved on the way.
Outcome steady(const Case &physics, const std::optional<Profile> &from, const Control &control);

} // namespace capsule
