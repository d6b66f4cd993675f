#include "spf/planning/plan_judge.hpp"

#include <algorithm>

#include "spf/planning/braking.hpp"
#include "spf/planning/cost_to_go.hpp"

namespace spf {
namespace {

constexpr double kRestShare = 0.01;  // [1] of max_speed

PlannerParameters at_constant_velocity(PlannerParameters planner) {
  planner.dynamic_model = DynamicModel::constant_velocity;
  return planner;
}

bool cut_off(const PlanRequest& request) {
  const CostToGoOutcome found = request.guide->outcome();
  return request.goal_cut_off || found == CostToGoOutcome::unreachable ||
         found == CostToGoOutcome::no_free_goal;
}

}  // namespace

PlanJudge::PlanJudge(const PlannerParameters& planner, const RobotParameters& robot)
    : robot_{robot},
      goal_tolerance_{planner.goal_tolerance},
      model_{at_constant_velocity(planner), robot, FieldParameters{}} {}

void PlanJudge::judge(const PlanRequest& request, double until, PlanResult& result) {
  const Trajectory& plan = result.trajectory;
  model_.prepare(request.world, request.time, PeerSelection::yield_to);
  const Trajectory brake = braking_trajectory(request.head, request.heading, request.time, robot_);
  const double end = std::max(plan.end_time(), request.time);
  const ClearanceReport report = model_.check(plan, {request.time, end, until, 1.0, &brake});
  if (!report.clear()) {
    result.outcome = PlanOutcome::unsafe;
    if (report.kind == ConflictKind::obstacle && result.blocking_track < 0) result.blocking_track = report.id;
    if (report.kind == ConflictKind::peer && result.blocking_peer < 0) result.blocking_peer = report.id;
    return;
  }
  if (cut_off(request)) {
    result.outcome = PlanOutcome::no_path;
    return;
  }
  const bool at_goal = (request.head.position_world - request.guide->goal_used()).norm() <= goal_tolerance_ &&
                       request.head.velocity_world.norm() <= kRestShare * robot_.max_speed &&
                       (plan.tail_position() - request.guide->goal_used()).norm() <= goal_tolerance_;
  result.outcome = at_goal ? PlanOutcome::goal_reached : PlanOutcome::success;
}

}  // namespace spf
