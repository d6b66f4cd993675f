// What a robot broadcasts to its peers: its committed trajectory and its state.
#pragma once

#include <cstdint>
#include <optional>

#include "spf/trajectory/trajectory.hpp"
#include "spf/world/passage_claim.hpp"

namespace spf {

enum class PeerState { moving, braking, stopped, arrived };

struct TrajectoryMessage {
  int robot_id = 0;
  int priority = 0;            ///< the smaller goes first; among equals the smaller robot_id (priority.hpp)
  std::uint32_t sequence = 0;  ///< grows with every message of this robot
  double sent_time = 0.0;      ///< [s]
  double expiry_time = 0.0;    ///< [s] after this the peer is only a disc at its last known position
  double radius = 0.3;         ///< [m] of the robot
  double position_sigma =
      0.0;  ///< [m] how far the robot may be from its trajectory (own pose and tracking error)
  PeerState state = PeerState::stopped;
  std::optional<PassageClaim> claim;  ///< to a narrow passage on its path
  Trajectory trajectory;              ///< world, absolute time
};

}  // namespace spf
