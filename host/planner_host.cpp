#include "host/planner_host.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "host/plan_check.hpp"
#include "host/scan_check.hpp"
#include "host/sensed_map.hpp"

namespace spf::host {
namespace {

constexpr double kLookBack = 0.3;          // [s] of poses by which a robot is seen to stand
constexpr double kStandingSpeed = 0.1;     // [1] of max_speed
constexpr std::size_t kMostWaiting = 256;  // poses, or messages, between two steps; then the agent takes them
constexpr std::size_t kMostRecent = 4096;  // poses of the look back, at 10 kHz and more
constexpr double kSpare = 1.0;             // [s] beyond braking, after which it is taken to stand

Eigen::Vector2d mean_position(const std::vector<PoseMeasurement>& poses, std::size_t from, std::size_t to) {
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (std::size_t i = from; i < to; ++i) sum += poses[i].pose_world.position_world;
  return sum / static_cast<double>(to - from);
}

}  // namespace

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
      gate_{host_, agent_parameters_.robot},
      clock_{host_.clock_jump},
      last_scan_time_{kNever},
      last_detections_time_{kNever},
      sequence_{first_sequence} {}

void PlannerHost::set_map(OccupancyMap map) {
  map_ = std::move(map);
  forget_agent();  // it knows another one
}

// ---- what comes in ----------------------------------------------------------------------------------------

PoseVerdict PlannerHost::add_pose(const PoseMeasurement& pose, double now) {
  if (clock_.jumped(now)) meet_clock_jump();
  const PoseVerdict verdict = gate_.judge(pose, clock_.now());
  if (!believed(verdict)) {
    ++counts_.inputs_refused;
    return verdict;
  }
  if (verdict == PoseVerdict::relocalised) forget_agent();
  if (agent_) {
    if (input_.poses.size() >= kMostWaiting) agent_->receive(clock_.now(), std::exchange(input_, {}));
    input_.poses.push_back(pose);
    return verdict;
  }
  if (!first_pose_time_) first_pose_time_ = pose.time;
  if (recent_poses_.size() >= kMostRecent) recent_poses_.erase(recent_poses_.begin());
  recent_poses_.push_back(pose);
  const auto old = [&](const PoseMeasurement& past) { return past.time < pose.time - kLookBack; };
  recent_poses_.erase(recent_poses_.begin(),
                      std::find_if_not(recent_poses_.begin(), recent_poses_.end(), old));
  return verdict;
}

ObservationVerdict PlannerHost::add_observation(SensedWorld sensed, double now) {
  if (clock_.jumped(now)) meet_clock_jump();
  now = clock_.now();
  const Observation& observation = sensed.observation;
  const auto refuse = [this](ObservationVerdict verdict) {
    ++counts_.inputs_refused;
    return verdict;
  };
  if (!std::isfinite(observation.time) || !sensible(observation.detections) ||
      (observation.scan && !sensible(*observation.scan)))
    return refuse(ObservationVerdict::malformed);
  if (observation.time > now + host_.clock_error) return refuse(ObservationVerdict::future);
  const bool newer = (observation.scan && observation.time > last_scan_time_) ||
                     (sensed.has_detections && observation.time > last_detections_time_);
  if (!newer || now - observation.time > agent_parameters_.team.stale_time)
    return refuse(ObservationVerdict::late);
  if (observation.scan) last_scan_time_ = std::max(last_scan_time_, observation.time);
  if (sensed.has_detections) last_detections_time_ = std::max(last_detections_time_, observation.time);
  if (agent_) {
    // One at a time: an agent's input holds one observation.
    if (input_.observation) agent_->receive(now, std::exchange(input_, {}));
    doubt_peers(observation);
    input_.observation = std::move(sensed.observation);
  }
  return ObservationVerdict::accepted;
}

/// Before the scan enters the map: whose discs are not to hide what it shows.
void PlannerHost::doubt_peers(const Observation& observation) {
  if (!observation.scan || !gate_.last()) return;
  witness_.see(*observation.scan, gate_.last()->pose_world, observation.time, agent_->peers());
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

MessageVerdict PlannerHost::add_message(const TrajectoryMessage& message, double now) {
  if (clock_.jumped(now)) meet_clock_jump();
  if (message.robot_id == robot_id_) return MessageVerdict::own;
  if (!well_formed(message)) {
    ++counts_.messages_malformed;
    return MessageVerdict::malformed;
  }
  // The agent's table judges the rest: order, age, clock.
  if (agent_) {
    if (input_.messages.size() >= kMostWaiting) agent_->receive(clock_.now(), std::exchange(input_, {}));
    input_.messages.push_back(message);
  }
  witness_.hear(message, clock_.now());
  return MessageVerdict::accepted;
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
  if (agent_) agent_->set_goal(goal.position_world, goal.heading);
  return true;
}

void PlannerHost::cancel() {
  goal_.reset();
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

std::string PlannerHost::fault() const {
  if (!agent_) return status().reason;
  return hindrance_ == to_string(StandReason::paused) ? std::string{} : hindrance_;
}

// ---- starting and starting afresh -------------------------------------------------------------------------

void PlannerHost::forget_agent() {
  counts_ = counts();
  agent_.reset();
  input_ = {};
  recent_poses_.clear();
  first_pose_time_.reset();
}

void PlannerHost::meet_clock_jump() {
  forget_agent();
  witness_.forget();
  gate_.reset();
  last_scan_time_ = kNever;
  last_detections_time_ = kNever;
}

/// Seen to stand, or long enough without a plan that its tracker must have stopped it.
bool PlannerHost::stands(double now) const {
  const RobotParameters& robot = agent_parameters_.robot;
  const double stopping = host_.plan_silence + robot.max_speed / robot.max_acceleration + kSpare;
  if (now - *first_pose_time_ > stopping) return true;
  const std::size_t count = recent_poses_.size();
  const double span = count < 2 ? 0.0 : recent_poses_.back().time - recent_poses_.front().time;
  if (span < 0.9 * kLookBack || count < 4) return false;
  const Eigen::Vector2d moved =
      mean_position(recent_poses_, count / 2, count) - mean_position(recent_poses_, 0, count / 2);
  return moved.norm() < kStandingSpeed * robot.max_speed * 0.5 * span;
}

void PlannerHost::start_when_ready(double now) {
  const bool ready = (map_ || !needs_map_) && first_pose_time_ && !recent_poses_.empty() &&
                     gate_.age(now) <= agent_parameters_.team.stale_time && stands(now);
  if (!ready) return;
  const Pose2 here = recent_poses_.back().pose_world;
  if (!map_) map_ = sensed_map(here.position_world, host_, agent_parameters_.occupancy);
  agent_.emplace(robot_id_, agent_parameters_, *map_, here, now);
  if (goal_) agent_->set_goal(goal_->position_world, goal_->heading);
  input_.poses.push_back(recent_poses_.back());
  sequence_ += agent_sequence_;
  agent_sequence_ = 0;
  hindrance_.clear();
  ++counts_.restarts;
}

// ---- stepping ---------------------------------------------------------------------------------------------

/// What is missing, so that the robot has to stand; empty when all is well.
std::string PlannerHost::hindrance(double now) const {
  const double stale = agent_parameters_.team.stale_time;
  if (emergency_stop_) return "emergency stop";
  if (paused_) return to_string(StandReason::paused);
  if (gate_.age(now) > stale) return to_string(StandReason::stale_pose);
  if (host_.relies_on_scan && now - last_scan_time_ > stale) return "no scan";
  if (host_.relies_on_obstacles && now - last_detections_time_ > stale) return "no report of obstacles";
  return {};
}

const PlannerOutput& PlannerHost::step(double now) {
  if (clock_.jumped(now)) meet_clock_jump();
  now = clock_.now();
  output_.planned = false;
  output_.broadcast.reset();
  if (!agent_) start_when_ready(now);
  if (!agent_) return output_;

  if (!host_.relies_on_scan && !host_.relies_on_obstacles && !input_.observation) {
    input_.observation.emplace();  // nothing is sensed, and nothing is to be waited for
    input_.observation->time = now;
  }
  agent_->receive(now, std::exchange(input_, {}));
  std::string hindered = hindrance(now);
  const bool at_once = hindered.empty() != hindrance_.empty();
  hindrance_ = std::move(hindered);
  agent_->set_paused(!hindrance_.empty());
  if (at_once || agent_->plan_due(now)) plan(now);
  // In parallel to the tracker, so that the agent's own observer knows what the wheels are told.
  if (agent_->control_due(now)) agent_->track(now);
  return output_;
}

void PlannerHost::plan(double now) {
  std::optional<TrajectoryMessage> told = agent_->plan(now);
  ++counts_.plans;
  output_.planned = true;
  if (told) {
    agent_sequence_ = told->sequence;
    told->sequence += sequence_;
  }
  output_.broadcast = std::move(told);
  TrajectoryMessage& plan = output_.plan;
  plan.robot_id = robot_id_;
  plan.priority = agent_parameters_.team.priority;
  plan.sequence = counts_.plans;
  plan.sent_time = now;
  plan.expiry_time = now + agent_parameters_.team.message_lifetime;
  plan.radius = agent_parameters_.robot.radius;
  plan.position_sigma = agent_->estimate().position_sigma;
  plan.state = agent_->status().state;
  plan.trajectory = agent_->committed();
  output_.observed = std::max(last_scan_time_, last_detections_time_);
}

PlannerStatus PlannerHost::status() const {
  if (!agent_) {
    std::string reason = "waits until the robot stands";
    if (!map_ && needs_map_) reason = "waits for the map";
    if (!first_pose_time_) reason = to_string(StandReason::stale_pose);
    return {PeerState::stopped, std::move(reason), -1};
  }
  const AgentStatus status = agent_->status();
  if (!hindrance_.empty()) return {status.state, hindrance_, -1};
  return {status.state, to_string(status.reason), status.culprit};
}

}  // namespace spf::host
