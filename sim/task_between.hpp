// A robot's task from one position to another. Frame: world.
#pragma once

#include <cmath>

#include "sim/scenario.hpp"

namespace spf::sim {

/// Starts at `start` [m], heading towards `goal` [m].
[[nodiscard]] inline RobotTask task_between(const Eigen::Vector2d& start, const Eigen::Vector2d& goal) {
  RobotTask task;
  const Eigen::Vector2d to_goal = goal - start;
  task.start = {start, std::atan2(to_goal.y(), to_goal.x())};
  task.goal_world = goal;
  return task;
}

}  // namespace spf::sim
