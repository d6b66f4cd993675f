// How a robot stands, for its host and for displays: why it does not move, and where it thinks it is.
#pragma once

#include <Eigen/Core>

#include <cstddef>

#include "spf/math/pose2.hpp"
#include "spf/world/trajectory_message.hpp"

namespace spf {

/// Why a robot stands still (or is about to); `none` while it moves as planned.
enum class StandReason {
  none,
  no_goal,
  arrived,
  obstacle_ahead,  ///< waits for a moving obstacle (culprit = its id)
  peer_ahead,      ///< waits for a teammate (culprit = its number)
  no_path,         ///< the static map leaves no way to the goal
  planner_failed,  ///< no safe plan within the budget; stands and tries again
  stale_pose,      ///< no pose measurement for too long
  stale_scan,      ///< no observation for too long
  paused,          ///< told to
};
[[nodiscard]] const char* to_string(StandReason reason);
inline constexpr std::size_t kStandReasons = static_cast<std::size_t>(StandReason::paused) + 1;

/// A reason and who is behind it.
struct StandCause {
  StandReason reason = StandReason::none;
  int culprit = -1;  ///< id of the obstacle or peer, -1 = none
};

struct AgentStatus {
  PeerState state = PeerState::stopped;
  StandReason reason = StandReason::no_goal;
  int culprit = -1;  ///< id of the obstacle or peer behind the reason, -1 = none
};

/// Where the robot thinks it is, and how sure it is of it.
struct AgentEstimate {
  Pose2 pose_world;
  Eigen::Vector3d disturbance_world = Eigen::Vector3d::Zero();  ///< [m/s, m/s, rad/s] eq. 17
  double position_sigma = 0.0;                                  ///< [m] per axis
  bool valid = false;
};

}  // namespace spf
