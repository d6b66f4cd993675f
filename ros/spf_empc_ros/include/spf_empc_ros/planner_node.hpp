// host::PlannerProcess on ROS: poses, what the wheels are told, observations, peers' trajectories and goals
// in; the robot's own trajectory, its broadcast, status and pictures out. Topics: docs/ros.md.
#pragma once

#include <nav_msgs/OccupancyGrid.h>
#include <nav_msgs/Odometry.h>
#include <ros/message_event.h>
#include <ros/node_handle.h>
#include <ros/publisher.h>
#include <ros/subscriber.h>
#include <ros/timer.h>
#include <spf_empc_msgs/Observation.h>
#include <spf_empc_msgs/Trajectory.h>
#include <spf_empc_msgs/WheelSpeeds.h>

#include <optional>
#include <string>
#include <vector>

#include "host/split_host.hpp"
#include "spf_empc_ros/clock_edge.hpp"
#include "spf_empc_ros/diagnostics.hpp"
#include "spf_empc_ros/frames.hpp"
#include "spf_empc_ros/goal_server.hpp"
#include "spf_empc_ros/parameter_store.hpp"
#include "spf_empc_ros/reconfigure_server.hpp"
#include "spf_empc_ros/robot_config.hpp"
#include "spf_empc_ros/stop_switch.hpp"

namespace spf_empc_ros {

class PlannerNode {
 public:
  /// `node` is in the robot's namespace; its callback queue must be served by one thread.
  PlannerNode(ros::NodeHandle node, const RobotConfig& config, const ros::Time& start);

 private:
  void on_pose(const nav_msgs::Odometry::ConstPtr& odometry);
  void on_wheels(const spf_empc_msgs::WheelSpeeds::ConstPtr& wheels);
  void on_observation(const spf_empc_msgs::Observation::ConstPtr& observation);
  void on_peer(const ros::MessageEvent<spf_empc_msgs::Trajectory const>& event);
  void on_map(const nav_msgs::OccupancyGrid::ConstPtr& map);
  void reconfigure(const RunTimeSettings& settings);
  void step();
  void publish_plan(const spf::host::PlannerOutput& output);
  void publish_status(const ros::Time& now, double plan_ms);
  void publish_pictures(double now);
  void publish_grid(const ros::Time& now);
  void report(const ros::Time& now);
  void refuse(const char* what, const std::string& why, bool harmless = false);
  [[nodiscard]] double now() const { return clock_.seconds(ros::Time::now()); }

  ros::NodeHandle node_;
  RobotConfig config_;
  ClockEdge clock_;
  spf::host::PlannerProcess host_;
  Frames frames_;
  Diagnostics diagnostics_;
  StopSwitch switch_;
  spf::host::RefusalLog refusals_;
  ros::NodeHandle own_;  // the private namespace, on the same queue
  ParameterStore store_;
  GoalServer goals_;
  ReconfigureServer reconfigure_;
  std::vector<ros::Subscriber> subscribers_;
  ros::Publisher trajectory_, broadcast_, status_;
  ros::Timer timer_;
  double next_status_ = 0.0;  // [s]
  struct {
    ros::Publisher path, markers, grid, tracks;
    double next = 0.0;                            // [s] of path and markers
    double next_grid = 0.0;                       // [s] when the grid may be shown again
    std::optional<std::uint64_t> shown_revision;  // of the map that was
  } pictures_;
  nav_msgs::OccupancyGrid::ConstPtr given_map_;
};

}  // namespace spf_empc_ros
