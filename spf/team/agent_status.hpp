// How a robot stands, for its host and for displays: why it does not move, and where it thinks it is.
#pragma once

#include <Eigen/Core>

#include <cstddef>

#include "spf/math/pose2.hpp"
#include "spf/world/trajectory_message.hpp"

namespace spf {

/// Why a robot stands still (or is about to); `none` while it moves as planned.
enum class StopCause {
  none,
  no_goal,
  arrived,
  obstacle_ahead,  ///< waits for a moving obstacle (culprit = its id)
  peer_ahead,      ///< waits for a teammate (culprit = its number)
  no_path,         ///< the static map leaves no way to the goal
  planner_failed,  ///< no safe plan within the budget; stands and tries again
  // Found by its host's watchdog (host/watchdog.hpp).
  emergency_stop,
  paused,        ///< told to
  clock_jump,    ///< nothing is known in the new time yet
  no_pose,       ///< none yet
  stale_pose,    ///< no pose for too long
  no_scan,       ///< none for too long, or none yet
  no_obstacles,  ///< likewise no report of moving obstacles
  no_plan,       ///< the controller has none yet
  stale_plan,    ///< no word of the planner for too long
  stuck,         ///< does not move as it is told, or gets no farther
  far_from_plan,
  control_failed,  ///< the controller had no answer
};
[[nodiscard]] const char* to_string(StopCause cause);
inline constexpr std::size_t kStopCauses = static_cast<std::size_t>(StopCause::control_failed) + 1;

/// A cause and who is behind it.
struct StandCause {
  StopCause reason = StopCause::none;
  int culprit = -1;  ///< id of the obstacle or peer, -1 = none
};

struct AgentStatus {
  PeerState state = PeerState::stopped;
  StopCause reason = StopCause::no_goal;
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
