#include "mcap/world_recorder.hpp"

#include <nlohmann/json.hpp>
#include <ros2_messages/geometry_msgs/PoseStamped.hpp>
#include <ros2_messages/nav_msgs/OccupancyGrid.hpp>
#include <ros2_messages/nav_msgs/Odometry.hpp>
#include <ros2_messages/sensor_msgs/LaserScan.hpp>
#include <ros2_messages/spf_empc_msgs/ObstacleTracks.hpp>
#include <ros2_messages/spf_empc_msgs/TrialOutcome.hpp>
#include <ros2_messages/tf2_msgs/TFMessage.hpp>
#include <ros2_messages/visualization_msgs/MarkerArray.hpp>

#include "simulator/map_cells.hpp"
#include "simulator/scene_shapes.hpp"
#include "simulator/world_messages.hpp"

namespace spf::mcap {
namespace {

using Stamp = simulator::Stamp<ros2::builtin_interfaces::Time>;
using sim::World;

std::string topic_of(int robot, const char* name) {
  std::string topic{"/"};  // gcc 12 warns of an overflow in a sum of strings here, where there is none
  topic.append(simulator::robot_name(robot)).append("/").append(name);
  return topic;
}

}  // namespace

WorldRecorder::WorldRecorder(Recording& recording, const simulator::Settings& settings)
    : recording_{recording}, frame_{settings.frame} {
  recording_.add("/map", 0.0,
                 simulator::map_message<ros2::nav_msgs::OccupancyGrid>(
                     simulator::map_cells(settings.scenario, settings.map_resolution), frame_,
                     recording_.clock().time(0.0)));
  if (!settings.publishes_goals) return;
  const Stamp stamp{frame_, recording_.clock().time(0.0)};
  for (std::size_t i = 0; i < settings.scenario.robots.size(); ++i) {
    const sim::RobotTask& task = settings.scenario.robots[i];
    recording_.add(topic_of(static_cast<int>(i), "goal_pose"), 0.0,
                   simulator::goal_of<ros2::geometry_msgs::PoseStamped>(
                       host::Goal{task.goal_world, task.goal_heading}, task.start.heading, stamp));
  }
}

void WorldRecorder::goal(const World& world, int robot, const host::Goal& goal, double any_heading) {
  const Stamp stamp{frame_, recording_.clock().time(world.time())};
  recording_.add(topic_of(robot, "goal_pose"), world.time(),
                 simulator::goal_of<ros2::geometry_msgs::PoseStamped>(goal, any_heading, stamp));
}

void WorldRecorder::order(const World& world, const sim::FleetOrder& order) {
  recording_.add_json("/simulator/orders", "spf.Order", world.time(),
                      {{"time", world.time()}, {"robot", order.robot}, {"act", enum_name(order.act)}});
}

void WorldRecorder::pose(const World& world, int robot, const Pose2& measured) {
  const Stamp stamp{frame_, recording_.clock().time(world.time())};
  recording_.add(topic_of(robot, "odom"), world.time(),
                 simulator::odometry_of<ros2::nav_msgs::Odometry>(world, robot, measured, stamp));
}

void WorldRecorder::truth(const World& world) {
  const Stamp stamp{frame_, recording_.clock().time(world.time())};
  ros2::tf2_msgs::TFMessage message;
  message.transforms = simulator::transforms_of<ros2::geometry_msgs::TransformStamped>(world.robots(), stamp);
  recording_.add("/tf", world.time(), message);
}

void WorldRecorder::obstacles(const World& world, int robot, const std::vector<Detection>& detections) {
  const Stamp stamp{frame_, recording_.clock().time(world.time())};
  recording_.add(topic_of(robot, "obstacles"), world.time(),
                 simulator::obstacles_of<ros2::spf_empc_msgs::ObstacleTracks>(detections, stamp));
}

void WorldRecorder::scan(const World& world, int robot, const RangeScan& scan) {
  recording_.add(
      topic_of(robot, "scan"), world.time(),
      simulator::scan_of<ros2::sensor_msgs::LaserScan>(scan, world.scenario().simulation.sensing.rate, robot,
                                                       recording_.clock().time(world.time())));
}

void WorldRecorder::scene(const World& world) {
  ros2::builtin_interfaces::Duration until_gone;
  until_gone.nanosec = 500'000'000;
  recording_.add("/simulator/markers", world.time(),
                 simulator::markers_of<ros2::visualization_msgs::MarkerArray>(
                     simulator::shapes_of(simulator::scene_of(world)), frame_,
                     recording_.clock().time(world.time()), until_gone));
}

void WorldRecorder::outcome(const World& world, const sim::TrialResult& result, bool finished) {
  const Stamp stamp{frame_, recording_.clock().time(world.time())};
  recording_.add("/simulator/outcome", world.time(),
                 simulator::outcome_of<ros2::spf_empc_msgs::TrialOutcome>(result, finished, stamp));
}

}  // namespace spf::mcap
