// What a node is told when it starts: the parameters robot_id, frame, base_frame, config and map.
#pragma once

#include <string>

#include "config/robot_file.hpp"
#include "ros2/node/node.hpp"

namespace spf_ros2 {

struct RobotConfig {
  int robot_id = 0;
  std::string frame = "map";  ///< the fleet's
  std::string base_frame;     ///< the robot's own: x forward, y left, around its centre
  bool waits_for_map = true;  ///< `map: wait`; `map: none` starts with what is sensed
  std::string distribution;   ///< of ROS 2, as ROS_DISTRO says; it decides what an action's result is
  spf::RobotFile file;
  spf::AgentParameters agent;  ///< of the file
};

/// Declares the parameters. Throws std::exception with every problem in one text; warns of settings that
/// contradict each other.
[[nodiscard]] RobotConfig read_config(ros2::Node& node);

}  // namespace spf_ros2
