#include "spf/planning/field/field_replanning.hpp"

#include <algorithm>

#include "spf/planning/braking.hpp"

namespace spf {
namespace {

constexpr double kRetryFirst = 0.2;    // [s] back-off after a failed plan; it doubles each time
constexpr double kRetryLongest = 1.6;  // [s] longest back-off
constexpr double kCommittedMargin =
    0.5;  // [1] of the margins: a plan is not dropped for a clearance with which it was accepted
constexpr double kPrimitiveHorizon = 3.0;  // [s]
constexpr double kLinger = 0.5;            // [s] longer in a field than the quickest way out, at most
constexpr double kTimeTolerance = 1e-9;    // [s]

/// Whether the robot goes before this peer, moving or not.
bool goes_before(const WorldSnapshot& world, int peer_id) {
  const auto peer = std::find_if(world.peers->begin(), world.peers->end(),
                                 [peer_id](const Peer& candidate) { return candidate.robot_id == peer_id; });
  return peer != world.peers->end() && goes_first(world.rank(), peer->rank());
}

}  // namespace

FieldReplanning::FieldReplanning(const PlannerParameters& planner, const RobotParameters& robot,
                                 const FieldParameters& field, const ReplanningParameters& replanning)
    : robot_{robot},
      replanning_{validated(replanning)},
      horizon_{planner.horizon},
      planner_{planner, robot, field},
      check_{planner, robot, field} {}

/// A new goal is planned for at once.
void FieldReplanning::meet_goal(const Eigen::Vector2d& goal_world) {
  if (goal_ == goal_world) return;
  goal_ = goal_world;
  last_plan_time_ = -1e9;
  retry_time_ = -1e9;
  back_off_ = 0.0;
}

FieldReplanning::Threat FieldReplanning::threat_to(const Trajectory& trajectory,
                                                   const PlanRequest& request) const {
  Threat threat;
  const double stop_time = request.head.velocity_world.norm() / robot_.max_acceleration;
  const double until = std::max(trajectory.end_time(), request.time + kPrimitiveHorizon);
  threat.report = check_.check(trajectory, {request.time, until, until, kCommittedMargin});
  threat.conflict = !threat.report.clear();
  threat.urgent =
      threat.conflict && threat.report.time - request.time < stop_time + replanning_.emergency_time;
  // A peer that has to yield will plan around this robot, which reacts only when the peer gets close.
  if (threat.report.kind == ConflictKind::peer && !threat.urgent &&
      goes_before(request.world, threat.report.id))
    threat.conflict = false;
  // The obstacle may be here soon: a trajectory has to leave the regions nearly as fast as possible.
  if (in_fields_) {
    const double stay = check_.time_in_fields(trajectory, request.time, request.time + kPrimitiveHorizon);
    threat.in_field = stay > escape_.time_in_fields + kLinger;
    threat.conflict = threat.conflict || threat.in_field;
    threat.urgent = threat.urgent || threat.in_field;
  }
  return threat;
}

/// Finds the quickest way out for a robot in a danger region.
void FieldReplanning::find_escape(const PlanRequest& request) {
  in_fields_ = replanning_.retreat && check_.field_clearance(request.head.position_world) < 0.0;
  if (!in_fields_) return;
  escape_ = best_emergency_manoeuvre(request.head, request.heading, request.time,
                                     request.time + kPrimitiveHorizon, check_, robot_);
}

bool FieldReplanning::plan_due(const PlanRequest& request, const Threat& threat) const {
  if (request.time < retry_time_ - kTimeTolerance) return false;
  if (request.braking || threat.conflict || request.committed == nullptr) return true;
  if (request.time - last_plan_time_ >= replanning_.replan_period - kTimeTolerance) return true;
  return request.committed->end_time() - request.time < replanning_.emergency_time;
}

void FieldReplanning::plan(const PlanRequest& request, PlanResult& result) {
  result.clear();
  if (!usable(request)) {
    stand_instead(request, robot_, PlanOutcome::invalid_request, result);
    return;
  }
  meet_goal(request.goal_world);
  // 1. Conflicts ahead on the committed trajectory, up to its end and with all peers.
  check_.prepare(request.world, request.time, PeerSelection::all);
  find_escape(request);
  Threat threat;
  if (request.committed != nullptr) threat = threat_to(*request.committed, request);
  // 2. A new plan when one is due; else the committed one, as long as it leads to no early contact.
  if (plan_due(request, threat)) {
    attempt(request, threat, result);
  } else {
    result.outcome = last_.outcome;
    result.blocking_track = last_.blocking_track;
    result.blocking_peer = last_.blocking_peer;
    if (threat.urgent)
      fail(request, threat, result);
    else
      keep(request, result);
  }
  last_ = {result.outcome, result.blocking_track, result.blocking_peer};
}

void FieldReplanning::attempt(const PlanRequest& request, const Threat& threat, PlanResult& result) {
  planner_.plan(request, result);
  // Accept it, unless it has an early contact with a peer that it did not plan around.
  if (succeeded(result.outcome) && !threat_to(result.trajectory, request).urgent) {
    last_plan_time_ = request.time;
    retry_time_ = -1e9;
    back_off_ = 0.0;
    return;
  }
  // No plan: wait a little longer each time before the next attempt.
  back_off_ = back_off_ > 0.0 ? std::min(2.0 * back_off_, kRetryLongest) : kRetryFirst;
  retry_time_ = request.time + back_off_;
  name_blocker(request, result);
  fail(request, threat, result);
}

void FieldReplanning::name_blocker(const PlanRequest& request, PlanResult& result) const {
  const CostToGo& guide = *request.guide;
  const bool named = result.blocking_track >= 0 || result.blocking_peer >= 0;
  if (named || !guide.ready() || result.outcome == PlanOutcome::no_path) return;
  const double step = 0.5 * robot_.radius;
  for (double ahead = 0.0; ahead <= horizon_; ahead += step) {
    const Eigen::Vector2d position = guide.descend(request.head.position_world, ahead);
    for (const MovingDisc& disc : check_.discs()) {
      DiscCursor cursor{disc};
      cursor.move_to(request.time);
      if ((position - cursor.position()).norm() > disc.radius) continue;
      (disc.is_peer ? result.blocking_peer : result.blocking_track) = disc.id;
      return;
    }
    for (const DangerRegion& region : check_.regions()) {
      if (region.field.clearance(position, region.threshold) > 0.0) continue;
      result.blocking_track = region.id;
      return;
    }
  }
}

void FieldReplanning::keep(const PlanRequest& request, PlanResult& result) {
  result.action = PlanAction::keep;
  if (request.committed != nullptr) result.trajectory = *request.committed;
}

void FieldReplanning::fail(const PlanRequest& request, const Threat& threat, PlanResult& result) {
  if (succeeded(result.outcome)) result.outcome = PlanOutcome::unsafe;
  if (request.committed != nullptr && !threat.urgent) return keep(request, result);
  if (threat.report.kind == ConflictKind::obstacle) result.blocking_track = threat.report.id;
  if (threat.report.kind == ConflictKind::peer) result.blocking_peer = threat.report.id;
  const EmergencyManoeuvre manoeuvre =
      in_fields_ ? escape_
                 : best_emergency_manoeuvre(request.head, request.heading, request.time,
                                            request.time + kPrimitiveHorizon, check_, robot_);
  if (manoeuvre.sidestep && replanning_.retreat) {
    result.action = PlanAction::brake;
    result.trajectory = manoeuvre.trajectory;
    return;
  }
  if (request.braking) return keep(request, result);  // it is braking or at rest already
  result.action = PlanAction::brake;
  result.trajectory = braking_trajectory(request.head, request.heading, request.time, robot_);
}

}  // namespace spf
