// The program spf-ros2: the nodes of one robot, together or one by one, each on a thread of its own, so that
// planning never holds up control. Only values pass between them, by the same topics as between processes.
// And the simulator, which stands for a fleet's world.
#pragma once

#include <string>
#include <vector>

namespace spf_ros2 {

/// `spf-ros2 planner | tracker | perception | robot | simulator [--ros-args ...]`; robot is the first three.
/// Runs until SIGINT or SIGTERM, which it takes for itself from here on: call it before there are other
/// threads. Returns the exit status: 0, 1 when a node could not go on or a trial failed, 2 for bad usage or
/// input.
int run_program(const std::vector<std::string>& arguments);

}  // namespace spf_ros2
