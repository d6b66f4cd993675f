// The end of a plan (local target) and the optimiser's initial guesses (seeds). Frame: world.
#pragma once

#include <Eigen/Core>

#include <vector>

#include "spf/planning/clearance.hpp"
#include "spf/planning/cost_to_go.hpp"
#include "spf/planning/planner.hpp"
#include "spf/planning/trajectory_optimizer.hpp"

namespace spf {

/// Kinds of seeds, in the order in which they are tried.
enum class SeedKind {
  warm,        ///< the committed plan, extended along the guide
  cold,        ///< along the guide
  bowed_left,  ///< along the guide, bent to one side
  bowed_right,
  slow,           ///< along the guide in more time, to let others pass first
  short_horizon,  ///< to a target at half the horizon
};

/// Tail of the plan.
struct LocalTarget {
  FlatState state;        ///< the goal at rest, or a position on the path at cruising speed
  bool is_goal = false;   ///< the plan ends at the goal
  double distance = 0.0;  ///< [m] from the head along the guide
};

/// Makes targets and seeds; keeps the guide's corners between calls.
class SeedMaker {
 public:
  SeedMaker(const PlannerParameters& planner, const RobotParameters& robot);

  /// The position after `horizon` metres along the guide, or the goal when it is nearer. A position on the
  /// path that is not free (static, or occupied by something at rest) is moved along the path, backwards
  /// first.
  [[nodiscard]] LocalTarget local_target(const PlanRequest& request, const CostToGo& guide,
                                         const ClearanceModel& clearance, double horizon);

  /// Fills the seed; false when this kind does not apply (nothing committed, or its end has passed). Call
  /// local_target() first for the same request.
  [[nodiscard]] bool make(SeedKind kind, const PlanRequest& request, const LocalTarget& target,
                          TrajectorySeed& seed);

 private:
  [[nodiscard]] Eigen::Vector2d on_path(double distance) const;
  [[nodiscard]] int pieces_for(double distance) const;
  void along_path(const PlanRequest& request, const LocalTarget& target, double bow, double stretch,
                  TrajectorySeed& seed) const;
  [[nodiscard]] bool from_committed(const PlanRequest& request, const LocalTarget& target,
                                    TrajectorySeed& seed) const;

  PlannerParameters planner_;
  RobotParameters robot_;
  std::vector<Eigen::Vector2d> path_;  // corners from the head to the goal
};

}  // namespace spf
