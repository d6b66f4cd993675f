// The space-time method (ours, docs/space_time.md): chooses the best of a hundred motion primitives, rolled
// out against the predicted obstacles and peers with their growing uncertainty, and smooths it with the
// optimiser. Costs are in seconds of travel; a certain contact costs SpaceTimeParameters::collision_cost of
// them.
#pragma once

#include <limits>
#include <optional>

#include "spf/planning/plan_judge.hpp"
#include "spf/planning/sight_limit.hpp"
#include "spf/planning/space_time/encounter_rate.hpp"
#include "spf/planning/space_time/motion_primitive.hpp"
#include "spf/planning/space_time/space_time_parameters.hpp"
#include "spf/planning/space_time/space_time_risk.hpp"
#include "spf/planning/space_time/surface_risk.hpp"
#include "spf/planning/space_time/trajectory_smoother.hpp"
#include "spf/planning/steering.hpp"
#include "spf/robot/robot_parameters.hpp"

namespace spf {

class SpaceTimePlanner final : public Planner {
 public:
  /// Throws std::invalid_argument when parameters are out of range. Plans allocate only when more obstacles
  /// and peers come near than ever before. `planner` holds the optimiser's settings and weights.
  SpaceTimePlanner(const SpaceTimeParameters& parameters, const PlannerParameters& planner,
                   const RobotParameters& robot);

  /// The current plan is kept while it is the best. The outcome is that of the clearance check (PlanJudge); a
  /// choice that fails it is driven all the same, as the one with the least cost.
  void plan(const PlanRequest& request, PlanResult& result) override;
  [[nodiscard]] bool passes_narrow_gaps() const override { return true; }
  [[nodiscard]] bool gives_way() const override { return true; }

 private:
  /// Cost of a roll-out in seconds, split for the record.
  struct Score {
    double time = 0.0;  ///< [s] travel time to the goal along it
    double risk = 0.0;  ///< [s] cost of the probability of contact, discounted and weighted
    int worst = -1;     ///< disc that contributes most, -1 = none
    [[nodiscard]] double total() const { return time + risk; }
  };
  [[nodiscard]] Score score(const RollOut& roll_out, const PlanRequest& request, double enough) const;
  void consider(const MotionPrimitive& primitive, const PlanRequest& request, PlanResult& result,
                double bonus = 0.0);
  void update_surface_price(const PlanRequest& request);
  [[nodiscard]] MovingRisk risk_in_crowd() const;
  void consider_previous(const PlanRequest& request, PlanResult& result);
  void consider_all(const PlanRequest& request, const Score& direct, PlanResult& result);
  [[nodiscard]] double time_to_go(const Eigen::Vector2d& position_world, const CostToGo& guide) const;
  [[nodiscard]] double turning_time(const SteeredState& state, const CostToGo& guide) const;
  [[nodiscard]] double turning_reach() const { return std::max(robot_.radius, robot_.min_turning_radius); }
  void consider_sidesteps(const PlanRequest& request, PlanResult& result);
  /// Index of the candidate among the result's; -1 when none are kept.
  int keep_candidate(const RollOut& roll_out, Candidate::Kind kind, const Score& score,
                     const PlanRequest& request, PlanResult& result) const;
  void take_best(const Score& score, int candidate, bool is_previous);
  void sample(const Trajectory& trajectory, double from, double drive_end, bool brakes);
  bool smooth_best(const PlanRequest& request, PlanResult& result);
  void finish(const PlanRequest& request, PlanResult& result);

  SpaceTimeParameters parameters_;
  RobotParameters robot_;
  std::optional<Steering> steering_;  // of a robot that drives along its heading
  RollOutSettings settings_;          // its max_speed is that of the plan under way
  SpaceTimeRisk risk_;
  EncounterRate encounters_;
  SightLimit sight_;
  PassageSpeed passage_;
  SurfaceRisk surfaces_;
  /// How the robot gets on.
  struct Progress {
    Eigen::Vector2d goal = Eigen::Vector2d::Zero();                // [m]
    double asked_time = -std::numeric_limits<double>::infinity();  // [s] of the last plan
    double nearest = std::numeric_limits<double>::infinity();      // [m] to go, the least of late
    double waits_since =
        std::numeric_limits<double>::infinity();  // [s] no faster than a creep, or to and fro
  };
  Progress progress_;
  RollOut trial_;
  RollOut best_;
  Score best_score_;
  bool best_is_previous_ = false;
  int best_candidate_ = -1;  // index in the result, when candidates are kept
  TrajectorySmoother smoother_;
  Trajectory smooth_;
  PlanJudge judge_;
  double plan_start_ = -1e9;  // [s] of the last plan made here
  double drive_end_ = -1e9;   // [s] when its braking to rest begins
};

}  // namespace spf
