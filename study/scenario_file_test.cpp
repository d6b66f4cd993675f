#include "study/scenario_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "config/contradiction_report.hpp"
#include "config/yaml_reader.hpp"
#include "spf/testing/source_dir.hpp"

namespace spf {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

std::string report(const std::string& text, const std::vector<Setting>& settings = {}) {
  try {
    static_cast<void>(run_configuration_from_text(text, "file.yaml", settings));
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

std::string text_of(const std::filesystem::path& path) {
  std::ostringstream text;
  text << std::ifstream{path}.rdbuf();
  return text.str();
}

const std::filesystem::path kScenarios = std::filesystem::path{source_dir()} / "scenarios";

TEST(ScenarioFile, GivesTheFamilyOfTheProtocol) {
  const RunConfiguration config =
      run_configuration_from_text("family: t2_hard\nnoise: {level: 1, model: walk}\n", "file.yaml");
  EXPECT_EQ(config.family, SceneFamily{sim::Family::t2_hard});
  EXPECT_EQ(config.method.name(), "space_time");
  EXPECT_EQ(config.simulation.noise.level, 1.0);
  EXPECT_EQ(config.simulation.noise.speed_limit, 1.2);  // of the family, not of the struct
  const sim::Scenario trial = make_trial(config, 3);
  EXPECT_EQ(trial.robots.size(), 12u);
  EXPECT_EQ(trial.trial, 3);
  EXPECT_EQ(trial.seed, sim::kDefaultSeed);
  EXPECT_EQ(trial.simulation.noise.model, sim::NoiseModel::walk);
}

TEST(ScenarioFile, DrawsTheSameTrialsAsTheGenerator) {
  const RunConfiguration config = run_configuration_from_text("family: t2\n", "file.yaml");
  const sim::Scenario expected = sim::make_scenario(sim::family_setup(sim::Family::t2), sim::kDefaultSeed, 7);
  const sim::Scenario trial = make_trial(config, 7);
  ASSERT_EQ(trial.moving.size(), expected.moving.size());
  for (std::size_t i = 0; i < trial.moving.size(); ++i)
    EXPECT_EQ(trial.moving[i].position_world, expected.moving[i].position_world);
}

TEST(ScenarioFile, SizesAFamily) {
  const RunConfiguration config = run_configuration_from_text("family: swap\n", "file.yaml", {{"robots=20"}});
  EXPECT_EQ(make_trial(config, 0).robots.size(), 20u);
}

TEST(ScenarioFile, DefaultsFollowTheRobotOfTheFileAndSetValuesDoNot) {
  const RunConfiguration standard = run_configuration_from_text("family: t2\n", "standard.yaml");
  const RunConfiguration small = run_configuration_from_text(
      "family: t2\nrobot: {radius: 0.15, max_speed: 0.5, max_acceleration: 0.5}\n"
      "agent: {space_time: {peer_margin: 0.05}}\n",
      "small.yaml");
  const SpaceTimeParameters& large = standard.agent.space_time;
  EXPECT_EQ(large.margin, SpaceTimeParameters{}.margin);
  EXPECT_DOUBLE_EQ(small.agent.space_time.margin, 0.5 * large.margin);
  EXPECT_DOUBLE_EQ(small.agent.space_time.horizon, large.horizon);  // it stops in the same time
  EXPECT_EQ(small.agent.space_time.peer_margin, 0.05);              // as written
  EXPECT_DOUBLE_EQ(small.simulation.sensing.map_grain.resolution,
                   0.5 * standard.simulation.sensing.map_grain.resolution);
}

TEST(ScenarioFile, AFamilyOfSmallRobotsHasTheirDefaults) {
  const RunConfiguration platform = run_configuration_from_text("family: p8\n", "p8.yaml");
  EXPECT_DOUBLE_EQ(platform.agent.space_time.margin, SpaceTimeParameters{}.margin / 6.0);
  EXPECT_EQ(platform.simulation.sensing.map_grain.resolution, 0.02);  // as the family says
  const RunConfiguration again = run_configuration_from_text(to_yaml_text(platform), "again.yaml");
  EXPECT_EQ(to_yaml_text(again), to_yaml_text(platform));
}

TEST(ScenarioFile, MethodSetsAgentParametersAndTheFileOverridesThem) {
  const AgentParameters defaults;
  const RunConfiguration config = run_configuration_from_text(
      "family: t2\nmethod: spf_empc\nrobot: {radius: 0.25}\nagent: {team: {emergency_time: 0.5}}\n",
      "file.yaml");
  const AgentParameters expected = with_method(defaults, "spf_empc");
  const AgentParameters parameters = agent_parameters(config);
  EXPECT_EQ(typeid(*parameters.make_planner(parameters)), typeid(*expected.make_planner(expected)));
  EXPECT_EQ(parameters.team.replanning.emergency_time, 0.5);
  EXPECT_EQ(parameters.robot.radius, 0.25);  // one robot for planner, controller and plant
  EXPECT_EQ(make_trial(config, 0).robot.radius, 0.25);
}

TEST(ScenarioFile, AFleetHasKindsOfRobots) {
  const RunConfiguration config = run_configuration_from_text(
      "family: swap\n"
      "robots: 5\n"
      "robot: {max_speed: 0.8}\n"
      "agent: {team: {plan_period: 0.2}}\n"
      "fleet:\n"
      "  - robot: {radius: 0.15}\n"
      "  - robot: {drive: car, max_speed: 0.5}\n"
      "    method: orca\n"
      "    agent: {team: {priority: 3}}\n",
      "file.yaml");
  const sim::Scenario trial = make_trial(config, 0);
  const std::vector<AgentParameters> agents = agents_of(config);
  ASSERT_EQ(trial.robots.size(), 5U);
  ASSERT_EQ(agents.size(), 2U);
  EXPECT_EQ(trial.robot_of(2).radius, 0.15);  // taken in turn
  EXPECT_EQ(trial.robot_of(2).max_speed, 0.8);
  EXPECT_EQ(trial.robot_of(3).drive, DriveType::car);
  EXPECT_EQ(trial.robot_of(3).max_speed, 0.5);
  EXPECT_EQ(trial.largest_radius(), RobotParameters{}.radius);
  EXPECT_EQ(agents[0].team.priority, 0);
  EXPECT_EQ(agents[1].team.priority, 3);
  EXPECT_EQ(agents[0].team.plan_period, 0.2);
  EXPECT_EQ(agents[1].team.plan_period, 0.2);
  EXPECT_DOUBLE_EQ(agents[0].space_time.margin, 0.5 * SpaceTimeParameters{}.margin);  // follows the robot
  const auto planner = [](const AgentParameters& agent) { return agent.make_planner(agent); };
  const AgentParameters orca = with_method({}, "orca");
  EXPECT_EQ(typeid(*planner(agents[1])), typeid(*planner(orca)));
  EXPECT_EQ(typeid(*planner(agents[0])), typeid(*planner({})));

  const RunConfiguration again = run_configuration_from_text(to_yaml_text(config), "again.yaml");
  EXPECT_EQ(to_yaml_text(again), to_yaml_text(config));
  EXPECT_EQ(agents_of(again)[0].space_time.margin, agents[0].space_time.margin);
}

TEST(ScenarioFile, ARobotNamesItsKind) {
  const auto text = [](const std::string& kind) {
    return "family: explicit\n"
           "fleet: [{robot: {radius: 0.2}}, {robot: {radius: 0.4}}]\n"
           "robots:\n"
           "  - {start: [0, 0], goal: [4, 0]}\n"
           "  - {start: [0, 0.65], goal: [4, 1], kind: " +
           kind + "}\n";
  };
  const sim::Scenario trial = make_trial(run_configuration_from_text(text("0"), "file.yaml"), 0);
  EXPECT_EQ(trial.robot_of(0).radius, 0.2);
  EXPECT_EQ(trial.robot_of(1).radius, 0.2);
  EXPECT_EQ(make_trial(run_configuration_from_text(text("1"), "file.yaml"), 0).robot_of(1).radius, 0.4);
  EXPECT_THAT(report(text("2")),
              "file.yaml:5:44: robots[1].kind = 2 must be below 2, the number of kinds of robots");
}

TEST(ScenarioFile, RefusesBadKindsOfRobotsWhereTheyStand) {
  EXPECT_THAT(report("family: swap\nfleet:\n  - robot: {radius: -1}\n"),
              StartsWith("file.yaml:3:21: fleet[0].robot.radius = -1 must lie in"));
  EXPECT_THAT(report("family: swap\nfleet:\n  - robot: {radus: 1}\n"),
              StartsWith("file.yaml:3:13: fleet[0].robot.radus"));
  EXPECT_THAT(report("family: swap\nfleet:\n  - {method: best}\n"),
              StartsWith("file.yaml:3:14: fleet[0].method = best must be one of"));
  EXPECT_EQ(report("family: swap\nfleet: 3\n"), "file.yaml:2:8: fleet = 3 must be a list");
  // What is wrong for all robots is said once.
  EXPECT_THAT(report("family: swap\nagent: {team: {priority: -1}}\nfleet: [{}, {}]\n"),
              StartsWith("file.yaml:2:26: agent.team.priority = -1 must lie in [0, 1e+06]"));
  EXPECT_THAT(report("family: doors\nfleet: [{}, {robot: {radius: 0.6}}]\n"), HasSubstr("radius 0.6"));
}

TEST(ScenarioFile, ALongFleetInABadFileIsRefusedOnce) {
  // Were the bad keys read for every kind, this would take minutes.
  std::string text = "family: swap\nagent: {";
  for (int i = 0; i < 20000; ++i) text += "key_" + std::to_string(i) + ": 1, ";
  text += "}\nfleet: [";
  for (int i = 0; i < 10000; ++i) text += "{}, ";
  EXPECT_THAT(report(text + "]\n"), HasSubstr("agent.key_0 = 1 is not a known key"));
}

TEST(ScenarioFile, RefusesSettingsThatContradictEachOther) {
  EXPECT_EQ(report("family: t2\ntrial:\n  computing_delay: 0.4\n"),
            "file.yaml:3:20: trial.computing_delay = 0.4 s is longer than agent.team.stale_time = 0.3 s: "
            "whatever the robot senses would be too old to count");
  EXPECT_EQ(report("family: t2\nagent: {team: {stale_time: 0.5}}\ntrial: {computing_delay: 0.4}\n"), "");
}

TEST(ScenarioFile, WarnsOfSettingsThatMayBeMeant) {
  const auto warnings = [](const std::string& text, const std::vector<Setting>& settings = {}) {
    std::string all;
    for (const InputProblem& warning : run_configuration_from_text(text, "file.yaml", settings).warnings)
      all += warning_text(warning) + "\n";
    return all;
  };
  EXPECT_EQ(warnings("family: t2\nrobot:\n  max_speed: 2\n  max_acceleration: 1.2\n"),
            "file.yaml:3:14: warning: robot.max_speed = 2 m/s is more than the wheels reach in every "
            "direction: 1.5 m/s (robot.max_wheel_speed = 1.5 m/s)\n");
  EXPECT_EQ(warnings("family: t2\nrobot: {max_speed: 2}\ntrial: {tracking: ideal}\n"), "");
  EXPECT_THAT(warnings("family: swap\n", {{"radio.loss=1"}}),
              StartsWith("--set: warning: radio.loss = 1 keeps robots from hearing of each other"));
  EXPECT_EQ(warnings("family: swap\n", {{"radio.loss=1"}, {"robots=1"}}), "");
  EXPECT_EQ(warnings("family: explicit\nrobots: [{start: [0, 0], goal: [4, 0]}]\nradio: {loss: 1}\n"), "");
}

TEST(ScenarioFile, DescribesASceneByHand) {
  const RunConfiguration config = run_configuration_from_text(
      "family: explicit\n"
      "border: {low: [-5, -5], high: [5, 5]}\n"
      "robots:\n"
      "  - {start: [-4, 0], goal: [4, 0]}\n"
      "  - {start: [0, -4], goal: [0, 4], heading: 1.5, goal_heading: 0.5}\n"
      "boxes: [{low: [1, 1], high: [2, 2]}]\n"
      "discs: [{center: [-2, 2], radius: 0.4}]\n"
      "walls: [{from: [-3, -3], to: [-2, -3]}]\n"
      "polygons:\n"
      "  - corners: [[3, 3], [4, 3], [3.5, 4]]\n"
      "moving: [{position: [3, -3], velocity: [0, 0.5], radius: 0.3}]\n",
      "file.yaml");
  const sim::Scenario scenario = make_trial(config, 0);
  ASSERT_EQ(scenario.robots.size(), 2u);
  EXPECT_EQ(scenario.robots[0].start.heading, 0.0);  // towards its goal
  EXPECT_EQ(scenario.robots[1].start.heading, 1.5);
  EXPECT_FALSE(scenario.robots[0].goal_heading.has_value());
  EXPECT_EQ(scenario.robots[1].goal_heading, 0.5);
  ASSERT_TRUE(scenario.border.has_value());
  EXPECT_EQ(scenario.border->high.x(), 5.0);
  ASSERT_EQ(scenario.boxes.size(), 1u);
  ASSERT_EQ(scenario.discs.size(), 1u);
  EXPECT_EQ(scenario.discs[0].radius, 0.4);
  ASSERT_EQ(scenario.walls.size(), 1u);
  ASSERT_EQ(scenario.polygons.size(), 1u);
  EXPECT_EQ(scenario.polygons[0].corners[2], (Eigen::Vector2d{3.5, 4.0}));
  ASSERT_EQ(scenario.moving.size(), 1u);
  EXPECT_EQ(scenario.moving[0].velocity_world, (Eigen::Vector2d{0.0, 0.5}));
}

TEST(ScenarioFile, TellsWhatHappensToRobots) {
  const std::string text = R"(family: explicit
trial: {goals: repeated, goal_pause: 2}
robots:
  - {start: [0, 0], goal: [4, 0], next_goals: [[4, 4], [0, 4]]}
  - {start: [0, 9], goal: [4, 0]}
events:
  - {at: 3, robot: 1, do: break_down}
  - {after: {robot: 0, goals: 2}, robot: 1, do: goal, goal: [7, 8], goal_heading: 1.5}
  - {at: 4, robot: 0, do: priority, priority: 7}
)";
  const RunConfiguration first = run_configuration_from_text(text, "test");
  // What is written out reads back to the same.
  const RunConfiguration config = run_configuration_from_text(to_yaml_text(first), "written");
  const sim::Scenario scenario = make_trial(config, 0);
  EXPECT_EQ(scenario.simulation.trial.goals, sim::GoalSupply::repeated);
  EXPECT_EQ(scenario.simulation.trial.goal_pause, 2.0);
  ASSERT_EQ(scenario.robots[0].next_goals.size(), 2U);
  EXPECT_EQ(scenario.robots[0].next_goals[1].position_world, (Eigen::Vector2d{0.0, 4.0}));
  ASSERT_EQ(scenario.events.size(), 3U);
  EXPECT_EQ(scenario.events[0].order.act, sim::FleetAct::break_down);
  EXPECT_EQ(scenario.events[0].order.robot, 1);
  EXPECT_EQ(scenario.events[0].time, 3.0);
  EXPECT_EQ(scenario.events[0].after_robot, -1);
  EXPECT_EQ(scenario.events[1].after_robot, 0);
  EXPECT_EQ(scenario.events[1].after_goals, 2);
  EXPECT_EQ(scenario.events[1].order.goal.position_world, (Eigen::Vector2d{7.0, 8.0}));
  EXPECT_EQ(scenario.events[1].order.goal.heading, 1.5);
  EXPECT_EQ(scenario.events[2].order.priority, 7);
  const RunConfiguration drawn =
      run_configuration_from_text("family: t2\nevents: [{at: 1, robot: 4, do: pause}]", "test");
  EXPECT_EQ(make_trial(drawn, 3).events.size(), 1U);
}

TEST(ScenarioFile, RefusesEventsThatCannotBeWhereTheyStand) {
  EXPECT_EQ(report("family: t2\nevents: [{at: 1, robot: 5, do: pause}]"),
            "file.yaml:2:25: events[0].robot = 5 must be below 5, the number of robots");
  EXPECT_EQ(report("family: t2\nevents: [{robot: 0, do: halt}]").substr(0, 67),
            "file.yaml:2:25: events[0].do = halt must be one of goal, cancel, pa");
  EXPECT_EQ(report("family: t2\nevents: [{robot: 0}]"), "file.yaml:2:10: events[0].do is missing");
  EXPECT_NE(report("family: t2\nevents: [{robot: 0, do: goal}]").find("events[0].goal must say where to"),
            std::string::npos);
  EXPECT_NE(report("family: t2\nevents: [{robot: 0, do: goal, goal: [1, far]}]").find("events[0].goal[1]"),
            std::string::npos);
}

TEST(ScenarioFile, PutsPeopleIntoADrawnScene) {
  const std::string plaza = (kScenarios / "crowds" / "plaza.csv").string();
  const std::string text =
      "family: explicit\nrobots: [{start: [0, 0], goal: [5, 0]}]\ntrial: {time_limit: 30}\n"
      "people:\n"
      "  - {waypoints: [[0, 2], [4, 2]], speed: 1.1, radius: 0.3, behaviour: fixed, at_last: loop, anywhere: "
      "true}\n"
      "  - waypoints: [[1, 4]]\n"
      "crowd: \"" +
      plaza + "\"\ncrowd_placement: {origin: [100, 50], heading: 1.5707963267948966, begin: 20}\n";
  const RunConfiguration config = run_configuration_from_text(text, "file.yaml");
  const sim::Scenario scenario = make_trial(config, 2);
  ASSERT_EQ(scenario.people.size(), 2u);
  EXPECT_EQ(scenario.people[0].waypoints[1], (Eigen::Vector2d{4.0, 2.0}));
  EXPECT_EQ(scenario.people[0].behaviour, sim::PersonBehaviour::fixed);
  EXPECT_EQ(scenario.people[0].at_last, sim::AtLastWaypoint::loop);
  EXPECT_TRUE(scenario.people[0].anywhere);
  EXPECT_EQ(scenario.people[1].behaviour, sim::PersonBehaviour::reacting);
  // What the recording shows 20 s + 2 x 5 s after its first sample, turned by 90 degrees and shifted.
  const std::vector<sim::CrowdSample> window =
      config.recording->window(config.recording->begin() + 30.0, 30.0);
  ASSERT_EQ(scenario.crowd.size(), window.size());
  for (std::size_t i = 0; i < window.size(); ++i) {
    const Eigen::Vector2d& at = window[i].position_world;
    EXPECT_LT((scenario.crowd[i].position_world - Eigen::Vector2d{100.0 - at.y(), 50.0 + at.x()}).norm(),
              1e-9);
    EXPECT_EQ(scenario.crowd[i].time, window[i].time);
  }
  EXPECT_EQ(trial_count(config), std::nullopt);  // it begins again
  EXPECT_FALSE(make_trial(config, 1'000'000).crowd.empty());
  EXPECT_EQ(identity_text(run_configuration_from_text(to_yaml_text(config), "again.yaml")),
            identity_text(config));
}

struct BadScenario {
  const char* text;
  const char* expected;
};

class ScenarioFileBadInput : public testing::TestWithParam<BadScenario> {};

TEST_P(ScenarioFileBadInput, IsRefusedWithPlaceKeyValueAndLimit) {
  EXPECT_EQ(report(GetParam().text), GetParam().expected);
}

#define ROBOT "robots: [{start: [0, 0], goal: [5, 0]}]\n"
INSTANTIATE_TEST_SUITE_P(
    Scenes, ScenarioFileBadInput,
    testing::Values(
        BadScenario{"noise: {level: 1}", "file.yaml:1:1: family is missing"},
        BadScenario{"family: explicit", "file.yaml:1:1: robots is missing"},
        BadScenario{"family: t2\nrobots: [{start: [0, 0], goal: [1, 1]}]",
                    "file.yaml:2:9: robots = [{...}] must be a whole number"},
        BadScenario{"family: t2\nboxes: []", "file.yaml:2:1: boxes = [] is not a known key"},
        BadScenario{"family: t2\nagent: {robot: {radius: 1}}",
                    "file.yaml:2:9: agent.robot = {...} is not a known key; did you mean robot?"},
        BadScenario{
            "family: explicit\n" ROBOT "discs: [{center: [0.5, 0], radius: 0.3}]",
            "file.yaml:2:18: robots[0].start = [0, 0] is 0.2 m from discs[0], less than the radius 0.3 m"},
        BadScenario{"family: explicit\n" ROBOT "polygons: [{corners: [[0, 1], [1, 1]]}]",
                    "file.yaml:3:22: polygons[0].corners = [[0, 1], [1, 1]] must be at least 3, and are 2"},
        BadScenario{"family: explicit\n" ROBOT "polygons:\n - {}",
                    "file.yaml:4:4: polygons[0].corners is missing"},
        BadScenario{"family: explicit\n" ROBOT "polygons:\n - corners: [[0, 1], [1, 1e6], [2, 1]]",
                    "file.yaml:4:26: polygons[0].corners[1][1] = 1e6 must lie in [-1e+05, 1e+05] m"},
        BadScenario{"family: explicit\n" ROBOT "polygons:\n - corners: [[0, 2], [1, 3], [1, 2], [0, 3]]",
                    "file.yaml:4:13: polygons[0].corners = [[0, 2], [1, 3], [1, 2], [0, 3]] must not cross "
                    "themselves: the sides from corner 0 and from corner 2 meet"},
        BadScenario{
            "family: explicit\n" ROBOT "polygons:\n - corners: [[0, 2], [1, 2], [2, 2]]",
            "file.yaml:4:13: polygons[0].corners = [[0, 2], [1, 2], [2, 2]] must enclose an area, and "
            "lie on a line"},
        BadScenario{"family: explicit\n" ROBOT "polygons:\n - corners: [[-2, -2], [2, -2], [2, 2], [-2, 2]]",
                    "file.yaml:2:18: robots[0].start = [0, 0] is 0 m from polygons[0], less than the radius "
                    "0.3 m"},
        BadScenario{
            "family: explicit\n" ROBOT "boxes: [{low: [4, -1], high: [6, 1]}]",
            "file.yaml:2:32: robots[0].goal = [5, 0] is 0 m from boxes[0], less than the radius 0.3 m"},
        BadScenario{"family: explicit\n" ROBOT "moving: [{position: [0, 0.5], radius: 0.4}]",
                    "file.yaml:2:18: robots[0].start = [0, 0] is inside moving[0]: centres 0.5 m apart"},
        BadScenario{"family: explicit\n" ROBOT "border: {low: [-5, -5], high: [5, 5]}",
                    "file.yaml:2:32: robots[0].goal = [5, 0] must lie inside the border by the radius 0.3 m"},
        BadScenario{"family: explicit\n" ROBOT "boxes: [{low: [2, 2], high: [1, 3]}]",
                    "file.yaml:3:9: boxes[0] low corner (2, 2) must lie below the high corner (1, 3)"},
        BadScenario{"family: explicit\nrobots:\n  - {start: [0, 0], goal: [5, 0]}\n  - {start: [0.5, 0], "
                    "goal: [5, 3]}",
                    "file.yaml:4:13: robots[1].start = [0.5, 0] is inside robots[0]: centres 0.5 m apart"},
        BadScenario{
            "family: explicit\nrobots:\n  - {start: [0, 0], goal: [5, 0]}\n  - {start: [0, 3], goal: [5, 0]}",
            "file.yaml:4:27: robots[1].goal = [5, 0] is 0 m from robots[0].goal, less than their radii, 0.6 "
            "m"},
        BadScenario{
            "family: explicit\n" ROBOT
            "border: {low: [-9, -9], high: [9, 9]}\nmoving: [{position: [8.9, 0]}]",
            "file.yaml:4:21: moving[0].position = [8.9, 0] must lie inside the border by its radius, 0.4 m"},
        // A refused value is reported once; the default that it leaves behind says nothing more.
        BadScenario{"family: explicit\n" ROBOT "discs: [{center: [0.5, 0], radius: -1}]",
                    "file.yaml:3:36: discs[0].radius = -1 must lie in [0.001, 1000] m"},
        BadScenario{"family: explicit\nrobots: [{start: [0, .nan], goal: [5, 0]}]",
                    "file.yaml:2:22: robots[0].start[1] = .nan must be a number in m, not NaN"}));
#undef ROBOT

TEST(ScenarioFile, ListsTheNamesThatAreAllowed) {
  EXPECT_THAT(report("family: t3"),
              testing::AllOf(testing::StartsWith("file.yaml:1:9: family = t3 must be one of "),
                             HasSubstr("f7"), HasSubstr("explicit; did you mean t2?")));
  EXPECT_THAT(report("family: t2\nmethod: spf_emp"),
              testing::AllOf(testing::StartsWith("file.yaml:2:9: method = spf_emp must be one of es2, "),
                             HasSubstr("space_time"), HasSubstr("did you mean spf_empc?")));
}

TEST(ScenarioFile, ReportsFormAndSceneAtOnce) {
  const std::string text = report(
      "family: explicit\n"
      "robots:\n"
      "  - {start: [0, 0], goal: [5, 0]}\n"
      "  - {start: [0.1, 0], gaol: [5, 3]}\n"
      "sensing: {range: -1}\n",
      {{"noise.level=-2", "--level"}});
  EXPECT_THAT(text, HasSubstr("--level: noise.level = -2 must lie in [0, 100]"));
  EXPECT_THAT(text, HasSubstr("file.yaml:4:5: robots[1].goal is missing"));
  EXPECT_THAT(
      text,
      HasSubstr("file.yaml:4:23: robots[1].gaol = [5, 3] is not a known key; did you mean robots[1].goal?"));
  EXPECT_THAT(text, HasSubstr("file.yaml:5:18: sensing.range = -1 must lie in"));
}

TEST(ScenarioFile, SaysWhenAFamilyHasNoRoom) {
  const std::string robots = report("family: t2\nrobots: 2000");
  EXPECT_THAT(robots, testing::StartsWith("file.yaml:2:9: robots = 2000 cannot be drawn: robots["));
  EXPECT_THAT(robots, testing::Not(HasSubstr("\n")));
  EXPECT_THAT(report("family: t2\nlayout: {squares: 200}"),
              testing::StartsWith(
                  "file.yaml:2:19: layout.squares = 200 cannot be drawn: no scene of family t2 found in "));
  EXPECT_THAT(report("family: t2\nlayout: {squares: 200}"), testing::EndsWith(": no room for 200 squares"));
  EXPECT_THAT(
      report("family: p8\nlayout: {discs: 200}"),
      testing::StartsWith("file.yaml:2:17: layout.discs = 200 cannot be drawn: no scene of family p8"));
  EXPECT_EQ(report("family: clutter\nrobots: 5"),
            "file.yaml:2:9: robots = 5 cannot be drawn: the family clutter has 1 robot, not 5");
  EXPECT_EQ(report("family: doors\nlayout: {door_width_low: 0.5}"),
            "file.yaml:2:26: layout.door_width_low = 0.5 cannot be drawn: a robot of radius 0.3 m must be "
            "narrower than that");
}

/// How many lines a report has, and how many problems beyond them it counts.
std::pair<std::size_t, std::string> size_of(const std::string& text) {
  const auto lines = static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n')) + 1;
  return {lines, text.substr(text.rfind('\n') + 1)};
}

TEST(ScenarioFile, TellsOfManyRobotsInOnePlaceInFewWords) {
  std::string text = "family: explicit\nrobots:\n";
  for (int i = 0; i < 2000; ++i) text += "  - {start: [0, 0], goal: [2, 0]}\n";
  const std::string found = report(text);
  // One for each start and goal but the first; a hundred of them are reported.
  const auto [lines, last] = size_of(found);
  EXPECT_EQ(lines, InputProblems::kMostProblems + 1);
  EXPECT_EQ(last, "(and 3898 more)");
  EXPECT_LT(found.size(), 20000u);
  EXPECT_THAT(found,
              HasSubstr("file.yaml:4:13: robots[1].start = [0, 0] is inside robots[0]: centres 0 m apart\n"));
  EXPECT_THAT(found, HasSubstr("robots[100].start = [0, 0] is inside robots["));
  EXPECT_THAT(found, HasSubstr(": centres 0 m apart (and 99 more)\n"));
}

TEST(ScenarioFile, ProblemsAreNoMoreThanEntriesWhateverStandsInTheWay) {
  std::string text = "family: explicit\nrobots:\n";
  for (int i = 0; i < 50; ++i)
    text += "  - {start: [" + std::to_string(i) + ", 0], goal: [" + std::to_string(i) + ", 9]}\n";
  text += "boxes:\n";
  for (int i = 0; i < 300; ++i) text += "  - {low: [-1, -1], high: [60, 60]}\n";
  text += "moving:\n";
  for (int i = 0; i < 300; ++i) text += "  - {position: [25, 0], radius: 60}\n";
  const auto [lines, last] = size_of(report(text));
  EXPECT_EQ(lines, InputProblems::kMostProblems + 1);
  EXPECT_EQ(last, "(and 50 more)");  // start and goal in the boxes, start in the discs: 150
}

TEST(ScenarioFile, RefusesLongerListsThanItLooksThrough) {
  std::string text = "robots:\n";
  for (int i = 0; i < 10001; ++i) text += "  - {start: [0, 0], goal: [2, 0]}\n";
  EXPECT_THAT(report(text), HasSubstr("has 10001 entries: must have at most 10000"));
}

TEST(ScenarioFile, AHopelessLayoutOfManyIsGivenUpSoon) {
  const std::string found = report("family: t2\nrobots: 10000\nlayout: {squares: 200}\n");
  EXPECT_THAT(found, HasSubstr("found in 20 attempts: no room for 200 squares"));
}

TEST(ScenarioFile, ResolvedFormReadsBackToTheSameStudy) {
  for (const std::string text :
       {"family: p8\nmethod: spf_empc\n",
        "family: t2\nnoise: {level: 0.25, model: walk}\nseed: 18446744073709551615\n",
        "family: explicit\nrobots: [{start: [0, 0], goal: [5, 0.1], heading: 0.3}, {start: [0, 3], goal: [5, "
        "3]}]\n"
        "border: {low: [-9, -9], high: [9, 9]}\nmoving: [{position: [3, -3], velocity: [0.1, 0.2]}]\n"}) {
    for (const bool explains : {false, true}) {
      const std::string resolved = to_yaml_text(run_configuration_from_text(text, "file.yaml"), explains);
      EXPECT_EQ(to_yaml_text(run_configuration_from_text(resolved, "resolved.yaml"), explains), resolved);
    }
  }
}

TEST(ScenarioFile, LoadsHundredsOfStaticDiscs) {
  std::string text = "family: explicit\nrobots: [{start: [-5, 0], goal: [50, 0]}]\ndiscs:\n";
  for (int i = 0; i < 30; ++i)
    for (int j = 0; j < 30; ++j)
      text += "  - {center: [" + std::to_string(i) + ", " + std::to_string(j + 1) + "], radius: 0.075}\n";
  EXPECT_EQ(make_trial(run_configuration_from_text(text, "file.yaml"), 0).discs.size(), 900u);
}

TEST(ScenarioFiles, AreAllGood) {
  int seen = 0;
  for (const std::filesystem::directory_entry& entry : std::filesystem::directory_iterator{kScenarios}) {
    if (entry.path().extension() != ".yaml") continue;
    SCOPED_TRACE(entry.path());
    const RunConfiguration config = read_run_configuration(entry.path().string());
    for (const InputProblem& warning : config.warnings) ADD_FAILURE() << warning_text(warning);
    EXPECT_FALSE(make_trial(config, 0).robots.empty());
    ++seen;
  }
  EXPECT_GE(seen, 7);
}

TEST(ScenarioFiles, FamiliesAreNamedAfterThemselves) {
  for (const auto& [family, name] : EnumNames<sim::Family>::values) {
    SCOPED_TRACE(name);
    const RunConfiguration config =
        read_run_configuration((kScenarios / (std::string{name} + ".yaml")).string());
    EXPECT_EQ(config.family, SceneFamily{family});
  }
}

// The hand-written scenario is the reference of the format: it has every key, and explains it.
TEST(ScenarioFiles, CrossingExplainsEveryKey) {
  const std::string text = text_of(kScenarios / "crossing.yaml");
  InputProblems problems;
  const YamlNode root = parse_yaml(text, "crossing.yaml", problems);
  ASSERT_TRUE(problems.empty()) << problems.to_text();
  RunConfiguration config = default_run_configuration(kExplicitScene, RunConfiguration{}.method);
  for (std::string key : keys_of(config)) {
    if (key == "border" || key.find("heading") != std::string::npos)
      continue;                                  // absent has a meaning of its own
    if (key.rfind("fleet[]", 0) == 0) continue;  // as the keys without it
    for (std::size_t at = key.find("[]"); at != std::string::npos; at = key.find("[]"))
      key.replace(at, 2, "[0]");
    const std::size_t last = key.find_last_of('.');
    const YamlNode& parent = last == std::string::npos ? root : nearest_node(root, key.substr(0, last));
    EXPECT_NE(parent.find(key.substr(last == std::string::npos ? 0 : last + 1)), nullptr)
        << key << " is missing; build the target spf_reference_files";
  }
  std::istringstream lines{text};
  int explained = 0;
  for (std::string line; std::getline(lines, line);)
    explained += line.find("  # ") != std::string::npos ? 1 : 0;
  int values = 0;
  for (const std::string& key : keys_of(config)) values += key.find("[]") == std::string::npos ? 1 : 0;
  EXPECT_GE(explained, values - 20);  // groups and lists have their comment above or none
}

}  // namespace
}  // namespace spf
