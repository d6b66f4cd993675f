#include "host/localiser.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

#include "spf/math/angles.hpp"

namespace spf::host {
Localiser::Localiser(const AgentParameters& agent, const HostParameters& host)
    : gate_{validated(host), validated(agent).robot},
      drive_{agent.robot},
      estimator_{agent.tracker.observer, drive_, reckoned_lag(agent.tracker, agent.robot)},
      history_{agent.team.stale_time},
      monitor_{agent.robot},
      command_silence_{host.command_silence} {}

PoseVerdict Localiser::add_pose(const PoseMeasurement& pose, double now) {
  const PoseVerdict verdict = gate_.judge(pose, now);
  if (!believed(verdict)) {
    ++poses_refused_;
    return verdict;
  }
  if (verdict == PoseVerdict::relocalised) {
    const DriveInput command = estimator_.state().command;
    const Pose2 thought = estimator_.estimate(pose.time).pose_world;
    correction_.heading = angle_difference(pose.pose_world.heading, thought.heading);
    correction_.position_world =
        pose.pose_world.position_world - Eigen::Rotation2Dd{correction_.heading} * thought.position_world;
    estimator_.reset();
    history_.clear();
    estimator_.apply(pose.time, command);
    monitor_.reset();
  }
  advance_to(pose.time);
  monitor_.note(pose.time, pose.pose_world,
                drive_.twist_world(estimator_.state().wheel_speeds, pose.pose_world.heading));
  estimator_.observe(pose.time, pose.pose_world);
  history_.add(estimator_.time(), estimator_.state().estimate.pose_world);
  return verdict;
}

std::optional<Pose2> Localiser::pose(double time) const {
  if (time < estimator_.time())
    if (const std::optional<Pose2> then = history_.at(time)) return then;
  const StateEstimate ahead = estimator_.estimate(time);
  if (!ahead.valid) return std::nullopt;
  return ahead.pose_world;
}

void Localiser::applied(double time, const DriveInput& wheel_speeds) {
  if (!std::isfinite(time) || time < command_time_) return;
  estimator_.apply(time, wheel_speeds);
  command_time_ = time;
  standing_ = false;
}

void Localiser::advance_to(double now) {
  if (!standing_ && now - command_time_ > command_silence_) {
    estimator_.apply(command_time_ + command_silence_, drive_.standstill());
    standing_ = true;
    guard_ = GuardAction::none;
  }
  estimator_.advance_to(now);
}

void Localiser::meet_clock_jump(double now) {
  const MotionState before = estimator_.state();
  gate_.reset();
  placed_time_.reset();
  estimator_.reset();
  history_.clear();
  monitor_.reset();
  if (before.estimate.valid) estimator_.observe(now, before.estimate.pose_world);
  // After a long pause (the process was suspended) a base that was told nothing has stopped by itself.
  standing_ = standing_ || now - command_time_ > command_silence_;
  estimator_.apply(now, standing_ ? drive_.standstill() : before.command);
  command_time_ = now;
}

AgentEstimate Localiser::belief() const {
  const StateEstimate believed = estimator_.state().estimate;
  return {believed.pose_world, believed.disturbance_world, std::sqrt(believed.position_variance),
          believed.valid};
}

}  // namespace spf::host
