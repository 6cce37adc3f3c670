#pragma once
// The wall on joined panels (joined_panels.hpp), as a march feels it. Throws nothing.
#include "flow/joined_panels.hpp"
#include "flow/wall.hpp"
#include <memory>
#include <vector>

namespace capsule {

// Keeps the compressed walls of the last two places: a march asks for some hundred flows before its capsule has left one,
// and may come back to the one before, when a step is tried again or the shape hovers between two.
class CompressedWall {
public:
  explicit CompressedWall(Wall whole) : whole_(std::make_shared<const Wall>(std::move(whole))) {}
  const Wall &whole() const { return *whole_; }
  const std::shared_ptr<const Wall> &shared_whole() const { return whole_; }
  // For membranes in this position. Which wall that is depends on the position alone.
  std::shared_ptr<const Wall> felt_by(const MembraneMesh &mesh, const Vector &position) const;

private:
  std::shared_ptr<const Wall> whole_;
  struct Felt {
    std::vector<Surroundings> place;
    Vector edges; // of the joined panels
    std::shared_ptr<const Wall> wall;
  };
  std::shared_ptr<const Wall> compressed(const Vector &edges) const;

  mutable Felt last_, before_;
};

} // namespace capsule
