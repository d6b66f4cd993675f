// What RViz shows of a planner: its plan as a path, and markers of robot, plan, fields and tracks.
#pragma once

#include <nav_msgs/Path.h>
#include <visualization_msgs/MarkerArray.h>

#include <string>

#include "spf/team/robot_agent.hpp"
#include "spf_empc_ros/clock_edge.hpp"

namespace spf_empc_ros {

/// The rest of the plan from a time on [s], every 0.1 s.
[[nodiscard]] nav_msgs::Path path_message(const spf::Trajectory& plan, double from, const ClockEdge& clock,
                                          const std::string& frame);

[[nodiscard]] visualization_msgs::MarkerArray marker_message(const spf::RobotAgent& agent,
                                                             const spf::Pose2& here, double now,
                                                             const ClockEdge& clock,
                                                             const std::string& frame);

}  // namespace spf_empc_ros
