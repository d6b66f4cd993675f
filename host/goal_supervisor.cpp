#include "host/goal_supervisor.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "spf/math/angles.hpp"
#include "spf/robot/footprint.hpp"

namespace spf::host {
namespace {

constexpr double kGoalSigmas = 2.0;  // [1] by which the robot may be off its goal where poses are uncertain

}  // namespace

const char* to_string(GoalOutcome outcome) {
  switch (outcome) {
    case GoalOutcome::none:
      return "none";
    case GoalOutcome::pursued:
      return "pursued";
    case GoalOutcome::reached:
      return "reached";
    case GoalOutcome::off_map:
      return "the goal is off the map";
    case GoalOutcome::in_wall:
      return "the goal is in a wall, or nearer to one than the robot goes";
    case GoalOutcome::no_path:
      return "no path to the goal";
    case GoalOutcome::preempted:
      return "a newer goal";
    case GoalOutcome::cancelled:
      return "cancelled";
  }
  return "?";
}

GoalFacts goal_facts(const PlannerHost& planner, const Localiser* localiser, double now) {
  GoalFacts facts;
  if (!planner.goal()) return facts;
  const Goal& goal = *planner.goal();
  if (const OccupancyMap* map = planner.given_map()) {
    const GridFrame& frame = map->frame();
    const Eigen::Vector2d high = frame.node_position(frame.width - 1, frame.height - 1);
    facts.map_known = true;
    facts.on_map = (goal.position_world.array() >= frame.origin_world.array()).all() &&
                   (goal.position_world.array() <= high.array()).all();
    facts.clearance = map->known_distance(goal.position_world);
  }
  const RobotAgent* agent = planner.agent();
  if (agent == nullptr || planner.backs_off() || planner.forced_stop() != StopCause::none) return facts;
  facts.access = agent->goal_access();
  if (!facts.access) return facts;
  const AgentStatus status = agent->status();
  facts.stands_short = status.reason == StopCause::no_path;
  facts.arrived = status.reason == StopCause::arrived;

  StateEstimate here;
  if (localiser != nullptr) {
    here = localiser->estimate(now);
  } else {
    here.valid = true;
    here.pose_world = {agent->committed().position(now), agent->committed().heading_state(now).heading};
  }
  if (!here.valid) return facts;
  facts.distance = (here.pose_world.position_world - goal.position_world).norm();
  facts.position_sigma = std::sqrt(here.position_variance);
  if (goal.heading) facts.heading_error = std::abs(angle_difference(*goal.heading, here.pose_world.heading));
  return facts;
}

void GoalSupervisor::reconfigure(const AgentParameters& agent, const HostParameters& host) {
  radius_ = Footprint{agent.robot}.inscribed_radius();
  tolerance_ = agent.team.goal_tolerance;
  heading_tolerance_ = host.goal_heading_tolerance;
}

void GoalSupervisor::begin(double timeout) {
  outcome_ = GoalOutcome::pursued;
  timeout_ = timeout;
  looked_up_ = false;
  wrong_since_.reset();
}

void GoalSupervisor::end(GoalOutcome outcome) {
  assert(outcome == GoalOutcome::preempted || outcome == GoalOutcome::cancelled);
  if (outcome_ == GoalOutcome::pursued) outcome_ = outcome;
}

bool GoalSupervisor::reached(const GoalFacts& facts) const {
  return facts.arrived && facts.distance <= tolerance_ + kGoalSigmas * facts.position_sigma &&
         facts.heading_error <= heading_tolerance_;
}

GoalOutcome GoalSupervisor::complaint(const GoalFacts& facts) const {
  if (facts.access == GoalAccess::cut_off) return GoalOutcome::no_path;
  // A path leads to beside it: that is driven first.
  if (facts.access == GoalAccess::blocked && facts.stands_short)
    return facts.on_map ? GoalOutcome::in_wall : GoalOutcome::off_map;
  return GoalOutcome::pursued;
}

GoalOutcome GoalSupervisor::step(const GoalFacts& facts, double now) {
  if (outcome_ != GoalOutcome::pursued) return outcome_;
  // What the given map says of the goal does not change by waiting.
  if (facts.map_known && !looked_up_) {
    looked_up_ = true;
    if (!facts.on_map) return outcome_ = GoalOutcome::off_map;
    if (facts.clearance < radius_) return outcome_ = GoalOutcome::in_wall;
  }
  if (reached(facts)) return outcome_ = GoalOutcome::reached;
  // What is sensed may: only what has stayed so is said.
  const GoalOutcome wrong = complaint(facts);
  if (wrong == GoalOutcome::pursued) {
    wrong_since_.reset();
    return outcome_;
  }
  wrong_since_ = std::min(wrong_since_.value_or(now), now);  // a clock may have gone back
  if (now - *wrong_since_ >= timeout_) outcome_ = wrong;
  return outcome_;
}

}  // namespace spf::host
