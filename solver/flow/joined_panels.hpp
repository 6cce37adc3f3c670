#pragma once
// A wall as membranes feel it that are far from most of it. What they do to a distant stretch of the wall and what it
// does to them are smooth along it: there neighbouring panels are joined to longer ones with as many points. Joined
// panels stay so far from the membranes that polynomials through their points interpolate the ring kernels with an
// error below the near tolerance: on the Bernstein ellipse through a point at height h (in half lengths), p points err
// like (h + sqrt(1 + h^2))^(-p). Throws nothing.
#include "flow/membrane_mesh.hpp"
#include <vector>

namespace capsule {

// A part of the meridian plane: |x - centre| <= half_length, r <= radius.
struct Surroundings {
  double centre = 0, half_length = 0, radius = 0;
  bool operator==(const Surroundings &) const = default;
};

// Where membranes in a position are, one a membrane. It stays the same while they move a little.
std::vector<Surroundings> place_of(const MembraneMesh &mesh, const Vector &position);

// Edges of the wall's panels by arc length, joined as far as what lies in these parts allows.
Vector joined_panels(const Panels &panels, const Curve &wall, double near_tolerance,
                     const std::vector<Surroundings> &membranes);

// The curve on longer panels, each of which holds whole ones: interpolated from the panels that hold its points.
Curve on_longer_panels(const Curve &curve, const Panels &whole, const Panels &longer);

// P, which interpolates unknowns of the whole wall from those of longer panels, each of which holds whole ones. The
// unknowns are the first component at the wall's points, one that belongs to no point, then the other component, if any.
class Joining {
public:
  Joining(const Panels &whole, const Panels &longer, int components);
  // P^T y
  Vector operator()(const Vector &values) const;
  // P^T M P
  RowMatrix both_sides(const RowMatrix &matrix) const;

private:
  // Points of the whole wall and those of the longer panel that they become; as they are without an interpolation.
  struct Joined {
    Eigen::Index begin, count, first, points;
    Matrix interpolation;
  };

  // Applies `use(panel, first unknown of the whole wall, first one of the longer panels)`.
  template <class Use>
  void for_each_component(const Use &use) const {
    for (const Joined &panel : joined_)
      for (Eigen::Index k = 0; k < components_; ++k)
        use(panel, k * (fine_ + 1) + panel.begin, k * (coarse_ + 1) + panel.first);
  }

  Eigen::Index unknowns() const { return components_ * coarse_ + 1; }
  RowMatrix columns(const Eigen::Ref<const RowMatrix> &matrix) const; // M P

  Eigen::Index components_, fine_, coarse_; // of points
  std::vector<Joined> joined_;
};

} // namespace capsule
