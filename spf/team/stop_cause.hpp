// Why a robot does not move.
#pragma once

#include <cstddef>

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

}  // namespace spf
