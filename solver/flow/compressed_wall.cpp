#include "flow/compressed_wall.hpp"
#include <utility>

namespace capsule {

std::shared_ptr<const Wall> CompressedWall::felt_by(const MembraneMesh &mesh, const Vector &position) const {
  if (whole_->unknowns() == 0 || !position.allFinite())
    return whole_;
  std::vector<Surroundings> place = place_of(mesh, position);
  if (last_.wall && place == last_.place)
    return last_.wall;
  std::swap(last_, before_);
  if (!last_.wall || place != last_.place) {
    Vector edges = joined_panels(whole_->panels(), whole_->curve(), whole_->near_tolerance(), place);
    const bool are_those_before =
        before_.wall && edges.size() == before_.edges.size() && edges == before_.edges;
    std::shared_ptr<const Wall> wall = are_those_before ? before_.wall : compressed(edges);
    last_ = {std::move(place), std::move(edges), std::move(wall)};
  }
  return last_.wall;
}

std::shared_ptr<const Wall> CompressedWall::compressed(const Vector &edges) const {
  const double share = static_cast<double>(edges.size()) / static_cast<double>(whole_->panels().edges.size());
  const double work_of_whole = whole_->inverse().is_mirrored() ? 0.5 : 1; // in products
  return share * share < work_of_whole ? std::make_shared<const Wall>(*whole_, edges) : whole_;
}

} // namespace capsule
