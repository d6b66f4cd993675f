// What is kept of one trial: one line of trials.jsonl. Everything but the timings repeats bit for bit. SI
// units.
//
// Every struct has one list of its fields, visit_fields, which writes and reads them: the keys of the file,
// in their order, and what their values may be. A visitor is called as
//   visit.number(key, value, range)         double; maybe_number: or null, which is "not known"
//   visit.whole(key, value, low, high)      int or int64
//   visit.robot(key, value, least)          index of a robot of the trial; robot_count(key, value): up to all
//   visit.seed, visit.flag                  (key, value)
//   visit.text(key, value, least, most)     bytes; visit.digits(key, value, least): hexadecimal
//   visit.choice(key, value)                of an enumeration; name<E>(key, text): the name of one
//   visit.histogram(key, value)
//   visit.list(key, structs, least, most)
//   visit.object(key, optional struct)      object_or_null: the key is always there
//   visit.part(optional struct)             its fields stand among these
//   visit.present(key, condition)           whether what may be absent is there: what follows hangs on it
#pragma once

#include <Eigen/Core>

#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "experiments/duration_histogram.hpp"
#include "sim/simulation_parameters.hpp"
#include "sim/trial_result.hpp"
#include "spf/math/parameters.hpp"

namespace spf {

inline constexpr double kNotKnown = std::numeric_limits<double>::quiet_NaN();

/// Limits far above any trial; sums over a million trials stay whole numbers.
namespace record_limits {
inline constexpr std::size_t kMostRobots = 10'000;
inline constexpr std::size_t kLongestName = 200;      // bytes
inline constexpr std::size_t kLongestText = 1 << 20;  // bytes
inline constexpr std::int64_t kMostCalls = 1'000'000'000'000;
inline constexpr std::int64_t kMostContacts = 100'000;
inline constexpr int kLargestId = 1'000'000'000;
inline constexpr Range kTime{0.0, 1e6};       // [s]
inline constexpr Range kLength{0.0, 1e9};     // [m], and ratios and speeds
inline constexpr Range kPosition{-1e9, 1e9};  // [m]
}  // namespace record_limits

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

/// Of one robot, in trials in which robots do more than go to one goal.
struct FleetRecord {
  std::int64_t goals_reached = 0;
  double present_time = 0.0;   ///< [s] in the scene
  double longest_stand = 0.0;  ///< [s] at a stretch, with a goal to go to and not told to stand
  bool excused = false;        ///< at the end nothing more was asked of it: no goal, taken away, or broken

  template <class Self, class Visitor>
  static void visit_fields(Self& self, Visitor&& visit) {
    using namespace record_limits;
    visit.whole("goals_reached", self.goals_reached, 0, kMostCalls);
    visit.number("present_time", self.present_time, kTime);
    visit.number("longest_stand", self.longest_stand, kTime);
    visit.flag("excused", self.excused);
  }
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
  int guard_stops = 0;                ///< by the guard
  double guard_held = 0.0;            ///< [s] in which the guard slowed or stopped it
  std::optional<FleetRecord> fleet;

  template <class Self, class Visitor>
  static void visit_fields(Self& self, Visitor&& visit) {
    using namespace record_limits;
    visit.flag("arrived", self.arrived);
    visit.number("path_length", self.path_length, kLength);
    visit.number("travel_time", self.travel_time, kTime);
    visit.maybe_number("path_length_ratio", self.path_length_ratio, kLength);
    visit.maybe_number("travel_time_ratio", self.travel_time_ratio, kLength);
    visit.whole("plans", self.plans, 0, kMostCalls);
    visit.whole("failed_plans", self.failed_plans, 0, kMostCalls);
    visit.whole("optimiser_calls", self.optimiser_calls, 0, kMostCalls);
    visit.whole("inner_iterations", self.inner_iterations, 0, kMostCalls);
    if (visit.present("guard_stops", self.guard_held > 0.0)) {
      visit.whole("guard_stops", self.guard_stops, 0, kMostContacts);
      visit.number("guard_held", self.guard_held, kTime);
    }
    if (visit.present("goals_reached", self.fleet.has_value())) visit.part(self.fleet);
  }
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

