#include "apps/run_summary.hpp"

#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <nlohmann/json.hpp>

#include "apps/version.hpp"
#include "config/parameter_text.hpp"
#include "experiments/statistics.hpp"
#include "parallel/worker_pool.hpp"
#include "report/table.hpp"

namespace spf {
namespace {

std::string percent(double share) {
  return fixed(100.0 * share, 1) + " %";
}

std::string trials_text(const std::vector<TrialRecord>& trials) {
  if (trials.size() == 1) return "number " + std::to_string(trials.front().key.trial);
  return std::to_string(trials.size()) + " (" + std::to_string(trials.front().key.trial) + " to " +
         std::to_string(trials.back().key.trial) + ")";
}

std::string success_text(const ResultRow& row) {
  return std::to_string(row.success) + " of " + std::to_string(row.trials) + " = " +
         percent(row.success_rate) + ", 95 % interval [" + fixed(100.0 * row.wilson_low, 1) + ", " +
         fixed(100.0 * row.wilson_high, 1) + "]";
}

std::string crossings_text(const ResultRow& row) {
  const Interval interval = wilson_interval(row.crossings_ok, row.crossings);
  return std::to_string(row.crossings_ok) + " of " + std::to_string(row.crossings) + " = " +
         percent(static_cast<double>(row.crossings_ok) / row.crossings) + ", 95 % interval [" +
         fixed(100.0 * interval.low, 1) + ", " + fixed(100.0 * interval.high, 1) + "]";
}

std::string rate_text(int count, const ResultRow& row) {
  return std::to_string(count) + " in " + fixed(row.robot_minutes, 1) + " robot-minutes, " +
         fixed(count / std::max(row.robot_minutes, 1e-9), 3) + " a minute";
}

std::string failures_text(const std::vector<TrialRecord>& trials) {
  constexpr std::size_t kMost = 20;
  Table table{{{"trial"}, {"outcome", Alignment::left}, {"why", Alignment::left}}};
  std::size_t failed = 0;
  for (const TrialRecord& trial : trials) {
    if (trial.succeeded() || ++failed > kMost) continue;
    table.add_row({std::to_string(trial.key.trial), enum_name(trial.outcome), trial.failure});
  }
  if (failed == 0) return "";
  std::string text = "\n" + table.to_text();
  if (failed > kMost) text += "(and " + std::to_string(failed - kMost) + " more)\n";
  return text;
}

}  // namespace

std::string today() {
  const std::time_t now = std::time(nullptr);
  std::tm utc{};
  gmtime_r(&now, &utc);
  char text[32];
  return {text, std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &utc)};
}

double peak_memory() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return 1024.0 * static_cast<double>(usage.ru_maxrss);
}

std::string summary_text(const RunConfiguration& config, const std::vector<TrialRecord>& trials,
                         double memory) {
  const ResultRow row = result_row(trials);
  Table table{{{"measure", Alignment::left}, {"value", Alignment::left}}};
  const auto add = [&table](const char* name, const std::string& value) { table.add_row({name, value}); };
  const bool single = trials.size() == 1;
  add("family", row.family);
  add("method", row.method);
  add("moving obstacles", row.noise + " noise at " + to_text(row.level) + " Sigma");
  add("tracking", row.tracking);
  add("seed", std::to_string(config.seed));
  add(single ? "trial" : "trials", trials_text(trials));
  if (single)
    add("outcome", enum_name(trials.front().outcome));
  else
    add("success", success_text(row));
  if (!single)
    add("timeout | collision", std::to_string(row.timeout) + " | " + std::to_string(row.collision));
  if (row.crossings > 0) {
    add("crossings", crossings_text(row));
    add("contacts while moving", rate_text(row.contacts_moving, row));
    add("hits while standing", rate_text(row.hits_while_standing, row));
  }
  add("robots at goal", std::to_string(row.arrived_robots) + " of " + std::to_string(row.robots));
  if (row.robot_hours > 0.0) {
    add("goals reached",
        std::to_string(row.goals_reached) + ", " + fixed(row.goals_per_robot_hour, 1) + " a robot-hour");
    add("longest stand", fixed(row.longest_stand, 1) + " s, of robots with a goal that were not told to");
  }
  add("travel time", fixed(row.travel_time_mean, 2) + " s, " + fixed(row.travel_time_ratio, 3) +
                         " times the obstacle-free optimum");
  add("path length",
      fixed(row.path_length_mean, 2) + " m, " + fixed(row.path_length_ratio, 3) + " times the straight line");
  if (single)
    add("nearest moving obstacle", fixed(trials.front().dynamic_distance, 2) + " m, clearance " +
                                       fixed(trials.front().dynamic_clearance, 2) + " m");
  else
    add("dynamic distance", "mean " + fixed(row.dynamic_distance_mean, 2) + " m, min " +
                                fixed(row.dynamic_distance_min, 2) + " m, std " +
                                fixed(row.dynamic_distance_std, 2) + " m; least clearance " +
                                fixed(row.dynamic_clearance_min, 2) + " m");
  add("optimiser calls per robot", fixed(row.optimiser_calls_per_robot, 2));
  add("planning call", "median " + fixed(row.plan_ms_median, 3) + " ms, p99 " + fixed(row.plan_ms_p99, 3) +
                           " ms, max " + fixed(row.plan_ms_max, 3) + " ms");
  add("control tick",
      "median " + fixed(row.control_us_median, 1) + " us, p99 " + fixed(row.control_us_p99, 1) + " us");
  add("simulated", fixed(row.sim_seconds, 1) + " s in " + fixed(row.wall_seconds, 2) + " s of computing");
  const std::string megabytes = fixed(1e-6 * memory, 0) + " MB";
  if (single && row.robots > 0)
    add("memory",
        megabytes + ", " + fixed(1e-3 * memory / row.robots, 0) + " kB a robot with its share of the map");
  else
    add("memory", megabytes);
  return table.to_text() + failures_text(trials);
}

std::string run_json(const RunConfiguration& config, const RunFacts& facts) {
  const nlohmann::ordered_json json{{"program", "spf"},
                                    {"version", version()},
                                    {"commit", kCommit},
                                    {"compiler", compiler()},
                                    {"date", today()},
                                    {"command", facts.command},
                                    {"family", enum_name(config.family)},
                                    {"method", config.method.name()},
                                    {"seed", config.seed},
                                    {"first", facts.first},
                                    {"trials", facts.trials},
                                    {"finished", facts.finished},
                                    {"jobs", facts.jobs},
                                    {"processors", processor_count()},
                                    {"wall_seconds", facts.wall_time},
                                    {"peak_memory_mb", 1e-6 * facts.peak_memory}};
  return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

std::string resolved_scenario(const RunConfiguration& config) {
  return "# Every key of the scenario as it was run, by spf " + std::string{version()} + " (commit " +
         kCommit + ").\n" + to_yaml_text(config);
}

}  // namespace spf
