#include "sim/families.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <map>
#include <sstream>

#include "sim/geometry.hpp"
#include "spf/math/angles.hpp"
#include "spf/testing/source_dir.hpp"

namespace spf::sim {
namespace {

struct Row {
  int trial = 0;
  std::string kind;
  std::size_t index = 0;
  double x = 0.0, y = 0.0, vx_or_gx = 0.0, vy_or_gy = 0.0, size = 0.0;
};

std::vector<Row> read_reference_scenes() {
  std::ifstream file{source_dir() + "/sim/test_data/t2_scenes50.csv"};
  std::vector<Row> rows;
  std::string line;
  std::getline(file, line);  // names of the columns
  while (std::getline(file, line)) {
    for (char& character : line)
      if (character == ',') character = ' ';
    Row row;
    std::istringstream{line} >> row.trial >> row.kind >> row.index >> row.x >> row.y >> row.vx_or_gx >>
        row.vy_or_gy >> row.size;
    rows.push_back(row);
  }
  return rows;
}

Scenario scene(Family family, int trial) {
  return make_scenario(family_setup(family), kDefaultSeed, trial);
}

std::string problems_text(const Scenario& scenario) {
  std::string text;
  for (const ScenarioProblem& problem : problems_of(scenario)) text += to_text(problem) + "\n";
  return text;
}

TEST(Families, T2ReproducesTheReferenceScenes) {
  const std::vector<Row> rows = read_reference_scenes();
  ASSERT_EQ(rows.size(), 50U * 15U);
  std::map<int, Scenario> scenes;
  for (int trial = 0; trial < 50; ++trial) scenes.emplace(trial, scene(Family::t2, trial));
  constexpr double kTolerance = 1e-9;  // the file has nine decimals: 5e-10, and rounding of sines
  for (const Row& row : rows) {
    SCOPED_TRACE(std::to_string(row.trial) + " " + row.kind + " " + std::to_string(row.index));
    const Scenario& scenario = scenes.at(row.trial);
    const Eigen::Vector2d position{row.x, row.y};
    const Eigen::Vector2d second{row.vx_or_gx, row.vy_or_gy};
    if (row.kind == "robot") {
      EXPECT_LT((scenario.robots.at(row.index).start.position_world - position).norm(), kTolerance);
      EXPECT_LT((scenario.robots.at(row.index).goal_world - second).norm(), kTolerance);
      EXPECT_NEAR(scenario.robot.radius, row.size, kTolerance);
    } else if (row.kind == "square") {
      const Box expected = square(position, row.size);
      EXPECT_LT((scenario.boxes.at(row.index).low - expected.low).norm(), 2.0 * kTolerance);
      EXPECT_LT((scenario.boxes.at(row.index).high - expected.high).norm(), 2.0 * kTolerance);
    } else {
      ASSERT_EQ(row.kind, "disc");
      EXPECT_LT((scenario.moving.at(row.index).position_world - position).norm(), kTolerance);
      EXPECT_LT((scenario.moving.at(row.index).velocity_world - second).norm(), kTolerance);
      EXPECT_NEAR(scenario.moving.at(row.index).radius, row.size, kTolerance);
    }
  }
}

TEST(Families, EveryFamilyDrawsUsableScenesOfItsSize) {
  for (const auto& [family, name] : EnumNames<Family>::values) {
    if (family == Family::ped) continue;  // needs a recording: crowd_test.cpp
    const FamilySetup setup = family_setup(family);
    for (const int trial : {0, 1, 2, 10000, 10001}) {
      SCOPED_TRACE(std::string{name} + " " + std::to_string(trial));
      const Scenario scenario = scene(family, trial);
      EXPECT_EQ(problems_text(scenario), "");
      EXPECT_EQ(static_cast<int>(scenario.robots.size()), setup.layout.robots);
      const bool passage = family == Family::doors || family == Family::corridor;
      const int walls = passage ? 2 : 0;  // either side of it
      EXPECT_EQ(static_cast<int>(scenario.boxes.size()), setup.layout.squares + walls);
      EXPECT_EQ(static_cast<int>(scenario.moving.size()), setup.layout.discs);
    }
  }
}

TEST(Families, ClutterIsForOneRobot) {
  FamilySetup setup = family_setup(Family::clutter);
  setup.layout.robots = 2;
  EXPECT_THROW(make_scenario(setup, kDefaultSeed, 0), NoRoom);
}

TEST(Families, TrafficStartsInOneRoomAndEndsInTheOther) {
  for (const Family family : {Family::doors, Family::corridor}) {
    for (const int robots : {2, 5, 20}) {
      FamilySetup setup = family_setup(family);
      setup.layout.robots = robots;
      for (int trial = 0; trial < 20; ++trial) {
        const Scenario scenario = make_scenario(setup, kDefaultSeed, trial);
        EXPECT_EQ(problems_text(scenario), "");
        ASSERT_EQ(static_cast<int>(scenario.robots.size()), robots);
        int from_left = 0;
        for (const RobotTask& task : scenario.robots) {
          EXPECT_LT(task.start.position_world.x() * task.goal_world.x(), 0.0);
          from_left += task.start.position_world.x() < 0.0 ? 1 : 0;
        }
        EXPECT_EQ(from_left, (robots + 1) / 2);
        EXPECT_LT(scenario.boxes[1].high.y(), scenario.boxes[0].low.y());
      }
    }
  }
}

TEST(Families, DrawsPassagesForRobotsThatAreNarrower) {
  for (const Family family : {Family::clutter, Family::doors, Family::corridor}) {
    FamilySetup setup = family_setup(family);
    setup.robot.radius = family == Family::corridor ? 0.41 : 0.36;
    EXPECT_THROW(make_scenario(setup, kDefaultSeed, 0), NoRoom);
    setup.robot.radius = family == Family::corridor ? 0.39 : 0.34;
    EXPECT_NO_THROW(make_scenario(setup, kDefaultSeed, 0));
  }
}

TEST(Families, T2HardKeepsItsGapsAndDrawsItsRadii) {
  double smallest = 1.0;
  double largest = 0.0;
  for (int trial = 0; trial < 40; ++trial) {
    const Scenario scenario = scene(Family::t2_hard, trial);
    for (std::size_t i = 0; i < scenario.moving.size(); ++i) {
      const ObstacleState& disc = scenario.moving[i];
      smallest = std::min(smallest, disc.radius);
      largest = std::max(largest, disc.radius);
      EXPECT_LE(disc.velocity_world.norm(), 1.2);
      for (const Box& box : scenario.boxes)
        EXPECT_GE(distance_to_box(disc.position_world, box), disc.radius + 0.2);
    }
    for (std::size_t i = 0; i < scenario.boxes.size(); ++i)
      for (std::size_t j = 0; j < i; ++j)
        EXPECT_GE(distance_between_boxes(scenario.boxes[i], scenario.boxes[j]), 1.2);
  }
  // 400 uniform draws leave the outer 5 % of the interval empty with probability 0.95^400 = 1e-9.
  EXPECT_GE(smallest, 0.3);
  EXPECT_LT(smallest, 0.315);
  EXPECT_LE(largest, 0.6);
  EXPECT_GT(largest, 0.585);
}

TEST(Families, SwapStandsOnACircleOfTheAskedSize) {
  FamilySetup setup = family_setup(Family::swap);
  setup.layout.robots = 50;
  const Scenario scenario = make_scenario(setup, kDefaultSeed, 3);
  for (const RobotTask& task : scenario.robots) {
    EXPECT_NEAR(2.0 * kPi * task.start.position_world.norm(), 1.5 * 50, 1e-9);
    EXPECT_LT((task.start.position_world + task.goal_world).norm(), 1e-12);
  }
}

TEST(Families, FieldHasEqualDensityAndGoalsInReach) {
  for (const int robots : {5, 50, 200}) {
    FamilySetup setup = family_setup(Family::field);
    setup.layout.robots = robots;
    const Scenario scenario = make_scenario(setup, kDefaultSeed, 0);
    EXPECT_EQ(static_cast<int>(scenario.discs.size()), robots / 4);
    EXPECT_NEAR((scenario.border->high - scenario.border->low).x(), 5.0 * std::sqrt(robots) + 2.0, 1e-9);
    for (const RobotTask& task : scenario.robots) {
      const double distance = (task.goal_world - task.start.position_world).norm();
      EXPECT_GE(distance, 10.0);
      EXPECT_LE(distance, 30.0);
    }
  }
}

TEST(Families, SimulationRobotIsLargerThanThePlatforms) {
  EXPECT_EQ(family_setup(Family::t2).robot.wheel_arm, 0.2);
  EXPECT_EQ(family_setup(Family::p8).robot.wheel_arm, 0.04);
}

TEST(Families, RobotsStartAtRestFacingTheirGoals) {
  for (const auto& [family, name] : EnumNames<Family>::values) {
    SCOPED_TRACE(name);
    if (family == Family::ped) continue;  // needs a recording: crowd_test.cpp
    for (const RobotTask& task : scene(family, 10000).robots) {
      const Eigen::Vector2d to_goal = task.goal_world - task.start.position_world;
      const Eigen::Vector2d facing{std::cos(task.start.heading), std::sin(task.start.heading)};
      EXPECT_NEAR(facing.dot(to_goal.normalized()), 1.0, 1e-12);
    }
  }
}

TEST(Families, PlatformMirrorsStartsAndHasSeamsBesideTheMiddle) {
  const Scenario scenario = scene(Family::p8, 10000);
  ASSERT_TRUE(scenario.border);
  const Eigen::Vector2d size = scenario.border->high - scenario.border->low;
  EXPECT_NEAR(size.x(), 1.374, 1e-12);
  EXPECT_NEAR(size.y(), 2.432, 1e-12);
  for (const RobotTask& task : scenario.robots) {
    EXPECT_EQ(task.goal_world.x(), task.start.position_world.x());
    EXPECT_EQ(task.goal_world.y(), -task.start.position_world.y());
    EXPECT_NEAR(std::abs(task.goal_world.y()), 0.5 * 2.432 - 0.12, 1e-12);
  }
  ASSERT_EQ(scenario.seams.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    const double y = (i == 0 ? -1.0 : 1.0) * 2.432 / 6.0;
    EXPECT_LT((scenario.seams[i].from - Eigen::Vector2d{-0.687, y}).norm(), 1e-12);
    EXPECT_LT((scenario.seams[i].to - Eigen::Vector2d{0.687, y}).norm(), 1e-12);
  }
}

TEST(Families, TooMuchForTheSceneIsAnError) {
  FamilySetup setup = family_setup(Family::t2);
  setup.layout.squares = 200;
  setup.layout.squares_within = 2.0;
  EXPECT_THROW((void)make_scenario(setup, kDefaultSeed, 0), std::runtime_error);
  setup = family_setup(Family::t2);
  setup.layout.disc_speed_low = -1.0;
  EXPECT_THROW((void)make_scenario(setup, kDefaultSeed, 0), std::invalid_argument);
}

TEST(Scenario, TellsEveryProblemWithItsPlace) {
  Scenario scenario = scene(Family::t2, 0);
  scenario.robots[1].start.position_world = scenario.robots[0].start.position_world;
  scenario.robots[2].goal_world = 0.5 * (scenario.boxes[3].low + scenario.boxes[3].high);
  scenario.robots[3].start.position_world.x() = std::nan("");
  scenario.robots[4].start.position_world = {14.9, 0.0};
  scenario.moving[0].radius = -1.0;
  scenario.boxes[5].low = scenario.boxes[5].high;
  scenario.simulation.radio.loss = 2.0;
  scenario.simulation.trial.plant_rate = 123.0;
  const std::string text = problems_text(scenario);
  for (const char* expected : {"robots[2].goal", "robots[3].start", "robots[4].start", "moving[0]",
                               "boxes[5]", "radio.loss = 2", "plant_rate = 123"})
    EXPECT_NE(text.find(expected), std::string::npos) << expected << " in\n" << text;

  scenario = scene(Family::t2, 0);
  scenario.robots[1].start.position_world = scenario.robots[0].start.position_world;
  EXPECT_NE(problems_text(scenario).find("is inside robots[0]"), std::string::npos);
}

TEST(Scenario, TimeLimitFollowsTheProtocol) {
  Scenario scenario = scene(Family::t2, 0);
  EXPECT_DOUBLE_EQ(time_limit_of(scenario), 120.0);  // 4 * (25 + 1) = 104 s
  scenario.robot.max_speed = 0.5;
  EXPECT_NEAR(time_limit_of(scenario), 4.0 * (25.0 / 0.5 + 0.5), 1e-9);
  scenario.simulation.trial.time_limit = 7.0;
  EXPECT_DOUBLE_EQ(time_limit_of(scenario), 7.0);
  EXPECT_DOUBLE_EQ(rest_to_rest_time(0.25, 1.0, 1.0), 1.0);  // too short for full speed: 2 sqrt(d / a)
}

}  // namespace
}  // namespace spf::sim
