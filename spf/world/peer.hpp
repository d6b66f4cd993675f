// Belief about one teammate, from its broadcasts.
#pragma once

#include "spf/math/shared.hpp"
#include "spf/world/priority.hpp"
#include "spf/world/trajectory_message.hpp"

namespace spf {

struct Peer {
  int robot_id = 0;
  int priority = 0;
  PeerState state = PeerState::stopped;
  double radius = 0.3;          ///< [m]
  double position_sigma = 0.0;  ///< [m]
  double received_time = 0.0;   ///< [s]
  bool expired = false;  ///< the message is too old: the peer is a growing disc at its last known position
  double growth = 0.0;   ///< [m] added to the radius of an expired peer
  double stood = 0.0;    ///< [s] for so long it has stood still, stopped or arrived
  Shared<Trajectory> trajectory{Trajectory{}};
  /// The narrow passage ahead that the peer claims; null: none. Owned, like `trajectory`, by the peer's last
  /// message: valid as long as that.
  const PassageClaim* claim = nullptr;

  [[nodiscard]] Rank rank() const { return {priority, robot_id}; }
  /// Position at an absolute time [m]; for an expired peer the last known position.
  [[nodiscard]] Eigen::Vector2d position(double time) const;
  /// Velocity at an absolute time [m/s].
  [[nodiscard]] Eigen::Vector2d velocity(double time) const;
};

}  // namespace spf
