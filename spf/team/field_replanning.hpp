// When the paper's planner is asked again, and what is done when it finds nothing: keep the plan, brake, step
// aside, try again later. Every robot brakes for every peer here, whatever its priority.
#pragma once

#include "spf/planning/field/evasion.hpp"
#include "spf/planning/field/field_planner.hpp"
#include "spf/team/team_parameters.hpp"

namespace spf {

enum class ReplanDecision {
  keep,    ///< the committed trajectory stays
  commit,  ///< the result's trajectory replaces it
  brake,   ///< likewise, but it is a way to rest (or aside) because no plan was found
};

class FieldReplanning {
 public:
  /// Throws std::invalid_argument when parameters are out of range.
  FieldReplanning(const PlannerParameters& planner, const RobotParameters& robot,
                  const FieldParameters& field, const TeamParameters& team);

  /// One planning check. `braking`: the committed trajectory is a braking one. `result` tells what was done.
  ReplanDecision decide(const PlanRequest& request, const GuidePath& guide, bool braking, PlanResult& result);
  /// A new goal: plan at once.
  void reset();

 private:
  /// What the committed trajectory is in for.
  struct Threat {
    bool conflict = false;
    bool urgent = false;    ///< sooner than it takes to stop, and the emergency time
    bool in_field = false;  ///< stays in a danger region longer than the quickest way out
    ClearanceReport report;
  };
  [[nodiscard]] Threat threat_to(const Trajectory& trajectory, const PlanRequest& request) const;
  void look_for_way_out(const PlanRequest& request);
  [[nodiscard]] bool plan_due(const PlanRequest& request, const Threat& threat, bool braking) const;
  /// Names the first moving thing on the guide's way when the planner ended without a name.
  void name_blocker(const PlanRequest& request, const GuidePath& guide, PlanResult& result) const;
  ReplanDecision fail(const PlanRequest& request, const Threat& threat, bool braking, PlanResult& result);

  RobotParameters robot_;
  TeamParameters team_;
  double horizon_;          // [m] of the planner
  Evasion way_out_;         // of the fields that hold the robot; of this check
  bool in_fields_ = false;  // they do
  FieldPlanner planner_;
  ClearanceModel check_;          // against all peers
  double last_plan_time_ = -1e9;  // [s] of the last success
  double retry_time_ = -1e9;      // [s] no attempt before it
  double back_off_ = 0.0;         // [s]
};

}  // namespace spf
