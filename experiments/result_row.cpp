#include "experiments/result_row.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <numeric>

#include "config/parameter_text.hpp"
#include "experiments/statistics.hpp"

namespace spf {
namespace {

using Json = nlohmann::ordered_json;

/// Path lengths and times of robots in successful trials.
struct Travel {
  std::vector<double> lengths, times, length_ratios, time_ratios;

  void add(const RobotRecord& robot) {
    lengths.push_back(robot.path_length);
    times.push_back(robot.travel_time);
    if (std::isfinite(robot.path_length_ratio)) length_ratios.push_back(robot.path_length_ratio);
    if (std::isfinite(robot.travel_time_ratio)) time_ratios.push_back(robot.travel_time_ratio);
  }
};

void count_outcome(ResultRow& row, sim::TrialOutcome outcome) {
  ++row.trials;
  switch (outcome) {
    case sim::TrialOutcome::success:
      ++row.success;
      return;
    case sim::TrialOutcome::timeout:
      ++row.timeout;
      return;
    case sim::TrialOutcome::collision:
      ++row.collision;
      return;
  }
}

double calls_per_robot(const TrialRecord& trial) {
  double calls = 0.0;
  for (const RobotRecord& robot : trial.robots) calls += static_cast<double>(robot.optimiser_calls);
  return trial.robots.empty() ? 0.0 : calls / static_cast<double>(trial.robots.size());
}

void fill_successes(ResultRow& row, const std::vector<TrialRecord>& trials) {
  Travel travel;
  std::vector<double> distances, clearances;
  for (const TrialRecord& trial : trials) {
    if (!trial.succeeded()) continue;
    for (const RobotRecord& robot : trial.robots) travel.add(robot);
    if (std::isfinite(trial.dynamic_distance)) distances.push_back(trial.dynamic_distance);
    if (std::isfinite(trial.dynamic_clearance)) clearances.push_back(trial.dynamic_clearance);
  }
  row.path_length_mean = mean(travel.lengths);
  row.travel_time_mean = mean(travel.times);
  row.path_length_ratio = mean(travel.length_ratios);
  row.travel_time_ratio = mean(travel.time_ratios);
  row.dynamic_distance_mean = mean(distances);
  row.dynamic_distance_min = minimum(distances);
  row.dynamic_distance_std = standard_deviation(distances);
  row.dynamic_clearance_min = minimum(clearances);
}

/// Saturates at the largest int, whatever numbers files contain.
void add_up(int& sum, int more) {
  sum += std::min(more, std::numeric_limits<int>::max() - sum);
}

void add_crossing(ResultRow& row, const TrialRecord& trial) {
  if (!trial.crossing) return;
  row.crossings += trial.crossing->crossings;
  row.crossings_ok += trial.crossing->crossings_ok;
  add_up(row.contacts_moving, trial.crossing->contacts_moving);
  add_up(row.hits_while_standing, trial.hits_while_standing);
  row.robot_minutes += trial.crossing->robot_minutes;
}

void add_fleet(ResultRow& row, const TrialRecord& trial) {
  for (const RobotRecord& robot : trial.robots) {
    if (!robot.fleet) continue;
    row.goals_reached += robot.fleet->goals_reached;
    row.robot_hours += robot.fleet->present_time / 3600.0;
    row.longest_stand = std::max(row.longest_stand, robot.fleet->longest_stand);
  }
  if (row.robot_hours > 0.0)
    row.goals_per_robot_hour = static_cast<double>(row.goals_reached) / row.robot_hours;
}

class CsvWriter {
 public:
  void operator()(const char*, const std::string& value) { cell(value); }
  void operator()(const char*, double value) { cell(std::isfinite(value) ? to_text(value) : ""); }
  void operator()(const char*, int value) { cell(to_text(value)); }
  void operator()(const char*, std::uint64_t value) { cell(to_text(value)); }
  void cell(const std::string& text) { line_ += (std::exchange(first_, false) ? "" : ",") + text; }
  [[nodiscard]] std::string take() { return line_ + "\n"; }

