#include "spf/team/agent_status.hpp"

namespace spf {

const char* to_string(StandReason reason) {
  switch (reason) {
    case StandReason::none:
      return "moving";
    case StandReason::no_goal:
      return "no goal";
    case StandReason::arrived:
      return "arrived";
    case StandReason::obstacle_ahead:
      return "waits for a moving obstacle";
    case StandReason::peer_ahead:
      return "waits for a peer";
    case StandReason::no_path:
      return "no path to the goal";
    case StandReason::planner_failed:
      return "no safe plan";
    case StandReason::stale_pose:
      return "no pose";
    case StandReason::stale_scan:
      return "no observation";
    case StandReason::paused:
      return "paused";
  }
  return "?";
}

}  // namespace spf
