#include "spf/team/robot_agent.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "spf/planning/braking.hpp"
#include "spf/planning/clearance.hpp"
#include "spf/planning/guide_path.hpp"
#include "spf/planning/orca/orca_planner.hpp"
#include "spf/planning/space_time/space_time_planner.hpp"
#include "spf/team/field_replanning.hpp"
#include "spf/tracking/tracker.hpp"
#include "spf/world/obstacle_tracker.hpp"
#include "spf/world/peer_table.hpp"

namespace spf {
namespace {

constexpr double kTimeTolerance = 1e-9;  // [s] ticks that fall on a due time within rounding
constexpr double kStandingSpeed = 0.05;  // [1] of max_speed: slower is standing
constexpr double kStandingTime = 0.5;    // [s]
constexpr double kArrivedSpeed = 0.1;    // [1] of max_speed
constexpr double kClockError = 0.1;      // [s] by which a sensor's clock may be ahead
constexpr double kLongestNap = 10.0;     // [s] without a step, after which the schedule starts afresh

/// The next time of a periodic duty that is due by now.
double next_due(double due, double period, double now) {
  if (now - due > kLongestNap) due = now;
  while (due <= now + kTimeTolerance) due += period;
  return due;
}

GuidePathParameters guide_parameters(const AgentParameters& parameters) {
  GuidePathParameters guide = parameters.guide;
  guide.clearance += parameters.robot.radius;
  return guide;
}

PlannerParameters planner_parameters(const AgentParameters& parameters) {
  PlannerParameters planner = parameters.planner;
  planner.keep_candidates = parameters.team.keep_candidates;
  return planner;
}

}  // namespace

const char* to_string(StandReason reason) {
  switch (reason) {
    case StandReason::none:
      return "moving";
    case StandReason::no_goal:
      return "no goal";
    case StandReason::arrived:
      return "arrived";
    case StandReason::obstacle_ahead:
      return "waits for a moving obstacle";
    case StandReason::peer_ahead:
      return "waits for a peer";
    case StandReason::no_path:
      return "no path to the goal";
    case StandReason::planner_failed:
      return "no safe plan";
    case StandReason::stale_pose:
      return "no pose";
    case StandReason::stale_scan:
      return "no observation";
    case StandReason::lost:
      return "far from its plan";
    case StandReason::paused:
      return "paused";
  }
  return "?";
}

struct RobotAgent::Implementation {
  Implementation(int robot_id, const AgentParameters& agent_parameters, const OccupancyMap& known_map,
                 const Pose2& start, double time);

  // Believing.
  void receive(double time, const AgentInput& input);
  void receive_observation(double time, const Observation& observation);
  void refresh_beliefs(double time);
  void explain_discs(double time);

  // Planning.
  std::optional<TrajectoryMessage> plan(double time);
  [[nodiscard]] StandReason forced_stop(double time) const;
  [[nodiscard]] PlanRequest make_request(double time);
  void refresh_guide(double time);
  [[nodiscard]] bool guide_way_clear(const Eigen::Vector2d& here);
  [[nodiscard]] Eigen::Vector2d last_free_place(const Eigen::Vector2d& here);
  void make_plan(double time);
  void commit(const PlanRequest& request, bool brakes);
  void brake(double time);
  void explain_standing(double time);
  [[nodiscard]] HeadingProfile heading_for(const PlanRequest& request) const;
  void update_status(double time);
  [[nodiscard]] double own_sigma(double time) const;
  [[nodiscard]] std::optional<TrajectoryMessage> message(double time);

  int id;
  AgentParameters parameters;
  OccupancyMap map;
  Tracker tracker;
  ObstacleTracker obstacle_tracker;
  PeerTable peer_table;
  GuidePath guide;
  SpaceTimePlanner space_time;
  OrcaPlanner orca;
  FieldReplanning field;

