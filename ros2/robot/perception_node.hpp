// PerceptionHost on ROS 2: scans and reports of obstacles in, observations for the planner out. Topics:
// docs/ros2.md.
#pragma once

#include <optional>
#include <ros2_messages/sensor_msgs/LaserScan.hpp>
#include <ros2_messages/spf_empc_msgs/Observation.hpp>
#include <ros2_messages/spf_empc_msgs/ObstacleTracks.hpp>
#include <ros2_messages/spf_empc_msgs/WheelSpeeds.hpp>
#include <string>

#include "host/perception_host.hpp"
#include "ros2/robot/clock_edge.hpp"
#include "ros2/robot/diagnostics.hpp"
#include "ros2/robot/frames.hpp"
#include "ros2/robot/robot_config.hpp"

namespace spf_ros2 {

class PerceptionNode {
 public:
  /// `node` is in the robot's namespace, and served by one thread.
  PerceptionNode(ros2::Node& node, const RobotConfig& config, ros2::Nanoseconds start);
  PerceptionNode(const PerceptionNode&) = delete;
  PerceptionNode& operator=(const PerceptionNode&) = delete;

 private:
  void on_scan(const ros2::sensor_msgs::LaserScan& scan);
  void on_obstacles(const ros2::spf_empc_msgs::ObstacleTracks& tracks);
  void on_wheels(const ros2::spf_empc_msgs::WheelSpeeds& wheels);
  void publish(const std::optional<spf::host::SensedWorld>& sensed, const char* what);
  void report();
  void refuse(const char* what, const std::string& why, bool harmless = false);
  void check_sight(double range);
  [[nodiscard]] double now() const { return clock_.seconds(node_.clock().now()); }

  ros2::Node& node_;
  RobotConfig config_;
  ClockEdge clock_;
  spf::host::PerceptionHost host_;
  Frames frames_;
  Diagnostics diagnostics_;
  ros2::Publisher<ros2::spf_empc_msgs::Observation> observation_;
  spf::host::RefusalLog refusals_;
  bool sight_checked_ = false;
};

}  // namespace spf_ros2
