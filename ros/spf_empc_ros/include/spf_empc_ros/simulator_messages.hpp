// A sim::World as messages of ROS 1 (simulator/world_messages.hpp).
#pragma once

#include <geometry_msgs/PoseStamped.h>
#include <geometry_msgs/TransformStamped.h>
#include <nav_msgs/OccupancyGrid.h>
#include <nav_msgs/Odometry.h>
#include <sensor_msgs/LaserScan.h>
#include <spf_empc_msgs/ObstacleTracks.h>
#include <spf_empc_msgs/TrialOutcome.h>
#include <visualization_msgs/MarkerArray.h>

#include <vector>

#include "simulator/world_messages.hpp"

namespace spf_empc_ros {

using Stamp = spf::simulator::Stamp<ros::Time>;

[[nodiscard]] nav_msgs::Odometry odometry_message(const spf::sim::World& world, int robot,
                                                  const spf::Pose2& measured, const Stamp& stamp);
[[nodiscard]] std::vector<geometry_msgs::TransformStamped> transforms(const spf::sim::World& world,
                                                                      const Stamp& stamp);
[[nodiscard]] sensor_msgs::LaserScan scan_message(const spf::RangeScan& scan, double rate, int robot,
                                                  const ros::Time& time);
[[nodiscard]] spf_empc_msgs::ObstacleTracks obstacles_message(const std::vector<spf::Detection>& detections,
                                                              const Stamp& stamp);
[[nodiscard]] geometry_msgs::PoseStamped goal_message(const spf::host::Goal& goal, double any_heading,
                                                      const Stamp& stamp);
/// The first goal of a robot; its start's heading, where any will do, spares it the turn.
[[nodiscard]] geometry_msgs::PoseStamped goal_message(const spf::sim::RobotTask& task, const Stamp& stamp);
[[nodiscard]] nav_msgs::OccupancyGrid map_message(const spf::sim::Scenario& scenario, double resolution,
                                                  const Stamp& stamp);
[[nodiscard]] visualization_msgs::MarkerArray world_markers(const spf::sim::World& world, const Stamp& stamp);
[[nodiscard]] spf_empc_msgs::TrialOutcome outcome_message(const spf::sim::TrialResult& result, bool finished,
                                                          const Stamp& stamp);

}  // namespace spf_empc_ros
