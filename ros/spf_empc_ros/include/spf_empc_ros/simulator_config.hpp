// What simulator_node is told when it starts (docs/ros.md).
#pragma once

#include <ros/node_handle.h>

#include <string>
#include <vector>

#include "sim/scenario.hpp"

namespace spf_empc_ros {

enum class FaultyTopic { odom, scan, obstacles };

/// Messages of one topic of one robot that are lost for a while.
struct Fault {
  FaultyTopic topic = FaultyTopic::odom;
  int robot = 0;
  double from = 0.0;  ///< [s] simulated
  double to = 0.0;    ///< [s]
};

struct SimulatorConfig {
  spf::sim::Scenario scenario;      ///< of one trial, with the overrides written over its file
  double control_period = 0.05;     ///< [s] of the scenario's robots: when to expect commands
  std::string frame = "map";        ///< the fleet's
  double speed = 1.0;               ///< [1] simulated seconds per second of the wall
  bool takes_wheel_speeds = false;  ///< `command: wheel_speeds` instead of cmd_vel
  bool waits_for_robots = true;     ///< the clock stands until all robots are there
  bool publishes_goals = true;
  bool quits_when_done = false;
  double map_resolution = 0.05;  ///< [m] of /map; half of what the scenario's robots have
  std::vector<Fault> faults;
};

/// Reads the private parameters. Throws std::exception with every problem in one text.
[[nodiscard]] SimulatorConfig read_simulator_config(const ros::NodeHandle& own);

}  // namespace spf_empc_ros
