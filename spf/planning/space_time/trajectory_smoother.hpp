// Smooths the roll-out of a chosen primitive to a minimum-jerk trajectory (MINCO under L-BFGS) with costs for
// jerk, time, limits and the space-time field. Side, speed and waiting stay as chosen. Frame: world.
#pragma once

#include "spf/planning/planner.hpp"
#include "spf/planning/space_time/motion_primitive.hpp"
#include "spf/planning/space_time/space_time_cost.hpp"
#include "spf/planning/trajectory_optimizer.hpp"

namespace spf {

class TrajectorySmoother {
 public:
  /// All memory is allocated here. Throws std::invalid_argument when parameters are out of range.
  TrajectorySmoother(const SpaceTimeParameters& space_time, const PlannerParameters& planner,
                     const RobotParameters& robot);

  /// Optimises from the roll-out, between the request's head (continuing its acceleration, too) and the
  /// roll-out's end. False when the optimiser failed or the result breaks the limits by more than their
  /// tolerance; `smooth` is then unusable. It ends by braking to rest, as to_trajectory() does.
  bool smooth(const RollOut& roll_out, const PlanRequest& request, const SpaceTimeRisk& risk,
              const RollOutSettings& settings, Trajectory& smooth, PlanStats& stats);

 private:
  SpaceTimeParameters space_time_;
  PlannerParameters planner_;
  RobotParameters robot_;
  TrajectoryOptimizer optimizer_;
  TrajectorySeed seed_;
  TrajectoryProblem problem_;
  SpaceTimeCost cost_;
};

}  // namespace spf
