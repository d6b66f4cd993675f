// host::PlannerProcess on ROS 2: poses, what the wheels are told, observations, peers' trajectories and goals
// in; the robot's own trajectory, its broadcast, status and pictures out. Topics: docs/ros2.md.
#pragma once

#include <optional>
#include <ros2_messages/nav2_msgs/SpeedLimit.hpp>
#include <ros2_messages/nav_msgs/OccupancyGrid.hpp>
#include <ros2_messages/nav_msgs/Odometry.hpp>
#include <ros2_messages/nav_msgs/Path.hpp>
#include <ros2_messages/spf_empc_msgs/Observation.hpp>
#include <ros2_messages/spf_empc_msgs/ObstacleTracks.hpp>
#include <ros2_messages/spf_empc_msgs/RobotStatus.hpp>
#include <ros2_messages/spf_empc_msgs/Trajectory.hpp>
#include <ros2_messages/spf_empc_msgs/WheelSpeeds.hpp>
#include <ros2_messages/visualization_msgs/MarkerArray.hpp>
#include <string>

#include "host/split_host.hpp"
#include "ros2/robot/brake_switches.hpp"
#include "ros2/robot/clock_edge.hpp"
#include "ros2/robot/diagnostics.hpp"
#include "ros2/robot/frames.hpp"
#include "ros2/robot/goals.hpp"
#include "ros2/robot/robot_config.hpp"
#include "ros2/robot/run_time_parameters.hpp"

namespace spf_ros2 {

class PlannerNode {
 public:
  /// `node` is in the robot's namespace, and served by one thread.
  PlannerNode(ros2::Node& node, const RobotConfig& config, ros2::Nanoseconds start);
  PlannerNode(const PlannerNode&) = delete;
  PlannerNode& operator=(const PlannerNode&) = delete;

 private:
  void listen();
  void on_pose(const ros2::nav_msgs::Odometry& odometry);
  void on_wheels(const ros2::spf_empc_msgs::WheelSpeeds& wheels);
  void on_observation(const ros2::spf_empc_msgs::Observation& observation);
  void on_peer(const ros2::spf_empc_msgs::Trajectory& message);
  void on_map(const ros2::nav_msgs::OccupancyGrid& map);
  void on_speed_limit(const ros2::nav2_msgs::SpeedLimit& limit);
  void reconfigure(const RunTimeSettings& settings);
  void step();
  void publish_plan(const spf::host::PlannerOutput& output);
  void publish_status(double plan_ms);
  void publish_pictures(double now);
  void publish_grid();
  void report();
  [[nodiscard]] Diagnostics::Values values(double now) const;
  void refuse(const char* what, const std::string& why, bool harmless = false);
  [[nodiscard]] double now() const { return clock_.seconds(node_.clock().now()); }

  ros2::Node& node_;
  RobotConfig config_;
  ClockEdge clock_;
  spf::host::PlannerProcess host_;
  Frames frames_;
  Diagnostics diagnostics_;
  BrakeSwitches switches_;
  spf::host::RefusalLog refusals_;
  Goals goals_;
  ros2::Publisher<ros2::spf_empc_msgs::Trajectory> trajectory_, broadcast_;
  ros2::Publisher<ros2::spf_empc_msgs::RobotStatus> status_;
  double next_status_ = 0.0;  // [s]
  struct {
    ros2::Publisher<ros2::nav_msgs::Path> path;
    ros2::Publisher<ros2::visualization_msgs::MarkerArray> markers;
    ros2::Publisher<ros2::nav_msgs::OccupancyGrid> grid;
    ros2::Publisher<ros2::spf_empc_msgs::ObstacleTracks> tracks;
    double next = 0.0;                            // [s] of path and markers
    double next_grid = 0.0;                       // [s] when the grid may be shown again
    std::optional<std::uint64_t> shown_revision;  // of the map that was
  } pictures_;
  std::optional<ros2::nav_msgs::OccupancyGrid> given_map_;
  RunTimeParameters run_time_;
};

}  // namespace spf_ros2
