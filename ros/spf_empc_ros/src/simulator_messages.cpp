#include "spf_empc_ros/simulator_messages.hpp"

#include "simulator/map_cells.hpp"
#include "simulator/scene_shapes.hpp"

namespace spf_empc_ros {

namespace served = spf::simulator;
using spf::sim::World;

nav_msgs::Odometry odometry_message(const World& world, int robot, const spf::Pose2& measured,
                                    const Stamp& stamp) {
  return served::odometry_of<nav_msgs::Odometry>(world, robot, measured, stamp);
}

std::vector<geometry_msgs::TransformStamped> transforms(const World& world, const Stamp& stamp) {
  return served::transforms_of<geometry_msgs::TransformStamped>(world.robots(), stamp);
}

sensor_msgs::LaserScan scan_message(const spf::RangeScan& scan, double rate, int robot,
                                    const ros::Time& time) {
  return served::scan_of<sensor_msgs::LaserScan>(scan, rate, robot, time);
}

spf_empc_msgs::ObstacleTracks obstacles_message(const std::vector<spf::Detection>& detections,
                                                const Stamp& stamp) {
  return served::obstacles_of<spf_empc_msgs::ObstacleTracks>(detections, stamp);
}

geometry_msgs::PoseStamped goal_message(const spf::host::Goal& goal, double any_heading, const Stamp& stamp) {
  return served::goal_of<geometry_msgs::PoseStamped>(goal, any_heading, stamp);
}

geometry_msgs::PoseStamped goal_message(const spf::sim::RobotTask& task, const Stamp& stamp) {
  return goal_message({task.goal_world, task.goal_heading}, task.start.heading, stamp);
}

nav_msgs::OccupancyGrid map_message(const spf::sim::Scenario& scenario, double resolution,
                                    const Stamp& stamp) {
  return served::map_message<nav_msgs::OccupancyGrid>(served::map_cells(scenario, resolution), stamp.frame,
                                                      stamp.time);
}

visualization_msgs::MarkerArray world_markers(const World& world, const Stamp& stamp) {
  return served::markers_of<visualization_msgs::MarkerArray>(served::shapes_of(served::scene_of(world)),
                                                             stamp.frame, stamp.time, ros::Duration{0.5});
}

spf_empc_msgs::TrialOutcome outcome_message(const spf::sim::TrialResult& result, bool finished,
                                            const Stamp& stamp) {
  return served::outcome_of<spf_empc_msgs::TrialOutcome>(result, finished, stamp);
}

}  // namespace spf_empc_ros
