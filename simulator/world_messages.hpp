// A simulated world as messages: what localisation, a scanner, an outside tracker and an operator would
// publish, and how the trial stands. Frame: the fleet's; stamps: the caller's clock.
#pragma once

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "sim/robot_truth.hpp"
#include "sim/trial_result.hpp"
#include "sim/world.hpp"
#include "wire/sensing.hpp"

namespace spf::simulator {

/// robotK, and the frame of its base.
[[nodiscard]] inline std::string robot_name(int robot) {
  return "robot" + std::to_string(robot);
}
[[nodiscard]] inline std::string base_frame(int robot) {
  return robot_name(robot) + "/base_link";
}

/// Where a message belongs: the fleet's frame, and its time.
template <class Time>
struct Stamp {
  std::string frame;
  Time time;
};

template <class Message, class Time>
void put(const Stamp<Time>& stamp, Message& message) {
  message.header.frame_id = stamp.frame;
  message.header.stamp = stamp.time;
}

/// A measured pose, with the true motion of the body and the noise as covariance.
template <class Odometry, class Time>
[[nodiscard]] Odometry odometry_of(const sim::World& world, int robot, const Pose2& measured,
                                   const Stamp<Time>& stamp) {
  const PlantState& plant = world.plant(robot).state();
  const sim::PoseNoiseParameters& noise = world.scenario().simulation.pose_noise;
  const Eigen::Vector3d twist = twist_in_body(plant.twist_world, plant.pose_world.heading);
  Odometry message;
  put(stamp, message);
  message.child_frame_id = base_frame(robot);
  wire::fill(measured, message.pose.pose);
  message.pose.covariance[0] = message.pose.covariance[7] = noise.position_sigma * noise.position_sigma;
  message.pose.covariance[35] = noise.heading_sigma * noise.heading_sigma;
  message.twist.twist.linear.x = twist.x();
  message.twist.twist.linear.y = twist.y();
  message.twist.twist.angular.z = twist.z();
  return message;
}

/// The true pose of every robot's base.
template <class TransformStamped, class Time>
[[nodiscard]] std::vector<TransformStamped> transforms_of(const std::vector<sim::RobotTruth>& robots,
                                                          const Stamp<Time>& stamp) {
  std::vector<TransformStamped> found;
  for (std::size_t i = 0; i < robots.size(); ++i) {
    TransformStamped& transform = found.emplace_back();
    put(stamp, transform);
    transform.child_frame_id = base_frame(static_cast<int>(i));
    auto& to = transform.transform;
    wire::fill(robots[i].pose.position_world, to.translation);
    to.rotation.z = std::sin(0.5 * robots[i].pose.heading);
    to.rotation.w = std::cos(0.5 * robots[i].pose.heading);
  }
  return found;
}

/// In the frame of the robot's base; `rate` [Hz].
template <class LaserScan, class Time>
[[nodiscard]] LaserScan scan_of(const RangeScan& scan, double rate, int robot, const Time& time) {
  LaserScan message;
  wire::fill(scan, message);
  message.header.frame_id = base_frame(robot);
  message.header.stamp = time;
  message.scan_time = static_cast<float>(1.0 / rate);
  return message;
}

/// Detections as an outside tracker tells them: exact ones with covariance 0, others with their position's
/// variance and no velocity.
template <class ObstacleTracks, class Time>
[[nodiscard]] ObstacleTracks obstacles_of(const std::vector<Detection>& detections,
                                          const Stamp<Time>& stamp) {
  ObstacleTracks message;
  put(stamp, message);
  for (const Detection& detection : detections) {
    auto& track = message.tracks.emplace_back();
    track.id = detection.id;
    wire::fill(detection.position_world, track.position);
    track.radius = detection.radius;
    track.covariance[0] = track.covariance[5] = detection.position_sigma * detection.position_sigma;
    if (detection.velocity_world)
      wire::fill(*detection.velocity_world, track.velocity);
    else
      track.covariance[10] = track.covariance[15] = -1.0;
  }
  return message;
}

/// A message has no "any heading": where the goal has none it has `any_heading` [rad].
template <class PoseStamped, class Time>
[[nodiscard]] PoseStamped goal_of(const host::Goal& goal, double any_heading, const Stamp<Time>& stamp) {
  PoseStamped message;
  put(stamp, message);
  wire::fill(Pose2{goal.position_world, goal.heading.value_or(any_heading)}, message.pose);
  return message;
}

/// "robot 1 touched disc 2 at 3.25 s, at 0.80 m/s (the other at 0.50 m/s)"
[[nodiscard]] std::string contact_text(const sim::Contact& contact);

/// How the trial stands, or how it ended.
template <class Message, class Time>
[[nodiscard]] Message outcome_of(const sim::TrialResult& result, bool finished, const Stamp<Time>& stamp) {
  Message message;
  put(stamp, message);
  message.robots = static_cast<std::uint32_t>(result.robots.size());
  message.duration = result.sim_seconds;
  std::string away;
  for (std::size_t i = 0; i < result.robots.size(); ++i) {
    const sim::RobotResult& robot = result.robots[i];
    if (robot.arrived) ++message.arrived;
    if (!robot.arrived) away += (away.empty() ? "" : ", ") + std::to_string(i);
    message.arrival_times.push_back(robot.arrived ? robot.travel_time : -1.0);
    message.path_lengths.push_back(robot.path_length);
  }
  if (!result.contacts.empty()) {
    message.outcome = Message::COLLISION;
    message.cause = contact_text(result.contacts.front());
  } else if (!finished) {
    message.outcome = Message::RUNNING;
  } else if (result.outcome == sim::TrialOutcome::success) {
    message.outcome = Message::SUCCESS;
  } else {
    message.outcome = Message::TIMEOUT;
    message.cause = "not at their goals: robots " + away;
  }
  return message;
}

}  // namespace spf::simulator
