// The door of planning: one request, one result, and one meaning of what the result says, whatever the
// method. Frame: world.
#pragma once

#include <optional>
#include <vector>

#include "spf/robot/robot_parameters.hpp"
#include "spf/trajectory/trajectory.hpp"
#include "spf/world/world_snapshot.hpp"

namespace spf {

class CostToGo;

/// What the last attempt to plan came to.
enum class PlanOutcome {
  success,          ///< the trajectory passed the clearance check (spf/planning/clearance.hpp)
  goal_reached,     ///< likewise, and it stands at the goal
  no_path,          ///< the static map leaves no way to the goal
  unsafe,           ///< nothing that was found passed the check
  deadline,         ///< the evaluation budget ended before anything passed
  invalid_request,  ///< numbers that are not finite, or no map, or no guide
};
[[nodiscard]] const char* to_string(PlanOutcome outcome);
/// Did the method find what it was asked for?
[[nodiscard]] constexpr bool succeeded(PlanOutcome outcome) {
  return outcome == PlanOutcome::success || outcome == PlanOutcome::goal_reached;
}

/// What the robot is to do with the result's trajectory.
enum class PlanAction {
  follow,  ///< it is new and replaces the plan under way
  keep,    ///< it is the plan under way, which goes on
  brake,   ///< it is new and leads to rest (or aside), since there is no plan to follow
};

struct PlanRequest {
  double time = 0.0;                                     ///< [s] start of the new trajectory
  FlatState head;                                        ///< state at that time
  HeadingState heading;                                  ///< heading at that time
  Eigen::Vector2d goal_world = Eigen::Vector2d::Zero();  ///< [m]
  std::optional<double> goal_heading;                    ///< [rad], free when absent
  double position_sigma = 0.0;                           ///< [m] own pose and tracking uncertainty per axis
  WorldSnapshot world;
  const CostToGo* guide = nullptr;        ///< cost-to-go of the map and the goal, up to date
  const Trajectory* committed = nullptr;  ///< plan under way, null after a reset
  bool braking = false;                   ///< the plan under way is a braking one
  bool goal_cut_off = false;              ///< no way leads to the goal; the guide leads as near as one does
  bool keep_candidates = false;           ///< keep every candidate in the result, for display (allocates)
};

/// One trajectory that was considered, for display and statistics.
struct Candidate {
  enum class Kind { previous, side_a, side_b, primitive, optimised, brake };
  Kind kind = Kind::optimised;
  double cost = 0.0;  ///< to compare candidates of one result: in units of the method (see its header)
  double risk = 0.0;  ///< [1] as PlanResult::risk
  bool chosen = false;
  Trajectory trajectory;
};

struct PlanStats {
  int optimiser_calls = 0;   ///< L-BFGS runs (the paper's "iterations")
  int inner_iterations = 0;  ///< L-BFGS iterations in all runs
  int evaluations = 0;       ///< cost evaluations in all runs
  int searches = 0;          ///< grid searches
  int primitives = 0;        ///< rolled-out candidates
  int side_changes = 0;      ///< in the last seconds, per obstacle the largest
};

struct PlanResult {
  PlanOutcome outcome = PlanOutcome::invalid_request;
  PlanAction action = PlanAction::brake;
  Trajectory trajectory;    ///< always usable, whatever the outcome
  double risk = 0.0;        ///< [1] chance of contact that the method sees along `trajectory`, in [0, 1]
  int blocking_track = -1;  ///< id of the obstacle that shapes the plan most, -1 = none
  int blocking_peer = -1;   ///< likewise, robot number
  PlanStats stats;          ///< of this call alone
  std::vector<Candidate> candidates;  ///< of this call, when asked for

  /// Empties all but the trajectory, before a call fills it in.
  void clear();
};

/// A method of planning. It may remember what it did; it knows no clock and draws no chance, so the same
/// requests give the same results.
class Planner {
 public:
  virtual ~Planner() = default;

  /// One planning check of the robot, at its planning rate. Never throws; a request that cannot be planned
  /// is answered with `invalid_request`. Allocates nothing in the long run, unless candidates are kept.
  virtual void plan(const PlanRequest& request, PlanResult& result) = 0;

  /// What the guide does where no way leads to the goal: true: it leads as near to it as a way does
  /// (PlanRequest::goal_cut_off), false: to where the shortest way is blocked, and the method stands.
  [[nodiscard]] virtual bool approaches_cut_off_goal() const { return true; }
};

/// Whether a request can be planned at all: finite numbers, a map and a guide.
[[nodiscard]] bool usable(const PlanRequest& request);

/// The result of a method that has no plan to offer: the braking trajectory under way goes on, else a new one
/// begins at the head. Where not even the head is finite, the plan under way goes on to its end, at rest.
void stand_instead(const PlanRequest& request, const RobotParameters& robot, PlanOutcome outcome,
                   PlanResult& result);

}  // namespace spf
