#include "ros2/robot/tracker_node.hpp"

#include <chrono>
#include <cmath>
#include <utility>

#include "ros2/robot/pose_input.hpp"
#include "ros2/robot/topics.hpp"
#include "wire/sensing.hpp"
#include "wire/trajectory.hpp"

namespace spf_ros2 {
namespace {

using ros2::nav_msgs::Odometry;
using ros2::sensor_msgs::LaserScan;
using ros2::spf_empc_msgs::RobotStatus;
using ros2::spf_empc_msgs::TrackerStatus;
using ros2::spf_empc_msgs::Trajectory;
using ros2::spf_empc_msgs::WheelSpeeds;

ros2::geometry_msgs::Pose2D pose2d(double x, double y, double theta) {
  ros2::geometry_msgs::Pose2D pose;
  pose.x = x;
  pose.y = y;
  pose.theta = theta;
  return pose;
}

ros2::geometry_msgs::Twist twist_of(const Eigen::Vector3d& twist_body) {
  ros2::geometry_msgs::Twist twist;
  twist.linear.x = twist_body.x();
  twist.linear.y = twist_body.y();
  twist.angular.z = twist_body.z();
  return twist;
}

/// What the tracker does, in one word or two.
std::string mode_of(const spf::host::TrackerCommand& command) {
  return command.stop == spf::StopCause::none ? "tracking" : to_string(command.stop);
}

std::string guard_text(const spf::host::ScanGuard* guard, double now) {
  if (guard == nullptr) return "off";
  if (!guard->sees(now)) return "no scan";
  return to_string(guard->verdict().action);
}

}  // namespace

TrackerNode::TrackerNode(ros2::Node& node, const RobotConfig& config, ros2::Nanoseconds start)
    : node_{node},
      config_{config},
      clock_{start},
      host_{config.robot_id, config.agent, config.file.host},
      frames_{node, config.agent.team.stale_time},
      diagnostics_{node, config_, "tracker", clock_},
      switches_{node,
                [this](bool paused, bool stop) {
                  host_.tracker().set_switches({stop, paused});
                }},
      stamped_{node.parameters().declare_as("stamped_cmd_vel", false,
                                            {"cmd_vel is a TwistStamped", true, {}, {}})},
      wheel_speeds_{node.advertise<WheelSpeeds>("wheel_speeds", kCommands)},
      estimate_{node.advertise<Odometry>("estimate", ros2::Qos::keep_last(5))},
      status_{node.advertise<TrackerStatus>("tracker_status", ros2::Qos::keep_last(20))} {
  if (stamped_)
    stamped_twist_ = node.advertise<ros2::geometry_msgs::TwistStamped>("cmd_vel", kCommands);
  else
    twist_ = node.advertise<ros2::geometry_msgs::Twist>("cmd_vel", kCommands);
  listen();
  node.every(config_.agent.tracker.control_period, [this] { step(); });
}

void TrackerNode::listen() {
  node_.subscribe<Odometry>("odom", kPoses, [this](const Odometry& odometry) { on_pose(odometry); });
  node_.subscribe<Trajectory>("trajectory", ros2::Qos::keep_last(5),
                              [this](const Trajectory& plan) { on_plan(plan); });
  // The limit of speed that its plans keep to now: commands keep to it as well.
  node_.subscribe<RobotStatus>("status", ros2::Qos::keep_last(2), [this](const RobotStatus& status) {
    host_.tracker().set_speed_limit(status.max_speed);
  });
  if (host_.tracker().guard() != nullptr)
    node_.subscribe<LaserScan>("scan", kScans, [this](const LaserScan& scan) { on_scan(scan); });
}

TrackerNode::~TrackerNode() {
  try {
    time_ = node_.clock().now();
    publish_twist(Eigen::Vector3d::Zero());
  } catch (const ros2::DdsError&) {  // nobody can be told any more
  }
}

void TrackerNode::refuse(const char* what, const std::string& why, bool harmless) {
  refusals_.note(what, why, now(), harmless);
  node_.log().warn_now_and_then(refusals_.last());
}

// ---- in

void TrackerNode::on_pose(const Odometry& odometry) {
  const std::optional<PoseRefusal> refusal =
      take_pose(odometry, frames_, clock_, config_.frame, host_, [this] { return now(); });
  if (refusal) refuse("odom", refusal->why, refusal->harmless);
}

void TrackerNode::on_plan(const Trajectory& trajectory) {
  const Converted<spf::wire::StampedTrajectory> received =
      spf::wire::read_trajectory(trajectory, clock_, config_.frame);
  if (!received) {
    host_.tracker().count_refused_plan();
    return refuse("trajectory", received.refusal);
  }
  const spf::host::PlanVerdict verdict = host_.add_plan(received->message, now());
  if (verdict != spf::host::PlanVerdict::accepted)
    return refuse("trajectory", to_string(verdict), verdict == spf::host::PlanVerdict::late);
  observed_ = received->observed;
}

/// As it comes from the driver, for the guard: by no other node.
void TrackerNode::on_scan(const LaserScan& scan) {
  const auto scanner = frames_.pose_in_space(scan.header, config_.base_frame);
  if (!scanner) return refuse("scan", scanner.refusal);
  Converted<spf::host::DriverScan> driver = spf::wire::read_driver_scan(scan, *scanner);
  if (!driver) return refuse("scan", driver.refusal);
  spf::host::DriverScan& plain = *driver.value;
  make_plain(plain, config_.file.host.no_return);
  if (!host_.add_scan(clock_.seconds(scan.header.stamp), plain.scan, plain.mount.in_body, now()))
    refuse("scan", "malformed, half blind, or not of the present");
}

// ---- out

void TrackerNode::step() {
  const auto begun = std::chrono::steady_clock::now();
  time_ = node_.clock().now();
  const spf::host::TrackerCommand& command = host_.step(now());
  const std::chrono::duration<double> control = std::chrono::steady_clock::now() - begun;
  publish_command(command);
  publish_estimate(command);
  publish_status(command, 1e6 * control.count());
  report();
  time_ = 0;
}

void TrackerNode::publish_twist(const Eigen::Vector3d& twist_body) const {
  if (!stamped_) return twist_.publish(twist_of(twist_body));
  ros2::geometry_msgs::TwistStamped message;
  message.header.stamp = stamp();
  message.header.frame_id = config_.base_frame;
  message.twist = twist_of(twist_body);
  stamped_twist_.publish(message);
}

void TrackerNode::publish_command(const spf::host::TrackerCommand& command) {
  publish_twist(command.twist_body);
  WheelSpeeds wheels;
  spf::wire::fill(command.wheel_speeds, host_.tracker().max_wheel_speed(), wheels);
  wheels.header.stamp = stamp();
  wheels.header.frame_id = config_.base_frame;
  wheels.guard = static_cast<std::uint8_t>(command.guard.action);
  wheel_speeds_.publish(wheels);
}

void TrackerNode::publish_estimate(const spf::host::TrackerCommand& command) {
  if (!command.estimate.valid || estimate_.subscribers() == 0) return;
  Odometry message;
  message.header.stamp = stamp();
  message.header.frame_id = config_.frame;
  message.child_frame_id = config_.base_frame;
  spf::wire::fill(command.estimate.pose_world, message.pose.pose);
  message.pose.covariance[0] = message.pose.covariance[7] = command.estimate.position_variance;
  message.pose.covariance[35] = command.estimate.heading_variance;
  message.twist.twist = twist_of(command.twist_body);
  estimate_.publish(message);
}

void TrackerNode::publish_status(const spf::host::TrackerCommand& command, double control_us) {
  TrackerStatus message;
  message.header.stamp = stamp();
  message.header.frame_id = config_.frame;
  message.robot_id = static_cast<std::uint32_t>(config_.robot_id);
  message.mode = mode_of(command);
  const spf::Pose2& here = command.estimate.pose_world;
  const Eigen::Vector3d& push = command.estimate.disturbance_world;
  const auto& aim = command.reference_pose;
  message.estimate = pose2d(here.position_world.x(), here.position_world.y(), here.heading);
  message.disturbance = pose2d(push.x(), push.y(), push.z());
  message.position_sigma = std::sqrt(command.estimate.position_variance);
  message.reference = pose2d(aim.x(), aim.y(), aim.z());
  message.control_us = control_us;
  const bool follows = command.stop == spf::StopCause::none && observed_;
  message.latency_ms = follows ? 1e3 * (now() - *observed_) : -1.0;
  message.plans_refused = host_.tracker().plans_refused();
  message.poses_refused = host_.localiser().poses_refused();
  message.guard_scale = command.guard.scale;
  message.guard_free_distance = command.guard.free_distance;
  if (const spf::host::ScanGuard* guard = host_.tracker().guard())
    message.guard_stops = guard->counts().stops;
  status_.publish(message);
}

void TrackerNode::report() {
  const double seconds = now();
  spf::host::Health health = host_.tracker().health();
  refusals_.add_to(health, seconds);
  if (!diagnostics_.due(health)) return;
  Diagnostics::Values values{{"pose age", age_text(host_.localiser().pose_age(seconds))},
                             {"localisation age", age_text(host_.localiser().localisation_age(seconds))},
                             {"plan age", age_text(host_.tracker().plan_age(seconds))},
                             {"poses refused", std::to_string(host_.localiser().poses_refused())},
                             {"plans refused", std::to_string(host_.tracker().plans_refused())},
                             {"clock jumps", std::to_string(host_.clock_jumps())},
                             {"guard", guard_text(host_.tracker().guard(), seconds)}};
  if (const spf::host::ScanGuard* guard = host_.tracker().guard())
    values.emplace_back("guard stops", std::to_string(guard->counts().stops));
  if (!refusals_.last().empty()) values.emplace_back("last refusal", refusals_.last());
  diagnostics_.report(health, values);
}

}  // namespace spf_ros2
