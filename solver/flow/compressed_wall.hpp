#pragma once
// The wall on joined panels (joined_panels.hpp), as a march feels it. Throws nothing.
#include "flow/joined_panels.hpp"
#include "flow/wall.hpp"
#include <memory>
#include <vector>

namespace capsule {

// Keeps the compressed wall of the last place: a march asks for some hundred flows before its capsule has left it.
class CompressedWall {
public:
  explicit CompressedWall(Wall whole) : whole_(std::make_shared<const Wall>(std::move(whole))) {}
  const Wall &whole() const { return *whole_; }
  const std::shared_ptr<const Wall> &shared_whole() const { return whole_; }
  // For membranes in this position. Which wall that is depends on the position alone.
  std::shared_ptr<const Wall> felt_by(const MembraneMesh &mesh, const Vector &position) const;

private:
  std::shared_ptr<const Wall> whole_;
  mutable std::vector<Surroundings> place_;
  mutable std::shared_ptr<const Wall> compressed_;
};

} // namespace capsule
