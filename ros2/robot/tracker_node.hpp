// host::TrackerProcess on ROS 2: odometry, scans and the planner's trajectory in, commands out, by a timer of
// its own. Topics: docs/ros2.md.
#pragma once

#include <optional>
#include <ros2_messages/geometry_msgs/Twist.hpp>
#include <ros2_messages/geometry_msgs/TwistStamped.hpp>
#include <ros2_messages/nav_msgs/Odometry.hpp>
#include <ros2_messages/sensor_msgs/LaserScan.hpp>
#include <ros2_messages/spf_empc_msgs/RobotStatus.hpp>
#include <ros2_messages/spf_empc_msgs/TrackerStatus.hpp>
#include <ros2_messages/spf_empc_msgs/Trajectory.hpp>
#include <ros2_messages/spf_empc_msgs/WheelSpeeds.hpp>
#include <string>

#include "host/split_host.hpp"
#include "ros2/robot/brake_switches.hpp"
#include "ros2/robot/clock_edge.hpp"
#include "ros2/robot/diagnostics.hpp"
#include "ros2/robot/frames.hpp"
#include "ros2/robot/robot_config.hpp"

namespace spf_ros2 {

class TrackerNode {
 public:
  /// `node` is in the robot's namespace, and served by one thread that nothing blocks. Beside the robot's
  /// parameters it has `stamped_cmd_vel`.
  TrackerNode(ros2::Node& node, const RobotConfig& config, ros2::Nanoseconds start);
  /// Tells the base to stand.
  ~TrackerNode();
  TrackerNode(const TrackerNode&) = delete;
  TrackerNode& operator=(const TrackerNode&) = delete;

 private:
  void on_pose(const ros2::nav_msgs::Odometry& odometry);
  void on_plan(const ros2::spf_empc_msgs::Trajectory& trajectory);
  void on_scan(const ros2::sensor_msgs::LaserScan& scan);
  void listen();
  void step();
  void publish_twist(const Eigen::Vector3d& twist_body) const;
  void publish_command(const spf::host::TrackerCommand& command);
  void publish_estimate(const spf::host::TrackerCommand& command);
  void publish_status(const spf::host::TrackerCommand& command, double control_us);
  void report();
  void refuse(const char* what, const std::string& why, bool harmless = false);
  [[nodiscard]] double now() const { return clock_.seconds(time_ != 0 ? time_ : node_.clock().now()); }
  [[nodiscard]] ros2::builtin_interfaces::Time stamp() const { return ros2::time_of(time_); }

  ros2::Node& node_;
  RobotConfig config_;
  ClockEdge clock_;
  spf::host::TrackerProcess host_;
  Frames frames_;
  Diagnostics diagnostics_;
  BrakeSwitches switches_;
  bool stamped_;  // cmd_vel is a TwistStamped
  ros2::Publisher<ros2::geometry_msgs::Twist> twist_;
  ros2::Publisher<ros2::geometry_msgs::TwistStamped> stamped_twist_;
  ros2::Publisher<ros2::spf_empc_msgs::WheelSpeeds> wheel_speeds_;
  ros2::Publisher<ros2::nav_msgs::Odometry> estimate_;
  ros2::Publisher<ros2::spf_empc_msgs::TrackerStatus> status_;
  ros2::Nanoseconds time_ = 0;  // of the step under way, from which on its command counts; 0 between steps
  std::optional<double> observed_;  // [s] the newest observation behind the plan
  spf::host::RefusalLog refusals_;
};

}  // namespace spf_ros2
