#include "experiments/result_row.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
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
          trial(2, Outcome::success, 1.4, 32.0), trial(3, Outcome::timeout, 0.9, 120.0)};
}

TEST(ResultRow, CondensesTrials) {
  const ResultRow row = result_row(some_trials());
  EXPECT_EQ(row.family, "t2");
  EXPECT_EQ(row.trials, 4);
  EXPECT_EQ(row.success, 2);
  EXPECT_EQ(row.timeout, 1);
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

TEST(TrialRecord, TellsOfAFleetThatLives) {
  TrialRecord record = trial(0, Outcome::success, 1.0, 30.0);
  record.robots[0].fleet = FleetRecord{40, 1800.0, 7.5, false};
  record.robots[1].fleet = FleetRecord{2, 360.0, 9.5, true};
  const TrialRecord read = trial_record_from_json(to_json_line(record), "file", 1);
  EXPECT_TRUE(same_result(record, read));
  ASSERT_TRUE(read.robots[1].fleet);
  EXPECT_EQ(read.robots[0].fleet->goals_reached, 40);
  EXPECT_TRUE(read.robots[1].fleet->excused);
  const ResultRow row = result_row({read});
  EXPECT_EQ(row.goals_reached, 42);
  EXPECT_NEAR(row.goals_per_robot_hour, 42 / 0.6, 1e-9);
  EXPECT_EQ(row.longest_stand, 9.5);
  EXPECT_NE(to_json_line(row).find("\"goals_per_robot_hour\""), std::string::npos);
  EXPECT_EQ(to_json_line(result_row(some_trials())).find("goals"), std::string::npos);
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

/// A change of a good line, by a JSON pointer, and how the refusal begins.
struct BadField {
  const char* at;
  const char* value;
  const char* expected;
};

TEST(TrialRecord, ChecksEveryField) {
  nlohmann::json good = nlohmann::json::parse(to_json_line(some_trials()[1]));
  good["crossings"] = 2;
  good["crossings_ok"] = 1;
  good["contacts_moving"] = 0;
  good["robot_minutes"] = 0.5;
  good["cause"] = {
      {"robot", 1}, {"last_plan", "unsafe"}, {"plan_age", 0.1}, {"stand_reason", ""}, {"culprit", -1}};
  ASSERT_NO_THROW(static_cast<void>(trial_record_from_json(good.dump(), "t", 1)));
  const BadField table[]{
      {"/family", "\"\"", "family = \"\" must be text"},
      {"/method", "7", "method = 7 must be text"},
      {"/noise", "\"pink\"", "noise = \"pink\" must be one of white, walk"},
      {"/level", "-1", "level = -1 must be a number in [0, 100]"},
      {"/level", "null", "level = null must be"},
      {"/tracking", "\"half\"", "tracking = \"half\" must be one of ideal, full"},
      {"/seed", "-3", "seed = -3 must be a whole number"},
      {"/seed", "1.5", "seed = 1.5 must be a whole number"},
      {"/trial", "-5", "trial = -5 must be a whole number in [0, 2000000000]"},
      {"/trial", "1e300", "trial = 1e+300 must be a whole number"},
      {"/trial", "18446744073709551615", "trial = 18446744073709551615 must be"},
      {"/outcome", "\"banana\"", "outcome = \"banana\" must be one of success, collision, overtime"},
      {"/robots", "[]", "robots = [...] must be a list of 1 to 10000 values"},
      {"/robots", "3", "robots = 3 must be a list"},
      {"/robots/1/arrived", "1", "robots[1].arrived = 1 must be true or false"},
      {"/robots/0/path_length", "-1", "robots[0].path_length = -1 must be"},
      {"/robots/0/travel_time", "1e9", "robots[0].travel_time = 1000000000.0 must be"},
      {"/robots/0/travel_time_ratio", "\"x\"", "robots[0].travel_time_ratio = \"x\" must be"},
      {"/robots/0/path_length_ratio", "-0.5", "robots[0].path_length_ratio = -0.5 must be"},
      {"/robots/0/plans", "-1", "robots[0].plans = -1 must be"},
      {"/robots/0/failed_plans", "1.5", "robots[0].failed_plans = 1.5 must be"},
      {"/robots/0/optimiser_calls", "1000000000001", "robots[0].optimiser_calls = 1000000000001 must be"},
      {"/robots/0/inner_iterations", "null", "robots[0].inner_iterations = null must be"},
      {"/failure", "null", "failure = null must be text"},
      {"/contact", "3", "contact = 3 must be an object"},
      {"/contact/time", "-1", "contact.time = -1 must be"},
      {"/contact/robot", "2", "contact.robot = 2 must be a whole number in [0, 1]"},
      {"/contact/with", "\"ghost\"", "contact.with = \"ghost\" must be one of disc"},
      {"/contact/other", "-2", "contact.other = -2 must be"},
      {"/contact/x", "1e300", "contact.x = 1e+300 must be"},
      {"/contact/y", "null", "contact.y = null must be"},
      {"/contact/robot_speed", "-1", "contact.robot_speed = -1 must be"},
      {"/contact/other_speed", "-1", "contact.other_speed = -1 must be"},
      {"/contacts", "-1", "contacts = -1 must be"},
      {"/hits_while_standing", "9999999", "hits_while_standing = 9999999 must be"},
      {"/sim_time", "null", "sim_time = null must be"},
      {"/dynamic_distance", "-0.1", "dynamic_distance = -0.1 must be"},
      {"/dynamic_clearance", "1e300", "dynamic_clearance = 1e+300 must be"},
      {"/digest", "\"xyz\"", "digest = \"xyz\" must be hexadecimal"},
      {"/wall_time", "-1", "wall_time = -1 must be"},
      {"/plan_time/min", "-1", "plan_time.min = -1 must be"},
      {"/plan_time/max", "0", "plan_time.max = 0 must be"},
      {"/plan_time/buckets", "{}", "plan_time.buckets = {...} must be a list"},
      {"/plan_time/buckets/0", "[1]", "plan_time.buckets[0] = [...] must be a list of 2 to 2"},
      {"/plan_time/buckets/0", "[-1, 1]", "plan_time.buckets[0][0] = -1 must be"},
      {"/control_time/buckets/0", "[1, 0]", "control_time.buckets[0][1] = 0 must be"},
      {"/control_time/buckets", "[[1, 600000000000], [2, 600000000000]]",
       "control_time.buckets[1][1] = 600000000000"},
      {"/crossings", "3", "crossings = 3 must be a whole number in [0, 2]"},
      {"/crossings_ok", "3", "crossings_ok = 3 must be a whole number in [0, 2]"},
      {"/contacts_moving", "-1", "contacts_moving = -1 must be"},
      {"/robot_minutes", "-1", "robot_minutes = -1 must be"},
      {"/cause/robot", "5", "cause.robot = 5 must be"},
      {"/cause/last_plan", "3", "cause.last_plan = 3 must be text"},
      {"/cause/plan_age", "-1", "cause.plan_age = -1 must be"},
      {"/cause/stand_reason", "null", "cause.stand_reason = null must be text"},
      {"/cause/culprit", "-7", "cause.culprit = -7 must be"},
      {"/setup", "\"no hash\"", "setup = \"no hash\" must be hexadecimal"},
      {"/wheel_share", "-1", "wheel_share = -1 must be"},
      {"/condition", "[]", "condition = [...] must be text"}};
  for (const BadField& bad : table) {
    nlohmann::json json = good;
    json[nlohmann::json::json_pointer{bad.at}] = nlohmann::json::parse(bad.value);
    EXPECT_THAT([&] { static_cast<void>(trial_record_from_json(json.dump(), "t", 4)); },
                testing::ThrowsMessage<InputError>(
                    testing::HasSubstr(std::string{"t:4: is no line of trial results: "} + bad.expected)))
        << bad.at;
  }
  for (const auto& item : good.items()) {
    nlohmann::json json = good;
    json.erase(item.key());
    const bool optional = item.key() == "cause" || item.key() == "crossings";
    if (optional) continue;
    EXPECT_THAT([&] { static_cast<void>(trial_record_from_json(json.dump(), "t", 4)); },
                testing::ThrowsMessage<InputError>(testing::HasSubstr(item.key() + " is missing")));
  }
  const std::string deep = "{\"family\":" + std::string(100000, '[');
  EXPECT_THAT([&] { static_cast<void>(trial_record_from_json(deep, "t", 4)); },
              testing::ThrowsMessage<InputError>(testing::HasSubstr("nested deeper than 6 levels")));
}

TEST(TrialRecord, TellsTheSameUnlessMoreThanTimingsDiffer) {
  const TrialRecord record = some_trials()[1];
  TrialRecord other = record;
  other.wall_time = 7.0;
  other.plan_time.add(3.0);
  EXPECT_TRUE(same_result(record, other));
  other.robots[1].plans = 9;
  EXPECT_FALSE(same_result(record, other));
}

TEST(ResultRow, CountsNoFurtherThanAnIntHolds) {
  TrialRecord record = trial(0, sim::TrialOutcome::success, 1.0, 30.0);
  record.hits_while_standing = 100'000;
  record.crossing = CrossingRecord{2, 2, 100'000, 1.0};
  const ResultRow row = result_row(std::vector<TrialRecord>(30'000, record));
  EXPECT_EQ(row.contacts_moving, std::numeric_limits<int>::max());
  EXPECT_EQ(row.hits_while_standing, std::numeric_limits<int>::max());
}

}  // namespace
}  // namespace spf
