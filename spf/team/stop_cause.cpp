#include "spf/team/stop_cause.hpp"

namespace spf {

const char* to_string(StopCause cause) {
  switch (cause) {
    case StopCause::none:
      return "moving";
    case StopCause::no_goal:
      return "no goal";
    case StopCause::arrived:
      return "arrived";
    case StopCause::obstacle_ahead:
      return "waits for a moving obstacle";
    case StopCause::peer_ahead:
      return "waits for a peer";
    case StopCause::no_path:
      return "no path to the goal";
    case StopCause::planner_failed:
      return "no safe plan";
    case StopCause::emergency_stop:
      return "emergency stop";
    case StopCause::paused:
      return "paused";
    case StopCause::clock_jump:
      return "clock jump";
    case StopCause::no_pose:
      return "no pose";
    case StopCause::stale_pose:
      return "stale pose";
    case StopCause::stale_localisation:
      return "stale localisation";
    case StopCause::no_scan:
      return "no scan";
    case StopCause::no_obstacles:
      return "no report of obstacles";
    case StopCause::no_plan:
      return "no plan";
    case StopCause::stale_plan:
      return "stale plan";
    case StopCause::stuck:
      return "stuck";
    case StopCause::far_from_plan:
      return "far from its plan";
    case StopCause::in_the_way:
      return "obstacle in the way";
    case StopCause::control_failed:
      return "no control";
  }
  return "?";
}

}  // namespace spf