  template <class Self, class Visitor>
  static void visit_fields(Self& self, Visitor&& visit) {
    using namespace record_limits;
    visit.number("time", self.time, kTime);
    visit.robot("robot", self.robot, 0);
    visit.template name<sim::ContactWith>("with", self.with);
    visit.whole("other", self.other, -1, kLargestId);
    visit.number("x", self.position.x(), kPosition);
    visit.number("y", self.position.y(), kPosition);
    visit.number("robot_speed", self.robot_speed, kLength);
    visit.number("other_speed", self.other_speed, kLength);
  }
};

/// What a robot was about when its trial failed.
struct CauseRecord {
  int robot = -1;            ///< that touched something, or the first that has not arrived
  std::string last_plan;     ///< outcome of its last planning call, empty when there was none
  double plan_age = 0.0;     ///< [s] since that call
  std::string stand_reason;  ///< moving, obstacle ahead, ...
  int blocking_id = -1;      ///< id of the obstacle or peer behind the reason, -1 = none

  template <class Self, class Visitor>
  static void visit_fields(Self& self, Visitor&& visit) {
    using namespace record_limits;
    visit.robot("robot", self.robot, -1);
    visit.text("last_plan", self.last_plan, 0, kLongestName);
    visit.maybe_number("plan_age", self.plan_age, kTime);
    visit.text("stand_reason", self.stand_reason, 0, kLongestName);
    visit.whole("culprit", self.blocking_id, -1, kLargestId);
  }
};

/// Of a trial among recorded people (PED): a crossing is one robot on its way through.
struct CrossingRecord {
  int crossings = 0;
  int crossings_ok = 0;        ///< in time and without a contact that counts
  int contacts_moving = 0;     ///< of all robots; not of those that had stood still for a second
  double robot_minutes = 0.0;  ///< [min] that robots spent in the scene

  template <class Self, class Visitor>
  static void visit_fields(Self& self, Visitor&& visit) {
    using namespace record_limits;
    visit.robot_count("crossings", self.crossings);
    visit.whole("crossings_ok", self.crossings_ok, 0, self.crossings);
    visit.whole("contacts_moving", self.contacts_moving, 0, kMostContacts);
    visit.number("robot_minutes", self.robot_minutes, Range{0.0, kTime.high * kMostRobots});
  }
};

struct TrialRecord {
  TrialKey key;
  std::string setup;  ///< hash over all settings of the trial but its number
  sim::TrialOutcome outcome = sim::TrialOutcome::timeout;
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

  template <class Self, class Visitor>
  static void visit_fields(Self& self, Visitor&& visit) {
    using namespace record_limits;
    visit.text("family", self.key.family, 1, kLongestName);
    visit.text("method", self.key.method, 1, kLongestName);
    visit.template name<sim::NoiseModel>("noise", self.key.noise);
    visit.number("level", self.key.level, Range{0.0, 100.0});
    visit.template name<sim::TrackingMode>("tracking", self.key.tracking);
    visit.seed("seed", self.key.seed);
    visit.whole("trial", self.key.trial, 0, 2'000'000'000);
    visit.choice("outcome", self.outcome);
    visit.text("failure", self.failure, 0, kLongestText);
    visit.object_or_null("contact", self.contact);
    visit.whole("contacts", self.contacts, 0, kMostContacts);
    visit.whole("hits_while_standing", self.hits_while_standing, 0, kMostContacts);
    visit.number("sim_time", self.sim_time, kTime);
    visit.maybe_number("dynamic_distance", self.dynamic_distance, kLength);
    visit.maybe_number("dynamic_clearance", self.dynamic_clearance, kPosition);
    visit.list("robots", self.robots, 1, kMostRobots);
    visit.digits("digest", self.digest, 1);
    visit.histogram("plan_time", self.plan_time);
    visit.histogram("control_time", self.control_time);
    visit.number("wall_time", self.wall_time, Range{0.0, 1e9});
    if (visit.present("crossings", self.crossing.has_value())) visit.part(self.crossing);
    // Only campaigns have these.
    if (visit.present("condition", !self.key.condition.empty()))
      visit.text("condition", self.key.condition, 0, kLongestName);
    if (visit.present("setup", !self.setup.empty())) visit.digits("setup", self.setup, 0);
    if (visit.present("wheel_share", std::isfinite(self.wheel_share)))
      visit.number("wheel_share", self.wheel_share, kLength);
    if (visit.present("new_plan_time", self.new_plan_time.count() > 0))
      visit.histogram("new_plan_time", self.new_plan_time);
    if (visit.present("optimiser_time", self.optimiser_time.count() > 0))
      visit.histogram("optimiser_time", self.optimiser_time);
    if (visit.present("cause", self.cause.has_value())) visit.object("cause", self.cause);
  }
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
