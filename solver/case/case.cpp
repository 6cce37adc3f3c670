#include "case/case.hpp"

namespace capsule {

std::vector<const Case *> capsules_of(const Case &physics) {
  std::vector<const Case *> capsules{&physics};
  for (const Case &follower : physics.followers)
    capsules.push_back(&follower);
  return capsules;
}

} // namespace capsule
