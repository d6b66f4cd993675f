#include "ros2/robot/robot_config.hpp"

#include <cstdlib>
#include <limits>
#include <stdexcept>

#include "config/contradiction_report.hpp"
#include "wire/converted.hpp"

namespace spf_ros2 {

RobotConfig read_config(ros2::Node& node) {
  const auto text = [&](const char* name, const std::string& value, const char* what) {
    return node.parameters().declare_as(name, value, {what, true, {}, {}});
  };
  RobotConfig config;
  if (const char* distribution = std::getenv("ROS_DISTRO")) config.distribution = distribution;
  const ros2::ParameterRange numbers{0.0, std::numeric_limits<int>::max()};
  config.robot_id = static_cast<int>(node.parameters().declare_as(
      "robot_id", std::int64_t{0}, {"number and rank of the robot: smaller goes first", true, numbers, {}}));
  config.frame = spf::wire::plain_frame(text("frame", "map", "the fleet's frame"));
  config.base_frame = spf::wire::plain_frame(
      text("base_frame", "robot" + std::to_string(config.robot_id) + "/base_link", "the robot's own frame"));
  const std::string path = text("config", "", "path of the robot's file; none: defaults");
  const std::string map = text("map", "wait", "wait for /map, or none: only what is sensed");
  std::string problems;
  if (config.frame.empty()) problems += "\nframe must not be empty";
  if (config.base_frame.empty()) problems += "\nbase_frame must not be empty";
  if (map != "wait" && map != "none") problems += "\nmap = " + map + " must be one of wait, none";
  config.waits_for_map = map == "wait";
  try {
    config.file = spf::read_robot_file(path);
  } catch (const spf::InputError& error) {
    problems += std::string{"\n"} + error.what();
  }
  if (!problems.empty()) throw std::invalid_argument{problems.substr(1)};
  config.agent = spf::agent_parameters(config.file);
  for (const spf::InputProblem& warning : config.file.warnings) node.log().warn(spf::warning_text(warning));
  return config;
}

}  // namespace spf_ros2
