// How a robot stands, for its host and for displays: why it does not move, and where it thinks it is.
#pragma once

#include <Eigen/Core>

#include "spf/math/pose2.hpp"
#include "spf/team/stop_cause.hpp"
#include "spf/world/trajectory_message.hpp"

namespace spf {

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
