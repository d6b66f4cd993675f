#include "spf/world/peer.hpp"

namespace spf {

// An expired peer's trajectory has been replaced by one at rest (PeerTable), so both cases read the same.
Eigen::Vector2d Peer::position(double time) const {
  return trajectory->position(time);
}

Eigen::Vector2d Peer::velocity(double time) const {
  if (expired) return Eigen::Vector2d::Zero();
  return trajectory->state(time).velocity_world;
}

}  // namespace spf
