// Result of a trial (docs/protocol.md, Figures).
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "sim/contact.hpp"
#include "spf/math/parameters.hpp"
#include "spf/team/stop_cause.hpp"

namespace spf::sim {

struct Recording;

enum class TrialOutcome { success, collision, timeout };

}  // namespace spf::sim

namespace spf {
template <>
struct EnumNames<sim::TrialOutcome> {
  static constexpr std::array<std::pair<sim::TrialOutcome, const char*>, 3> values{
      {{sim::TrialOutcome::success, "success"},
       {sim::TrialOutcome::collision, "collision"},
       {sim::TrialOutcome::timeout, "overtime"}}};
};
}  // namespace spf

namespace spf::sim {

[[nodiscard]] inline const char* to_string(TrialOutcome outcome) {
  return enum_name(outcome);
}

/// What a robot did in all, on its ways to one goal or more.
struct RobotLife {
  int goals_reached = 0;
  double last_arrival = 0.0;   ///< [s] of the trial, at its last goal so far
  double present_time = 0.0;   ///< [s] in the scene
  double longest_stand = 0.0;  ///< [s] at a stretch, with a goal to go to and not told to stand
};

/// Of one robot. Lengths and times count while it is on its way to a goal, so until it arrived or to the end
/// of the trial; ratios are over all its ways.
struct RobotResult {
  bool arrived = false;
  bool wrecked = false;
  bool touched = false;            ///< had a contact that counts
  bool in_time = false;            ///< arrived no later than the trial's latest_arrival
  bool excused = false;            ///< nothing more was asked of it: no goal, taken away, or broken
  double travel_time = 0.0;        ///< [s]
  double path_length = 0.0;        ///< [m] of the true path
  double travel_time_ratio = 0.0;  ///< [1] over the obstacle-free rest-to-rest optimum
  double path_length_ratio = 0.0;  ///< [1] over the straight line
  RobotLife life;
  int plans = 0;                     ///< calls of the planner
  int failed_plans = 0;              ///< those whose outcome is not success or goal_reached
  std::int64_t optimiser_calls = 0;  ///< L-BFGS runs (the paper's iterations)
  std::int64_t inner_iterations = 0;
  int guard_stops = 0;                      ///< by the guard, in the whole trial
  double guard_held = 0.0;                  ///< [s] in which the guard slowed or stopped it, likewise
  double static_clearance = 0.0;            ///< [m] least, minus the radius; at most 3 m
  std::array<double, kStopCauses> stood{};  ///< [s] by StopCause; `arrived` and `none` stay 0
};

struct TrialResult {
  int trial = 0;
  TrialOutcome outcome = TrialOutcome::timeout;
  std::vector<Contact> contacts;             ///< by time; only the first, where a contact ends the trial
  std::vector<Contact> hits_while_standing;  ///< by recorded people who do not react
  std::vector<RobotResult> robots;
  double last_arrival = 0.0;  ///< [s] of the robots that arrived
  double dynamic_distance =
      0.0;  ///< [m] least centre distance to an obstacle while travelling; infinite without dynamic obstacles
  double dynamic_clearance = 0.0;  ///< [m] likewise minus the radii
  double peer_clearance = 0.0;     ///< [m] least gap between robots; infinite when never below 1 m
  double static_clearance = 0.0;   ///< [m] least gap to static shapes and border
  double sim_seconds = 0.0;        ///< [s] simulated
  double wall_seconds = 0.0;       ///< [s] by the caller's clock, 0 without
  std::uint64_t messages = 0;      ///< broadcasts sent
  std::uint64_t digest = 0;        ///< hash over the bits of all positions at every 0.1 s
  std::shared_ptr<const Recording> recording;  ///< null unless asked for
};

}  // namespace spf::sim
