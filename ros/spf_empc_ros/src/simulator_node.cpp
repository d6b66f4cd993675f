#include "spf_empc_ros/simulator_node.hpp"

#include <ros/console.h>
#include <rosgraph_msgs/Clock.h>
#include <std_msgs/Bool.h>
#include <std_msgs/Empty.h>

#include <cstdio>

namespace spf_empc_ros {

using spf::sim::World;
using spf::simulator::robot_name;

SimulatorNode::SimulatorNode(ros::NodeHandle node, const spf::simulator::Settings& settings,
                             const ros::Time& epoch)
    : node_{std::move(node)}, server_{settings}, clock_{epoch}, robots_(settings.scenario.robots.size()) {
  node_.setCallbackQueue(&queue_);
  clock_publisher_ = node_.advertise<rosgraph_msgs::Clock>("/clock", 10);
  map_ = node_.advertise<nav_msgs::OccupancyGrid>("/map", 1, true);
  markers_ = node_.advertise<visualization_msgs::MarkerArray>("/simulator/markers", 2, true);
  outcome_ = node_.advertise<spf_empc_msgs::TrialOutcome>("/simulator/outcome", 2, true);
  const int count = static_cast<int>(robots_.size());
  for (int i = 0; i < count; ++i) connect(i);
  map_.publish(map_message(settings.scenario, settings.map_resolution, stamp()));
  if (!settings.publishes_goals) return;
  for (std::size_t i = 0; i < robots_.size(); ++i)
    robots_[i].goal.publish(goal_message(settings.scenario.robots[i], stamp()));
}

void SimulatorNode::connect(int robot) {
  const std::string name = "/" + robot_name(robot) + "/";
  Robot& topics = robots_[static_cast<std::size_t>(robot)];
  topics.odom = node_.advertise<nav_msgs::Odometry>(name + "odom", 50);
  topics.scan = node_.advertise<sensor_msgs::LaserScan>(name + "scan", 5);
  topics.obstacles = node_.advertise<spf_empc_msgs::ObstacleTracks>(name + "obstacles", 5);
  if (settings().publishes_goals)
    topics.goal = node_.advertise<geometry_msgs::PoseStamped>(name + "goal", 1, true);
  if (!settings().scenario.events.empty()) {
    topics.cancel = node_.advertise<std_msgs::Empty>(name + "cancel", 1);
    topics.pause = node_.advertise<std_msgs::Bool>(name + "pause", 1, true);
    topics.emergency_stop = node_.advertise<std_msgs::Bool>(name + "emergency_stop", 1, true);
  }
  listen(robot, name);
}

void SimulatorNode::listen(int robot, const std::string& name) {
  ros::Subscriber& command = robots_[static_cast<std::size_t>(robot)].command;
  const ros::TransportHints no_delay = ros::TransportHints().tcpNoDelay();
  if (settings().takes_wheel_speeds) {
    const boost::function<void(const spf_empc_msgs::WheelSpeeds::ConstPtr&)> take =
        [this, robot](const spf_empc_msgs::WheelSpeeds::ConstPtr& message) {
          server_.command_wheels(robot, message->speeds);
        };
    command = node_.subscribe<spf_empc_msgs::WheelSpeeds>(name + "wheel_speeds", 10, take, {}, no_delay);
    return;
  }
  const boost::function<void(const geometry_msgs::Twist::ConstPtr&)> take =
      [this, robot](const geometry_msgs::Twist::ConstPtr& message) {
        server_.command_twist(robot, {message->linear.x, message->linear.y, message->angular.z});
      };
  command = node_.subscribe<geometry_msgs::Twist>(name + "cmd_vel", 10, take, {}, no_delay);
}

bool SimulatorNode::is_there(int robot) const {
  const Robot& topics = robots_[static_cast<std::size_t>(robot)];
  return topics.command.getNumPublishers() > 0 && topics.odom.getNumSubscribers() > 0 &&
         (!settings().publishes_goals || topics.goal.getNumSubscribers() > 0);
}

int SimulatorNode::run() {
  const int status = server_.run(*this);
  // Not by rosout, which is gone when ROS has shut down.
  std::printf("%s", server_.timing().c_str());
  std::fflush(stdout);
  return status;
}

double SimulatorNode::wall() const {
  return ros::WallTime::now().toSec();
}

bool SimulatorNode::serve_until(double until) {
  queue_.callAvailable();
  for (double left = until - wall(); left > 0.0 && ros::ok(); left = until - wall())
    queue_.callAvailable(ros::WallDuration{left});
  return ros::ok();
}

void SimulatorNode::say(const std::string& text) {
  ROS_INFO("%s", text.c_str());
}

void SimulatorNode::clock(const World&) {
  rosgraph_msgs::Clock message;
  message.clock = stamp().time;
  clock_publisher_.publish(message);
}

void SimulatorNode::goal(const World&, int robot, const spf::host::Goal& goal, double any_heading) {
  robots_[static_cast<std::size_t>(robot)].goal.publish(goal_message(goal, any_heading, stamp()));
}

void SimulatorNode::order(const World&, const spf::sim::FleetOrder& order) {
  using spf::sim::FleetAct;
  const Robot& topics = robots_[static_cast<std::size_t>(order.robot)];
  if (order.act == FleetAct::cancel) return topics.cancel.publish(std_msgs::Empty{});
  std_msgs::Bool on;
  on.data = order.act == FleetAct::pause || order.act == FleetAct::stop ? 1 : 0;
  const bool pauses = order.act == FleetAct::pause || order.act == FleetAct::resume;
  (pauses ? topics.pause : topics.emergency_stop).publish(on);
}

void SimulatorNode::pose(const World& world, int robot, const spf::Pose2& measured) {
  robots_[static_cast<std::size_t>(robot)].odom.publish(odometry_message(world, robot, measured, stamp()));
}

void SimulatorNode::truth(const World& world) {
  transforms_.sendTransform(transforms(world, stamp()));
}

void SimulatorNode::obstacles(const World&, int robot, const std::vector<spf::Detection>& detections) {
  robots_[static_cast<std::size_t>(robot)].obstacles.publish(obstacles_message(detections, stamp()));
}

void SimulatorNode::scan(const World&, int robot, const spf::RangeScan& scan) {
  robots_[static_cast<std::size_t>(robot)].scan.publish(
      scan_message(scan, settings().scenario.simulation.sensing.rate, robot, stamp().time));
}

void SimulatorNode::scene(const World& world) {
  markers_.publish(world_markers(world, stamp()));
}

void SimulatorNode::outcome(const World&, const spf::sim::TrialResult& result, bool finished) {
  outcome_.publish(outcome_message(result, finished, stamp()));
}

}  // namespace spf_empc_ros
