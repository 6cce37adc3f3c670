#pragma once
// The way from a state that is easily found to that of a case, one key after the other: branches (continuation.hpp), followed
// through folds, on meshes that get finer where they must.
#include "case/key_path.hpp"
#include "observe/outcome.hpp"
#include "steady/continuation.hpp"
#include "steady/mesh_change.hpp"
#include <algorithm>
#include <string>
#include <utility>

namespace capsule {

class Homotopy {
public:
  // `begin` is the state of `now`, which differs from the target in the keys to be varied.
  Homotopy(const Case &target, const Case &now, SteadyState begin)
      : target_(target), now_(now), state_(std::move(begin)) {}

  // Takes one key to a value. Throws NumericsFailure: "fold" where the branch turns for good and the membrane runs away behind
  // it, "softening" where the membrane's law softens; other kinds say nothing about the case. Throws what it asks of `control`.
  void vary(const std::string &key, double to, const Control &control);

  const SteadyState &state() const { return state_; }

  // The case that the last key varied to its end has led to.
  const Case &reached() const { return now_; }
  // Where the branch of the last key has turned for good.
  struct Fold {
    SteadyState state;
    double part = 0;
    Vector tangent;
  };
  const Fold &fold() const { return place_.fold; }

private:
  int most() const { return target_.mesh.membrane > 0 ? target_.mesh.membrane : most_nodes; }
  int next_mesh() const { return std::min(finer_mesh(static_cast<int>(state_.system->nodes())), most()); }
  bool can_refine() const { return state_.system->nodes() < most(); }
  void begin_path();
  void refine_at(const Case &input);
  bool follow(const KeyPath &path, const Control &control);

  // How far the branch of one key has been followed.
  struct Place {
    double part = 0;
    Vector direction; // in which it goes on
    Branch::Trend trend = Branch::Trend::grows;
    double first_step = 0.2;
    std::string turned_at; // the farthest fold, while the branch is behind it
    double farthest = 0, stretch_at_fold = 0;
    Fold fold; // the farthest one
  };

  Case target_, now_;
  SteadyState state_;
  Place place_;
};

} // namespace capsule
