// The clearance check of a finished plan, for methods that choose by other rules: what it says is the
// outcome.
#pragma once

#include "spf/planning/clearance.hpp"
#include "spf/planning/planner.hpp"

namespace spf {

class PlanJudge {
 public:
  /// Margins are the planner's; obstacles are taken at constant velocity, which is where a method that knows
  /// better expects them too for the near future.
  PlanJudge(const PlannerParameters& planner, const RobotParameters& robot);

  /// `success`, or `goal_reached` where the trajectory stands there, when it passes the check against the map
  /// to its end, and until `until` [s] against obstacles and those peers that this robot plans around; being
  /// as near to things as braking would be is no conflict. Else `unsafe`; what it would meet is named in the
  /// result. `no_path` where the goal is cut off.
  void judge(const PlanRequest& request, double until, PlanResult& result);

 private:
  RobotParameters robot_;
  double goal_tolerance_;  // [m]
  ClearanceModel model_;
};

}  // namespace spf
