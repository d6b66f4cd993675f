#include "host/robot_host.hpp"

#include "spf/team/schedule.hpp"

namespace spf::host {

RobotHost::RobotHost(int robot_id, const AgentParameters& agent, const HostParameters& host, Motion motion,
                     std::uint32_t first_sequence)
    : motion_{motion},
      control_period_{validated(agent).tracker.control_period},
      clock_{validated(host).clock_jump},
      localiser_{agent, host},
      planner_{robot_id, agent, host, first_sequence},
      tracker_{robot_id, agent, host} {}

double RobotHost::tell_time(double now) {
  if (clock_.jumped(now)) {
    localiser_.meet_clock_jump(clock_.now());
    if (motion_ == Motion::as_planned)
      planner_.restart_where_planned(last_time_, clock_.now());
    else
      planner_.meet_clock_jump();
    tracker_.meet_clock_jump();
    next_control_time_ = kNever;
  }
  last_time_ = clock_.now();
  return last_time_;
}

void RobotHost::start(const OccupancyMap& map, const Pose2& pose_world, double now) {
  planner_.start(map, pose_world, tell_time(now));
}

PoseVerdict RobotHost::add_pose(const PoseMeasurement& pose, double now) {
  const PoseVerdict verdict = localiser_.add_pose(pose, tell_time(now));
  planner_.note_pose(pose, verdict, localiser_);
  tracker_.note_pose(verdict, now);
  return verdict;
}

ObservationVerdict RobotHost::add_observation(const SensedWorld& sensed, double now) {
  now = tell_time(now);
  const Observation& observation = sensed.observation;
  if (observation.scan) tracker_.add_scan(observation.time, *observation.scan, Pose2{}, now);
  return planner_.add_observation(sensed, now, localiser_of_plan());
}

MessageVerdict RobotHost::add_message(const HeardMessage& message, double now) {
  return planner_.add_message(message, tell_time(now));
}

void RobotHost::set_switches(const Switches& switches) {
  planner_.set_switches(switches);
  tracker_.set_switches(switches);
}

const PlannerOutput& RobotHost::plan(double now) {
  const PlannerOutput& output = planner_.step(tell_time(now), localiser_of_plan());
  if (output.planned && motion_ == Motion::by_wheels) {
    tracker_.set_speed_limit(planner_.parameters().robot.max_speed);
    tracker_.add_plan(output.plan, clock_.now());
  }
  return output;
}

bool RobotHost::control_due(double now) const {
  return motion_ == Motion::by_wheels && is_due(next_control_time_, now);
}

const TrackerCommand& RobotHost::control(double now) {
  now = tell_time(now);
  if (next_control_time_ == kNever) next_control_time_ = now;
  next_control_time_ = next_due(next_control_time_, control_period_, now);
  return tracker_.step(now, localiser_);
}

RobotOutput RobotHost::step(double now) {
  RobotOutput output;
  const PlannerOutput& plan_output = plan(now);
  output.planned = plan_output.planned;
  output.broadcast = plan_output.broadcast;
  output.controlled = control_due(now);
  if (output.controlled) control(now);
  output.wheel_speeds = tracker_.command().wheel_speeds;
  return output;
}

}  // namespace spf::host
