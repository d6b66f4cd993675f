// What simulator_node is told when it starts (docs/ros.md).
#pragma once

#include <ros/node_handle.h>

#include "simulator/settings.hpp"

namespace spf_empc_ros {

/// Reads the private parameters. Throws std::exception with every problem in one text.
[[nodiscard]] spf::simulator::Settings read_simulator_config(const ros::NodeHandle& own);

}  // namespace spf_empc_ros
