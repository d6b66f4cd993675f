// A sim::World as messages: what localisation, a scanner, an outside tracker and a map server would publish,
// and the pictures of what is true. Frame: the fleet's; stamps: the caller's clock.
#pragma once

#include <geometry_msgs/PoseStamped.h>
#include <geometry_msgs/TransformStamped.h>
#include <nav_msgs/OccupancyGrid.h>
#include <nav_msgs/Odometry.h>
#include <sensor_msgs/LaserScan.h>
#include <spf_empc_msgs/ObstacleTracks.h>
#include <spf_empc_msgs/TrialOutcome.h>
#include <visualization_msgs/MarkerArray.h>

#include <string>
#include <vector>

#include "sim/world.hpp"

namespace spf_empc_ros {

/// Where a message belongs: the fleet's frame, and its time.
struct Stamp {
  std::string frame;
  ros::Time time;
};

/// robotK, and the frame of its base.
[[nodiscard]] std::string robot_name(int robot);
[[nodiscard]] std::string base_frame(int robot);

/// A measured pose, with the true motion of the body and the noise as covariance.
[[nodiscard]] nav_msgs::Odometry odometry_message(const spf::sim::World& world, int robot,
                                                  const spf::Pose2& measured, const Stamp& stamp);
/// The true pose of every robot's base.
[[nodiscard]] std::vector<geometry_msgs::TransformStamped> transforms(const spf::sim::World& world,
                                                                      const Stamp& stamp);
[[nodiscard]] sensor_msgs::LaserScan scan_message(const spf::RangeScan& scan, double rate, int robot,
                                                  const ros::Time& time);
/// Detections as an outside tracker tells them: exact ones with covariance 0, others with their position's
/// variance and no velocity.
[[nodiscard]] spf_empc_msgs::ObstacleTracks obstacles_message(const std::vector<spf::Detection>& detections,
                                                              const Stamp& stamp);
/// A message has no "any heading": where the goal has none it has `any_heading` [rad].
[[nodiscard]] geometry_msgs::PoseStamped goal_message(const spf::host::Goal& goal, double any_heading,
                                                      const Stamp& stamp);
/// The first goal of a robot; its start's heading, where any will do, spares it the turn.
[[nodiscard]] geometry_msgs::PoseStamped goal_message(const spf::sim::RobotTask& task, const Stamp& stamp);

/// The map that the robots are given: the border's inside (or all there is, where the scene is open), with
/// the static shapes when the scenario says that they are known. A cell is occupied when its centre is.
[[nodiscard]] nav_msgs::OccupancyGrid map_message(const spf::sim::Scenario& scenario, double resolution,
                                                  const Stamp& stamp);

/// Everything as it truly is.
[[nodiscard]] visualization_msgs::MarkerArray world_markers(const spf::sim::World& world, const Stamp& stamp);

/// How the trial stands, or how it ended.
[[nodiscard]] spf_empc_msgs::TrialOutcome outcome_message(const spf::sim::TrialResult& result, bool finished,
                                                          const Stamp& stamp);

}  // namespace spf_empc_ros
