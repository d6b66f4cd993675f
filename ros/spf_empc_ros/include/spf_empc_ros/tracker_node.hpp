// host::TrackerProcess on ROS: odometry, scans and the planner's trajectory in, commands out, by a timer of
// its own. Topics: docs/ros.md.
#pragma once

#include <nav_msgs/Odometry.h>
#include <ros/node_handle.h>
#include <ros/publisher.h>
#include <ros/subscriber.h>
#include <ros/timer.h>
#include <sensor_msgs/LaserScan.h>
#include <spf_empc_msgs/RobotStatus.h>
#include <spf_empc_msgs/Trajectory.h>

#include <optional>
#include <string>
#include <vector>

#include "host/split_host.hpp"
#include "spf_empc_ros/clock_edge.hpp"
#include "spf_empc_ros/diagnostics.hpp"
#include "spf_empc_ros/frames.hpp"
#include "spf_empc_ros/robot_config.hpp"
#include "spf_empc_ros/stop_switch.hpp"

namespace spf_empc_ros {

class TrackerNode {
 public:
  /// `node` is in the robot's namespace; its callback queue must be served by one thread, and by nothing that
  /// blocks.
  TrackerNode(ros::NodeHandle node, const RobotConfig& config, const ros::Time& start);
  /// Tells the base to stand.
  ~TrackerNode();
  TrackerNode(const TrackerNode&) = delete;
  TrackerNode& operator=(const TrackerNode&) = delete;

 private:
  void on_pose(const nav_msgs::Odometry::ConstPtr& odometry);
  void on_plan(const spf_empc_msgs::Trajectory::ConstPtr& trajectory);
  void on_scan(const sensor_msgs::LaserScan::ConstPtr& scan);
  void on_planner(const spf_empc_msgs::RobotStatus& status);
  void step();
  void publish_command(const ros::Time& now, const spf::host::TrackerCommand& command);
  void publish_estimate(const ros::Time& now, const spf::host::TrackerCommand& command);
  void publish_status(const ros::Time& now, const spf::host::TrackerCommand& command, double control_us);
  void report(const ros::Time& now);
  void refuse(const char* what, const std::string& why, bool harmless = false);
  [[nodiscard]] double now() const { return clock_.seconds(ros::Time::now()); }

  ros::NodeHandle node_;
  RobotConfig config_;
  ClockEdge clock_;
  spf::host::TrackerProcess host_;
  Frames frames_;
  Diagnostics diagnostics_;
  StopSwitch switch_;
  std::vector<ros::Subscriber> subscribers_;
  ros::Publisher cmd_vel_, wheel_speeds_, estimate_, status_;
  ros::Timer timer_;
  std::optional<double> observed_;  // [s] the newest observation behind the plan
  spf::host::RefusalLog refusals_;
};

}  // namespace spf_empc_ros