 private:
  std::string line_;
  bool first_ = true;
};

}  // namespace

ResultRow result_row(const std::vector<TrialRecord>& trials) {
  assert(!trials.empty());
  ResultRow row;
  const TrialKey& key = trials.front().key;
  row.family = key.family;
  row.method = key.method;
  row.noise = key.noise;
  row.level = key.level;
  row.tracking = key.tracking;
  row.seed = key.seed;
  row.condition = key.condition;
  DurationHistogram plan_time, control_time;
  std::vector<double> calls;
  for (const TrialRecord& trial : trials) {
    count_outcome(row, trial.outcome);
    calls.push_back(calls_per_robot(trial));
    for (const RobotRecord& robot : trial.robots) row.arrived_robots += robot.arrived ? 1 : 0;
    row.robots += static_cast<int>(trial.robots.size());
    add_crossing(row, trial);
    add_fleet(row, trial);
    row.sim_seconds += trial.sim_time;
    row.wall_seconds += trial.wall_time;
    plan_time.merge(trial.plan_time);
    control_time.merge(trial.control_time);
  }
  const Interval interval = wilson_interval(row.success, row.trials);
  row.success_rate = static_cast<double>(row.success) / row.trials;
  row.wilson_low = interval.low;
  row.wilson_high = interval.high;
  fill_successes(row, trials);
  row.optimiser_calls_per_robot = mean(calls);
  row.plan_ms_median = 1e3 * plan_time.percentile(0.5);
  row.plan_ms_p99 = 1e3 * plan_time.percentile(0.99);
  row.plan_ms_max = 1e3 * plan_time.maximum();
  row.control_us_median = 1e6 * control_time.percentile(0.5);
  row.control_us_p99 = 1e6 * control_time.percentile(0.99);
  return row;
}

std::string to_json_line(const ResultRow& row) {
  Json json = Json::object();
  ResultRow::visit_fields(row, [&json](const char* name, const auto& value) { json[name] = value; });
  if (row.crossings > 0)
    ResultRow::visit_crossing_fields(row,
                                     [&json](const char* name, const auto& value) { json[name] = value; });
  if (row.robot_hours > 0.0)
    ResultRow::visit_fleet_fields(row, [&json](const char* name, const auto& value) { json[name] = value; });
  if (!row.condition.empty()) json["condition"] = row.condition;
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);  // NaN is written as null
}

std::string csv_header() {
  CsvWriter writer;
  const ResultRow row;
  const auto name_cell = [&writer](const char* name, const auto&) { writer.cell(name); };
  ResultRow::visit_fields(row, name_cell);
  ResultRow::visit_crossing_fields(row, name_cell);
  return writer.take();
}

std::string to_csv_line(const ResultRow& row) {
  CsvWriter writer;
  ResultRow::visit_fields(row, writer);
  if (row.crossings > 0)
    ResultRow::visit_crossing_fields(row, writer);
  else
    ResultRow::visit_crossing_fields(row, [&writer](const char*, const auto&) { writer.cell(""); });
  return writer.take();
}

PairedRow paired_row(const std::vector<TrialRecord>& a, const std::vector<TrialRecord>& b) {
  assert(!a.empty() && !b.empty());
  std::map<int, bool> successes_of_a;
  for (const TrialRecord& trial : a) successes_of_a[trial.key.trial] = trial.succeeded();
  PairedRow row;
  const TrialKey& key = a.front().key;
  row.family = key.family;
  row.noise = key.noise;
  row.tracking = key.tracking;
  row.level = key.level;
  row.seed = key.seed;
  row.condition = key.condition;
  row.method_a = key.method;
  row.method_b = b.front().key.method;
  for (const TrialRecord& trial : b) {
    const auto found = successes_of_a.find(trial.key.trial);
    if (found == successes_of_a.end()) continue;
    const bool success_of_b = trial.succeeded();
    ++row.trials;
    ++(found->second ? (success_of_b ? row.both : row.only_a) : (success_of_b ? row.only_b : row.neither));
  }
  row.mcnemar_p = mcnemar_exact(row.only_a, row.only_b);
  return row;
}

std::string to_json_line(const PairedRow& row) {
  Json json{{"paired", true},         {"family", row.family},      {"noise", row.noise},
            {"level", row.level},     {"tracking", row.tracking},  {"seed", row.seed},
            {"trials", row.trials},   {"method_a", row.method_a},  {"method_b", row.method_b},
            {"both", row.both},       {"only_a", row.only_a},      {"only_b", row.only_b},
            {"neither", row.neither}, {"mcnemar_p", row.mcnemar_p}};
  if (!row.condition.empty()) json["condition"] = row.condition;
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace spf
