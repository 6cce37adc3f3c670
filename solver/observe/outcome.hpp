#pragma once
// How a run ends, whichever method computes it: a march in time, a steady state, a branch of them. And how its caller
// follows and interrupts it.
#include "flow/recycled_solver.hpp"
#include "observe/records.hpp"
#include "observe/step_memory.hpp"
#include <array>
#include <cstddef>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace capsule {

// Meridional stretch beyond which a membrane is said to run away, in a march and on a branch of steady states.
constexpr double runaway_stretch = 4;

enum class Status { reached, steady, unbounded, burst, failed, interrupted };
// The same as summary.json and expectations have it; an interrupted run has no summary.
constexpr std::array status_words{"reached", "steady", "unbounded", "burst", "failed"};
constexpr const char *word_of(Status status) {
  const auto place = static_cast<std::size_t>(status);
  return place < status_words.size() ? status_words[place] : "interrupted";
}

// Everything that a march needs to go on.
struct Checkpoint {
  double time = 0;
  Vector position; // empty: not started
  long steps = 0;
  std::vector<SeriesRow> series;
  std::vector<Profile> profiles;
  std::vector<CapsuleRecord> followers = {}; // of the capsules behind the leading one, at the same times
  StepMemory memory = {};                    // of the integrator; empty where it has not begun
  RecycledFlow recycled = {};                // what the flow has left behind
  std::size_t next_x_g = 0, next_time = 0;   // which of the march's stations come next
  double checked = 0;                        // time at the last look whether the steps add enough to it
  std::vector<Checkpoint> companion = {};    // of a march that has reached its end: the coarser one beside it
};

// Of the key itself, in the error estimates of a fold.
inline std::optional<double> error_of_place(const std::map<std::string, double> &errors,
                                            const std::string &key) {
  const auto found = errors.find(key);
  return found == errors.end() ? std::nullopt : std::optional(found->second);
}

// A steady state on a branch.
struct BranchRow {
  double parameter = 0;
  SeriesRow row;
  double growth_rate = 0; // of the least stable small motion
  // Only of a fold: the key or quantity -> bound of the absolute error by estimate. Empty where nothing tells it.
  std::map<std::string, double> error_estimate = {};
};

// A fold that is followed along a second key: where it is, and the key's value there.
struct FoldRow {
  double second = 0;
  BranchRow fold;
};

struct Outcome {
  Status status = Status::failed;
  std::string failure; // NumericsFailure::kind, empty when nothing failed
  std::string message; // why it failed, where (t, x_g), what to try; empty otherwise
  Checkpoint last;     // all that was computed
  // Quantity -> bound of the absolute error by estimate: "v_g" of the last row, "v_g@x_g" or "v_g@time" of all rows at
  // the same x_g or time
  std::map<std::string, double> error_estimate;
  // Other quantities of summary.json.
  std::map<std::string, double> further = {};
  int membrane_nodes = 0;                   // 0: those of choose_resolution
  std::vector<int> nodes_of_followers = {}; // empty: those of choose_resolution
  // Only of a branch: the key that varies, its points and its folds.
  std::string along = {};
  std::vector<BranchRow> branch = {};
  std::vector<BranchRow> folds = {};
  // Of a branch whose last fold is followed: the second key, and the fold along it.
  std::string fold_along = {};
  std::vector<FoldRow> fold_curve = {};
};

// How the caller of a run follows it and interrupts it.
struct Control {
  std::function<void(const SeriesRow &, long steps)> progress; // after each recorded row
  std::function<bool()> interrupted;                           // asked after each step
  std::function<bool()> wants_checkpoint;                      // asked after each step
  std::function<void(const Checkpoint &)> save;                // where either is answered by yes
  std::function<void(double work)> spend; // before each part of a search for a steady state
};

// Thrown where the caller has asked to stop.
struct Interrupted {};
inline void throw_if_interrupted(const Control &control) {
  if (control.interrupted && control.interrupted())
    throw Interrupted{};
}

// A march that begins the search for a steady state: to just behind the mouth, or far into the tube, where a capsule may
// come to rest later.
enum class MarchLength { into_tube, far_into_tube };

// Thrown by `spend` where a search has done the work that it may cost.
struct Exhausted {};
// Asks for a number of linearisations of a steady state on so many nodes. The work is counted in those on 48 nodes, whose
// time grows with the square of the nodes.
inline void spend(const Control &control, double linearisations, double nodes) {
  throw_if_interrupted(control);
  if (control.spend)
    control.spend(linearisations * (nodes / 48) * (nodes / 48));
}

} // namespace capsule
