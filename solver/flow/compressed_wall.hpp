#pragma once
// The wall as membranes feel it that are far from most of it. What they do to a distant stretch of the wall and what it
// does to them are smooth along it: there neighbouring panels are joined to longer ones with as many points. Joined
// panels stay so far from the membranes that polynomials through their points interpolate the ring stokeslet with an
// error below the near tolerance: on the Bernstein ellipse through a point at height h (in half lengths), p points err
// like (h + sqrt(1 + h^2))^(-p). Throws nothing.
#include "flow/membrane_mesh.hpp"
#include "flow/wall.hpp"
#include <memory>
#include <vector>

namespace capsule {

// A part of the meridian plane: |x - centre| <= half_length, r <= radius.
struct Surroundings {
  double centre = 0, half_length = 0, radius = 0;
  bool operator==(const Surroundings &) const = default;
};

// Edges of the wall's panels by arc length, joined as far as what lies in these parts allows.
Vector joined_panels(const Wall &wall, const std::vector<Surroundings> &membranes);

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
