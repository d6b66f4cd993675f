// What a simulator for robots elsewhere is told when it starts: a trial of a scenario file, and how it is
// served. The same for every ROS (docs/ros.md, docs/ros2.md).
#pragma once

#include <string>
#include <vector>

#include "sim/scenario.hpp"

namespace spf::simulator {

enum class FaultyTopic { odom, scan, obstacles };

/// Messages of one topic of one robot that are lost for a while.
struct Fault {
  FaultyTopic topic = FaultyTopic::odom;
  int robot = 0;
  double from = 0.0;  ///< [s] simulated
  double to = 0.0;    ///< [s]
};

struct Settings {
  sim::Scenario scenario;           ///< of one trial, with the overrides written over its file
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

/// Which trial of which file.
struct TrialChoice {
  std::string path;                    ///< of a scenario file
  int trial = 0;                       ///< which of the scenes that a family draws
  std::vector<std::string> overrides;  ///< keys of the file, each as key=value
};

/// Fills what the scenario decides: itself, control_period and map_resolution. What is wrong is added to
/// `problems`, a line each; what is merely odd to `warnings`.
void read_trial(const TrialChoice& choice, Settings& settings, std::string& problems,
                std::vector<std::string>& warnings);

/// "cmd_vel" or "wheel_speeds"; anything else is added to `problems`.
void read_command(const std::string& command, Settings& settings, std::string& problems);

/// A fault by its words; throws std::invalid_argument with key, value and limit. `robots`: how many there
/// are.
[[nodiscard]] Fault make_fault(const std::string& topic, int robot, double from, double to, int robots);

/// Throws std::invalid_argument with the problems so far and those that the settings have, if any; makes the
/// frame plain, and what a network decides as it is: what that changes is added to `warnings`.
void check(Settings& settings, std::string problems, std::vector<std::string>& warnings);

}  // namespace spf::simulator
