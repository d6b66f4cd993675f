#include "experiments/result_row.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "config/input_problem.hpp"
#include "experiments/statistics.hpp"

namespace spf {
namespace {

RobotRecord robot(bool arrived, double time, std::int64_t calls) {
  RobotRecord record;
  record.arrived = arrived;
  record.travel_time = time;
  record.path_length = 25.0 + time;
  record.travel_time_ratio = time / 26.0;
  record.path_length_ratio = 1.1;
  record.optimiser_calls = calls;
  return record;
}

using Outcome = sim::TrialOutcome;

TrialRecord trial(int number, Outcome outcome, double distance, double time) {
  TrialRecord record;
  record.key = {"t2", "space_time", "walk", 1.0, "full", 20240501, number, ""};
  record.outcome = outcome;
  record.dynamic_distance = distance;
  record.dynamic_clearance = distance - 0.7;
  record.robots = {robot(true, time, 10), robot(outcome == Outcome::success, time + 2.0, 30)};
  record.sim_time = time + 3.0;
  record.wall_time = 0.5;
  record.plan_time.add(1e-3);
  record.control_time.add(2e-6);
  record.digest = "0123456789abcdef";
  if (outcome == Outcome::collision) {
    record.contact = ContactRecord{12.5, 1, "disc", 3, {0.1, -2.0}, 0.4, 0.9};
    record.failure = "robot 1 touched disc 3";
  }
  return record;
}

std::vector<TrialRecord> some_trials() {
  return {trial(0, Outcome::success, 1.0, 30.0), trial(1, Outcome::collision, 0.6, 12.0),
          trial(2, Outcome::success, 1.4, 32.0), trial(3, Outcome::overtime, 0.9, 120.0)};
}

TEST(ResultRow, CondensesTrials) {
  const ResultRow row = result_row(some_trials());
  EXPECT_EQ(row.family, "t2");
  EXPECT_EQ(row.trials, 4);
  EXPECT_EQ(row.success, 2);
  EXPECT_EQ(row.overtime, 1);
  EXPECT_EQ(row.collision, 1);
  EXPECT_EQ(row.success_rate, 0.5);
  EXPECT_EQ(row.wilson_low, wilson_interval(2, 4).low);
  // Over successful trials: times 30, 32, 32, 34; distances 1.0, 1.4.
  EXPECT_NEAR(row.travel_time_mean, 32.0, 1e-12);
  EXPECT_NEAR(row.travel_time_ratio, 32.0 / 26.0, 1e-12);
  EXPECT_NEAR(row.path_length_mean, 57.0, 1e-12);
  EXPECT_NEAR(row.dynamic_distance_mean, 1.2, 1e-12);
  EXPECT_NEAR(row.dynamic_distance_min, 1.0, 1e-12);
  EXPECT_NEAR(row.dynamic_distance_std, std::sqrt(0.08), 1e-12);
  EXPECT_NEAR(row.dynamic_clearance_min, 0.3, 1e-12);
  // Over all.
  EXPECT_EQ(row.optimiser_calls_per_robot, 20.0);
  EXPECT_EQ(row.arrived_robots, 6);
  EXPECT_EQ(row.robots, 8);
  EXPECT_NEAR(row.plan_ms_max, 1.0, 1e-12);
  EXPECT_NEAR(row.control_us_median, 2.0, 1e-12);
  EXPECT_NEAR(row.wall_seconds, 2.0, 1e-12);
}

TEST(ResultRow, HasExactlyTheNamesOfTheContract) {
  const std::vector<std::string> contract{"family",
                                          "method",
                                          "noise",
                                          "level",
                                          "tracking",
                                          "seed",
                                          "trials",
                                          "success",
                                          "overtime",
                                          "collision",
                                          "success_rate",
                                          "wilson_low",
                                          "wilson_high",
                                          "path_length_mean",
                                          "travel_time_mean",
                                          "path_length_ratio",
                                          "travel_time_ratio",
                                          "dynamic_distance_mean",
                                          "dynamic_distance_min",
                                          "dynamic_distance_std",
                                          "dynamic_clearance_min",
                                          "optimiser_calls_per_robot",
                                          "plan_ms_median",
                                          "plan_ms_p99",
                                          "plan_ms_max",
                                          "control_us_median",
                                          "control_us_p99",
                                          "arrived_robots",
                                          "robots",
                                          "sim_seconds",
                                          "wall_seconds"};
  const nlohmann::ordered_json json = nlohmann::ordered_json::parse(to_json_line(result_row(some_trials())));
  std::vector<std::string> names;
  for (const auto& item : json.items()) names.push_back(item.key());
  EXPECT_EQ(names, contract);
  std::string header;
  for (const std::string& name : contract) header += (header.empty() ? "" : ",") + name;
  const std::string of_ped = ",crossings,crossings_ok,contacts_moving,hits_while_standing,robot_minutes";
  EXPECT_EQ(csv_header(), header + of_ped + "\n");
}

TEST(ResultRow, WritesUnknownNumbersAsNullAndEmpty) {
  const ResultRow row = result_row({trial(0, Outcome::collision, 0.5, 3.0)});
  const nlohmann::json json = nlohmann::json::parse(to_json_line(row));
  EXPECT_TRUE(json.at("travel_time_mean").is_null());
  EXPECT_TRUE(json.at("dynamic_distance_std").is_null());
  EXPECT_EQ(json.at("success_rate"), 0.0);
  EXPECT_NE(to_csv_line(row).find(",,"), std::string::npos);
  std::istringstream header{csv_header()}, line{to_csv_line(row)};
  EXPECT_EQ(std::count(std::istreambuf_iterator<char>{header}, {}, ','),
            std::count(std::istreambuf_iterator<char>{line}, {}, ','));
}

TEST(PairedRow, CountsTrialsThatBothRan) {
  std::vector<TrialRecord> b = some_trials();
  for (TrialRecord& record : b) record.key.method = "es2";
  b[0].outcome = Outcome::collision;                   // only a
  b[1].outcome = Outcome::success;                     // only b
  b.push_back(trial(9, Outcome::success, 1.0, 30.0));  // not in a
  const nlohmann::json json = nlohmann::json::parse(to_json_line(paired_row(some_trials(), b)));
  EXPECT_EQ(json.at("paired"), true);
  EXPECT_EQ(json.at("trials"), 4);
  EXPECT_EQ(json.at("both"), 1);
  EXPECT_EQ(json.at("only_a"), 1);
  EXPECT_EQ(json.at("only_b"), 1);
  EXPECT_EQ(json.at("neither"), 1);
  EXPECT_EQ(json.at("mcnemar_p"), 1.0);
  EXPECT_EQ(json.at("method_a"), "space_time");
  EXPECT_EQ(json.at("method_b"), "es2");
}

TEST(TrialRecord, SurvivesItsFile) {
  for (const TrialRecord& record : some_trials()) {
    const std::string line = to_json_line(record);
    EXPECT_EQ(line.find('\n'), std::string::npos);
    const TrialRecord read = trial_record_from_json(line, "trials.jsonl", 1);
    EXPECT_EQ(to_json_line(read), line);
    EXPECT_EQ(read.robots.size(), 2u);
    EXPECT_EQ(read.plan_time.count(), 1);
    EXPECT_EQ(read.contact.has_value(), record.contact.has_value());
  }
}

TEST(TrialRecord, NamesTheLineThatIsBroken) {
  const std::string whole = to_json_line(some_trials()[1]);
  for (const std::string& text :
       {std::string{}, std::string{"{}"}, std::string{"[1]"}, whole.substr(0, 100)}) {
    try {
      static_cast<void>(trial_record_from_json(text, "trials.jsonl", 7));
      ADD_FAILURE() << text;
    } catch (const InputError& error) {
      EXPECT_EQ(std::string{error.what()}.rfind("trials.jsonl:7: ", 0), 0u) << error.what();
    }
  }
}

}  // namespace
}  // namespace spf
