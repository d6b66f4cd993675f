// The clearance check of a finished plan, for methods that choose by other rules: it sets the outcome.
#pragma once

#include "spf/planning/clearance.hpp"
#include "spf/planning/planner.hpp"

namespace spf {

class PlanJudge {
 public:
  /// Margins are the planner's; obstacles move at constant velocity, which more detailed predictions agree
  /// with in the near future.
  PlanJudge(const PlannerParameters& planner, const RobotParameters& robot);

  /// Sets `success`, or `goal_reached` when robot and plan rest at the goal, if the trajectory passes the
  /// check: against the map to its end, and until `until` [s] against obstacles and those peers that this
  /// robot plans around; to be as near to them as braking would be is no conflict. Else `unsafe`, with the
  /// obstacle or peer in conflict named in the result. `no_path` if the goal is cut off.
  void judge(const PlanRequest& request, double until, PlanResult& result);

 private:
  RobotParameters robot_;
  double goal_tolerance_;  // [m]
  ClearanceModel model_;
};

}  // namespace spf
