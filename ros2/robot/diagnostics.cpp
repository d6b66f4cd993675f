#include "ros2/robot/diagnostics.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace spf_ros2 {
namespace {

using ros2::diagnostic_msgs::DiagnosticStatus;
using spf::host::Health;
using spf::host::Level;

std::uint8_t level_of(Level level) {
  switch (level) {
    case Level::ok:
      return DiagnosticStatus::OK;
    case Level::warn:
      return DiagnosticStatus::WARN;
    case Level::error:
      break;
  }
  return DiagnosticStatus::ERROR;
}

/// The parts that the robot needs, in the order in which they speak for it: who drives first.
std::vector<std::string> parts_of(const RobotConfig& config) {
  std::vector<std::string> parts{"tracker", "planner"};
  if (config.file.host.relies_on_scan || config.file.host.relies_on_obstacles)
    parts.emplace_back("perception");
  return parts;
}

DiagnosticStatus status_of(const Health& health, const std::string& name, const std::string& hardware) {
  DiagnosticStatus status;
  status.level = level_of(health.level);
  status.name = name;
  status.message = health.text;
  status.hardware_id = hardware;
  return status;
}

}  // namespace

Diagnostics::Diagnostics(ros2::Node& node, const RobotConfig& config, const std::string& part,
                         const ClockEdge& clock)
    : node_{node},
      clock_{clock},
      robot_{"robot" + std::to_string(config.robot_id)},
      part_{part},
      robot_health_{parts_of(config), part, now()},
      publisher_{node.advertise<ros2::diagnostic_msgs::DiagnosticArray>("/diagnostics")},
      to_parts_{node.advertise<DiagnosticStatus>("health")} {
  node.subscribe<DiagnosticStatus>("health", ros2::Qos::keep_last(20),
                                   [this](const DiagnosticStatus& status) { on_part(status); });
}

bool Diagnostics::due(const Health& health, const Line& last) const {
  const ros2::Nanoseconds time = node_.clock().now();
  return health.text != last.health.text || health.level != last.health.level || time < last.time ||
         time - last.time >= ros2::nanoseconds_of(kPeriod);
}

void Diagnostics::report(const Health& health, const Values& values) {
  last_ = {health, node_.clock().now()};
  publish(robot_ + ": " + part_, health, values);
  to_parts_.publish(status_of(health, part_, robot_));
  robot_health_.hear(part_, health, now());
  report_robot();
}

void Diagnostics::on_part(const DiagnosticStatus& status) {
  if (status.name == part_) return;
  const auto level = static_cast<Level>(std::min<int>(status.level, static_cast<int>(Level::error)));
  robot_health_.hear(status.name, {level, status.message}, now());
  report_robot();
}

void Diagnostics::report_robot() {
  if (!robot_health_.speaks(now())) return;
  const Health health = robot_health_.overall(now());
  if (!due(health, last_robot_)) return;
  last_robot_ = {health, node_.clock().now()};
  publish(robot_, health, {{"spoken by", part_}});
}

void Diagnostics::publish(const std::string& name, const Health& health, const Values& values) const {
  ros2::diagnostic_msgs::DiagnosticArray array;
  array.header.stamp = node_.clock().stamp();
  array.status.push_back(status_of(health, name, robot_));
  for (const auto& [key, text] : values) {
    ros2::diagnostic_msgs::KeyValue value;
    value.key = key;
    value.value = text;
    array.status.back().values.push_back(value);
  }
  publisher_.publish(array);
}

std::string age_text(double seconds) {
  if (!std::isfinite(seconds)) return "never";
  char text[32];
  std::snprintf(text, sizeof text, "%.3f s", seconds);
  return text;
}

}  // namespace spf_ros2
