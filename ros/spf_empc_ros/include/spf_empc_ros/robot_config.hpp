// What a node is told when it starts: the private parameters robot_id, frame, base_frame, config and map.
#pragma once

#include <ros/node_handle.h>

#include <string>

#include "config/robot_file.hpp"

namespace spf_empc_ros {

struct RobotConfig {
  int robot_id = 0;
  std::string frame = "map";  ///< the fleet's
  std::string base_frame;     ///< the robot's own: x forward, y left, around its centre
  bool waits_for_map = true;  ///< `map: wait`; `map: none` starts with what is sensed
  spf::RobotFile file;
  spf::AgentParameters agent;  ///< of the file
};

/// Throws std::exception with every problem in one text.
[[nodiscard]] RobotConfig read_config(const ros::NodeHandle& own);

/// Waits for the first ROS time: with use_sim_time, for a clock. Zero when the node is to end.
[[nodiscard]] ros::Time first_time();

/// Runs a node's body; problems with its parameters are logged and end it with status 1.
int run_node(int argc, char** argv, const char* name, void (*body)(const RobotConfig& config));

}  // namespace spf_empc_ros
