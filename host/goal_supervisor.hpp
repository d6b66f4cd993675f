// What becomes of a goal: whether the robot has reached it, or whether it is to be given up and for what. It
// decides nothing about the motion; who sends goals asks it, and tells its user. Frame: world (the fleet's);
// times are the host's [s].
#pragma once

#include <limits>
#include <optional>

#include "host/planner_host.hpp"

namespace spf::host {

enum class GoalOutcome {
  none,     ///< there was no goal yet
  pursued,  ///< nothing is decided
  reached,  ///< the robot stands there, and points where it was to point
  // Given up:
  off_map,  ///< it lies beyond the map
  in_wall,  ///< in a wall, or nearer to one than the robot goes
  no_path,  ///< no path has led there for as long as it was waited for
  // By somebody's wish:
  preempted,  ///< for a newer one
  cancelled,
};
[[nodiscard]] const char* to_string(GoalOutcome outcome);
/// Neither reached nor anybody's wish: the robot could not do what it was told.
[[nodiscard]] constexpr bool given_up(GoalOutcome outcome) {
  return outcome == GoalOutcome::off_map || outcome == GoalOutcome::in_wall ||
         outcome == GoalOutcome::no_path;
}

/// What is known of the goal in one step.
struct GoalFacts {
  bool map_known = false;  ///< there is a map to look for it
  bool on_map = true;
  double clearance =
      std::numeric_limits<double>::infinity();  ///< [m] of the goal from the walls of the given map
  /// How the path to it stands; none while no plan is made for it, or something else makes the robot stand.
  std::optional<GoalAccess> access;
  bool stands_short = false;                                  ///< of a goal that it cannot come nearer to
  bool arrived = false;                                       ///< its plan has ended at the goal
  double distance = std::numeric_limits<double>::infinity();  ///< [m] from the robot to the goal
  double position_sigma = 0.0;                                ///< [m] of that
  double heading_error = 0.0;                                 ///< [rad] 0 where any heading will do
};
/// `localiser` null: the robot is where its plan says.
[[nodiscard]] GoalFacts goal_facts(const PlannerHost& planner, const Localiser* localiser, double now);

class GoalSupervisor {
 public:
  static constexpr double kForEver = std::numeric_limits<double>::infinity();

  GoalSupervisor(const AgentParameters& agent, const HostParameters& host) { reconfigure(agent, host); }
  /// Takes what it needs of them: the robot's radius and the tolerances.
  void reconfigure(const AgentParameters& agent, const HostParameters& host);

  /// A new goal. It is given up when for `timeout` [s] without a break there was no path to it: kForEver for
  /// those that nobody waits for.
  void begin(double timeout);
  /// In every step of the planner, after it. What was decided stays.
  GoalOutcome step(const GoalFacts& facts, double now);
  /// The goal was taken away: `preempted` or `cancelled`.
  void end(GoalOutcome outcome);

  [[nodiscard]] GoalOutcome outcome() const { return outcome_; }

 private:
  [[nodiscard]] bool reached(const GoalFacts& facts) const;
  /// What would be the outcome if it stayed so; `pursued` when nothing is wrong.
  [[nodiscard]] GoalOutcome complaint(const GoalFacts& facts) const;

  double radius_ = 0.0;             // [m]
  double tolerance_ = 0.0;          // [m]
  double heading_tolerance_ = 0.0;  // [rad]
  GoalOutcome outcome_ = GoalOutcome::none;
  double timeout_ = kForEver;          // [s]
  bool looked_up_ = false;             // on the given map
  std::optional<double> wrong_since_;  // [s]
};

}  // namespace spf::host
