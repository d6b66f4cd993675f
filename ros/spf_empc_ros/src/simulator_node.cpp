#include "spf_empc_ros/simulator_node.hpp"

#include <ros/console.h>
#include <rosgraph_msgs/Clock.h>
#include <std_msgs/Bool.h>
#include <std_msgs/Empty.h>

#include <cmath>
#include <cstdio>

namespace spf_empc_ros {
namespace {

constexpr double kTransformPeriod = 0.02;  // [s]
constexpr double kOutcomePeriod = 1.0;     // [s]
constexpr double kTimeRounding = 1e-9;     // [s] sums of ticks are not exact

double wall_now() {
  return ros::WallTime::now().toSec();
}

/// The same scene with a range sensor on every robot, whatever the robots are told of the map.
spf::sim::Scenario with_scans(spf::sim::Scenario scenario) {
  scenario.simulation.sensing.map = spf::sim::MapKnowledge::sensed;
  return scenario;
}

std::vector<spf::RobotParameters> robots_of(const spf::sim::Scenario& scenario) {
  std::vector<spf::RobotParameters> robots;
  for (std::size_t i = 0; i < scenario.robots.size(); ++i) robots.push_back(scenario.robot_of(i));
  return robots;
}

}  // namespace

void Pace::start(double time, double wall) {
  time_ = time;
  wall_ = wall;
}

void Pace::reached(double time, double wall) {
  const double late = wall - due(time);
  if (late <= kTolerated) return;
  wall_ += late;
  lost_ += late;
  ++shifts_;
}

SimulatorNode::SimulatorNode(ros::NodeHandle node, const SimulatorConfig& config, const ros::Time& epoch)
    : node_{std::move(node)},
      config_{config},
      clock_{epoch},
      world_{with_scans(config.scenario)},
      bases_{robots_of(config.scenario), config.control_period},
      pace_{config.speed},
      robots_(config.scenario.robots.size()) {
  node_.setCallbackQueue(&queue_);
  clock_publisher_ = node_.advertise<rosgraph_msgs::Clock>("/clock", 10);
  map_ = node_.advertise<nav_msgs::OccupancyGrid>("/map", 1, true);
  markers_ = node_.advertise<visualization_msgs::MarkerArray>("/simulator/markers", 2, true);
  outcome_ = node_.advertise<spf_empc_msgs::TrialOutcome>("/simulator/outcome", 2, true);
  for (int i = 0; i < count(); ++i) connect(i);
  map_.publish(map_message(config_.scenario, config_.map_resolution, stamp()));
  if (!config_.publishes_goals) return;
  for (int i = 0; i < count(); ++i)
    robots_[static_cast<std::size_t>(i)].goal.publish(
        goal_message(config_.scenario.robots[static_cast<std::size_t>(i)], stamp()));
}

void SimulatorNode::connect(int robot) {
  const std::string name = "/" + robot_name(robot) + "/";
  Robot& topics = robots_[static_cast<std::size_t>(robot)];
  topics.odom = node_.advertise<nav_msgs::Odometry>(name + "odom", 50);
  topics.scan = node_.advertise<sensor_msgs::LaserScan>(name + "scan", 5);
  topics.obstacles = node_.advertise<spf_empc_msgs::ObstacleTracks>(name + "obstacles", 5);
  if (config_.publishes_goals)
    topics.goal = node_.advertise<geometry_msgs::PoseStamped>(name + "goal", 1, true);
  if (!config_.scenario.events.empty()) {
    topics.cancel = node_.advertise<std_msgs::Empty>(name + "cancel", 1);
    topics.pause = node_.advertise<std_msgs::Bool>(name + "pause", 1, true);
    topics.emergency_stop = node_.advertise<std_msgs::Bool>(name + "emergency_stop", 1, true);
  }
  const ros::TransportHints no_delay = ros::TransportHints().tcpNoDelay();
  if (config_.takes_wheel_speeds) {
    const boost::function<void(const spf_empc_msgs::WheelSpeeds::ConstPtr&)> take =
        [this, robot](const spf_empc_msgs::WheelSpeeds::ConstPtr& message) {
          bases_.command_wheels(robot, message->speeds, world_.time());
        };
    topics.command =
        node_.subscribe<spf_empc_msgs::WheelSpeeds>(name + "wheel_speeds", 10, take, {}, no_delay);
  } else {
    const boost::function<void(const geometry_msgs::Twist::ConstPtr&)> take = [this, robot](
                                                                                  const geometry_msgs::Twist::
                                                                                      ConstPtr& message) {
      bases_.command_twist(robot, {message->linear.x, message->linear.y, message->angular.z}, world_.time());
    };
    topics.command = node_.subscribe<geometry_msgs::Twist>(name + "cmd_vel", 10, take, {}, no_delay);
  }
}

std::string SimulatorNode::missing() const {
  std::string names;
  for (int i = 0; i < count(); ++i) {
    const Robot& robot = robots_[static_cast<std::size_t>(i)];
    const bool there = robot.command.getNumPublishers() > 0 && robot.odom.getNumSubscribers() > 0 &&
                       (!config_.publishes_goals || robot.goal.getNumSubscribers() > 0);
    if (!there) names += (names.empty() ? "" : ", ") + robot_name(i);
  }
  return names;
}

bool SimulatorNode::wait_for_robots() {
  constexpr double kSettle = 0.5;  // [s] for the rest of their connections
  double complete_since = wall_now();
  while (ros::ok()) {
    publish_clock();  // nodes begin with the first one
    const std::string names = missing();
    if (!names.empty()) {
      complete_since = wall_now();
      ROS_INFO_THROTTLE(5.0, "waiting for %s", names.c_str());
    } else if (wall_now() - complete_since >= kSettle) {
      return true;
    }
    serve_until(wall_now() + 0.1);
  }
  return false;
}

int SimulatorNode::run() {
  world_.begin_tick();
  publish_poses();
  publish_pictures();
  publish_outcome();
  if (config_.waits_for_robots && !wait_for_robots()) return config_.quits_when_done ? 1 : 0;
  ROS_INFO("%d robots, %s trial %d, speed %g", count(), config_.scenario.family.c_str(),
           config_.scenario.trial, config_.speed);
  started_ = wall_now();
  pace_.start(world_.time(), started_);
  while (ros::ok() && !(end_ && config_.quits_when_done)) tick();
  print_summary();
  if (!end_) return config_.quits_when_done ? 1 : 0;
  return end_->outcome == spf::sim::TrialOutcome::success ? 0 : 1;
}

/// The tick has begun. What is sensed goes out, commands come in, and the world moves on when it is time.
void SimulatorNode::tick() {
  if (world_.pose_due()) {
    publish_clock();
    publish_orders();
    publish_poses();
  }
  if (world_.observation_due()) publish_observations();
  if (world_.step_due()) publish_pictures();
  if (world_.time() + kTimeRounding >= next_outcome_) publish_outcome();
  serve_until(pace_.due(world_.next_time()));
  for (int i = 0; i < count(); ++i) world_.command(i, bases_.wheels(i, world_.time()));
  world_.end_tick();
  pace_.reached(world_.time(), wall_now());
  if (!end_ && world_.finished()) note_end();
  world_.begin_tick();
}

/// What people would tell the robots. Another priority is not told: nodes take theirs from their parameters.
void SimulatorNode::publish_orders() {
  using spf::sim::FleetAct;
  for (const spf::sim::FleetOrder& order : world_.orders()) {
    const auto robot = static_cast<std::size_t>(order.robot);
    const Robot& topics = robots_[robot];
    const spf::sim::RobotTruth& truth = world_.robots()[robot];
    if (order.act == FleetAct::goal && config_.publishes_goals)
      topics.goal.publish(goal_message(order.goal, truth.pose.heading, stamp()));
    if (order.act == FleetAct::cancel) topics.cancel.publish(std_msgs::Empty{});
    std_msgs::Bool on;
    on.data = order.act == FleetAct::pause || order.act == FleetAct::stop ? 1 : 0;
    if (order.act == FleetAct::pause || order.act == FleetAct::resume) topics.pause.publish(on);
    if (order.act == FleetAct::stop || order.act == FleetAct::release) topics.emergency_stop.publish(on);
  }
}

void SimulatorNode::serve_until(double wall) {
  queue_.callAvailable();
  for (double left = wall - wall_now(); left > 0.0 && ros::ok(); left = wall - wall_now())
    queue_.callAvailable(ros::WallDuration{left});
}

bool SimulatorNode::dropped(FaultyTopic topic, int robot) const {
  for (const Fault& fault : config_.faults)
    if (fault.topic == topic && fault.robot == robot && fault.from <= world_.time() &&
        world_.time() < fault.to)
      return true;
  return false;
}

void SimulatorNode::publish_clock() {
  rosgraph_msgs::Clock message;
  message.clock = stamp().time;
  clock_publisher_.publish(message);
}

void SimulatorNode::publish_poses() {
  for (int i = 0; i < count(); ++i) {
    if (!world_.robots()[static_cast<std::size_t>(i)].active()) continue;
    const spf::PoseMeasurement measured = world_.measure_pose(i);
    if (dropped(FaultyTopic::odom, i)) continue;
    robots_[static_cast<std::size_t>(i)].odom.publish(
        odometry_message(world_, i, measured.pose_world, stamp()));
  }
  if (world_.time() + kTimeRounding < next_transform_) return;
  next_transform_ += kTransformPeriod;
  transforms_.sendTransform(transforms(world_, stamp()));
}

void SimulatorNode::publish_observations() {
  using spf::sim::DetectionQuality;
  const bool reports = config_.scenario.simulation.sensing.detections != DetectionQuality::scan;
  for (int i = 0; i < count(); ++i) {
    const Robot& robot = robots_[static_cast<std::size_t>(i)];
    if (!world_.robots()[static_cast<std::size_t>(i)].active()) continue;
    world_.observe(i, observation_);
    if (reports && !dropped(FaultyTopic::obstacles, i))
      robot.obstacles.publish(obstacles_message(observation_.detections, stamp()));
    if (!dropped(FaultyTopic::scan, i))
      robot.scan.publish(
          scan_message(*observation_.scan, config_.scenario.simulation.sensing.rate, i, stamp().time));
  }
}

void SimulatorNode::publish_pictures() {
  markers_.publish(world_markers(world_, stamp()));
}

void SimulatorNode::publish_outcome() {
  next_outcome_ = world_.time() + kOutcomePeriod;
  outcome_.publish(outcome_message(end_ ? *end_ : world_.result(), end_.has_value(), stamp()));
}

void SimulatorNode::note_end() {
  end_ = world_.result();
  const spf_empc_msgs::TrialOutcome message = outcome_message(*end_, true, stamp());
  outcome_.publish(message);
  publish_pictures();
  ROS_INFO("trial %d: %s after %.2f s, %u of %u robots at goal%s%s", config_.scenario.trial,
           to_string(end_->outcome), message.duration, message.arrived, message.robots,
           message.cause.empty() ? "" : ": ", message.cause.c_str());
  if (config_.quits_when_done) serve_until(wall_now() + 0.5);  // so that the last messages leave
}

/// Not by rosout, which is gone when ROS has shut down.
void SimulatorNode::print_summary() const {
  const double wall = wall_now() - started_;
  std::printf("simulated %.2f s in %.2f s; the clock was shifted %ld times, by %.3f s in all\n",
              world_.time(), wall, pace_.shifts(), pace_.lost());
  for (int i = 0; i < count(); ++i) {
    const CommandRecord& record = bases_.record(i);
    std::printf("%s: %ld commands, %ld late, longest gap %.3f s, %ld beyond the wheels, %ld refused\n",
                robot_name(i).c_str(), record.count, record.late, record.longest_gap, record.cut,
                record.refused);
  }
  std::fflush(stdout);
}

}  // namespace spf_empc_ros
