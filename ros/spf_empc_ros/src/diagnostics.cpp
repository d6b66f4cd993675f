#include "spf_empc_ros/diagnostics.hpp"

#include <diagnostic_msgs/DiagnosticArray.h>

#include <cmath>
#include <cstdio>

namespace spf_empc_ros {
namespace {

std::uint8_t level_of(Health health) {
  switch (health) {
    case Health::ok:
      return diagnostic_msgs::DiagnosticStatus::OK;
    case Health::standing:
      return diagnostic_msgs::DiagnosticStatus::WARN;
    case Health::missing:
      return diagnostic_msgs::DiagnosticStatus::ERROR;
  }
  return diagnostic_msgs::DiagnosticStatus::ERROR;
}

}  // namespace

Diagnostics::Diagnostics(ros::NodeHandle& node, int robot_id, const std::string& part)
    : publisher_{node.advertise<diagnostic_msgs::DiagnosticArray>("/diagnostics", 10)},
      name_{"robot" + std::to_string(robot_id) + ": " + part},
      id_{"robot" + std::to_string(robot_id)} {}

bool Diagnostics::due(const ros::Time& now, const std::string& message) const {
  return message != last_message_ || now < last_time_ || now - last_time_ >= ros::Duration{1.0};
}

void Diagnostics::report(const ros::Time& now, Health health, const std::string& message,
                         const Values& values) {
  last_message_ = message;
  last_time_ = now;
  diagnostic_msgs::DiagnosticStatus status;
  status.level = static_cast<std::int8_t>(level_of(health));
  status.name = name_;
  status.message = message;
  status.hardware_id = id_;
  for (const auto& [key, text] : values) {
    diagnostic_msgs::KeyValue value;
    value.key = key;
    value.value = text;
    status.values.push_back(value);
  }
  diagnostic_msgs::DiagnosticArray array;
  array.header.stamp = now;
  array.status.push_back(status);
  publisher_.publish(array);
}

std::string age_text(double seconds) {
  if (!std::isfinite(seconds)) return "never";
  char text[32];
  std::snprintf(text, sizeof text, "%.3f s", seconds);
  return text;
}

}  // namespace spf_empc_ros
