// What may change while a robot drives: a few keys of its file, with the file's ranges and words, under names
// of their own. For whoever lets people set them (ROS: dynamic_reconfigure).
#pragma once

#include <map>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "config/robot_file.hpp"
#include "spf/math/parameters.hpp"

namespace spf {

/// A number, or the name of an enumerator.
using RunTimeValue = std::variant<double, std::string>;

struct RunTimeField {
  std::string name;  ///< "speed_limit"
  std::string key;   ///< of the file: "robot.max_speed"
  RunTimeValue value;
  Range range{0.0, 0.0};             ///< of a number
  std::string unit;                  ///< likewise
  std::vector<std::string> choices;  ///< of an enumeration
  std::string what;
};

/// Name and key of each. `speed_limit` is robot.max_speed, which may sink below what the file says and rise
/// again up to it: everything else that follows the robot's speed was laid out for that.
[[nodiscard]] const std::vector<std::pair<std::string, std::string>>& run_time_keys();

/// As they are in a file.
[[nodiscard]] std::vector<RunTimeField> run_time_fields(const RobotFile& file);

/// The file with other values. Throws std::invalid_argument with every problem: name, value and limit.
[[nodiscard]] RobotFile with_run_time_values(const RobotFile& file,
                                             const std::map<std::string, RunTimeValue>& values);

}  // namespace spf
