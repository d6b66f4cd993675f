#include "config/robot_file.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "config/contradiction_report.hpp"
#include "config/parameter_table.hpp"
#include "spf/testing/source_dir.hpp"

namespace spf {
namespace {

std::string problems(const std::string& text) {
  try {
    static_cast<void>(robot_file_from_text(text, "robot.yaml"));
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(RobotFile, ReadsWhatConcernsOneRobot) {
  const RobotFile file = robot_file_from_text(
      "method: spf_empc\nrobot: {radius: 0.25}\nagent: {team: {stale_time: 0.2}}\nhost: {relies_on_scan: "
      "false}\n",
      "robot.yaml");
  EXPECT_EQ(file.method.name(), "spf_empc");
  EXPECT_EQ(file.host.relies_on_scan, false);
  EXPECT_EQ(file.host.relies_on_obstacles, true);
  const AgentParameters agent = agent_parameters(file);
  EXPECT_EQ(agent.robot.radius, 0.25);
  EXPECT_EQ(agent.team.stale_time, 0.2);
  EXPECT_EQ(agent.tracker.observer.kind, ObserverKind::eso);
  EXPECT_EQ(typeid(*agent.make_planner(agent)), typeid(*MethodTable{}.at("spf_empc").make_planner(agent)));
}

TEST(RobotFile, PerceptionTellsOfEverythingWhereNobodyElseDoes) {
  const auto perception = [](const std::string& host) {
    const std::string text = "agent: {perception: {enabled: true}}\n" + host;
    return agent_parameters(robot_file_from_text(text, "robot.yaml")).perception;
  };
  const PerceptionParameters alone = perception("host: {relies_on_obstacles: false}\n");
  EXPECT_TRUE(alone.enabled);
  EXPECT_TRUE(alone.map_scans);
  EXPECT_FALSE(alone.moving_alone);
  EXPECT_TRUE(perception("").moving_alone);
}

TEST(RobotFile, RefusesWithTheMessagesOfTheProgram) {
  EXPECT_EQ(problems("robot: {radus: 1}\n"),
            "robot.yaml:1:9: robot.radus = 1 is not a known key; did you mean robot.radius?");
  EXPECT_EQ(problems("host: {plan_silence: 0}\n"),
            "robot.yaml:1:22: host.plan_silence = 0 must lie in [0.05, 10] s");
  EXPECT_NE(problems("robots: 5\n"), "");
  EXPECT_NE(problems("agent: {ideal_tracking: true}\n"), "");
  EXPECT_NE(problems("- 1\n"), "");
}

TEST(RobotFile, ReadsTheOutlineAndSettlesItsRadius) {
  const RobotFile file = robot_file_from_text("robot: {length: 0.8, width: 0.6}\n", "robot.yaml");
  EXPECT_NEAR(file.robot.radius, 0.5, 1e-12);
  EXPECT_NEAR(file.agent.robot.radius, 0.5, 1e-12);
  EXPECT_NEAR(robot_file_from_text(to_yaml_text(file), "again.yaml").robot.radius, 0.5, 1e-12);
  const RobotFile corners = robot_file_from_text(
      "robot: {footprint: [[0.4, 0.3], [-0.4, 0.3], [-0.4, -0.3], [0.4, -0.3]]}\n", "r.yaml");
  EXPECT_NEAR(corners.robot.radius, 0.5, 1e-12);
  EXPECT_EQ(
      problems("robot: {length: 0.8, width: 0.6, radius: 0.3}\n"),
      "robot.yaml:1:42: robot.radius = 0.3 must be left out, or be 0.5 m: so far are the robot's corners "
      "from its centre");
  EXPECT_EQ(problems("robot: {length: 0.8}\n"),
            "robot.yaml:1:17: robot.width = 0 [m] must be above 0 where length is");
  EXPECT_EQ(problems("robot: {footprint: [[1, 0], [0, 1]]}\n"),
            "robot.yaml:1:20: robot.footprint has 2 corners; it needs 3 to 16");
}

TEST(RobotFile, RefusesSettingsThatContradictEachOther) {
  EXPECT_EQ(problems("agent:\n  team: {plan_period: 0.6}\n"),
            "robot.yaml:2:23: agent.team.plan_period = 0.6 s is longer than host.plan_silence = 0.5 s: the "
            "controller would brake between any two plans");
  // Where the one that is written stands, if only one is.
  EXPECT_EQ(problems("host:\n  plan_silence: 0.05\n"),
            "robot.yaml:2:17: agent.team.plan_period = 0.1 s is longer than host.plan_silence = 0.05 s: the "
            "controller would brake between any two plans");
}

TEST(RobotFile, WarnsOfSettingsThatMayBeMeant) {
  const RobotFile file = robot_file_from_text("robot:\n  max_speed: 2\n", "robot.yaml");
  ASSERT_EQ(file.warnings.size(), 1u);
  EXPECT_EQ(warning_text(file.warnings.front()),
            "robot.yaml:2:14: warning: robot.max_speed = 2 m/s is more than the wheels reach in every "
            "direction: 1.5 m/s (robot.max_wheel_speed = 1.5 m/s)");
  EXPECT_TRUE(robot_file_from_text("method: space_time\n", "robot.yaml").warnings.empty());
  // What is refused for itself is not told again for what it contradicts.
  EXPECT_EQ(problems("robot: {max_speed: 1.6, radius: -1}\n"),
            "robot.yaml:1:33: robot.radius = -1 must lie in [0.01, 5] m");
}

TEST(RobotFile, AnEmptyPathGivesTheDefaultsAndAMissingFileIsRefused) {
  EXPECT_EQ(read_robot_file("").method.name(), "space_time");
  EXPECT_THROW(static_cast<void>(read_robot_file("/no/such/robot.yaml")), InputError);
}

TEST(RobotFile, ReadsBackWhatItWrites) {
  RobotFile file = read_robot_file("");
  file.host.clock_jump = 2.5;
  file.robot.max_speed = 0.75;
  const std::string text = to_yaml_text(file, true);
  EXPECT_EQ(to_yaml_text(robot_file_from_text(text, "robot.yaml"), true), text);
}

TEST(RobotFile, ThePageOfTheNodesNamesEveryHostParameter) {
  std::ostringstream page;
  page << std::ifstream{source_dir() + "/docs/ros.md"}.rdbuf();
  for (const ParameterRow& row : parameter_rows(host::HostParameters{})) {
    const std::string line =
        "| `host." + row.key + "` | " + row.value + " | " + (row.unit.empty() ? "" : row.unit) + " |";
    EXPECT_NE(page.str().find(line), std::string::npos) << line;
  }
}

TEST(RobotFile, DefaultsOfTheHostFollowTheRobotButNotItsPeers) {
  const RobotFile standard = robot_file_from_text("method: space_time", "robot.yaml");
  const RobotFile small =
      robot_file_from_text("robot: {radius: 0.15}\nhost: {jump_distance: 0.4}", "robot.yaml");
  EXPECT_DOUBLE_EQ(small.host.map_grain.resolution, 0.5 * standard.host.map_grain.resolution);
  EXPECT_DOUBLE_EQ(small.host.map_grain.reach, 0.5 * standard.host.map_grain.reach);
  EXPECT_EQ(small.host.jump_distance, 0.4);  // as it is written
  EXPECT_EQ(small.host.largest_peer_radius, standard.host.largest_peer_radius);
}

}  // namespace
}  // namespace spf
