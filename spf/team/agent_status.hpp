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
  obstacle_ahead,  ///< waits for a moving obstacle (blocking_id = its id)
  peer_ahead,      ///< waits for a teammate (blocking_id = its number)
  no_path,         ///< the static map leaves no path to the goal
  planner_failed,  ///< no safe plan within the budget; stands and tries again
  // Found by its host's watchdog (host/watchdog.hpp).
  emergency_stop,
  paused,              ///< told to
  clock_jump,          ///< nothing is known in the new time yet
  no_pose,             ///< none yet
  stale_pose,          ///< no pose for too long
  stale_localisation,  ///< poses come, but the transform that places them is too old
  no_scan,             ///< none for too long, or none yet
  no_obstacles,        ///< likewise no report of moving obstacles
  no_plan,             ///< the controller has none yet
  stale_plan,          ///< no word of the planner for too long
  stuck,               ///< does not move as it is told, or gets no farther
  far_from_plan,
  in_the_way,      ///< the guard holds it before what its scanner shows
  control_failed,  ///< the controller had no answer
};
[[nodiscard]] const char* to_string(StopCause cause);
inline constexpr std::size_t kStopCauses = static_cast<std::size_t>(StopCause::control_failed) + 1;

/// How the static map, as far as it is known, lets a robot come to its goal.
enum class GoalAccess {
  open,     ///< a path leads there
  blocked,  ///< it lies in a wall, or nearer to one than the robot goes: at best a path leads to beside it
  cut_off,  ///< no path leads there
};

/// A cause and who is behind it.
struct StandCause {
  StopCause reason = StopCause::none;
  int blocking_id = -1;  ///< id of the obstacle or peer, -1 = none
};

/// Something below the planner, as a guard, keeps the robot from doing as planned.
struct Hold {
  Eigen::Vector3d twist_world = Eigen::Vector3d::Zero();  ///< [m/s, m/s, rad/s] that it is told instead
  bool stands = false;                                    ///< it may not go on at all
};

struct AgentStatus {
  PeerState state = PeerState::stopped;
  StopCause reason = StopCause::no_goal;
  int blocking_id = -1;  ///< id of the obstacle or peer behind the reason, -1 = none
};

/// Where the robot thinks it is, and how sure it is of it.
struct AgentEstimate {
  Pose2 pose_world;
  Eigen::Vector3d disturbance_world = Eigen::Vector3d::Zero();  ///< [m/s, m/s, rad/s] eq. 17
  double position_sigma = 0.0;                                  ///< [m] per axis
  bool valid = false;
};

}  // namespace spf
