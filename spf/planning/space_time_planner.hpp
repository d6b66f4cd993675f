// The space-time method (ours, docs/space_time.md): a hundred manoeuvres rolled out against the growing
// belief about everything that moves choose the way; cost and risk are both counted in seconds of travel.
#pragma once

#include "spf/planning/manoeuvre.hpp"
#include "spf/planning/planner.hpp"
#include "spf/planning/space_time_parameters.hpp"
#include "spf/planning/space_time_risk.hpp"
#include "spf/robot/robot_parameters.hpp"

namespace spf {

class SpaceTimePlanner {
 public:
  /// Throws std::invalid_argument when parameters are out of range. All memory is allocated here.
  SpaceTimePlanner(const SpaceTimeParameters& parameters, const RobotParameters& robot);

  /// Plans from the request's head. `guide` leads to the request's goal. With `keep_candidates` every
  /// manoeuvre is kept in the result (which allocates).
  void plan(const PlanRequest& request, const GuidePath& guide, bool keep_candidates, PlanResult& result);

 private:
  /// Cost of a roll-out in seconds, split for the record.
  struct Score {
    double time = 0.0;  ///< [s] travel time still needed at the end of the horizon
    double risk = 0.0;  ///< [s] price of the chance of contact
    int worst = -1;     ///< entity that contributes most, -1 = none
    [[nodiscard]] double total() const { return time + risk; }
  };
  [[nodiscard]] Score score(const RollOut& roll_out, const PlanRequest& request, const GuidePath& guide,
                            double enough) const;
  void consider(const Manoeuvre& manoeuvre, const PlanRequest& request, const GuidePath& guide,
                PlanResult& result, bool keep);
  bool consider_previous(const PlanRequest& request, const GuidePath& guide, PlanResult& result, bool keep);
  void consider_sidesteps(const PlanRequest& request, const GuidePath& guide, PlanResult& result, bool keep);
  void keep_candidate(const RollOut& roll_out, Candidate::Kind kind, const Score& score,
                      const PlanRequest& request, PlanResult& result) const;
  void finish(const PlanRequest& request, PlanResult& result) const;

  SpaceTimeParameters parameters_;
  RobotParameters robot_;
  RollOutSettings settings_;
  SpaceTimeRisk risk_;
  RollOut trial_;
  RollOut best_;
  Score best_score_;
  bool best_is_previous_ = false;
};

}  // namespace spf
