#include "spf/team/guide_policy.hpp"

#include <algorithm>

#include "spf/team/schedule.hpp"

namespace spf {
namespace {

CostToGoParameters for_robot(const AgentParameters& parameters) {
  CostToGoParameters guide = parameters.guide;
  guide.clearance += parameters.robot.radius;
  return guide;
}

}  // namespace

GuidePolicy::GuidePolicy(const AgentParameters& parameters, bool approaches_cut_off_goal, double time)
    : approaches_cut_off_goal_{approaches_cut_off_goal},
      goal_tolerance_{parameters.team.goal_tolerance},
      path_{for_robot(parameters)},
      next_time_{time} {}

void GuidePolicy::reconfigure(const AgentParameters& parameters, bool approaches_cut_off_goal) {
  approaches_cut_off_goal_ = approaches_cut_off_goal;
  goal_tolerance_ = parameters.team.goal_tolerance;
  const CostToGoParameters wanted = for_robot(parameters);
  const CostToGoParameters& present = path_.parameters();
  if (wanted.clearance == present.clearance && wanted.resolution == present.resolution) return;
  path_ = CostToGo{wanted};
  goal_.reset();
}

void GuidePolicy::refresh(double time, const OccupancyMap& map, const Eigen::Vector2d& goal_world,
                          const Eigen::Vector2d& here) {
  const bool same_goal = path_.ready() && goal_ == goal_world;
  if (same_goal && !is_due(next_time_, time)) return;
  // What was newly sensed off the way makes no other way shorter: only a way that is blocked cannot wait.
  const bool can_wait = same_goal && !is_due(update_time_ + kIdlePeriod, time);
  if (can_wait && (cut_off_ || way_clear(map, here))) return;
  if (same_goal && !cut_off_ && !path_.outdated(map, goal_world, here)) return;
  path_.update(map, goal_world, here);
  // Without a way to the goal the robot goes as near as the shortest way through the walls leads, and waits
  // there.
  cut_off_ = path_.outcome() == CostToGoOutcome::unreachable && approaches_cut_off_goal_;
  if (cut_off_) path_.update(map, last_free_position(map, here), here);
  goal_ = goal_world;
  update_time_ = time;
  next_time_ = time + kPeriod;
}

/// The last position on the guide's way that keeps its clearance all the way there.
Eigen::Vector2d GuidePolicy::last_free_position(const OccupancyMap& map, const Eigen::Vector2d& here) {
  path_.way(here, way_);
  Eigen::Vector2d last = here;
  const double step = map.frame().resolution;
  for (std::size_t i = 1; i < way_.size(); ++i) {
    const Eigen::Vector2d leg = way_[i] - way_[i - 1];
    const int steps = std::max(1, static_cast<int>(leg.norm() / step));
    for (int k = 1; k <= steps; ++k) {
      const Eigen::Vector2d position = way_[i - 1] + leg * (static_cast<double>(k) / steps);
      if (map.distance(position) < path_.parameters().clearance) return last;
      last = position;
    }
  }
  return last;
}

bool GuidePolicy::way_clear(const OccupancyMap& map, const Eigen::Vector2d& here) {
  if (!path_.ready() || path_.outcome() == CostToGoOutcome::unreachable) return false;
  path_.way(here, way_);
  const double clearance =
      path_.parameters().clearance - 0.5 * map.frame().resolution;  // it grazes its corners
  for (std::size_t i = 1; i < way_.size(); ++i)
    if (!map.segment_clear(way_[i - 1], way_[i], clearance)) return false;
  return true;
}

std::optional<GoalAccess> GuidePolicy::access(const Eigen::Vector2d& goal_world) const {
  if (goal_ != goal_world) return std::nullopt;
  if (cut_off_ || path_.outcome() == CostToGoOutcome::unreachable) return GoalAccess::cut_off;
  if (path_.outcome() == CostToGoOutcome::no_free_goal) return GoalAccess::blocked;
  // A robot that ends within its tolerance of the goal gets there all the same.
  const bool beside = (path_.goal_used() - goal_world).norm() >= goal_tolerance_;
  return beside ? GoalAccess::blocked : GoalAccess::open;
}

bool GuidePolicy::goal_out_of_reach(const Eigen::Vector2d& here) const {
  if (cut_off_ || path_.outcome() == CostToGoOutcome::unreachable ||
      path_.outcome() == CostToGoOutcome::no_free_goal)
    return true;
  // As near to a goal on blocked ground as the way leads.
  return path_.outcome() == CostToGoOutcome::goal_moved &&
         (here - path_.goal_used()).norm() < goal_tolerance_;
}

}  // namespace spf
