// The paper's method (and its baselines, by DynamicModel) as a Planner: decides when FieldPlanner runs again,
// and what to do when it finds nothing: keep the plan, brake, step aside, try again later. Every robot brakes
// for every peer here, whatever its rank. Candidates are compared by eq. 9 [1].
#pragma once

#include "spf/planning/field/emergency_manoeuvre.hpp"
#include "spf/planning/field/field_planner.hpp"
#include "spf/planning/field/replanning_parameters.hpp"

namespace spf {

class FieldReplanning final : public Planner {
 public:
  /// Throws std::invalid_argument when parameters are out of range.
  FieldReplanning(const PlannerParameters& planner, const RobotParameters& robot,
                  const FieldParameters& field, const ReplanningParameters& replanning);

  /// A check without a new plan repeats the outcome of the last attempt.
  void plan(const PlanRequest& request, PlanResult& result) override;
  /// It reports `no_path` and stops.
  [[nodiscard]] bool approaches_cut_off_goal() const override { return false; }

 private:
  /// Conflicts ahead on a trajectory.
  struct Threat {
    bool conflict = false;
    bool urgent = false;    ///< sooner than the stopping time plus the emergency time
    bool in_field = false;  ///< stays in a danger region longer than the quickest way out
    ClearanceReport report;
  };
  /// Outcome of the last attempt.
  struct Attempt {
    PlanOutcome outcome = PlanOutcome::success;
    int blocking_track = -1;
    int blocking_peer = -1;
  };
  void meet_goal(const Eigen::Vector2d& goal_world);
  [[nodiscard]] Threat threat_to(const Trajectory& trajectory, const PlanRequest& request) const;
  void find_escape(const PlanRequest& request);
  [[nodiscard]] bool plan_due(const PlanRequest& request, const Threat& threat) const;
  void attempt(const PlanRequest& request, const Threat& threat, PlanResult& result);
  /// Names the first moving obstacle or peer on the guide when the planner named none.
  void name_blocker(const PlanRequest& request, PlanResult& result) const;
  static void keep(const PlanRequest& request, PlanResult& result);
  void fail(const PlanRequest& request, const Threat& threat, PlanResult& result);

  RobotParameters robot_;
  ReplanningParameters replanning_;
  double horizon_;             // [m] of the planner
  EmergencyManoeuvre escape_;  // of the danger regions that contain the robot; of this check
  bool in_fields_ = false;     // some region does
  FieldPlanner planner_;
  ClearanceModel check_;  // against all peers
  Attempt last_;
  std::optional<Eigen::Vector2d> goal_;  // [m] of the last check
  double last_plan_time_ = -1e9;         // [s] of the last success
  double retry_time_ = -1e9;             // [s] no attempt before it
  double back_off_ = 0.0;                // [s]
};

}  // namespace spf
