// The space-time method (ours, docs/space_time.md): a hundred manoeuvres rolled out against the growing
// belief about everything that moves choose the way, the optimiser makes it smooth. Cost and risk are both
// counted in seconds of travel.
#pragma once

#include "spf/planning/planner.hpp"
#include "spf/planning/space_time/manoeuvre.hpp"
#include "spf/planning/space_time/space_time_parameters.hpp"
#include "spf/planning/space_time/space_time_risk.hpp"
#include "spf/planning/space_time/way_smoother.hpp"
#include "spf/robot/robot_parameters.hpp"

namespace spf {

class SpaceTimePlanner {
 public:
  /// Throws std::invalid_argument when parameters are out of range. All memory is allocated here.
  /// `planner` holds the optimiser's settings and weights.
  SpaceTimePlanner(const SpaceTimeParameters& parameters, const PlannerParameters& planner,
                   const RobotParameters& robot);

  /// Plans from the request's head. `guide` leads to the request's goal. With `keep_candidates` every
  /// manoeuvre is kept in the result (which allocates).
  void plan(const PlanRequest& request, const GuidePath& guide, bool keep_candidates, PlanResult& result);

 private:
  /// Cost of a roll-out in seconds, split for the record.
  struct Score {
    double time = 0.0;  ///< [s] travel time to the goal along it
    double risk = 0.0;  ///< [s] price of the chance of contact
    int worst = -1;     ///< entity that contributes most, -1 = none
    [[nodiscard]] double total() const { return time + risk; }
  };
  [[nodiscard]] Score score(const RollOut& roll_out, const PlanRequest& request, const GuidePath& guide,
                            double enough) const;
  void consider(const Manoeuvre& manoeuvre, const PlanRequest& request, const GuidePath& guide,
                PlanResult& result, bool keep, double bonus = 0.0);
  void consider_previous(const PlanRequest& request, const GuidePath& guide, PlanResult& result, bool keep);
  void consider_sidesteps(const PlanRequest& request, const GuidePath& guide, PlanResult& result, bool keep);
  void keep_candidate(const RollOut& roll_out, Candidate::Kind kind, const Score& score,
                      const PlanRequest& request, PlanResult& result) const;
  void sample(const Trajectory& trajectory, double from, double drive_end);
  bool smooth_best(const PlanRequest& request, const GuidePath& guide, PlanResult& result, bool keep);
  void finish(const PlanRequest& request, const GuidePath& guide, PlanResult& result, bool keep);

  SpaceTimeParameters parameters_;
  RobotParameters robot_;
  RollOutSettings settings_;
  SpaceTimeRisk risk_;
  RollOut trial_;
  RollOut best_;
  Score best_score_;
  bool best_is_previous_ = false;
  WaySmoother smoother_;
  Trajectory smooth_;
  double plan_start_ = -1e9;  // [s] of the last plan made here
  double drive_end_ = -1e9;   // [s] when its braking to rest begins
};

}  // namespace spf
