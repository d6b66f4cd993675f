// The parameter file of a scenario's robots: what the nodes of a robot are to be told when a simulator runs
// that scenario and its robots are not the default ones.
#pragma once

#include "config/robot_file.hpp"
#include "study/scenario_file.hpp"

namespace spf::simulator {

/// Of the robot `number`; where robots are of several kinds (`fleet`) they have different files. Throws
/// std::invalid_argument with number and limit when there is no such robot.
[[nodiscard]] RobotFile robot_file_of(const RunConfiguration& run, int number);

/// A program of its own: `arguments` are SCENARIO [--robot NUMBER] [KEY=VALUE...], and the file is printed.
/// `name` is how people call it. Returns the exit status: 0, 2 for bad usage or input, which it names.
int print_robot_file(const std::string& name, const std::vector<std::string>& arguments);

}  // namespace spf::simulator
