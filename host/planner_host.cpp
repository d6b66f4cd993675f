#include "host/planner_host.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "host/plan_check.hpp"
#include "host/robot_map.hpp"
#include "host/scan_check.hpp"
#include "spf/team/schedule.hpp"

namespace spf::host {

const char* to_string(ObservationVerdict verdict) {
  switch (verdict) {
    case ObservationVerdict::accepted:
      return "accepted";
    case ObservationVerdict::malformed:
      return "malformed";
    case ObservationVerdict::future:
      return "from the future";
    case ObservationVerdict::late:
      return "late or duplicated";
  }
  return "?";
}

PlannerHost::PlannerHost(int robot_id, const AgentParameters& agent, const HostParameters& host,
                         std::uint32_t first_sequence)
    : robot_id_{robot_id},
      agent_parameters_{validated(agent)},
      host_{validated(host)},
      watchdog_{host_, agent_parameters_.team.stale_time},
      standing_{host_, agent_parameters_.robot},
      recovery_{agent_parameters_},
      sequence_{first_sequence} {}

void PlannerHost::set_map(OccupancyMap map) {
  map_ = std::move(map);
  forget_agent();  // it knows another one
}

// ---- what comes in ----------------------------------------------------------------------------------------

void PlannerHost::note_pose(const PoseMeasurement& pose, PoseVerdict verdict) {
  if (verdict == PoseVerdict::relocalised) forget_agent();
  if (believed(verdict) && !agent_) standing_.add(pose);
}

ObservationVerdict PlannerHost::judge(const SensedWorld& sensed, double now) const {
  const Observation& observation = sensed.observation;
  if (!std::isfinite(observation.time) || !sensible(observation.detections) ||
      (observation.scan && !sensible(*observation.scan)))
    return ObservationVerdict::malformed;
  // What the agent would not take in must not pass for a look around.
  if (observation.time > now + std::min(host_.clock_error, kClockError)) return ObservationVerdict::future;
  const bool newer = (observation.scan && observation.time > last_scan_time_) ||
                     (sensed.has_detections && observation.time > last_detections_time_);
  if (!newer || observation.time < now - agent_parameters_.team.stale_time - kTimeTolerance)
    return ObservationVerdict::late;
  return ObservationVerdict::accepted;
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
  const StateEstimate then = localiser != nullptr ? localiser->estimate(observation.time) : StateEstimate{};
  std::optional<Pose2> from;
  if (then.valid) from = then.pose_world;
  if (localiser == nullptr) {
    const Trajectory& plan = agent_->committed();
    from = Pose2{plan.position(observation.time), plan.heading().state(observation.time).heading};
  }
  if (observation.scan && from && !host_.trusts_peers) doubt_peers(observation, *from);
  agent_->observe(observation, from, now);
  return verdict;
}

/// Before the scan enters the map: whose discs are not to hide what it shows.
void PlannerHost::doubt_peers(const Observation& observation, const Pose2& pose_world) {
  witness_.see(*observation.scan, pose_world, observation.time, agent_->peers());
  std::vector<int> doubted;
  for (const Peer& peer : agent_->peers())
    if (!witness_.trusts(peer.robot_id, observation.time)) doubted.push_back(peer.robot_id);
  agent_->set_distrusted(std::move(doubted));
}

bool PlannerHost::well_formed(const TrajectoryMessage& message) const {
  return message.robot_id >= 0 && message.radius > 0.0 && message.radius <= host_.largest_peer_radius &&
         message.position_sigma <= host_.largest_peer_sigma &&
         drivable(message.trajectory, {host_.largest_peer_speed});
}

MessageVerdict PlannerHost::add_message(const HeardMessage& message, double now) {
  if (message->robot_id == robot_id_) return MessageVerdict::own;
  if (!host_.trusts_peers) {
    if (!well_formed(message)) {
      ++counts_.messages_malformed;
      return MessageVerdict::malformed;
    }
  }
  // The agent's table judges the rest: order, age, clock.
  const MessageVerdict verdict = agent_ ? agent_->hear(message, now) : MessageVerdict::accepted;
  if (verdict == MessageVerdict::accepted && !host_.trusts_peers) witness_.hear(message, now);
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
  goal_ = goal;
  recovery_.begin_anew();
  if (agent_) tell_goal();
  return true;
}

void PlannerHost::cancel() {
  goal_.reset();
  recovery_.begin_anew();
  if (agent_) agent_->clear_goal();
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

void PlannerHost::forget_agent() {
  counts_ = counts();
  agent_.reset();
  standing_.forget();
}

void PlannerHost::meet_clock_jump() {
  forget_agent();
  witness_.forget();
  last_scan_time_ = kNever;
  last_detections_time_ = kNever;
  vouched_time_ = kNever;
}

void PlannerHost::start_when_ready(double now, const Localiser& localiser) {
  const bool ready = (map_ || !needs_map_) && standing_.last() != nullptr &&
                     localiser.pose_age(now) <= agent_parameters_.team.stale_time && standing_.stands(now);
  if (!ready) return;
  const Pose2 here = standing_.last()->pose_world;
  if (!map_) map_ = sensed_map(here.position_world, host_, agent_parameters_.occupancy);
  make_agent(here, now);
}

void PlannerHost::start(const OccupancyMap& map, const Pose2& pose_world, double now) {
  set_map(map);
  vouched_time_ = now;
  make_agent(pose_world, now);
}

void PlannerHost::restart_where_planned(double then, double now) {
  if (!agent_) return meet_clock_jump();
  const Trajectory& plan = agent_->committed();
  const Pose2 here{plan.position(then), plan.heading().state(then).heading};
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
  if (localiser != nullptr) facts.pose_age = localiser->pose_age(now);
  facts.stuck = recovery_.stuck(now);
  if (host_.relies_on_scan) facts.scan_age = now - std::max(last_scan_time_, vouched_time_);
  if (host_.relies_on_obstacles) facts.obstacles_age = now - std::max(last_detections_time_, vouched_time_);
  return watchdog_.watch(facts);
}

const PlannerOutput& PlannerHost::step(double now, const Localiser* localiser) {
  output_.planned = false;
  output_.broadcast.reset();
  if (!agent_ && localiser != nullptr) start_when_ready(now, *localiser);
  if (!agent_) return output_;

  if (localiser != nullptr) recover(now, *localiser);
  const StopCause cause = stop_cause(now, localiser);
  const bool at_once = (cause == StopCause::none) != (stop_cause_ == StopCause::none);
  stop_cause_ = cause;
  if (at_once || agent_->plan_due(now)) plan(now, localiser);
  return output_;
}

/// A robot that is stuck: it is to stand, and may have to back off before it goes on to its goal.
void PlannerHost::recover(double now, const Localiser& localiser) {
  const std::optional<Eigen::Vector2d> before = recovery_.aside();
  const bool goes = goal_ && (stop_cause_ == StopCause::none || stop_cause_ == StopCause::stuck);
  recovery_.look(now, localiser, *agent_, goes);
  if (recovery_.aside() != before) tell_goal();
}

void PlannerHost::tell_goal() {
  agent_->set_goal(recovery_.aside().value_or(goal_->position_world), goal_->heading);
}

/// Nobody looks, and nobody is relied on to: what was seen once is let go in time.
void PlannerHost::let_go(double now) {
  const double last = std::max(last_scan_time_, last_detections_time_);
  if (host_.relies_on_obstacles || now - last <= agent_parameters_.team.stale_time) return;
  Observation nothing;
  nothing.time = now;
  agent_->observe(nothing, std::nullopt, now);
}

void PlannerHost::plan(double now, const Localiser* localiser) {
  let_go(now);
  std::optional<StateEstimate> state;
  if (localiser != nullptr) state = localiser->estimate(now);
  std::optional<TrajectoryMessage> told = agent_->plan(now, state, stop_cause_);
  ++counts_.plans;
  output_.planned = true;
  if (told) {
    sequence_.of_agent = told->sequence;
    told->sequence += sequence_.before;
  }
  if (told) output_.broadcast = *told;
  TrajectoryMessage& plan = output_.plan;
  plan.robot_id = robot_id_;
  plan.priority = agent_parameters_.team.priority;
  plan.sequence = counts_.plans;
  plan.sent_time = now;
  plan.expiry_time = now + agent_parameters_.team.message_lifetime;
  plan.radius = agent_parameters_.robot.radius;
  plan.position_sigma = state ? std::sqrt(state->position_variance) : 0.0;
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
  return {status.state, to_string(status.reason), status.culprit};
}

std::string PlannerHost::fault() const {
  if (!agent_) return status().reason;
  if (stop_cause_ == StopCause::none || stop_cause_ == StopCause::paused) return {};
  return to_string(stop_cause_);
}

}  // namespace spf::host
