#include "spf/team/robot_agent.hpp"

#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "spf/math/phase.hpp"
#include "spf/planning/contact_risk.hpp"
#include "spf/robot/drive_dynamics.hpp"
#include "spf/team/announcement.hpp"
#include "spf/team/beliefs.hpp"
#include "spf/team/commitment.hpp"
#include "spf/team/guide_policy.hpp"
#include "spf/team/plan_schedule.hpp"
#include "spf/team/right_of_way.hpp"

namespace spf {
namespace {

AgentParameters within_drive(AgentParameters parameters) {
  parameters.robot = spf::within_drive(parameters.robot);
  return settled(std::move(parameters));
}

}  // namespace

struct RobotAgent::Implementation {
  Implementation(int robot_id, const AgentParameters& agent_parameters, const OccupancyMap& map,
                 const Pose2& start, double time);

  void reconfigure(const AgentParameters& changed);
  std::optional<TrajectoryMessage> plan(double now, const StateEstimate& state, StopCause stop,
                                        const std::optional<Hold>& hold);
  void brake(double now, const StateEstimate* held_at);
  void make_plan(double now, const StateEstimate& state, const std::optional<Hold>& hold);
  [[nodiscard]] StandCause standing_cause(double now, const std::optional<Hold>& hold) const;
  [[nodiscard]] double position_sigma(const StateEstimate& state) const;

  int id;
  AgentParameters parameters;

  Beliefs beliefs;
  std::unique_ptr<Planner> planner;
  GuidePolicy guide;
  RightOfWay right_of_way;
  Commitment commitment;
  Announcement announcement;

