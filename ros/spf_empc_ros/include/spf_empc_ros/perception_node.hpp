// PerceptionHost on ROS: scans and reports of obstacles in, observations for the planner out. Topics:
// docs/ros.md.
#pragma once

#include <ros/node_handle.h>
#include <ros/publisher.h>
#include <ros/subscriber.h>
#include <ros/timer.h>
#include <sensor_msgs/LaserScan.h>
#include <spf_empc_msgs/ObstacleTracks.h>
#include <spf_empc_msgs/WheelSpeeds.h>

#include <optional>
#include <string>
#include <vector>

#include "host/perception_host.hpp"
#include "spf_empc_ros/clock_edge.hpp"
#include "spf_empc_ros/diagnostics.hpp"
#include "spf_empc_ros/frames.hpp"
#include "spf_empc_ros/robot_config.hpp"

namespace spf_empc_ros {

class PerceptionNode {
 public:
  /// `node` is in the robot's namespace; its callback queue must be served by one thread.
  PerceptionNode(ros::NodeHandle node, const RobotConfig& config, const ros::Time& start);

 private:
  void on_scan(const sensor_msgs::LaserScan::ConstPtr& scan);
  void on_obstacles(const spf_empc_msgs::ObstacleTracks::ConstPtr& tracks);
  void publish(const std::optional<spf::host::SensedWorld>& sensed, const char* what);
  void report();
  void on_wheels(const spf_empc_msgs::WheelSpeeds::ConstPtr& wheels);
  void refuse(const char* what, const std::string& why, bool harmless = false);
  void check_sight(double range);
  [[nodiscard]] double now() const { return clock_.seconds(ros::Time::now()); }

  ros::NodeHandle node_;
  RobotConfig config_;
  ClockEdge clock_;
  spf::host::PerceptionHost host_;
  Frames frames_;
  Diagnostics diagnostics_;
  std::vector<ros::Subscriber> subscribers_;
  ros::Publisher observation_;
  ros::Timer timer_;
  spf::host::RefusalLog refusals_;
  bool sight_checked_ = false;
};

}  // namespace spf_empc_ros
