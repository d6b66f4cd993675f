// The outline of a robot that a file describes: its length and width, or its corners.
#pragma once

#include <string>

#include "config/yaml_tree.hpp"
#include "spf/robot/robot_parameters.hpp"

namespace spf {

/// Sets the radius of a robot with corners to that of the disc around them, once its keys have been read from
/// `map` (null: it sets none of them). Corners that are no outline, and another radius beside them, are
/// problems; such a robot then is a disc. `key` is that of the map, "robot".
void settle_footprint(const YamlNode* map, const std::string& key, RobotParameters& robot,
                      InputProblems& problems);

}  // namespace spf
