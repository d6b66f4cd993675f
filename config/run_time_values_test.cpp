#include "config/run_time_values.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <stdexcept>

#include "config/parameter_table.hpp"

namespace spf {
namespace {

std::string problem_with(const RobotFile& file, const std::map<std::string, RunTimeValue>& values) {
  try {
    static_cast<void>(with_run_time_values(file, values));
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(RunTimeValues, AreKeysOfTheFileWithItsRangesUnitsAndWords) {
  const RobotFile file = read_robot_file("");
  const std::vector<RunTimeField> fields = run_time_fields(file);
  ASSERT_EQ(fields.size(), run_time_keys().size());
  const std::vector<ParameterRow> rows = parameter_rows(file);
  for (const RunTimeField& field : fields) {
    const auto row = std::find_if(rows.begin(), rows.end(),
                                  [&](const ParameterRow& candidate) { return candidate.key == field.key; });
    ASSERT_NE(row, rows.end()) << field.key;
    EXPECT_EQ(field.what, row->what);
    EXPECT_EQ(field.unit, row->unit);
    if (!field.choices.empty()) {
      EXPECT_EQ(std::get<std::string>(field.value), row->value);
      continue;
    }
    EXPECT_EQ(to_text(std::get<double>(field.value)), row->value);
    const bool slower = field.name == "speed_limit";  // than the file says at most
    EXPECT_EQ(to_text(field.range), slower ? "[0.01, 1]" : row->range);
  }
}

TEST(RunTimeValues, ChangeWhatTheyAreNamedForAndNothingElse) {
  const RobotFile file = read_robot_file("");
  const RobotFile changed =
      with_run_time_values(file, {{"speed_limit", 0.4}, {"heading_mode", std::string{"motion"}}});
  RobotFile expected = file;
  expected.robot.max_speed = 0.4;
  expected.agent.planner.horizon *= 0.4;  // as far in time (slowed_to)
  expected.agent.heading_mode = HeadingMode::motion;
  EXPECT_EQ(to_yaml_text(changed), to_yaml_text(expected));
  EXPECT_EQ(to_yaml_text(with_run_time_values(file, {})), to_yaml_text(file));
}

TEST(RunTimeValues, TheLimitOfSpeedIsNeverAboveTheFiles) {
  RobotFile file = read_robot_file("");
  file.robot.max_speed = 0.6;
  EXPECT_EQ(with_run_time_values(file, {{"speed_limit", 0.6}}).robot.max_speed, 0.6);
  EXPECT_EQ(problem_with(file, {{"speed_limit", 0.7}}), "speed_limit = 0.7 must lie in [0.01, 0.6] m/s");
}

TEST(RunTimeValues, AreRefusedWithEveryProblem) {
  const RobotFile file = read_robot_file("");
  EXPECT_EQ(
      problem_with(file, {{"goal_tolerance", -1.0}, {"heading_mode", std::string{"sideways"}}}),
      "heading_mode = sideways must be one of look, keep, goal, motion; goal_tolerance = -1 must lie in "
      "[0.001, 1] m");
  EXPECT_EQ(problem_with(file, {{"radius", 0.1}}), "radius cannot be changed at run time");
  EXPECT_EQ(problem_with(file, {{"goal_patience", std::string{"long"}}}),
            "goal_patience = long is no number");
  EXPECT_EQ(problem_with(file, {{"heading_mode", 1.0}}),
            "heading_mode = 1 must be one of look, keep, goal, motion");
  EXPECT_NE(problem_with(file, {{"speed_limit", std::numeric_limits<double>::quiet_NaN()}}), "");
}

}  // namespace
}  // namespace spf
