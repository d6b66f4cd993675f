#include "host/tracker_host.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "host/contradictions.hpp"
#include "host/plan_check.hpp"
#include "spf/planning/braking.hpp"

namespace spf::host {
namespace {

/// Own plans may be a little beyond the planned limits (PlannerParameters), never by half.
constexpr double kSpeedSpare = 1.5;

}  // namespace

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
      robot_{validated(agent).robot},
      clock_error_{validated(host).clock_error},
      drive_{robot_},
      controller_{agent.tracker, drive_, reckoned_lag(agent.tracker, agent.robot)},
      limiter_{robot_, drive_, agent.tracker.control_period},
      watchdog_{host, agent.team.stale_time},
      relies_on_scan_{host.relies_on_scan} {
  refuse_contradictions(contradictions(agent, host));
  command_.wheel_speeds = drive_.standstill();
  if (host.guard.enabled) guard_ = std::make_unique<ScanGuard>(host.guard, agent, host.clock_error);
}

void TrackerHost::note_pose(PoseVerdict verdict, double now) {
  if (verdict != PoseVerdict::relocalised) return;
  // It is somewhere else than it was thought to be: neither its plan nor a braking under way leads on from
  // there. It brakes where it is, and waits for a plan that begins there.
  controller_.reset();
  has_plan_ = false;
  braking_.reset();
  relocalised_ = now;
}

PlanVerdict TrackerHost::add_plan(const TrajectoryMessage& message, double now) {
  const PlanVerdict verdict = judge(message, now);
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
  if (!drivable(message.trajectory, {kSpeedSpare * robot_.max_speed})) return PlanVerdict::malformed;
  const double latest = now + clock_error_;
  if (message.sent_time > latest || message.trajectory.start_time() > latest) return PlanVerdict::future;
  if (has_plan_ && message.sent_time <= plan_.sent_time) return PlanVerdict::late;
  if (message.sent_time < relocalised_) return PlanVerdict::late;
  return PlanVerdict::accepted;
}

double TrackerHost::plan_age(double now) const {
  return has_plan_ ? now - plan_.sent_time : std::numeric_limits<double>::infinity();
}

void TrackerHost::meet_clock_jump() {
  controller_.reset();
  has_plan_ = false;
  relocalised_ = kNever;
  after_jump_ = true;
  braking_.reset();
  last_step_time_ = kNever;
  if (guard_) guard_->forget();
}

bool TrackerHost::add_scan(double time, const RangeScan& scan, const Pose2& sensor_in_body, double now) {
  return guard_ && guard_->add_scan(time, scan, sensor_in_body, now);
}

StopCause TrackerHost::stop_cause(double now, const Localiser& localiser) const {
  WatchFacts facts;
  facts.emergency_stop = switches_.emergency_stop;
  facts.paused = switches_.paused;
  facts.clock_jumped = after_jump_ && (!localiser.has_pose() || !has_plan_);
  facts.pose_age = localiser.pose_age(now);
  facts.localisation_age = localiser.localisation_age(now);
  if (guard_ && relies_on_scan_) facts.scan_age = guard_->scan_age(now);
  facts.plan_age = plan_age(now);
  facts.stuck = localiser.motion().stuck(now);
  if (has_plan_)
    facts.plan_error = (command_.estimate.pose_world.position_world - plan_.trajectory.position(now)).norm();
  return watchdog_.watch(facts);
}

const TrackerCommand& TrackerHost::step(double now, Localiser& localiser) {
  localiser.advance_to(now);
  const MotionState state = localiser.state();
  command_.estimate = state.estimate;
  command_.stop = stop_cause(now, localiser);
  if (command_.stop == StopCause::none) {
    after_jump_ = false;
    braking_.reset();
    follow(now, state);
  } else if (localiser.motion().stuck(now)) {
    stop_pushing(now, state);
  } else {
    brake(now, state);
  }
  heed_guard(now, state);
  localiser.applied(now, command_.wheel_speeds);
  localiser.note_guard(command_.guard.action);
  return command_;
}

/// Below everything that was decided above.
void TrackerHost::heed_guard(double now, const MotionState& state) {
  if (!guard_) return;
  guard_->moves(now, drive_.twist_body(state.wheel_speeds));
  command_.guard = guard_->judge(now, command_.twist_body);
  if (command_.guard.action == GuardAction::none) return;
  command_.twist_body = guard_->allowed(command_.twist_body);
  command_.wheel_speeds = drive_.input_for(command_.twist_body);
  const bool stops = command_.guard.action == GuardAction::stops;
  if (stops && command_.stop == StopCause::none) command_.stop = StopCause::in_the_way;
}

void TrackerHost::follow(double now, const MotionState& state) {
  const TrackerOutput& output = controller_.step(now, state, plan_.trajectory);
  WatchFacts facts;
  facts.controller_failed = output.status != TrackerStatus::tracking;
  command_.stop = watchdog_.watch(facts);
  command_.braking = false;
  send(now, output.wheel_speeds, state);
  command_.reference_pose = output.reference_pose;
}

/// What leaves for the wheels: within the limits, after what is in force.
void TrackerHost::send(double now, const DriveInput& wanted, const MotionState& state) {
  const double period = limiter_.period();
  const double elapsed = last_step_time_ == kNever ? period : now - last_step_time_;
  last_step_time_ = now;
  command_.wheel_speeds = limiter_.limited(wanted, state.command, elapsed);
  command_.twist_body = drive_.twist_body(command_.wheel_speeds);
}

/// By its wheels alone: what is missing of the path is not to be made up for, nor what the observer takes for
/// a push against it.
void TrackerHost::stop_pushing(double now, const MotionState& state) {
  braking_.reset();
  send(now, controller_.stop().wheel_speeds, state);
  command_.braking = !command_.wheel_speeds.isZero();
  command_.reference_pose << command_.estimate.pose_world.position_world,
      command_.estimate.pose_world.heading;
}

/// Along a braking trajectory from where the robot is, as fast as it was told to go (and from there anew,
/// should it turn out to be somewhere else); then no motion at all, since what the observer believes about
/// slip is not to move a robot that stands.
void TrackerHost::brake(double now, const MotionState& state) {
  const Eigen::Vector2d& here = command_.estimate.pose_world.position_world;
  if (braking_ && watchdog_.far((here - braking_->position(now)).norm())) braking_.reset();
  if (!braking_) {
    const double heading = command_.estimate.pose_world.heading;
    const Eigen::Vector3d twist = drive_.twist_world(state.command, heading);
    const FlatState head{here, twist.head<2>(), Eigen::Vector2d::Zero()};
    braking_ = std::make_unique<Trajectory>(braking_trajectory(head, {heading, twist.z()}, now, robot_));
  }
  const bool moving = command_.estimate.valid && !state.command.isZero() && now < braking_->rest_time();
  const TrackerOutput& output = moving ? controller_.step(now, state, *braking_) : controller_.stop();
  send(now, output.wheel_speeds, state);
  command_.braking = moving || !command_.wheel_speeds.isZero();
  command_.reference_pose << braking_->position(now), braking_->heading_state(now).heading;
}

Health TrackerHost::health() const {
  switch (command_.stop) {
    case StopCause::none:
      return {Level::ok, "tracking"};
    case StopCause::paused:
    case StopCause::far_from_plan:
    case StopCause::in_the_way:
      return {Level::warn, to_string(command_.stop)};
    default:
      return {Level::error, to_string(command_.stop)};
  }
}

}  // namespace spf::host
