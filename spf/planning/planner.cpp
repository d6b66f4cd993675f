#include "spf/planning/planner.hpp"

#include <cmath>

#include "spf/planning/braking.hpp"
#include "spf/planning/cost_to_go.hpp"

namespace spf {
namespace {

constexpr double kRestDuration = 1.0;  // [s] any duration will do: a trajectory rests at its ends

bool finite_head(const PlanRequest& request) {
  return std::isfinite(request.time) && request.head.position_world.allFinite() &&
         request.head.velocity_world.allFinite() && request.head.acceleration_world.allFinite() &&
         std::isfinite(request.heading.heading) && std::isfinite(request.heading.yaw_rate);
}

}  // namespace

const char* to_string(PlanOutcome outcome) {
  switch (outcome) {
    case PlanOutcome::success:
      return "success";
    case PlanOutcome::goal_reached:
      return "goal reached";
    case PlanOutcome::no_path:
      return "no path";
    case PlanOutcome::unsafe:
      return "unsafe";
    case PlanOutcome::deadline:
      return "deadline";
    case PlanOutcome::invalid_request:
      return "invalid request";
  }
  return "?";
}

void PlanResult::clear() {
  outcome = PlanOutcome::invalid_request;
  action = PlanAction::brake;
  risk = 0.0;
  blocking_track = -1;
  blocking_peer = -1;
  stats = {};
  candidates.clear();
}

bool usable(const PlanRequest& request) {
  return finite_head(request) && request.goal_world.allFinite() &&
         std::isfinite(request.goal_heading.value_or(0.0)) && std::isfinite(request.position_sigma) &&
         request.world.map != nullptr && request.guide != nullptr;
}

std::optional<PlanOutcome> refusal(const PlanRequest& request) {
  if (!usable(request)) return PlanOutcome::invalid_request;
  if (!request.guide->ready()) return PlanOutcome::no_path;
  return std::nullopt;
}

void stand_instead(const PlanRequest& request, const RobotParameters& robot, PlanOutcome outcome,
                   PlanResult& result) {
  result.outcome = outcome;
  const bool planned = request.committed != nullptr && !request.committed->empty();
  if (planned && (request.braking || !finite_head(request))) {
    result.action = PlanAction::keep;
    result.trajectory = *request.committed;
    return;
  }
  result.action = PlanAction::brake;
  if (finite_head(request)) {
    result.trajectory = braking_trajectory(request.head, request.heading, request.time, robot);
    return;
  }
  const Eigen::Vector2d& here = request.head.position_world;
  result.trajectory = Trajectory::standing(here.allFinite() ? here : Eigen::Vector2d{0.0, 0.0},
                                           std::isfinite(request.time) ? request.time : 0.0, kRestDuration);
}

}  // namespace spf
