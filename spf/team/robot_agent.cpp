#include "spf/team/robot_agent.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "spf/team/announcement.hpp"
#include "spf/team/beliefs.hpp"
#include "spf/team/commitment.hpp"
#include "spf/team/guide_policy.hpp"
#include "spf/team/schedule.hpp"
#include "spf/tracking/tracker.hpp"

namespace spf {

struct RobotAgent::Implementation {
  Implementation(int robot_id, const AgentParameters& agent_parameters, const OccupancyMap& map,
                 const Pose2& start, double time, StateSource state_source);

  void receive(double time, const AgentInput& input);
  std::optional<TrajectoryMessage> plan(double time);
  [[nodiscard]] StandReason forced_stop(double time) const;
  void stop(double time);
  void make_plan(double time);
  [[nodiscard]] StandCause standing_cause(double time) const;
  [[nodiscard]] double position_sigma(double time) const;

  int id;
  AgentParameters parameters;
  StateSource source;

  Beliefs beliefs;
  std::unique_ptr<Planner> planner;
  GuidePolicy guide;
  Commitment commitment;
  Announcement announcement;
  Tracker tracker;

  std::optional<Eigen::Vector2d> goal;  // [m]
  std::optional<double> goal_heading;   // [rad]
  bool paused = false;
  bool keep_candidates = false;
  PlanResult result;
  Eigen::Vector3d wheel_speeds = Eigen::Vector3d::Zero();  // [m/s]
  double last_pose_time;                                   // [s]
  double next_plan_time;                                   // [s]
  double next_control_time;                                // [s]
};

RobotAgent::Implementation::Implementation(int robot_id, const AgentParameters& agent_parameters,
                                           const OccupancyMap& map, const Pose2& start, double time,
                                           StateSource state_source)
    : id{robot_id},
      parameters{validated(agent_parameters)},
      source{state_source},
      beliefs{robot_id, parameters, map, time},
      planner{parameters.make_planner(parameters)},
      guide{parameters, planner->approaches_cut_off_goal(), time},
      commitment{parameters, start, time},
      announcement{robot_id, parameters, time},
      tracker{parameters.tracker, parameters.robot},
      last_pose_time{time},
      next_plan_time{time},
      next_control_time{time} {
  result.trajectory = commitment.trajectory();
}

void RobotAgent::Implementation::receive(double time, const AgentInput& input) {
  for (const PoseMeasurement& measurement : input.poses) {
    if (measurement.time > time + kClockError) continue;  // it would make all later ones late
    const MeasurementOutcome outcome = tracker.observe(measurement.time, measurement.pose_world);
    if (outcome != MeasurementOutcome::invalid) last_pose_time = std::max(last_pose_time, measurement.time);
  }
  for (const HeardMessage& received : input.messages) beliefs.hear(received, time);
  if (!input.observation || !beliefs.timely(*input.observation, time)) return;
  const StateEstimate then = tracker.estimate(input.observation->time);
  beliefs.observe(*input.observation, then.valid ? std::optional{then.pose_world} : std::nullopt);
}

std::optional<TrajectoryMessage> RobotAgent::Implementation::plan(double time) {
  next_plan_time = next_due(next_plan_time, parameters.team.plan_period, time);
  // 1. What is believed now.
  beliefs.refresh(time);
  // 2. A plan, unless there is a reason to stand that no plan can mend.
  const StandReason stop_reason = forced_stop(time);
  if (stop_reason == StandReason::none)
    make_plan(time);
  else
    stop(time);
  // 3. Say how it stands, to the host and to the peers.
  announcement.update(
      time, {commitment.trajectory(), commitment.braking(), goal, stop_reason, standing_cause(time)});
  return announcement.message(time, next_plan_time, commitment.trajectory(), position_sigma(time));
}

StandReason RobotAgent::Implementation::forced_stop(double time) const {
  if (paused) return StandReason::paused;
  if (!goal) return StandReason::no_goal;
  if (source == StateSource::as_planned) return StandReason::none;
  if (time - last_pose_time > parameters.team.stale_time) return StandReason::stale_pose;
  if (time - beliefs.last_observation_time() > parameters.team.stale_time) return StandReason::stale_scan;
  return StandReason::none;
}

void RobotAgent::Implementation::stop(double time) {
  if (!commitment.brake(time)) return;
  result.clear();
  result.outcome = PlanOutcome::unsafe;
  result.trajectory = commitment.trajectory();
}

void RobotAgent::Implementation::make_plan(double time) {
  guide.refresh(time, beliefs.map(), *goal, commitment.trajectory().position(time));
  PlanRequest request;
  request.time = time;
  request.goal_world = *goal;
  request.goal_heading = goal_heading;
  request.world = beliefs.snapshot(time);
  request.guide = &guide.path();
  request.goal_cut_off = guide.cut_off();
  request.keep_candidates = keep_candidates;
  const bool measured = source == StateSource::measured;
  commitment.begin_plan(measured ? std::optional{tracker.estimate(time)} : std::nullopt, request);
  request.position_sigma = position_sigma(time);
  planner->plan(request, result);
  commitment.follow(request, result);
}

/// Why the robot stands where no reason forces it to.
StandCause RobotAgent::Implementation::standing_cause(double time) const {
  if (guide.goal_out_of_reach(commitment.trajectory().position(time))) return {StandReason::no_path};
  if (result.blocking_track >= 0) return {StandReason::obstacle_ahead, result.blocking_track};
  if (result.blocking_peer >= 0) return {StandReason::peer_ahead, result.blocking_peer};
  return {StandReason::planner_failed};
}

double RobotAgent::Implementation::position_sigma(double time) const {
  if (source == StateSource::as_planned) return 0.0;
  return std::sqrt(tracker.estimate(time).position_variance + commitment.tracking_variance());
}

RobotAgent::RobotAgent(int robot_id, const AgentParameters& parameters, const OccupancyMap& map,
                       const Pose2& start, double time, StateSource source)
    : implementation_{std::make_unique<Implementation>(robot_id, parameters, map, start, time, source)} {}
RobotAgent::~RobotAgent() = default;
RobotAgent::RobotAgent(RobotAgent&&) noexcept = default;
RobotAgent& RobotAgent::operator=(RobotAgent&&) noexcept = default;

void RobotAgent::set_goal(const Eigen::Vector2d& goal_world, std::optional<double> goal_heading) {
  if (!goal_world.allFinite() || !std::isfinite(goal_heading.value_or(0.0))) {
    throw std::invalid_argument{"the goal of robot " + std::to_string(robot_id()) + " must be finite"};
  }
  implementation_->goal = goal_world;
  implementation_->goal_heading = goal_heading;
}
void RobotAgent::clear_goal() {
  implementation_->goal.reset();
}
void RobotAgent::set_paused(bool paused) {
  implementation_->paused = paused;
}

void RobotAgent::set_keep_candidates(bool keep) {
  implementation_->keep_candidates = keep;
}
void RobotAgent::set_distrusted(std::vector<int> robot_ids) {
  implementation_->beliefs.set_distrusted(std::move(robot_ids));
}

AgentOutput RobotAgent::step(double time, const AgentInput& input) {
  AgentOutput output;
  receive(time, input);
  if (plan_due(time)) {
    output.broadcast = plan(time);
    output.planned = true;
  }
  if (control_due(time)) {
    track(time);
    output.controlled = true;
  }
  output.wheel_speeds = implementation_->wheel_speeds;
  return output;
}

void RobotAgent::receive(double time, const AgentInput& input) {
  implementation_->receive(time, input);
}
bool RobotAgent::plan_due(double time) const {
  return is_due(implementation_->next_plan_time, time);
}
bool RobotAgent::control_due(double time) const {
  return is_due(implementation_->next_control_time, time);
}
std::optional<TrajectoryMessage> RobotAgent::plan(double time) {
  return implementation_->plan(time);
}

Eigen::Vector3d RobotAgent::track(double time) {
  Implementation& self = *implementation_;
  const double period = self.parameters.tracker.control_period;
  self.next_control_time = next_due(self.next_control_time, period, time);
  self.wheel_speeds = self.tracker.step(time, self.commitment.trajectory()).wheel_speeds;
  return self.wheel_speeds;
}

int RobotAgent::robot_id() const {
  return implementation_->id;
}
const AgentParameters& RobotAgent::parameters() const {
  return implementation_->parameters;
}
const PlanResult& RobotAgent::last_plan() const {
  return implementation_->result;
}
const Trajectory& RobotAgent::committed() const {
  return implementation_->commitment.trajectory();
}

AgentEstimate RobotAgent::estimate() const {
  const StateEstimate believed = implementation_->tracker.estimate(implementation_->last_pose_time);
  return {believed.pose_world, believed.disturbance_world, std::sqrt(believed.position_variance),
          believed.valid};
}

AgentStatus RobotAgent::status() const {
  return implementation_->announcement.status();
}
const OccupancyMap& RobotAgent::map() const {
  return implementation_->beliefs.map();
}
const std::vector<ObstacleTrack>& RobotAgent::tracks() const {
  return implementation_->beliefs.tracks();
}
const std::vector<Peer>& RobotAgent::peers() const {
  return implementation_->beliefs.peers();
}
std::uint64_t RobotAgent::message_count(MessageVerdict verdict) const {
  return implementation_->beliefs.message_count(verdict);
}

}  // namespace spf
