// Parameters in YAML: the files of ROS 2, and values on the command line.
//   /robot0/planner:            names of nodes, whole or by part; * stands for one part, ** for any number
//     ros__parameters:
//       robot_id: 0
//       host: {map_reach: 2.0}  nested names are joined by dots: host.map_reach
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "ros2/node/parameter_value.hpp"

namespace ros2 {

struct ParameterRule {
  std::string node;  ///< pattern of full names of nodes
  std::string name;
  ParameterValue value;
};

/// The rules of a file in its order. Throws std::invalid_argument that names file, line and key.
[[nodiscard]] std::vector<ParameterRule> read_parameter_file(const std::string& path);

/// Of text in YAML; `source` is its name in messages.
[[nodiscard]] std::vector<ParameterRule> parse_parameters(const std::string& text, const std::string& source);

/// One value: a scalar or a list of one type. Throws std::invalid_argument.
[[nodiscard]] ParameterValue parse_parameter_value(const std::string& text);

/// Does a pattern ("/**", "/robot0/*", "planner") mean this node? Without a slash it is a name in any
/// namespace.
[[nodiscard]] bool matches(const std::string& pattern, const std::string& node);

}  // namespace ros2
