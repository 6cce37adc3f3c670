#include "flow/compressed_wall.hpp"

namespace capsule {

std::shared_ptr<const Wall> CompressedWall::felt_by(const MembraneMesh &mesh, const Vector &position) const {
  if (whole_->unknowns() == 0 || !position.allFinite())
    return whole_;
  std::vector<Surroundings> place = place_of(mesh, position);
  if (!compressed_ || place != place_) {
    const Vector edges = joined_panels(whole_->panels(), whole_->curve(), whole_->near_tolerance(), place);
    const double share =
        static_cast<double>(edges.size()) / static_cast<double>(whole_->panels().edges.size());
    const double work_of_whole = whole_->inverse().is_mirrored() ? 0.5 : 1; // in products
    compressed_ = share * share < work_of_whole ? std::make_shared<const Wall>(*whole_, edges) : whole_;
    place_ = std::move(place);
  }
  return compressed_;
}

} // namespace capsule
