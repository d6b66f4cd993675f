// The door of planning: one request, one result. Behind it the paper's generator (eq. 9-13) and ours
// (space-time).
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "spf/trajectory/trajectory.hpp"
#include "spf/world/world_snapshot.hpp"

namespace spf {

enum class PlanOutcome {
  success,          ///< a new trajectory that passed the checks
  goal_reached,     ///< standing at the goal is the plan
  no_path,          ///< the static map leaves no way to the goal
  unsafe,           ///< no candidate passed the checks; `trajectory` is the best fallback (braking)
  deadline,         ///< the evaluation budget ended before any candidate passed
  invalid_request,  ///< NaN or missing data
};
[[nodiscard]] const char* to_string(PlanOutcome outcome);

struct PlanRequest {
  double time = 0.0;                                     ///< [s] start of the new trajectory
  FlatState head;                                        ///< state at that time
  HeadingState heading;                                  ///< heading at that time
  Eigen::Vector2d goal_world = Eigen::Vector2d::Zero();  ///< [m]
  std::optional<double> goal_heading;                    ///< [rad], free when absent
  double position_sigma = 0.0;                           ///< [m] own pose and tracking uncertainty per axis
  WorldSnapshot world;
  const Trajectory* committed = nullptr;  ///< plan under way, null after a reset
};

/// One trajectory that was considered, for display and statistics.
struct Candidate {
  enum class Kind { previous, side_a, side_b, manoeuvre, optimised, brake };
  Kind kind = Kind::optimised;
  double cost = 0.0;
  double risk = 0.0;  ///< method dependent: largest risk of the field, or expected cost of contact
  bool chosen = false;
  Trajectory trajectory;
};

struct PlanStats {
  int optimiser_calls = 0;   ///< L-BFGS runs (the paper's "iterations")
  int inner_iterations = 0;  ///< L-BFGS iterations in all runs
  int evaluations = 0;       ///< cost evaluations in all runs
  int searches = 0;          ///< grid searches
  int manoeuvres = 0;        ///< rolled-out candidates
  int side_changes = 0;      ///< in the last seconds, per obstacle the largest
};

struct PlanResult {
  PlanOutcome outcome = PlanOutcome::invalid_request;
  Trajectory trajectory;    ///< always usable: the plan, or the best fallback
  double risk = 0.0;        ///< remaining risk of `trajectory`
  int blocking_track = -1;  ///< id of the obstacle that shapes the plan most, -1 = none
  int blocking_peer = -1;   ///< likewise, robot number
  PlanStats stats;
  std::vector<Candidate> candidates;  ///< filled when asked for (PlannerParameters::keep_candidates)
};

}  // namespace spf