  std::optional<Eigen::Vector2d> goal;  // [m]
  std::optional<double> goal_heading;   // [rad]
  bool keep_candidates = false;
  bool too_fast = false;  // the plan under way was made for a higher speed
  PlanResult result;      // of the planner's last call
  StopCause stop_cause = StopCause::none;
  PlanSchedule schedule;
};

RobotAgent::Implementation::Implementation(int robot_id, const AgentParameters& agent_parameters,
                                           const OccupancyMap& map, const Pose2& start, double time)
    : id{robot_id},
      parameters{within_drive(validated(agent_parameters))},
      beliefs{robot_id, parameters, map},
      planner{parameters.make_planner(parameters)},
      guide{parameters, GuideNeeds::of(*planner), time},
      right_of_way{parameters.robot, planner->gives_way()},
      commitment{parameters, start, time},
      announcement{robot_id, parameters, time},
      schedule{parameters.team.plan_period, time, phase_of(robot_id)} {
  result.trajectory = commitment.trajectory();
}

void RobotAgent::Implementation::reconfigure(const AgentParameters& changed) {
  const AgentParameters wanted = within_drive(validated(changed));
  std::unique_ptr<Planner> made = wanted.make_planner(wanted);
  too_fast = too_fast || wanted.robot.max_speed < parameters.robot.max_speed;
  parameters = wanted;
  planner = std::move(made);
  guide.reconfigure(parameters, GuideNeeds::of(*planner));
  right_of_way.reconfigure(parameters.robot, planner->gives_way());
  commitment.reconfigure(parameters);
  announcement.reconfigure(parameters);
  beliefs.set_priority(parameters.team.priority);
}

std::optional<TrajectoryMessage> RobotAgent::Implementation::plan(double now, const StateEstimate& state,
                                                                  StopCause stop,
                                                                  const std::optional<Hold>& hold) {
  schedule.planned(now);
  // 1. What is believed now.
  beliefs.refresh(now);
  // 2. A plan, unless there is a cause to stop that no plan can mend.
  if (stop == StopCause::none && !goal) stop = StopCause::no_goal;
  stop_cause = stop;
  if (stop == StopCause::none) {
    make_plan(now, state, hold);
  } else {
    right_of_way.stop();
    brake(now, stop == StopCause::stuck ? &state : nullptr);
  }
  // 3. Say how it stands, to the host and to the peers.
  announcement.update(now,
                      {commitment.trajectory(), commitment.braking(), goal, stop, standing_cause(now, hold)});
  return announcement.message(now, schedule.next(), commitment.trajectory(), position_sigma(state),
                              right_of_way.claim());
}

/// `held_at`: where a robot is that does not move as it is told, nor will brake as it is told; else null.
void RobotAgent::Implementation::brake(double now, const StateEstimate* held_at) {
  commitment.brake(now);
  if (held_at != nullptr) commitment.stand_where(*held_at, now);
}

void RobotAgent::Implementation::make_plan(double now, const StateEstimate& state,
                                           const std::optional<Hold>& hold) {
  guide.refresh(now, beliefs.snapshot(now), *goal, commitment.trajectory().position(now));
  PlanRequest request;
  request.time = now;
  request.goal_world = *goal;
  request.goal_heading = goal_heading;
  request.world = beliefs.snapshot(now);
  request.guide = &guide.cost_to_go();
  request.goal_cut_off = guide.cut_off();
  request.keep_candidates = keep_candidates;
  commitment.begin_plan(state, request, hold);
  if (std::exchange(too_fast, false)) request.committed = nullptr;  // there is none to keep
  request.position_sigma = position_sigma(state);
  right_of_way.update(now, request.head.position_world, guide.cost_to_go(), request.world);
  request.give_way = right_of_way.give_way();
  planner->plan(request, result);
  set_risk(request, parameters.robot.radius, result);
  commitment.follow(request, result);
}

/// Why the robot stands where no cause forces it to.
StandCause RobotAgent::Implementation::standing_cause(double now, const std::optional<Hold>& hold) const {
  if (hold && hold->stands) return {StopCause::in_the_way};
  if (guide.goal_out_of_reach(commitment.trajectory().position(now))) return {StopCause::no_path};
  if (result.blocking_track >= 0) return {StopCause::obstacle_ahead, result.blocking_track};
  if (result.blocking_peer >= 0) return {StopCause::peer_ahead, result.blocking_peer};
  return {StopCause::planner_failed};
}

double RobotAgent::Implementation::position_sigma(const StateEstimate& state) const {
  return std::sqrt(state.position_variance + commitment.tracking_variance());
}

RobotAgent::RobotAgent(int robot_id, const AgentParameters& parameters, const OccupancyMap& map,
                       const Pose2& start, double time)
    : implementation_{std::make_unique<Implementation>(robot_id, parameters, map, start, time)} {}
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
void RobotAgent::set_map(OccupancyMap map) {
  implementation_->beliefs.set_map(std::move(map));
}
void RobotAgent::reconfigure(const AgentParameters& parameters) {
  implementation_->reconfigure(parameters);
}
void RobotAgent::set_keep_candidates(bool keep) {
  implementation_->keep_candidates = keep;
}
void RobotAgent::set_distrusted(std::vector<int> robot_ids) {
  implementation_->beliefs.set_distrusted(std::move(robot_ids));
}

MessageVerdict RobotAgent::hear(const HeardMessage& message, double now) {
  return implementation_->beliefs.hear(message, now);
}
void RobotAgent::observe(const Observation& observation, const std::optional<Pose2>& pose_world, double now) {
  implementation_->beliefs.observe(observation, pose_world, now);
}
bool RobotAgent::plan_due(double now) const {
  return implementation_->schedule.due(now);
}
void RobotAgent::plan_soon(double now, double least_interval) {
  implementation_->schedule.bring_forward(now, least_interval);
}
std::optional<TrajectoryMessage> RobotAgent::plan(double now, const StateEstimate& state, StopCause stop,
                                                  const std::optional<Hold>& hold) {
  return implementation_->plan(now, state, stop, hold);
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
StopCause RobotAgent::stop_cause() const {
  return implementation_->stop_cause;
}
const Trajectory& RobotAgent::committed() const {
  return implementation_->commitment.trajectory();
}

AgentStatus RobotAgent::status() const {
  return implementation_->announcement.status();
}
std::optional<GoalAccess> RobotAgent::goal_access() const {
  if (!implementation_->goal) return std::nullopt;
  return implementation_->guide.access(*implementation_->goal);
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
