// The interface of planning methods: one request and one result, whose fields mean the same for every method.
// Frame: world.
#pragma once

#include <optional>
#include <vector>

#include "spf/robot/robot_parameters.hpp"
#include "spf/trajectory/trajectory.hpp"
#include "spf/world/world_snapshot.hpp"

namespace spf {

class CostToGo;

/// Outcome of the last attempt to plan.
enum class PlanOutcome {
  success,          ///< the trajectory passed the clearance check (spf/planning/clearance.hpp)
  goal_reached,     ///< likewise, and it rests at the goal
  no_path,          ///< the static map has no path to the goal
  unsafe,           ///< the method came to no trajectory that passed the check; there may be others,
                    ///< which it did not check
  deadline,         ///< the evaluation budget ended before anything passed
  invalid_request,  ///< numbers not finite, or no map, or no guide
};
[[nodiscard]] const char* to_string(PlanOutcome outcome);
/// Whether the method found what was requested.
[[nodiscard]] constexpr bool succeeded(PlanOutcome outcome) {
  return outcome == PlanOutcome::success || outcome == PlanOutcome::goal_reached;
}

/// What the robot has to do with the result's trajectory.
enum class PlanAction {
  follow,  ///< it is new and replaces the current plan
  keep,    ///< it is the current plan, which goes on
  brake,   ///< it is new and brakes (or steps aside), since there is no plan to follow
};

/// The robot has to stop where its cost-to-go is `cost_to_go`, and let a peer pass.
struct GiveWay {
  double cost_to_go = 0.0;  ///< [m]
  int peer = -1;            ///< robot number of the peer to let pass
};

struct PlanRequest {
  double time = 0.0;                                     ///< [s] start of the new trajectory
  FlatState head;                                        ///< state at that time
  HeadingState heading;                                  ///< heading at that time
  Eigen::Vector2d goal_world = Eigen::Vector2d::Zero();  ///< [m]
  std::optional<double> goal_heading;                    ///< [rad], free when absent
  double position_sigma = 0.0;                           ///< [m] own pose and tracking uncertainty per axis
  WorldSnapshot world;
  const CostToGo* guide = nullptr;        ///< up-to-date cost-to-go of the map and the goal
  const Trajectory* committed = nullptr;  ///< current plan, null after a reset
  bool braking = false;                   ///< the current plan is a braking one
  bool goal_cut_off = false;        ///< no path leads to the goal; the guide leads as near to it as possible
  std::optional<GiveWay> give_way;  ///< see Planner::gives_way()
  bool keep_candidates = false;     ///< keep every candidate in the result, for display (allocates)
};

/// One trajectory that was considered, for display and statistics.
struct Candidate {
  enum class Kind { previous, side_a, side_b, primitive, optimised, brake };
  Kind kind = Kind::optimised;
  double cost = 0.0;  ///< for comparing candidates of one result: the unit is the method's (see its header)
  double risk = 0.0;  ///< [1] as PlanResult::risk, and set by the agent like that
  bool chosen = false;
  Trajectory trajectory;
};

struct PlanStats {
  int optimiser_calls = 0;   ///< L-BFGS runs (the paper's "iterations")
  int inner_iterations = 0;  ///< L-BFGS iterations in all runs
  int evaluations = 0;       ///< cost evaluations in all runs
  int primitives = 0;        ///< rolled-out candidates
};

struct PlanResult {
  PlanOutcome outcome = PlanOutcome::invalid_request;
  PlanAction action = PlanAction::brake;
  Trajectory trajectory;  ///< always usable, whatever the outcome
  double risk = 0.0;  ///< [1] of `trajectory`, in [0, 1]: contact_risk() (spf/planning/contact_risk.hpp). No
                      ///< method sets it; the agent does, alike for all
  int blocking_track = -1;            ///< id of the obstacle that shapes the plan most, -1 = none
  int blocking_peer = -1;             ///< likewise, robot number
  PlanStats stats;                    ///< of this call alone
  std::vector<Candidate> candidates;  ///< of this call, when asked for

  /// Empties all but the trajectory, before a call fills it in.
  void clear();
};

/// A planning method. It may keep state; it uses no clock and no random numbers, so the same requests give
/// the same results.
class Planner {
 public:
  virtual ~Planner() = default;

  /// Called at the robot's planning rate. Never throws; a request that cannot be planned gives
  /// `invalid_request`. Allocates nothing after the first calls, unless candidates are kept.
  virtual void plan(const PlanRequest& request, PlanResult& result) = 0;

  /// Where the guide leads when no path leads to the goal. True: as near to it as possible
  /// (PlanRequest::goal_cut_off); false: to where the shortest path is blocked, and the method stops.
  [[nodiscard]] virtual bool approaches_cut_off_goal() const { return true; }
  /// Whether the guide may lead through gaps that are hardly wider than the robot: the method then slows down
  /// as they need.
  [[nodiscard]] virtual bool passes_narrow_gaps() const { return false; }
  /// Whether it stops where PlanRequest::give_way says.
  [[nodiscard]] virtual bool gives_way() const { return false; }
};

/// Whether a request can be planned at all: finite numbers, a map and a guide.
[[nodiscard]] bool usable(const PlanRequest& request);
/// Why a request cannot be planned, for a method that needs the guide: `invalid_request` when it is not
/// usable, `no_path` when the guide leads nowhere, since no position near the goal is free. None when it can.
[[nodiscard]] std::optional<PlanOutcome> refusal(const PlanRequest& request);

/// The result of a method without a plan: a braking trajectory under way goes on, else a new one begins at
/// the head. If not even the head is finite, the current plan goes on to its end, at rest.
void stand_instead(const PlanRequest& request, const RobotParameters& robot, PlanOutcome outcome,
                   PlanResult& result);

}  // namespace spf
