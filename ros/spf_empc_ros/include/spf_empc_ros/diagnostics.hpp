// One line of /diagnostics: what a part of a robot does, and why it stands. Sent when it changes, and once a
// second.
#pragma once

#include <diagnostic_msgs/DiagnosticStatus.h>
#include <ros/node_handle.h>
#include <ros/publisher.h>

#include <string>
#include <utility>
#include <vector>

namespace spf_empc_ros {

enum class Health { ok, standing, missing };  ///< shown as OK, WARN, ERROR

class Diagnostics {
 public:
  /// `part` such as "planner"; the robot's number is shown beside it.
  Diagnostics(ros::NodeHandle& node, int robot_id, const std::string& part);

  using Values = std::vector<std::pair<std::string, std::string>>;
  void report(const ros::Time& now, Health health, const std::string& message, const Values& values);
  /// Is one due, when nothing changes?
  [[nodiscard]] bool due(const ros::Time& now, const std::string& message) const;

 private:
  ros::Publisher publisher_;
  std::string name_;
  std::string id_;
  std::string last_message_;
  ros::Time last_time_;
};

/// "0.042 s", or "never" when infinite.
[[nodiscard]] std::string age_text(double seconds);

}  // namespace spf_empc_ros
