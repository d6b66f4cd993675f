#include "host/tracker_host.hpp"

#include <cmath>
#include <limits>

#include "host/plan_check.hpp"
#include "spf/planning/braking.hpp"

namespace spf::host {
namespace {

/// Own plans may be a little beyond the planned limits (PlannerParameters), never by half.
constexpr double kSpeedSpare = 1.5;

}  // namespace

const char* to_string(TrackerMode mode) {
  switch (mode) {
    case TrackerMode::tracking:
      return "tracking";
    case TrackerMode::emergency_stop:
      return "emergency stop";
    case TrackerMode::paused:
      return "paused";
    case TrackerMode::clock_jump:
      return "clock jump";
    case TrackerMode::no_pose:
      return "no pose";
    case TrackerMode::stale_pose:
      return "stale pose";
    case TrackerMode::no_plan:
      return "no plan";
    case TrackerMode::stale_plan:
      return "stale plan";
    case TrackerMode::far_from_plan:
      return "far from its plan";
    case TrackerMode::failed:
      return "no control";
  }
  return "?";
}

const char* to_string(PlanVerdict verdict) {
  switch (verdict) {
    case PlanVerdict::accepted:
      return "accepted";
    case PlanVerdict::foreign:
      return "of another robot";
    case PlanVerdict::malformed:
      return "malformed";
    case PlanVerdict::future:
      return "from the future";
    case PlanVerdict::late:
      return "late or duplicated";
  }
  return "?";
}

TrackerHost::TrackerHost(int robot_id, const AgentParameters& agent, const HostParameters& host)
    : robot_id_{robot_id},
      agent_{validated(agent)},
      host_{validated(host)},
      kinematics_{agent_.robot},
      tracker_{agent_.tracker, agent_.robot},
      gate_{host_, agent_.robot},
      clock_{host_.clock_jump} {}

PoseVerdict TrackerHost::add_pose(const PoseMeasurement& pose, double now) {
  if (clock_.jumped(now)) meet_clock_jump(now);
  const PoseVerdict verdict = gate_.judge(pose, clock_.now());
  if (!believed(verdict)) {
    ++poses_refused_;
    return verdict;
  }
  if (verdict == PoseVerdict::relocalised) tracker_.reset();
  tracker_.observe(pose.time, pose.pose_world);
  return verdict;
}

PlanVerdict TrackerHost::add_plan(const TrajectoryMessage& message, double now) {
  if (clock_.jumped(now)) meet_clock_jump(now);
  const PlanVerdict verdict = judge(message, clock_.now());
  if (verdict != PlanVerdict::accepted) {
    ++plans_refused_;
    return verdict;
  }
  plan_ = message;
  has_plan_ = true;
  return verdict;
}

PlanVerdict TrackerHost::judge(const TrajectoryMessage& message, double now) const {
  if (message.robot_id != robot_id_) return PlanVerdict::foreign;
  if (!std::isfinite(message.sent_time)) return PlanVerdict::malformed;
  if (!drivable(message.trajectory, {kSpeedSpare * agent_.robot.max_speed})) return PlanVerdict::malformed;
  const double latest = now + host_.clock_error;
  if (message.sent_time > latest || message.trajectory.start_time() > latest) return PlanVerdict::future;
  if (has_plan_ && message.sent_time <= plan_.sent_time) return PlanVerdict::late;
  return PlanVerdict::accepted;
}

double TrackerHost::plan_age(double now) const {
  return has_plan_ ? now - plan_.sent_time : std::numeric_limits<double>::infinity();
}

/// Nothing known can be dated any more, but the robot still moves as it was told.
void TrackerHost::meet_clock_jump(double now) {
  const Pose2 here = command_.estimate.pose_world;
  const bool knew = command_.estimate.valid;
  gate_.reset();
  tracker_.reset();
  if (knew) tracker_.observe(now, here);
  has_plan_ = false;
  after_jump_ = true;
  braking_.reset();
}

TrackerMode TrackerHost::mode_now(double now) const {
  if (emergency_stop_) return TrackerMode::emergency_stop;
  if (paused_) return TrackerMode::paused;
  if (after_jump_ && (!gate_.last() || !has_plan_)) return TrackerMode::clock_jump;
  if (!gate_.last()) return TrackerMode::no_pose;
  if (gate_.age(now) > agent_.team.stale_time) return TrackerMode::stale_pose;
  if (!has_plan_) return TrackerMode::no_plan;
  if (plan_age(now) > host_.plan_silence) return TrackerMode::stale_plan;
  const Eigen::Vector2d error = command_.estimate.pose_world.position_world - plan_.trajectory.position(now);
  if (!(error.norm() <= host_.largest_plan_error)) return TrackerMode::far_from_plan;
  return TrackerMode::tracking;
}

const TrackerCommand& TrackerHost::step(double now) {
  if (clock_.jumped(now)) meet_clock_jump(now);
  now = clock_.now();
  command_.estimate = tracker_.estimate(now);
  command_.mode = mode_now(now);
  if (command_.mode == TrackerMode::tracking) {
    after_jump_ = false;
    braking_.reset();
    follow(now);
  } else {
    brake(now);
  }
  return command_;
}

void TrackerHost::follow(double now) {
  const TrackerOutput& output = tracker_.step(now, plan_.trajectory);
  if (output.status != TrackerStatus::tracking) command_.mode = TrackerMode::failed;
  command_.braking = false;
  command_.wheel_speeds = output.wheel_speeds;
  command_.twist_body = kinematics_.twist_body(output.wheel_speeds);
  command_.reference_pose = output.reference_pose;
}

/// Along a braking trajectory from where the robot is, as fast as it was told to go; then no motion at all,
/// since what the observer believes about slip is not to move a robot that stands.
void TrackerHost::brake(double now) {
  if (!braking_) {
    const double heading = command_.estimate.pose_world.heading;
    const Eigen::Vector3d twist = kinematics_.twist_world(command_.wheel_speeds, heading);
    const FlatState head{command_.estimate.pose_world.position_world, twist.head<2>(),
                         Eigen::Vector2d::Zero()};
    braking_ = braking_trajectory(head, {heading, twist.z()}, now, agent_.robot);
  }
  const bool moving = command_.estimate.valid && !command_.wheel_speeds.isZero() &&
                      now < std::max(braking_->end_time(),
                                     braking_->heading().start_time() + braking_->heading().turn_duration());
  const TrackerOutput& output = moving ? tracker_.step(now, *braking_) : tracker_.stop(now);
  command_.braking = moving;
  command_.wheel_speeds = output.wheel_speeds;
  command_.twist_body = kinematics_.twist_body(output.wheel_speeds);
  command_.reference_pose << braking_->position(now), braking_->heading().state(now).heading;
}

}  // namespace spf::host
