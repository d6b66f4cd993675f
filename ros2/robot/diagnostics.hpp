// Lines of /diagnostics: what a part of a robot does, and why it stands; and one line for the robot as a
// whole, from whichever part speaks for it (host/health.hpp). Sent when they change, and twice a second.
#pragma once

#include <ros2_messages/diagnostic_msgs/DiagnosticArray.hpp>
#include <string>
#include <utility>
#include <vector>

#include "host/health.hpp"
#include "ros2/node/node.hpp"
#include "ros2/robot/clock_edge.hpp"
#include "ros2/robot/robot_config.hpp"

namespace spf_ros2 {

class Diagnostics {
 public:
  /// `part` such as "planner"; the robot's number is shown beside it.
  Diagnostics(ros2::Node& node, const RobotConfig& config, const std::string& part, const ClockEdge& clock);
  Diagnostics(const Diagnostics&) = delete;
  Diagnostics& operator=(const Diagnostics&) = delete;

  using Values = std::vector<std::pair<std::string, std::string>>;
  void report(const spf::host::Health& health, const Values& values);
  /// Is one due, also when nothing changes?
  [[nodiscard]] bool due(const spf::host::Health& health) const { return due(health, last_); }
  /// [s] in which something that does not change is said again.
  static constexpr double kPeriod = 0.5;

 private:
  struct Line {
    spf::host::Health health;
    ros2::Nanoseconds time = 0;
  };
  void on_part(const ros2::diagnostic_msgs::DiagnosticStatus& status);
  void report_robot();
  void publish(const std::string& name, const spf::host::Health& health, const Values& values) const;
  [[nodiscard]] bool due(const spf::host::Health& health, const Line& last) const;
  [[nodiscard]] double now() const { return clock_.seconds(node_.clock().now()); }

  ros2::Node& node_;
  ClockEdge clock_;
  std::string robot_;
  std::string part_;
  spf::host::RobotHealth robot_health_;
  ros2::Publisher<ros2::diagnostic_msgs::DiagnosticArray> publisher_;
  ros2::Publisher<ros2::diagnostic_msgs::DiagnosticStatus> to_parts_;
  Line last_;        // of the part
  Line last_robot_;  // of the robot
};

/// "0.042 s", or "never" when infinite.
[[nodiscard]] std::string age_text(double seconds);

}  // namespace spf_ros2
