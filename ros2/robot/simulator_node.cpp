#include "ros2/robot/simulator_node.hpp"

#include <chrono>
#include <cstdio>
#include <ros2_messages/diagnostic_msgs/DiagnosticArray.hpp>
#include <ros2_messages/geometry_msgs/Twist.hpp>
#include <ros2_messages/nav_msgs/Path.hpp>
#include <ros2_messages/spf_empc_msgs/RobotStatus.hpp>
#include <ros2_messages/spf_empc_msgs/TrackerStatus.hpp>
#include <ros2_messages/spf_empc_msgs/Trajectory.hpp>
#include <ros2_messages/spf_empc_msgs/WheelSpeeds.hpp>

#include "ros2/robot/topics.hpp"
#include "simulator/map_cells.hpp"
#include "simulator/scene_shapes.hpp"

namespace spf_ros2 {

using ros2::Qos;
using spf::as_index;
using spf::sim::World;

SimulatorNode::SimulatorNode(ros2::Node& node, ros2::Executor& executor, const ros2::StopSwitch& stop,
                             const spf::simulator::Settings& settings, const std::string& mcap)
    : node_{node},
      executor_{executor},
      stop_{stop},
      server_{settings},
      clock_{ros2::Clock::wall()},
      robots_(settings.scenario.robots.size()),
      clock_publisher_{node.advertise<ros2::rosgraph_msgs::Clock>("/clock", Qos::keep_last(10))},
      map_{node.advertise<ros2::nav_msgs::OccupancyGrid>("/map", kMaps)},
      transforms_{node.advertise<ros2::tf2_msgs::TFMessage>("/tf", Qos::keep_last(100))},
      markers_{node.advertise<ros2::visualization_msgs::MarkerArray>("/simulator/markers", Qos::latched(2))},
      outcome_{node.advertise<ros2::spf_empc_msgs::TrialOutcome>("/simulator/outcome", Qos::latched(2))} {
  for (std::size_t i = 0; i < robots_.size(); ++i) connect(static_cast<int>(i));
  const spf::simulator::MapCells cells =
      spf::simulator::map_cells(settings.scenario, settings.map_resolution);
  map_.publish(
      spf::simulator::map_message<ros2::nav_msgs::OccupancyGrid>(cells, settings.frame, stamp().time));
  if (!mcap.empty()) record(mcap);
}

void SimulatorNode::record(const std::string& mcap) {
  const ros2::Nanoseconds epoch = ros2::nanoseconds_of(clock_.time(0.0));
  recording_.emplace(mcap, spf::mcap::RecordClock{static_cast<std::uint64_t>(epoch)});
  recorder_.emplace(*recording_, settings());
  server_.record_by(*recorder_);
  const Qos often = Qos::keep_last(20);
  for (std::size_t i = 0; i < robots_.size(); ++i) {
    const std::string name = "/" + spf::simulator::robot_name(static_cast<int>(i)) + "/";
    record_topic<ros2::nav_msgs::Path>(name + "path", often);
    record_topic<ros2::visualization_msgs::MarkerArray>(name + "markers", often);
    record_topic<ros2::nav_msgs::OccupancyGrid>(name + "grid", kMaps);
    record_topic<ros2::spf_empc_msgs::RobotStatus>(name + "status", often);
    record_topic<ros2::spf_empc_msgs::TrackerStatus>(name + "tracker_status", often);
    record_topic<ros2::spf_empc_msgs::ObstacleTracks>(name + "tracks", often);
  }
  record_topic<ros2::diagnostic_msgs::DiagnosticArray>("/diagnostics", Qos::keep_last(100));
  record_topic<ros2::spf_empc_msgs::Trajectory>("/swarm/trajectories", kPeers);
}

void SimulatorNode::connect(int robot) {
  const std::string name = "/" + spf::simulator::robot_name(robot) + "/";
  Robot& topics = robots_[as_index(robot)];
  topics.odom = node_.advertise<ros2::nav_msgs::Odometry>(name + "odom", Qos::keep_last(50));
  topics.scan = node_.advertise<ros2::sensor_msgs::LaserScan>(name + "scan", Qos::keep_last(5));
  topics.obstacles =
      node_.advertise<ros2::spf_empc_msgs::ObstacleTracks>(name + "obstacles", Qos::keep_last(5));
  if (settings().publishes_goals)
    topics.goal = node_.advertise<ros2::geometry_msgs::PoseStamped>(name + "goal_pose", Qos::latched());
  if (!settings().scenario.events.empty()) {
    topics.cancel = node_.advertise<ros2::std_msgs::Empty>(name + "cancel", Qos::keep_last(1));
    topics.pause = node_.advertise<ros2::std_msgs::Bool>(name + "pause", Qos::latched());
    topics.emergency_stop = node_.advertise<ros2::std_msgs::Bool>(name + "emergency_stop", Qos::latched());
  }
  if (settings().takes_wheel_speeds)
    topics.command = &node_.subscribe<ros2::spf_empc_msgs::WheelSpeeds>(
        name + "wheel_speeds", Qos::keep_last(10),
        [this, robot](const auto& message) { server_.command_wheels(robot, message.speeds); });
  else
    topics.command = &node_.subscribe<ros2::geometry_msgs::Twist>(
        name + "cmd_vel", Qos::keep_last(10), [this, robot](const auto& message) {
          server_.command_twist(robot, {message.linear.x, message.linear.y, message.angular.z});
        });
}

bool SimulatorNode::is_there(int robot) const {
  const Robot& topics = robots_[as_index(robot)];
  return topics.command->matched() > 0 && topics.odom.subscribers() > 0 &&
         (!settings().publishes_goals || topics.goal.subscribers() > 0);
}

/// Planners do not hear what was said before they came.
void SimulatorNode::begin(const World& world) {
  if (!settings().publishes_goals) return;
  for (std::size_t i = 0; i < robots_.size(); ++i) {
    const spf::sim::RobotTask& task = settings().scenario.robots[i];
    goal(world, static_cast<int>(i), {task.goal_world, task.goal_heading}, task.start.heading);
  }
}

int SimulatorNode::run() {
  const int status = server_.run(*this);
  if (recording_) recording_->close();
  std::printf("%s\n%s", server_.summary().c_str(), server_.timing().c_str());
  std::fflush(stdout);
  return status;
}

double SimulatorNode::wall() const {
  return std::chrono::duration<double>{std::chrono::steady_clock::now().time_since_epoch()}.count();
}

bool SimulatorNode::serve_until(double until) {
  executor_.spin_once(0.0);
  for (double left = until - wall(); left > 0.0 && !stop_.stopped(); left = until - wall())
    executor_.spin_once(left);
  return !stop_.stopped();
}

void SimulatorNode::clock(const World&) {
  ros2::rosgraph_msgs::Clock message;
  message.clock = stamp().time;
  clock_publisher_.publish(message);
}

void SimulatorNode::goal(const World&, int robot, const spf::host::Goal& goal, double any_heading) {
  robots_[as_index(robot)].goal.publish(
      spf::simulator::goal_of<ros2::geometry_msgs::PoseStamped>(goal, any_heading, stamp()));
}

void SimulatorNode::order(const World&, const spf::sim::FleetOrder& order) {
  using spf::sim::FleetAct;
  const Robot& topics = robots_[as_index(order.robot)];
  if (order.act == FleetAct::cancel) return topics.cancel.publish({});
  ros2::std_msgs::Bool on;
  on.data = order.act == FleetAct::pause || order.act == FleetAct::stop;
  const bool pauses = order.act == FleetAct::pause || order.act == FleetAct::resume;
  (pauses ? topics.pause : topics.emergency_stop).publish(on);
}

void SimulatorNode::pose(const World& world, int robot, const spf::Pose2& measured) {
  robots_[as_index(robot)].odom.publish(
      spf::simulator::odometry_of<ros2::nav_msgs::Odometry>(world, robot, measured, stamp()));
}

void SimulatorNode::truth(const World& world) {
  transforms_.publish(
      {spf::simulator::transforms_of<ros2::geometry_msgs::TransformStamped>(world.robots(), stamp())});
}

void SimulatorNode::obstacles(const World&, int robot, const std::vector<spf::Detection>& detections) {
  robots_[as_index(robot)].obstacles.publish(
      spf::simulator::obstacles_of<ros2::spf_empc_msgs::ObstacleTracks>(detections, stamp()));
}

void SimulatorNode::scan(const World&, int robot, const spf::RangeScan& scan) {
  robots_[as_index(robot)].scan.publish(spf::simulator::scan_of<ros2::sensor_msgs::LaserScan>(
      scan, settings().scenario.simulation.sensing.rate, robot, stamp().time));
}

void SimulatorNode::scene(const World& world) {
  ros2::builtin_interfaces::Duration until_gone;
  until_gone.nanosec = 500'000'000;
  markers_.publish(spf::simulator::markers_of<ros2::visualization_msgs::MarkerArray>(
      spf::simulator::shapes_of(spf::simulator::scene_of(world)), settings().frame, stamp().time,
      until_gone));
}

void SimulatorNode::outcome(const World&, const spf::sim::TrialResult& result, bool finished) {
  outcome_.publish(spf::simulator::outcome_of<ros2::spf_empc_msgs::TrialOutcome>(result, finished, stamp()));
}

}  // namespace spf_ros2