  std::vector<ObstacleTrack> tracks;
  std::vector<Peer> peers;
  std::vector<int> distrusted;         // peers whose discs explain nothing, sorted
  std::vector<IgnoredDisc> explained;  // of the observation under way, kept for its memory
  Trajectory committed;
  PlanResult result;
  AgentStatus status;
  std::optional<Eigen::Vector2d> goal;
  std::optional<double> goal_heading;
  double held_heading;
  OmniKinematics kinematics;
  Eigen::Vector3d wheel_speeds = Eigen::Vector3d::Zero();  // [m/s]
  double told_start_time = -1.0;
  PeerState told_state = PeerState::stopped;
  bool paused = false;
  bool braking = false;  // the committed trajectory is a braking one
  StandReason stop_reason = StandReason::no_goal;

  double next_plan_time;
  double next_control_time;
  double next_message_time;
  double next_guide_time;
  double guide_time = -1e9;  // [s] of the last flood
  std::vector<Eigen::Vector2d> guide_way;
  std::optional<Eigen::Vector2d> guided_goal;  // the goal that the guide stands for
  bool cut_off = false;                        // it leads to a waiting place, since none leads to the goal
  double last_motion_time;
  double last_pose_time;
  double last_observation_time;
  double tracking_error_squared = 0.0;  // [m^2] smoothed, per axis
  std::uint32_t sequence = 0;
};

RobotAgent::Implementation::Implementation(int robot_id, const AgentParameters& agent_parameters,
                                           const OccupancyMap& known_map, const Pose2& start, double time)
    : id{robot_id},
      parameters{validated(agent_parameters)},
      map{known_map},
      tracker{parameters.tracker, parameters.robot},
      obstacle_tracker{parameters.obstacles},
      peer_table{robot_id, parameters.peers},
      guide{guide_parameters(parameters)},
      space_time{parameters.space_time, parameters.planner, parameters.robot},
      orca{parameters.orca, parameters.robot},
      field{planner_parameters(parameters), parameters.robot, parameters.field, parameters.team},
      committed{Trajectory::standing(start.position_world, time, 1.0, HeadingProfile{start.heading})},
      held_heading{start.heading},
      kinematics{parameters.robot},
      next_plan_time{time},
      next_control_time{time},
      next_message_time{time},
      next_guide_time{time},
      last_motion_time{time},
      last_pose_time{time},
      last_observation_time{time} {
  result.trajectory = committed;
}

void RobotAgent::Implementation::receive(double time, const AgentInput& input) {
  for (const PoseMeasurement& measurement : input.poses) {
    if (measurement.time > time + kClockError) continue;  // it would make all later ones late
    const MeasurementOutcome outcome = tracker.observe(measurement.time, measurement.pose_world);
    if (outcome != MeasurementOutcome::invalid) last_pose_time = std::max(last_pose_time, measurement.time);
  }
  for (const TrajectoryMessage& received : input.messages) peer_table.receive(received, time);
  if (input.observation) receive_observation(time, *input.observation);
}

void RobotAgent::Implementation::receive_observation(double time, const Observation& observation) {
  // What is too old to rely on, or not of this time at all, tells nothing about the present.
  const bool timely = observation.time >= time - parameters.team.stale_time - kTimeTolerance &&
                      observation.time <= time + kClockError;
  if (!timely) return;
  obstacle_tracker.update(observation);
  last_observation_time = std::max(last_observation_time, observation.time);
  const StateEstimate believed = tracker.estimate(observation.time);
  if (observation.scan && believed.valid) {
    explain_discs(observation.time);
    map.integrate(*observation.scan, believed.pose_world, explained);
  }
}

void RobotAgent::Implementation::explain_discs(double time) {
  // Returns from what is tracked or has told its place are not static; a little more than the disc itself,
  // since both places are uncertain.
  const double slack = 0.5 * parameters.robot.radius;
  explained.clear();
  for (const ObstacleTrack& track : obstacle_tracker.tracks()) {
    const Eigen::Vector2d now = track.state.position_world + (time - track.time) * track.state.velocity_world;
    explained.push_back(
        {now, track.state.radius + slack + 2.0 * track.position_sigma(std::max(0.0, time - track.time))});
  }
  for (const Peer& peer : peers) {
    if (std::binary_search(distrusted.begin(), distrusted.end(), peer.robot_id)) continue;
    explained.push_back({peer.position(time), peer.radius + peer.growth + slack + 2.0 * peer.position_sigma});
  }
}

void RobotAgent::Implementation::refresh_beliefs(double time) {
  tracks = obstacle_tracker.tracks();
  peers = peer_table.peers(time);
}

StandReason RobotAgent::Implementation::forced_stop(double time) const {
  if (paused) return StandReason::paused;
  if (!goal) return StandReason::no_goal;
  if (parameters.ideal_tracking) return StandReason::none;
  if (time - last_pose_time > parameters.team.stale_time) return StandReason::stale_pose;
  if (time - last_observation_time > parameters.team.stale_time) return StandReason::stale_scan;
  return StandReason::none;
}

double RobotAgent::Implementation::own_sigma(double time) const {
  if (parameters.ideal_tracking) return 0.0;
  return std::sqrt(tracker.estimate(time).position_variance + tracking_error_squared);
}

PlanRequest RobotAgent::Implementation::make_request(double time) {
  PlanRequest request;
  request.time = time;
  request.goal_world = *goal;
  request.goal_heading = goal_heading;
  request.head = committed.state(time);
  request.heading = committed.heading().state(time);
  request.committed = &committed;
  request.world = {time, id, &map, &tracks, &peers};

  const StateEstimate believed = tracker.estimate(time);
  if (!parameters.ideal_tracking && believed.valid) {
    // The plan goes on from the plan, which keeps it smooth; but a robot that has been pushed away starts
    // anew.
    const Eigen::Vector2d error = believed.pose_world.position_world - request.head.position_world;
    const double limit =
        std::max(parameters.team.reanchor_distance, 4.0 * std::sqrt(believed.position_variance));
    if (error.norm() > limit) {
      request.head = {believed.pose_world.position_world, Eigen::Vector2d::Zero(), Eigen::Vector2d::Zero()};
      request.heading = {believed.pose_world.heading, 0.0};
      request.committed = nullptr;
      tracking_error_squared = 0.0;
    } else {
      constexpr double kSmoothing = 0.1;  // of about one second at ten plans a second
      tracking_error_squared += kSmoothing * (0.5 * error.squaredNorm() - tracking_error_squared);
    }
  }
  request.position_sigma = own_sigma(time);
  return request;
}

void RobotAgent::Implementation::refresh_guide(double time) {
  const Eigen::Vector2d here = committed.position(time);
  const bool same_goal = guide.ready() && guided_goal == *goal;
  if (same_goal && time < next_guide_time - kTimeTolerance) return;
  // What was newly sensed off the way makes no other way shorter: only a way that is blocked cannot wait.
  const bool can_wait = same_goal && time < guide_time + parameters.team.guide_idle_period - kTimeTolerance;
  if (can_wait && (cut_off || guide_way_clear(here))) return;
  if (same_goal && !cut_off && !guide.outdated(map, *goal, here)) return;
  guide.update(map, *goal, here);
  // Without a way to the goal the robot goes as near as the shortest way through the walls leads, and waits
  // there.
  cut_off = guide.outcome() == GuideOutcome::unreachable && parameters.generator != Generator::field;
  if (cut_off) guide.update(map, last_free_place(here), here);
  guided_goal = *goal;
  guide_time = time;
  next_guide_time = time + parameters.team.guide_period;
}

/// The last place on the guide's way that keeps its clearance all the way there.
Eigen::Vector2d RobotAgent::Implementation::last_free_place(const Eigen::Vector2d& here) {
  guide.way(here, guide_way);
  Eigen::Vector2d last = here;
  const double step = map.frame().resolution;
  for (std::size_t i = 1; i < guide_way.size(); ++i) {
    const Eigen::Vector2d leg = guide_way[i] - guide_way[i - 1];
    const int steps = std::max(1, static_cast<int>(leg.norm() / step));
    for (int k = 1; k <= steps; ++k) {
      const Eigen::Vector2d place = guide_way[i - 1] + leg * (static_cast<double>(k) / steps);
      if (map.distance(place) < guide.parameters().clearance) return last;
      last = place;
    }
  }
  return last;
}

bool RobotAgent::Implementation::guide_way_clear(const Eigen::Vector2d& here) {
  if (!guide.ready() || guide.outcome() == GuideOutcome::unreachable) return false;
  guide.way(here, guide_way);
  const double clearance =
      guide.parameters().clearance - 0.5 * map.frame().resolution;  // it grazes its corners
  for (std::size_t i = 1; i < guide_way.size(); ++i) {
    if (!map.segment_clear(guide_way[i - 1], guide_way[i], clearance)) return false;
  }
  return true;
}

std::optional<TrajectoryMessage> RobotAgent::Implementation::plan(double time) {
  next_plan_time = next_due(next_plan_time, parameters.team.plan_period, time);
  // 1. What is believed now.
  refresh_beliefs(time);
  // 2. Reasons to stand that no plan can mend.
  stop_reason = forced_stop(time);
  if (stop_reason != StandReason::none) {
    brake(time);
  } else {
    // 3. A plan, committed unless it failed.
    refresh_guide(time);
    make_plan(time);
  }
  // 4. Say how it stands, to the host and to the peers.
  update_status(time);
  return message(time);
}

void RobotAgent::Implementation::make_plan(double time) {
  const PlanRequest request = make_request(time);
  switch (parameters.generator) {
    case Generator::space_time:
      space_time.plan(request, guide, parameters.team.keep_candidates, result);
      commit(request, false);
      break;
    case Generator::orca:
      orca.plan(request, guide, parameters.team.keep_candidates, result);
      commit(request, false);
      break;
    case Generator::field: {
      const ReplanDecision decision = field.decide(request, guide, braking, result);
      if (decision == ReplanDecision::commit) commit(request, false);
      if (decision == ReplanDecision::brake) commit(request, true);
      if (decision == ReplanDecision::keep && request.committed == nullptr) brake(time);
      break;
    }
  }
}

/// Makes the result's trajectory the one under way.
void RobotAgent::Implementation::commit(const PlanRequest& request, bool brakes) {
  braking = brakes;
  if (request.committed != nullptr && result.trajectory.start_time() < request.time)
    return;  // it is the old one
  committed = result.trajectory;
  committed.set_heading(heading_for(request));
}

HeadingProfile RobotAgent::Implementation::heading_for(const PlanRequest& request) const {
  double target = held_heading;
  switch (parameters.heading_mode) {
    case HeadingMode::keep:
      break;
    case HeadingMode::goal:
      target = goal_heading.value_or(held_heading);
      break;
    case HeadingMode::motion: {
      const Eigen::Vector2d ahead = committed.state(request.time + 0.5).velocity_world;
      const bool clearly = ahead.norm() > 0.1 * parameters.robot.max_speed;
      target = clearly ? std::atan2(ahead.y(), ahead.x()) : request.heading.heading;
      break;
    }
  }
  const bool held =
      std::abs(angle_difference(target, request.heading.heading)) < 1e-9 && request.heading.yaw_rate == 0.0;
  if (held) return HeadingProfile{target};
  return fitted_heading(committed, request.heading, target, parameters.robot, kinematics);
}

void RobotAgent::Implementation::brake(double time) {
  if (braking) return;  // the braking trajectory under way ends standing
  const FlatState head = committed.state(time);
  committed = braking_trajectory(head, committed.heading().state(time), time, parameters.robot);
  result.outcome = PlanOutcome::unsafe;
  result.trajectory = committed;
  result.stats = {};
  result.candidates.clear();
  braking = true;
}

void RobotAgent::Implementation::update_status(double time) {
  const FlatState now = committed.state(time);
  const double standing_speed = kStandingSpeed * parameters.robot.max_speed;
  const double soon = committed.state(time + 0.5).velocity_world.norm();
  // A robot that means to go soon, and still means to half a second later, stands.
  if (now.velocity_world.norm() >= standing_speed) last_motion_time = time;
  const bool stands = now.velocity_world.norm() < standing_speed &&
                      (soon < standing_speed || time - last_motion_time > kStandingTime);
  status = {};
  if (goal && (now.position_world - *goal).norm() < parameters.team.goal_tolerance &&
      now.velocity_world.norm() < kArrivedSpeed * parameters.robot.max_speed) {
    status.state = PeerState::arrived;
    status.reason = stands ? StandReason::arrived : StandReason::none;
    return;
  }
  status.reason = stop_reason;
  if (!stands) {
    status.state = braking ? PeerState::braking : PeerState::moving;
    return;
  }
  status.state = PeerState::stopped;
  if (stop_reason == StandReason::none) explain_standing(time);
}

void RobotAgent::Implementation::explain_standing(double time) {
  const bool no_way = cut_off || guide.outcome() == GuideOutcome::unreachable ||
                      guide.outcome() == GuideOutcome::no_free_goal;
  // As near to a goal on blocked ground as the way leads.
  const bool at_substitute =
      guide.outcome() == GuideOutcome::goal_moved &&
      (committed.position(time) - guide.goal_used()).norm() < parameters.team.goal_tolerance;
  if (no_way || at_substitute) {
    status.reason = StandReason::no_path;
  } else if (result.blocking_track >= 0) {
    status.reason = StandReason::obstacle_ahead;
    status.culprit = result.blocking_track;
  } else if (result.blocking_peer >= 0) {
    status.reason = StandReason::peer_ahead;
    status.culprit = result.blocking_peer;
  } else {
    status.reason = StandReason::planner_failed;
  }
}

std::optional<TrajectoryMessage> RobotAgent::Implementation::message(double time) {
  const bool changed = committed.start_time() != told_start_time || status.state != told_state;
  const bool due = next_plan_time > next_message_time + kTimeTolerance;  // the next chance would be too late
  if (!changed && !due) return std::nullopt;
  next_message_time = time + parameters.team.message_period;
  told_start_time = committed.start_time();
  told_state = status.state;
  TrajectoryMessage told;
  told.robot_id = id;
  told.sequence = ++sequence;
  told.sent_time = time;
  told.expiry_time = time + parameters.team.message_lifetime;
  told.radius = parameters.robot.radius;
  told.position_sigma = own_sigma(time);
  told.state = status.state;
  told.trajectory = committed;
  return told;
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
  implementation_->field.reset();
  implementation_->goal = goal_world;
  implementation_->goal_heading = goal_heading;
}
void RobotAgent::clear_goal() {
  implementation_->goal.reset();
}
void RobotAgent::set_paused(bool paused) {
  implementation_->paused = paused;
}
void RobotAgent::set_distrusted(std::vector<int> robot_ids) {
  implementation_->distrusted = std::move(robot_ids);
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
  return time >= implementation_->next_plan_time - kTimeTolerance;
}
bool RobotAgent::control_due(double time) const {
  return time >= implementation_->next_control_time - kTimeTolerance;
}
std::optional<TrajectoryMessage> RobotAgent::plan(double time) {
  return implementation_->plan(time);
}

Eigen::Vector3d RobotAgent::track(double time) {
  Implementation& self = *implementation_;
  const double period = self.parameters.tracker.control_period;
  self.next_control_time = next_due(self.next_control_time, period, time);
  self.wheel_speeds = self.tracker.step(time, self.committed).wheel_speeds;
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
  return implementation_->committed;
}

AgentEstimate RobotAgent::estimate() const {
  const StateEstimate believed = implementation_->tracker.estimate(implementation_->last_pose_time);
  return {believed.pose_world, believed.disturbance_world, std::sqrt(believed.position_variance),
          believed.valid};
}

AgentStatus RobotAgent::status() const {
  return implementation_->status;
}
const OccupancyMap& RobotAgent::map() const {
  return implementation_->map;
}
const std::vector<ObstacleTrack>& RobotAgent::tracks() const {
  return implementation_->tracks;
}
const std::vector<Peer>& RobotAgent::peers() const {
  return implementation_->peers;
}
std::uint64_t RobotAgent::message_count(MessageVerdict verdict) const {
  return implementation_->peer_table.count(verdict);
}

}  // namespace spf
