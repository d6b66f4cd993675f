#include "spf_empc_ros/tracker_node.hpp"

#include <geometry_msgs/Twist.h>
#include <ros/console.h>
#include <spf_empc_msgs/TrackerStatus.h>
#include <spf_empc_msgs/WheelSpeeds.h>

#include "spf_empc_ros/conversions.hpp"
#include "spf_empc_ros/transport.hpp"

namespace spf_empc_ros {
namespace {

geometry_msgs::Pose2D pose2d(double x, double y, double theta) {
  geometry_msgs::Pose2D pose;
  pose.x = x;
  pose.y = y;
  pose.theta = theta;
  return pose;
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

TrackerNode::TrackerNode(ros::NodeHandle node, const RobotConfig& config, const ros::Time& start)
    : node_{std::move(node)},
      config_{config},
      clock_{start},
      host_{config.robot_id, config.agent, config.file.host},
      frames_{config.agent.team.stale_time},
      diagnostics_{node_, config_, "tracker", clock_},
      switch_{node_, [this](bool paused, bool stop) {
                host_.tracker().set_switches({stop, paused});
              }} {
  cmd_vel_ = node_.advertise<geometry_msgs::Twist>("cmd_vel", 1);
  wheel_speeds_ = node_.advertise<spf_empc_msgs::WheelSpeeds>("wheel_speeds", 1);
  estimate_ = node_.advertise<nav_msgs::Odometry>("estimate", 5);
  status_ = node_.advertise<spf_empc_msgs::TrackerStatus>("tracker_status", 20);
  subscribers_ = {node_.subscribe("odom", 20, &TrackerNode::on_pose, this, no_delay()),
                  node_.subscribe("trajectory", 5, &TrackerNode::on_plan, this, no_delay()),
                  node_.subscribe("status", 2, &TrackerNode::on_planner, this, no_delay())};
  if (host_.tracker().guard() != nullptr)
    subscribers_.push_back(node_.subscribe("scan", 2, &TrackerNode::on_scan, this, no_delay()));
  timer_ = node_.createTimer(ros::Duration{config_.agent.tracker.control_period},
                             [this](const ros::TimerEvent&) { step(); });
}

TrackerNode::~TrackerNode() {
  timer_.stop();
  cmd_vel_.publish(geometry_msgs::Twist{});
}

void TrackerNode::refuse(const char* what, const std::string& why, bool harmless) {
  refusals_.note(what, why, now(), harmless);
  ROS_WARN_THROTTLE(1.0, "%s", refusals_.last().c_str());
}

void TrackerNode::on_pose(const nav_msgs::Odometry::ConstPtr& odometry) {
  const Converted<PlacedPose> placed =
      frames_.pose_of_any_age(odometry->header, odometry->pose.pose, config_.frame);
  if (!placed) {
    host_.localiser().count_refused_pose();
    return refuse("odom", placed.refusal);
  }
  const double time = clock_.seconds(odometry->header.stamp);
  const spf::host::PoseVerdict verdict = host_.add_pose({time, placed->pose}, now());
  if (!believed(verdict)) return refuse("odom", to_string(verdict), verdict == spf::host::PoseVerdict::late);
  if (!placed->by_itself) host_.localiser().placed_by_transform_of(time - placed->age);
}

void TrackerNode::on_plan(const spf_empc_msgs::Trajectory::ConstPtr& trajectory) {
  const Converted<StampedTrajectory> received = from_message(*trajectory, clock_, config_.frame);
  if (!received) {
    host_.tracker().count_refused_plan();
    return refuse("trajectory", received.refusal);
  }
  const spf::host::PlanVerdict verdict = host_.add_plan(received->message, now());
  if (verdict != spf::host::PlanVerdict::accepted)
    return refuse("trajectory", to_string(verdict), verdict == spf::host::PlanVerdict::late);
  observed_ = received->observed;
}

/// The limit of speed that its plans keep to now: commands keep to it as well.
void TrackerNode::on_planner(const spf_empc_msgs::RobotStatus& status) {
  host_.tracker().set_speed_limit(status.max_speed);
}

/// As it comes from the driver, for the guard: by no other node.
void TrackerNode::on_scan(const sensor_msgs::LaserScan::ConstPtr& scan) {
  const Converted<geometry_msgs::Pose> scanner =
      frames_.pose_in_space(scan->header.frame_id, config_.base_frame, scan->header.stamp);
  if (!scanner) return refuse("scan", scanner.refusal);
  Converted<spf::host::DriverScan> driver = driver_scan(*scan, *scanner);
  if (!driver) return refuse("scan", driver.refusal);
  spf::host::DriverScan& plain = *driver.value;
  make_plain(plain, config_.file.host.no_return);
  if (!host_.add_scan(clock_.seconds(scan->header.stamp), plain.scan, plain.mount.in_body, now()))
    refuse("scan", "malformed, half blind, or not of the present");
}

void TrackerNode::step() {
  const ros::WallTime begun = ros::WallTime::now();
  const ros::Time time = ros::Time::now();  // from which on the command counts
  const spf::host::TrackerCommand& command = host_.step(clock_.seconds(time));
  const double control_us = 1e6 * (ros::WallTime::now() - begun).toSec();
  publish_command(time, command);
  publish_estimate(time, command);
  publish_status(time, command, control_us);
  report(time);
}

void TrackerNode::publish_command(const ros::Time& now, const spf::host::TrackerCommand& command) {
  geometry_msgs::Twist twist;
  twist.linear.x = command.twist_body.x();
  twist.linear.y = command.twist_body.y();
  twist.angular.z = command.twist_body.z();
  cmd_vel_.publish(twist);
  spf_empc_msgs::WheelSpeeds wheels = to_message(command.wheel_speeds, host_.tracker().max_wheel_speed());
  wheels.header.stamp = now;
  wheels.header.frame_id = config_.base_frame;
  wheels.guard = static_cast<std::uint8_t>(command.guard.action);
  wheel_speeds_.publish(wheels);
}

void TrackerNode::publish_estimate(const ros::Time& now, const spf::host::TrackerCommand& command) {
  if (!command.estimate.valid || estimate_.getNumSubscribers() == 0) return;
  nav_msgs::Odometry message;
  message.header.stamp = now;
  message.header.frame_id = config_.frame;
  message.child_frame_id = config_.base_frame;
  message.pose.pose = to_message(command.estimate.pose_world);
  message.pose.covariance[0] = message.pose.covariance[7] = command.estimate.position_variance;
  message.pose.covariance[35] = command.estimate.heading_variance;
  message.twist.twist.linear.x = command.twist_body.x();
  message.twist.twist.linear.y = command.twist_body.y();
  message.twist.twist.angular.z = command.twist_body.z();
  estimate_.publish(message);
}

void TrackerNode::publish_status(const ros::Time& now, const spf::host::TrackerCommand& command,
                                 double control_us) {
  spf_empc_msgs::TrackerStatus message;
  message.header.stamp = now;
  message.header.frame_id = config_.frame;
  message.robot_id = static_cast<std::uint32_t>(config_.robot_id);
  message.mode = mode_of(command);
  const spf::Pose2& here = command.estimate.pose_world;
  const Eigen::Vector3d& push = command.estimate.disturbance_world;
  message.estimate = pose2d(here.position_world.x(), here.position_world.y(), here.heading);
  message.disturbance = pose2d(push.x(), push.y(), push.z());
  message.position_sigma = std::sqrt(command.estimate.position_variance);
  message.reference =
      pose2d(command.reference_pose.x(), command.reference_pose.y(), command.reference_pose.z());
  message.control_us = control_us;
  const bool follows = command.stop == spf::StopCause::none && observed_;
  message.latency_ms = follows ? 1e3 * (clock_.seconds(now) - *observed_) : -1.0;
  message.plans_refused = host_.tracker().plans_refused();
  message.poses_refused = host_.localiser().poses_refused();
  message.guard_scale = command.guard.scale;
  message.guard_free_distance = command.guard.free_distance;
  if (const spf::host::ScanGuard* guard = host_.tracker().guard())
    message.guard_stops = guard->counts().stops;
  status_.publish(message);
}

void TrackerNode::report(const ros::Time& now) {
  const double seconds = clock_.seconds(now);
  spf::host::Health health = host_.tracker().health();
  refusals_.add_to(health, seconds);
  if (!diagnostics_.due(now, health)) return;
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
  diagnostics_.report(now, health, values);
}

}  // namespace spf_empc_ros
