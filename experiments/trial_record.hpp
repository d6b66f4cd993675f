// What is kept of one trial: one line of trials.jsonl. Everything but the timings repeats bit for bit. SI
// units.
#pragma once

#include <Eigen/Core>

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "experiments/duration_histogram.hpp"
#include "sim/trial_result.hpp"

namespace spf {

inline constexpr double kNotKnown = std::numeric_limits<double>::quiet_NaN();

/// What was run: all that names a row of a table, and the trial.
struct TrialKey {
  std::string family;
  std::string method;
  std::string noise;     ///< white, walk
  double level = 0.0;    ///< [1] multiple of Sigma
  std::string tracking;  ///< ideal, full
  std::uint64_t seed = 0;
  int trial = 0;
  std::string condition;  ///< of a campaign: which further settings of the scene; empty = none
};

/// Of one robot; lengths and times count until it first arrived, or to the end of the trial.
struct RobotRecord {
  bool arrived = false;
  double path_length = 0.0;        ///< [m]
  double travel_time = 0.0;        ///< [s]
  double path_length_ratio = 0.0;  ///< [1] over the straight line
  double travel_time_ratio = 0.0;  ///< [1] over the obstacle-free rest-to-rest optimum
  std::int64_t plans = 0;          ///< planning calls
  std::int64_t failed_plans = 0;
  std::int64_t optimiser_calls = 0;   ///< L-BFGS runs
  std::int64_t inner_iterations = 0;  ///< in all of them
};

/// The first contact of a trial.
struct ContactRecord {
  double time = 0.0;  ///< [s]
  int robot = -1;
  std::string with;                                    ///< disc, person, robot, box, pillar, wall, border
  int other = -1;                                      ///< which of them, -1 = there is but one
  Eigen::Vector2d position = Eigen::Vector2d::Zero();  ///< [m]
  double robot_speed = 0.0;                            ///< [m/s]
  double other_speed = 0.0;                            ///< [m/s]
};

/// What a robot was about when its trial failed.
struct CauseRecord {
  int robot = -1;            ///< that touched something, or the first that is not home
  std::string last_plan;     ///< outcome of its last planning call, empty when there was none
  double plan_age = 0.0;     ///< [s] since that call
  std::string stand_reason;  ///< moving, obstacle ahead, ...
  int culprit = -1;          ///< id of the obstacle or peer behind the reason, -1 = none
};

/// Of a trial among recorded people (PED): a crossing is one robot on its way through.
struct CrossingRecord {
  int crossings = 0;
  int crossings_ok = 0;        ///< in time and without a contact that counts
  int contacts_moving = 0;     ///< of all robots; not of those that had stood still for a second
  double robot_minutes = 0.0;  ///< [min] that robots spent in the place
};

struct TrialRecord {
  TrialKey key;
  std::string setup;  ///< hash over all settings of the trial but its number
  sim::TrialOutcome outcome = sim::TrialOutcome::overtime;
  std::optional<ContactRecord> contact;
  int contacts = 0;                        ///< in all, where contacts do not end a trial
  int hits_while_standing = 0;             ///< by recorded people who do not react
  std::optional<CrossingRecord> crossing;  ///< of PED
  double sim_time = 0.0;                   ///< [s] simulated
  double dynamic_distance =
      kNotKnown;  ///< [m] smallest, centre to a moving obstacle; unknown when there is none
  double dynamic_clearance = kNotKnown;  ///< [m] the same minus radii
  std::vector<RobotRecord> robots;
  std::string failure;               ///< why it failed, in words; empty after a success
  std::optional<CauseRecord> cause;  ///< of a failed trial
  double wheel_share =
      kNotKnown;       ///< [1] largest wheel speed over its limit, in frames of 0.1 s; unknown without wheels
  std::string digest;  ///< hash over the bits of all positions, in hexadecimal digits

  // Timings: the only fields that differ between runs.
  DurationHistogram plan_time;       ///< [s] of each planning call
  DurationHistogram control_time;    ///< [s] of each control tick
  double wall_time = 0.0;            ///< [s] of the whole trial
  DurationHistogram new_plan_time;   ///< [s] of the planning calls that looked for a new plan
  DurationHistogram optimiser_time;  ///< [s] of each optimiser call: such a planning call over its number

  [[nodiscard]] bool succeeded() const { return outcome == sim::TrialOutcome::success; }
};

/// One line of JSON without its line feed. Unknown numbers read null.
[[nodiscard]] std::string to_json_line(const TrialRecord& record);
/// The record of such a line. Every field is checked: its kind, its range, its name among those known. Throws
/// InputError that names `source`, `line`, key, value and limit.
[[nodiscard]] TrialRecord trial_record_from_json(const std::string& text, const std::string& source,
                                                 int line);
/// Whether two records tell the same of a trial, timings apart.
[[nodiscard]] bool same_result(const TrialRecord& a, const TrialRecord& b);

}  // namespace spf
