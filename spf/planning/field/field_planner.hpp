// The paper's planner (eq. 9-13, Fig. 4) and, by DynamicModel, its baselines ES2 and ES2*: seeds along the
// guide, both sides of every obstacle in conflict, L-BFGS over MINCO, and the common clearance check.
// Frame: world.
#pragma once

#include <vector>

#include "spf/field/field_parameters.hpp"
#include "spf/planning/clearance.hpp"
#include "spf/planning/cost_to_go.hpp"
#include "spf/planning/field/field_guidance.hpp"
#include "spf/planning/field/grid_search.hpp"
#include "spf/planning/field/guide_pairs.hpp"
#include "spf/planning/field/seeds.hpp"
#include "spf/planning/planner.hpp"
#include "spf/planning/planner_parameters.hpp"
#include "spf/planning/trajectory_optimizer.hpp"
#include "spf/robot/drive.hpp"

namespace spf {

class FieldPlanner final : public Planner {
 public:
  /// Throws std::invalid_argument when parameters are out of range. The working memory is allocated here and
  /// by the first plan.
  FieldPlanner(const PlannerParameters& planner, const RobotParameters& robot, const FieldParameters& field);

  /// Plans from the request's head to the goal, or as far as the horizon, around those peers that go first or
  /// do not move. Without an accepted plan the trajectory is a braking one; whether to follow it at once, or
  /// to keep the committed plan while contact is far, is left to the caller. Ends within
  /// PlannerParameters::max_evaluations cost evaluations.
  void plan(const PlanRequest& request, PlanResult& result) override;

  /// The clearance model as of the last plan; also for checks of committed plans.
  [[nodiscard]] const ClearanceModel& clearance() const { return clearance_; }
  [[nodiscard]] const PlannerParameters& parameters() const { return planner_; }

 private:
  /// The best optimised trajectory that passed the checks.
  struct Accepted {
    bool valid = false;
    double cost = 0.0;  // with the side bonus
    Trajectory trajectory;
    std::vector<SideChoice> sides;
    int candidate = -1;  // index in the result, when candidates are kept
  };

  void prepare(const PlanRequest& request);
  bool stands_at_goal(const PlanRequest& request, PlanResult& result);
  /// One seed, all sides. False when the budget is spent.
  bool try_seed(SeedKind kind, const PlanRequest& request, const LocalTarget& target, PlanResult& result);
  /// One seed, one combination of sides (sides_): runs and checks alternate. False when the budget is spent.
  bool run_candidate(const PlanRequest& request, Candidate::Kind kind, PlanResult& result);
  OptimizerResult launch(bool may_rebound, bool& rebound, PlanResult& result);
  /// Adapts the problem to a failed check (last_report_) before the next run; false when nothing can be
  /// changed.
  bool answer(const PlanRequest& request);
  [[nodiscard]] bool within_limits(const LimitReport& limits, const FlatState& head) const;
  void keep_best(const PlanRequest& request, const OptimizerResult& run, Candidate::Kind kind,
                 const Trajectory& trajectory, PlanResult& result);
  [[nodiscard]] double side_discount(double time) const;
  void add_heading(const PlanRequest& request, Trajectory& trajectory) const;
  /// Fills the result with the best accepted plan, or with braking and the outcome `failure`.
  void conclude(const PlanRequest& request, PlanOutcome failure, PlanResult& result);

  PlannerParameters planner_;
  RobotParameters robot_;
  Drive drive_;
  ClearanceModel clearance_;
  FieldGuidance guidance_;
  GuidePairFinder finder_;
  GridSearch search_;
  SeedMaker seeds_;
  TrajectoryOptimizer optimizer_;

  // State of the current plan.
  TrajectorySeed seed_;     // of the current seed
  TrajectorySeed current_;  // where the next run of a candidate starts
  TrajectoryProblem problem_;
  std::vector<FieldConflict> conflicts_;
  std::vector<GuidePair> seed_pairs_;    // static pairs of the seed
  std::vector<GuidePair> static_pairs_;  // of the candidate
  std::vector<GuidePair> field_pairs_;   // of the candidate
  std::vector<SideChoice> sides_;        // of the candidate
  Trajectory brake_;                     // the fallback
  Accepted best_;
  ClearanceReport last_report_;
};

}  // namespace spf
