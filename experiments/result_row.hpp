// One row of a result table: trials of one scene family, method, noise and tracking, condensed. The names of
// its fields are a contract with scripts outside the repository and do not change.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "experiments/trial_record.hpp"

namespace spf {

struct ResultRow {
  std::string family, method, noise;
  double level = 0.0;  ///< [1]
  std::string tracking;
  std::uint64_t seed = 0;
  int trials = 0, success = 0, timeout = 0, collision = 0;
  double success_rate = kNotKnown, wilson_low = 0.0, wilson_high = 1.0;  ///< [1] with the 95 % interval
  // Means over robots and successful trials; ratios to the obstacle-free rest-to-rest optimum.
  double path_length_mean = kNotKnown;   ///< [m]
  double travel_time_mean = kNotKnown;   ///< [s]
  double path_length_ratio = kNotKnown;  ///< [1]
  double travel_time_ratio = kNotKnown;  ///< [1]
  // Over successful trials.
  double dynamic_distance_mean = kNotKnown, dynamic_distance_min = kNotKnown,
         dynamic_distance_std = kNotKnown;   ///< [m]
  double dynamic_clearance_min = kNotKnown;  ///< [m]
  // Over all trials.
  double optimiser_calls_per_robot = kNotKnown;  ///< [1] mean over trials
  double plan_ms_median = kNotKnown, plan_ms_p99 = kNotKnown, plan_ms_max = kNotKnown;  ///< [ms]
  double control_us_median = kNotKnown, control_us_p99 = kNotKnown;                     ///< [us]
  int arrived_robots = 0, robots = 0;                                                   ///< in all trials
  double sim_seconds = 0.0, wall_seconds = 0.0;                                         ///< [s] in all trials
  // Of PED alone, over all trials; a row without crossings does not write them.
  int crossings = 0, crossings_ok = 0;  ///< passages of one robot; in time and without contact
  int contacts_moving = 0;              ///< contacts of robots that had not stood still for a second
  int hits_while_standing = 0;          ///< by people, who do not react, of robots that had
  double robot_minutes = 0.0;           ///< [min] that robots spent in the scene
  // Of fleets that do more than go to one goal each, over all trials; other rows do not write them.
  std::int64_t goals_reached = 0;
  double robot_hours = 0.0;           ///< [h] that robots spent in the scene
  double goals_per_robot_hour = 0.0;  ///< [1/h] throughput
  double longest_stand = 0.0;         ///< [s] at a stretch, of a robot with a goal and not told to stand
  std::string condition;              ///< of a campaign; a row without one does not write it

  /// The only list of these fields.
  template <class Self, class Visitor>
  static void visit_fields(Self& self, Visitor&& visit) {
    visit("family", self.family);
    visit("method", self.method);
    visit("noise", self.noise);
    visit("level", self.level);
    visit("tracking", self.tracking);
    visit("seed", self.seed);
    visit("trials", self.trials);
    visit("success", self.success);
    visit("overtime", self.timeout);
    visit("collision", self.collision);
    visit("success_rate", self.success_rate);
    visit("wilson_low", self.wilson_low);
    visit("wilson_high", self.wilson_high);
    visit("path_length_mean", self.path_length_mean);
    visit("travel_time_mean", self.travel_time_mean);
    visit("path_length_ratio", self.path_length_ratio);
    visit("travel_time_ratio", self.travel_time_ratio);
    visit("dynamic_distance_mean", self.dynamic_distance_mean);
    visit("dynamic_distance_min", self.dynamic_distance_min);
    visit("dynamic_distance_std", self.dynamic_distance_std);
    visit("dynamic_clearance_min", self.dynamic_clearance_min);
    visit("optimiser_calls_per_robot", self.optimiser_calls_per_robot);
    visit("plan_ms_median", self.plan_ms_median);
    visit("plan_ms_p99", self.plan_ms_p99);
    visit("plan_ms_max", self.plan_ms_max);
    visit("control_us_median", self.control_us_median);
    visit("control_us_p99", self.control_us_p99);
    visit("arrived_robots", self.arrived_robots);
    visit("robots", self.robots);
    visit("sim_seconds", self.sim_seconds);
    visit("wall_seconds", self.wall_seconds);
  }
  template <class Self, class Visitor>
  static void visit_crossing_fields(Self& self, Visitor&& visit) {
    visit("crossings", self.crossings);
    visit("crossings_ok", self.crossings_ok);
    visit("contacts_moving", self.contacts_moving);
    visit("hits_while_standing", self.hits_while_standing);
    visit("robot_minutes", self.robot_minutes);
  }
  template <class Self, class Visitor>
  static void visit_fleet_fields(Self& self, Visitor&& visit) {
    visit("goals_reached", self.goals_reached);
    visit("robot_hours", self.robot_hours);
    visit("goals_per_robot_hour", self.goals_per_robot_hour);
    visit("longest_stand", self.longest_stand);
  }
};

/// Condenses trials that differ in their number alone; `wall_seconds` is the sum over trials. Requires at
/// least one.
[[nodiscard]] ResultRow result_row(const std::vector<TrialRecord>& trials);

/// One JSON object in one line, without its line feed. Unknown numbers read null.
[[nodiscard]] std::string to_json_line(const ResultRow& row);
/// The names of the fields, and their values, as CSV lines with line feeds. Unknown numbers, and those of PED
/// in other rows, are empty.
[[nodiscard]] std::string csv_header();
[[nodiscard]] std::string to_csv_line(const ResultRow& row);

/// Two methods on the same trials.
struct PairedRow {
  std::string family, noise, tracking;
  double level = 0.0;
  std::uint64_t seed = 0;
  std::string condition;  ///< as in ResultRow
  int trials = 0;         ///< that both ran
  std::string method_a, method_b;
  int both = 0, only_a = 0, only_b = 0, neither = 0;  ///< trials that succeeded with ...
  double mcnemar_p = 1.0;                             ///< [1] exact, two-sided
};

/// Compares the trials that are in both lists. Requires that the lists differ in method alone.
[[nodiscard]] PairedRow paired_row(const std::vector<TrialRecord>& a, const std::vector<TrialRecord>& b);
[[nodiscard]] std::string to_json_line(const PairedRow& row);

}  // namespace spf
