// Lines of /diagnostics: what a part of a robot does, and why it stands; and one line for the robot as a
// whole, from whichever part speaks for it (host/health.hpp). Sent when they change, and twice a second.
#pragma once

#include <diagnostic_msgs/DiagnosticStatus.h>
#include <ros/node_handle.h>
#include <ros/publisher.h>
#include <ros/subscriber.h>

#include <string>
#include <utility>
#include <vector>

#include "host/health.hpp"
#include "spf_empc_ros/clock_edge.hpp"
#include "spf_empc_ros/robot_config.hpp"

namespace spf_empc_ros {

class Diagnostics {
 public:
  /// `part` such as "planner"; the robot's number is shown beside it.
  Diagnostics(ros::NodeHandle& node, const RobotConfig& config, const std::string& part,
              const ClockEdge& clock);
  Diagnostics(const Diagnostics&) = delete;
  Diagnostics& operator=(const Diagnostics&) = delete;

  using Values = std::vector<std::pair<std::string, std::string>>;
  void report(const ros::Time& now, const spf::host::Health& health, const Values& values);
  /// Is one due, also when nothing changes?
  [[nodiscard]] bool due(const ros::Time& now, const spf::host::Health& health) const;
  /// [s] in which something that does not change is said again.
  static constexpr double kPeriod = 0.5;

 private:
  struct Line {
    spf::host::Health health;
    ros::Time time;
  };
  void on_part(const diagnostic_msgs::DiagnosticStatus::ConstPtr& status);
  void report_robot(const ros::Time& now);
  void publish(const ros::Time& now, const std::string& name, const spf::host::Health& health,
               const Values& values) const;
  [[nodiscard]] static bool due(const ros::Time& now, const spf::host::Health& health, const Line& last);

  ClockEdge clock_;
  std::string robot_;
  std::string part_;
  spf::host::RobotHealth robot_health_;
  ros::Publisher publisher_;
  ros::Publisher to_parts_;
  ros::Subscriber from_parts_;
  Line last_;        // of the part
  Line last_robot_;  // of the robot
};

/// "0.042 s", or "never" when infinite.
[[nodiscard]] std::string age_text(double seconds);

}  // namespace spf_empc_ros
