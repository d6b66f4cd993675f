#include "host/planner_host.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "host/contradictions.hpp"
#include "host/plan_check.hpp"
#include "host/robot_map.hpp"
#include "host/scan_check.hpp"
#include "spf/team/schedule.hpp"

namespace spf::host {
namespace {

/// Of a robot that is moved exactly as it plans.
Pose2 pose_on(const Trajectory& plan, double time) {
  return {plan.position(time), plan.heading_state(time).heading};
}

}  // namespace

const char* to_string(ObservationVerdict verdict) {
  switch (verdict) {
    case ObservationVerdict::accepted:
      return "accepted";
    case ObservationVerdict::malformed:
      return "malformed";
    case ObservationVerdict::blind:
      return "half blind";
    case ObservationVerdict::future:
      return "from the future";
    case ObservationVerdict::late:
      return "late or duplicated";
  }
  return "?";
}

ObservationVerdict time_verdict(double observed, double now, double stale_time, double clock_error,
                                bool newer) {
  const Timeliness of_time = timeliness(observed, now, stale_time, clock_error);
  if (of_time == Timeliness::ahead) return ObservationVerdict::future;
  if (of_time == Timeliness::late || !newer) return ObservationVerdict::late;
  return ObservationVerdict::accepted;
}

PlannerHost::PlannerHost(int robot_id, const AgentParameters& agent, const HostParameters& host,
                         std::uint32_t first_sequence)
    : robot_id_{robot_id},
      agent_parameters_{settled(validated(agent))},
      host_{validated(host)},
      watchdog_{host_, agent_parameters_.team.stale_time},
      peer_watch_{robot_id, host_.peer_clock_error},
      standing_{host_, agent_parameters_.robot},
      recovery_{agent_parameters_},
      sequence_{first_sequence} {
  refuse_contradictions(contradictions(agent_parameters_, host_));
}

void PlannerHost::set_map(OccupancyMap map) {
  if (agent_)
    agent_->set_map(map);
  else if (map_)
    map.take_over_sensed(*map_);
  map_ = std::move(map);
}

// ---- what comes in ----------------------------------------------------------------------------------------

void PlannerHost::note_pose(const PoseMeasurement& pose, PoseVerdict verdict, const Localiser& localiser) {
  if (verdict == PoseVerdict::relocalised) forget_agent(localiser.correction());
  if (believed(verdict) && !agent_) standing_.add(pose);
}

ObservationVerdict PlannerHost::judge(const SensedWorld& sensed, double now) const {
  const Observation& observation = sensed.observation;
  if (!std::isfinite(observation.time) || !sensible(observation.detections) ||
      (observation.scan && !sensible(*observation.scan)))
    return ObservationVerdict::malformed;
  const bool newer = (observation.scan && observation.time > last_scan_time_) ||
                     (sensed.has_detections && observation.time > last_detections_time_);
  return time_verdict(observation.time, now, agent_parameters_.team.stale_time, host_.clock_error, newer);
}

ObservationVerdict PlannerHost::add_observation(const SensedWorld& sensed, double now,
                                                const Localiser* localiser) {
  const ObservationVerdict verdict = judge(sensed, now);
  if (verdict != ObservationVerdict::accepted) {
    ++counts_.inputs_refused;
    return verdict;
  }
  const Observation& observation = sensed.observation;
  if (observation.scan) last_scan_time_ = std::max(last_scan_time_, observation.time);
  if (sensed.has_detections) last_detections_time_ = std::max(last_detections_time_, observation.time);
  if (!agent_) return verdict;
  const std::optional<Pose2> from = localiser != nullptr ? localiser->pose(observation.time)
                                                         : pose_on(agent_->committed(), observation.time);
  if (observation.scan && from && !host_.trusts_peers) doubt_peers(observation, *from);
  agent_->observe(observation, from, now);
  const bool tells = sensed.has_detections || (observation.scan && from);
  if (tells) agent_->plan_soon(now, host_.least_plan_interval);
  return verdict;
}

/// Before the scan enters the map: whose discs are not to hide what it shows.
void PlannerHost::doubt_peers(const Observation& observation, const Pose2& pose_world) {
  peer_watch_.add_scan(*observation.scan, pose_world, observation.time, agent_->peers());
  agent_->set_distrusted(peer_watch_.distrusted(agent_->peers(), observation.time));
}

bool PlannerHost::well_formed(const TrajectoryMessage& message) const {
  return message.robot_id >= 0 && message.radius > 0.0 && message.radius <= host_.largest_peer_radius &&
         message.position_sigma <= host_.largest_peer_sigma &&
         drivable(message.trajectory, {host_.largest_peer_speed});
}

MessageVerdict PlannerHost::add_message(const HeardMessage& message, double now) {
  if (host_.trusts_peers) {
    if (message->robot_id == robot_id_) return MessageVerdict::own;
    return agent_ ? agent_->hear(message, now) : MessageVerdict::accepted;
  }
  if (!well_formed(message)) {
    refuse_message(message->robot_id, PeerFault::malformed, "its messages are out of range", now);
    return MessageVerdict::malformed;
  }
  const std::optional<HeardMessage> admitted = peer_watch_.admitted(message, now);
  if (!admitted) return MessageVerdict::own;
  // The agent's table judges the rest: order, age, clock.
  const MessageVerdict verdict = agent_ ? agent_->hear(*admitted, now) : MessageVerdict::accepted;
  if (verdict == MessageVerdict::accepted) peer_watch_.believed(*admitted, now);
  if (verdict == MessageVerdict::malformed)
    peer_watch_.complain(message->robot_id, PeerFault::malformed, "its messages are of another time", now);
  return verdict;
}

bool PlannerHost::set_goal(const Goal& goal) {
  const bool usable = goal.position_world.allFinite() &&
                      goal.position_world.lpNorm<Eigen::Infinity>() <= kFarthest &&
                      std::isfinite(goal.heading.value_or(0.0));
  if (!usable) {
    ++counts_.inputs_refused;
    return false;
  }
  const bool repeated =
      goal_ && goal_->position_world == goal.position_world && goal_->heading == goal.heading;
  goal_ = goal;
  if (!repeated) recovery_.begin_anew();
  if (agent_) tell_goal();
  return true;
}

void PlannerHost::cancel() {
  goal_.reset();
  recovery_.begin_anew();
  if (agent_) agent_->clear_goal();
}

void PlannerHost::reconfigure(const AgentParameters& agent) {
  refuse_contradictions(contradictions(validated(agent), host_));
  if (agent_) agent_->reconfigure(agent);  // may refuse: the rest then stays as it was
  agent_parameters_ = agent;
  recovery_.reconfigure(agent);
}

PlannerCounts PlannerHost::counts() const {
  PlannerCounts counts = counts_;
  if (!agent_) return counts;
  const auto of = [this](MessageVerdict verdict) {
    return static_cast<std::uint32_t>(agent_->message_count(verdict));
  };
  counts.messages_accepted += of(MessageVerdict::accepted);
  counts.messages_malformed += of(MessageVerdict::malformed);
  counts.messages_old += of(MessageVerdict::old) + of(MessageVerdict::duplicate);
  counts.messages_crowded += of(MessageVerdict::crowded);
  return counts;
}

// ---- starting and starting afresh -------------------------------------------------------------------------

void PlannerHost::forget_agent(const Pose2& correction) {
  counts_ = counts();
  if (map_) {
    const OccupancyMap before = agent_ ? agent_->map() : *map_;
    map_->take_over_sensed(before, correction);
  }
  agent_.reset();
  standing_.forget();
}

void PlannerHost::meet_clock_jump() {
  forget_agent();
  peer_watch_.forget();
  last_scan_time_ = kNever;
  last_detections_time_ = kNever;
  vouched_time_ = kNever;
}

void PlannerHost::start_when_ready(double now, const Localiser& localiser) {
  const bool ready = (map_ || !needs_map_) && standing_.last() != nullptr &&
                     localiser.pose_age(now) <= agent_parameters_.team.stale_time && standing_.stands(now);
  if (!ready) return;
  const Pose2 here = standing_.last()->pose_world;
  if (!map_) map_ = sensed_map(here.position_world, host_);
  make_agent(here, now);
}

void PlannerHost::start(const OccupancyMap& map, const Pose2& pose_world, double now) {
  forget_agent();
  map_ = map;
  vouched_time_ = now;
  make_agent(pose_world, now);
}

void PlannerHost::restart_where_planned(double then, double now) {
  if (!agent_) return meet_clock_jump();
  const Pose2 here = pose_on(agent_->committed(), then);
  meet_clock_jump();
  vouched_time_ = now;
  make_agent(here, now);
}

void PlannerHost::make_agent(const Pose2& pose_world, double now) {
  agent_.emplace(robot_id_, agent_parameters_, *map_, pose_world, now);
  agent_->set_keep_candidates(keep_candidates_);
  recovery_.reset();
  if (goal_) tell_goal();
  sequence_ = {sequence_.before + sequence_.of_agent};
  stop_cause_ = StopCause::none;
  standing_.forget();
  ++counts_.restarts;
}

// ---- stepping ---------------------------------------------------------------------------------------------

StopCause PlannerHost::stop_cause(double now, const Localiser* localiser) const {
  WatchFacts facts;
  facts.emergency_stop = switches_.emergency_stop;
  facts.paused = switches_.paused;
  if (localiser != nullptr) {
    facts.pose_age = localiser->pose_age(now);
    facts.localisation_age = localiser->localisation_age(now);
  }
  facts.stuck = recovery_.stuck(now);
  if (host_.relies_on_scan) facts.scan_age = now - std::max(last_scan_time_, vouched_time_);
  if (host_.relies_on_obstacles) facts.obstacles_age = now - std::max(last_detections_time_, vouched_time_);
  return watchdog_.watch(facts);
}

const PlannerOutput& PlannerHost::step(double now, const Localiser* localiser) {
  output_.planned = output_.asked_planner = false;
  output_.broadcast.reset();
  if (!agent_ && localiser != nullptr) start_when_ready(now, *localiser);
  if (!agent_) return output_;

  if (localiser != nullptr) recover(now, *localiser);
  const StopCause cause = stop_cause(now, localiser);
  const bool at_once = (cause == StopCause::none) != (stop_cause_ == StopCause::none);
  stop_cause_ = cause;
  if (at_once || plan_due(now)) plan(now, localiser);
  return output_;
}

/// The guard lets the robot do less than was planned.
std::optional<Hold> PlannerHost::hold(const Localiser* localiser) const {
  if (localiser == nullptr || localiser->guard() == GuardAction::none) return std::nullopt;
  const MotionState motion = localiser->state();
  const Drive drive{agent_parameters_.robot};
  return Hold{drive.twist_world(motion.command, motion.estimate.pose_world.heading),
              localiser->guard() == GuardAction::stops};
}

/// A robot that is stuck: it is to stand, and may have to back off before it goes on to its goal.
void PlannerHost::recover(double now, const Localiser& localiser) {
  const std::optional<Eigen::Vector2d> before = recovery_.aside();
  const bool goes = goal_ && (stop_cause_ == StopCause::none || stop_cause_ == StopCause::stuck);
  recovery_.look(now, localiser, *agent_, goes);
  if (recovery_.aside() != before) tell_goal();
}

void PlannerHost::tell_goal() {
  if (recovery_.aside())
    agent_->set_goal(*recovery_.aside());
  else
    agent_->set_goal(goal_->position_world, goal_->heading);
}

/// Nobody looks, and nobody is relied on to: what was seen once is let go in time.
void PlannerHost::let_go(double now) {
  const double last = std::max(last_scan_time_, last_detections_time_);
  if (host_.relies_on_obstacles || now - last <= agent_parameters_.team.stale_time) return;
  Observation nothing;
  nothing.time = now;
  agent_->observe(nothing, std::nullopt, now);
}

/// Where the robot is, for the agent.
StateEstimate PlannerHost::estimate(double now, const Localiser* localiser) const {
  if (localiser != nullptr) return localiser->estimate(now);
  StateEstimate exact;
  exact.valid = true;
  exact.pose_world = pose_on(agent_->committed(), now);
  return exact;
}

void PlannerHost::plan(double now, const Localiser* localiser) {
  let_go(now);
  const StateEstimate state = estimate(now, localiser);
  std::optional<TrajectoryMessage> told = agent_->plan(now, state, stop_cause_, hold(localiser));
  output_.planned = true;
  output_.asked_planner = agent_->stop_cause() == StopCause::none;
  if (output_.asked_planner) ++counts_.plans;
  if (told) {
    sequence_.of_agent = told->sequence;
    told->sequence += sequence_.before;
    peer_watch_.told(*told);
    output_.broadcast = *told;
  }
  TrajectoryMessage& plan = output_.plan;
  plan.robot_id = robot_id_;
  plan.priority = agent_parameters_.team.priority;
  ++plan.sequence;
  plan.sent_time = now;
  plan.expiry_time = now + agent_parameters_.team.message_lifetime;
  plan.radius = agent_parameters_.robot.radius;
  plan.position_sigma = std::sqrt(state.position_variance);
  plan.state = agent_->status().state;
  plan.trajectory = agent_->committed();
  output_.observed = std::max(last_scan_time_, last_detections_time_);
}

PlannerStatus PlannerHost::status() const {
  if (!agent_) {
    std::string reason = "waits until the robot stands";
    if (!map_ && needs_map_) reason = "waits for the map";
    if (standing_.last() == nullptr) reason = to_string(StopCause::no_pose);
    return {PeerState::stopped, std::move(reason), -1};
  }
  const AgentStatus status = agent_->status();
  if (stop_cause_ != StopCause::none) return {status.state, to_string(stop_cause_), -1};
  if (recovery_.aside() && status.reason == StopCause::none) return {status.state, "backs off", -1};
  return {status.state, to_string(status.reason), status.blocking_id};
}

std::string PlannerHost::fault() const {
  if (!agent_) return status().reason;
  if (stop_cause_ == StopCause::none || stop_cause_ == StopCause::paused) return {};
  return to_string(stop_cause_);
}

Health PlannerHost::health(double now) const {
  const PlannerStatus status = this->status();
  Health health{Level::ok, status.reason};
  const bool moves = status.reason == to_string(StopCause::none);
  if (moves && status.state == PeerState::braking) health.text = "brakes";
  const bool done = !goal_ || status.state == PeerState::arrived;
  if (!done && !(moves && status.state == PeerState::moving)) health.level = Level::warn;
  if (!fault().empty()) health = {Level::error, fault()};
  peer_watch_.add_to(health, now);
  return health;
}

}  // namespace spf::host
