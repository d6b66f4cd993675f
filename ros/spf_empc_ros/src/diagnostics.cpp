#include "spf_empc_ros/diagnostics.hpp"

#include <diagnostic_msgs/DiagnosticArray.h>
#include <ros/time.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace spf_empc_ros {
namespace {

using spf::host::Health;
using spf::host::Level;

std::int8_t level_of(Level level) {
  switch (level) {
    case Level::ok:
      return static_cast<std::int8_t>(diagnostic_msgs::DiagnosticStatus::OK);
    case Level::warn:
      return static_cast<std::int8_t>(diagnostic_msgs::DiagnosticStatus::WARN);
    case Level::error:
      break;
  }
  return static_cast<std::int8_t>(diagnostic_msgs::DiagnosticStatus::ERROR);
}

/// The parts that the robot needs, in the order in which they speak for it: who drives first.
std::vector<std::string> parts_of(const RobotConfig& config) {
  std::vector<std::string> parts{"tracker", "planner"};
  if (config.file.host.relies_on_scan || config.file.host.relies_on_obstacles)
    parts.emplace_back("perception");
  return parts;
}

diagnostic_msgs::DiagnosticStatus status_of(const Health& health, const std::string& name,
                                            const std::string& hardware) {
  diagnostic_msgs::DiagnosticStatus status;
  status.level = level_of(health.level);
  status.name = name;
  status.message = health.text;
  status.hardware_id = hardware;
  return status;
}

}  // namespace

Diagnostics::Diagnostics(ros::NodeHandle& node, const RobotConfig& config, const std::string& part,
                         const ClockEdge& clock)
    : clock_{clock},
      robot_{"robot" + std::to_string(config.robot_id)},
      part_{part},
      robot_health_{parts_of(config), part, clock.seconds(ros::Time::now())},
      publisher_{node.advertise<diagnostic_msgs::DiagnosticArray>("/diagnostics", 10)},
      to_parts_{node.advertise<diagnostic_msgs::DiagnosticStatus>("health", 10)},
      from_parts_{node.subscribe("health", 20, &Diagnostics::on_part, this)} {}

bool Diagnostics::due(const ros::Time& now, const Health& health, const Line& last) {
  return health.text != last.health.text || health.level != last.health.level || now < last.time ||
         now - last.time >= ros::Duration{kPeriod};
}

bool Diagnostics::due(const ros::Time& now, const Health& health) const {
  return due(now, health, last_);
}

void Diagnostics::report(const ros::Time& now, const Health& health, const Values& values) {
  last_ = {health, now};
  publish(now, robot_ + ": " + part_, health, values);
  to_parts_.publish(status_of(health, part_, robot_));
  robot_health_.hear(part_, health, clock_.seconds(now));
  report_robot(now);
}

void Diagnostics::on_part(const diagnostic_msgs::DiagnosticStatus::ConstPtr& status) {
  if (status->name == part_) return;
  const ros::Time now = ros::Time::now();
  const auto level = static_cast<Level>(std::clamp<int>(status->level, 0, static_cast<int>(Level::error)));
  robot_health_.hear(status->name, {level, status->message}, clock_.seconds(now));
  report_robot(now);
}

void Diagnostics::report_robot(const ros::Time& now) {
  const double seconds = clock_.seconds(now);
  if (!robot_health_.speaks(seconds)) return;
  const Health health = robot_health_.overall(seconds);
  if (!due(now, health, last_robot_)) return;
  last_robot_ = {health, now};
  publish(now, robot_, health, {{"spoken by", part_}});
}

void Diagnostics::publish(const ros::Time& now, const std::string& name, const Health& health,
                          const Values& values) const {
  diagnostic_msgs::DiagnosticArray array;
  array.header.stamp = now;
  array.status.push_back(status_of(health, name, robot_));
  for (const auto& [key, text] : values) {
    diagnostic_msgs::KeyValue value;
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

}  // namespace spf_empc_ros
