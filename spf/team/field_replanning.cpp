#include "spf/team/field_replanning.hpp"

#include <algorithm>

#include "spf/planning/braking.hpp"

namespace spf {
namespace {

constexpr double kCommittedMargin =
    0.5;  // [1] of the margins: a plan is not dropped for what it was accepted with
constexpr double kEvasionHorizon = 3.0;  // [s]
constexpr double kLinger = 0.5;          // [s] longer in a field than the quickest way out, at most
constexpr double kTimeTolerance = 1e-9;  // [s]

}  // namespace

FieldReplanning::FieldReplanning(const PlannerParameters& planner, const RobotParameters& robot,
                                 const FieldParameters& field, const TeamParameters& team)
    : robot_{robot},
      team_{team},
      horizon_{planner.horizon},
      planner_{planner, robot, field},
      check_{planner, robot, field} {}

void FieldReplanning::reset() {
  last_plan_time_ = -1e9;
  retry_time_ = -1e9;
  back_off_ = 0.0;
}

FieldReplanning::Threat FieldReplanning::threat_to(const Trajectory& trajectory,
                                                   const PlanRequest& request) const {
  Threat threat;
  const double stop_time = request.head.velocity_world.norm() / robot_.max_acceleration;
  const double until = std::max(trajectory.end_time(), request.time + kEvasionHorizon);
  threat.report = check_.check(trajectory, {request.time, until, until, kCommittedMargin});
  threat.conflict = !threat.report.clear();
  threat.urgent = threat.conflict && threat.report.time - request.time < stop_time + team_.emergency_time;
  // A moving peer of lower priority will plan around this robot: only when it gets close is it this robot's
  // matter.
  const bool yields = threat.report.kind == ConflictKind::peer && threat.report.id > request.world.robot_id;
  if (yields && !threat.urgent) threat.conflict = false;
  // The obstacle may be here soon: a trajectory has to leave, and about as soon as can be.
  if (in_fields_) {
    const double stay = check_.time_in_fields(trajectory, request.time, request.time + kEvasionHorizon);
    threat.in_field = stay > way_out_.time_in_fields + kLinger;
    threat.conflict = threat.conflict || threat.in_field;
    threat.urgent = threat.urgent || threat.in_field;
  }
  return threat;
}

/// A robot in a danger region has to know how soon it could be out.
void FieldReplanning::look_for_way_out(const PlanRequest& request) {
  in_fields_ = team_.retreat && check_.field_clearance(request.head.position_world) < 0.0;
  if (!in_fields_) return;
  way_out_ = best_evasion(request.head, request.heading, request.time, request.time + kEvasionHorizon, check_,
                          robot_);
}

bool FieldReplanning::plan_due(const PlanRequest& request, const Threat& threat, bool braking) const {
  if (request.time < retry_time_ - kTimeTolerance) return false;
  if (braking || threat.conflict || request.committed == nullptr) return true;
  if (request.time - last_plan_time_ >= team_.replan_period - kTimeTolerance) return true;
  return request.committed->end_time() - request.time < team_.emergency_time;
}

ReplanDecision FieldReplanning::decide(const PlanRequest& request, const GuidePath& guide, bool braking,
                                       PlanResult& result) {
  // 1. What lies ahead on the committed trajectory, up to its end and against everybody.
  check_.prepare(request.world, request.time, PeerSelection::all);
  look_for_way_out(request);
  Threat threat;
  if (request.committed != nullptr) threat = threat_to(*request.committed, request);
  if (!plan_due(request, threat, braking)) {
    result.stats = {};
    result.candidates.clear();
    return threat.urgent ? fail(request, threat, braking, result) : ReplanDecision::keep;
  }
  // 2. A new plan, unless it is itself in for an early contact with somebody it does not plan around.
  planner_.plan(request, guide, result);
  const bool found = result.outcome == PlanOutcome::success || result.outcome == PlanOutcome::goal_reached;
  if (found && !threat_to(result.trajectory, request).urgent) {
    last_plan_time_ = request.time;
    retry_time_ = -1e9;
    back_off_ = 0.0;
    return ReplanDecision::commit;
  }
  // 3. No plan: wait a little longer each time before the next attempt.
  back_off_ = back_off_ > 0.0 ? std::min(2.0 * back_off_, team_.retry_longest) : team_.retry_first;
  retry_time_ = request.time + back_off_;
  name_blocker(request, guide, result);
  return fail(request, threat, braking, result);
}

void FieldReplanning::name_blocker(const PlanRequest& request, const GuidePath& guide,
                                   PlanResult& result) const {
  const bool named = result.blocking_track >= 0 || result.blocking_peer >= 0;
  if (named || !guide.ready() || result.outcome == PlanOutcome::no_path) return;
  const double step = 0.5 * robot_.radius;
  for (double ahead = 0.0; ahead <= horizon_; ahead += step) {
    const Eigen::Vector2d place = guide.descend(request.head.position_world, ahead);
    for (const MovingDisc& disc : check_.discs()) {
      DiscCursor cursor{disc};
      cursor.move_to(request.time);
      if ((place - cursor.position()).norm() > disc.radius) continue;
      (disc.is_peer ? result.blocking_peer : result.blocking_track) = disc.id;
      return;
    }
    for (const DangerRegion& region : check_.regions()) {
      if (region.field.clearance(place, region.threshold) > 0.0) continue;
      result.blocking_track = region.id;
      return;
    }
  }
}

ReplanDecision FieldReplanning::fail(const PlanRequest& request, const Threat& threat, bool braking,
                                     PlanResult& result) {
  if (request.committed != nullptr && !threat.urgent) return ReplanDecision::keep;
  if (result.outcome == PlanOutcome::success) result.outcome = PlanOutcome::unsafe;
  if (threat.report.kind == ConflictKind::obstacle) result.blocking_track = threat.report.id;
  if (threat.report.kind == ConflictKind::peer) result.blocking_peer = threat.report.id;
  const Evasion evasion = in_fields_ ? way_out_
                                     : best_evasion(request.head, request.heading, request.time,
                                                    request.time + kEvasionHorizon, check_, robot_);
  if (evasion.sidestep && team_.retreat) {
    result.trajectory = evasion.trajectory;
    return ReplanDecision::brake;
  }
  if (braking) return ReplanDecision::keep;  // it brakes, or stands, already
  result.trajectory = braking_trajectory(request.head, request.heading, request.time, robot_);
  return ReplanDecision::brake;
}

}  // namespace spf
