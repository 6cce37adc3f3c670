#include "flow/compressed_wall.hpp"

namespace capsule {

std::shared_ptr<const Wall> CompressedWall::felt_by(const MembraneMesh &mesh, const Vector &position) const {
  if (whole_->unknowns() == 0 || !position.allFinite())
    return whole_;
  std::vector<Surroundings> place = place_of(mesh, position);
  if (!compressed_ || place != place_) {
    compressed_ = std::make_shared<const Wall>(
        *whole_, joined_panels(whole_->panels(), whole_->curve(), whole_->near_tolerance(), place));
    place_ = std::move(place);
  }
  return compressed_;
}

} // namespace capsule
