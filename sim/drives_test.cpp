// Robots on every drive in whole trials: the default method, the paper's and the baselines.
#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>
#include <string>
#include <vector>

#include "sim/families.hpp"
#include "sim/simulation.hpp"
#include "sim/world.hpp"
#include "spf/robot/drive.hpp"
#include "spf/team/method_table.hpp"

namespace spf::sim {
namespace {

RobotParameters robot_with(DriveType drive, int wheels = 3) {
  RobotParameters robot;
  robot.drive = drive;
  robot.wheels = wheels;
  return robot;
}

/// T2 with the first robots alone, and noise of 1 Sigma.
TrialResult drive_t2(const RobotParameters& robot, std::string_view method, int trial) {
  FamilySetup setup = family_setup(Family::t2);
  setup.robot = robot;
  const Scenario scenario = make_scenario(setup, kDefaultSeed, trial);
  return Simulation{scenario, with_method(defaults_for(scenario.robot), method)}.run();
}

class EveryDriveSlow : public testing::TestWithParam<RobotParameters> {};

INSTANTIATE_TEST_SUITE_P(Robots, EveryDriveSlow,
                         testing::Values(robot_with(DriveType::omni, 4), robot_with(DriveType::mecanum),
                                         robot_with(DriveType::differential), robot_with(DriveType::car)),
                         [](const auto& robot) { return std::string{enum_name(robot.param.drive)}; });

// Differential robots and cars reached them in 60 of 60 such trials, in 1.07 and 1.09 times the free time.
TEST_P(EveryDriveSlow, ReachesItsGoalsAmongMovingObstacles) {
  for (int trial = 10000; trial < 10003; ++trial) {
    const TrialResult result = drive_t2(GetParam(), kDefaultMethod, trial);
    EXPECT_EQ(result.outcome, TrialOutcome::success) << "trial " << trial;
    for (const RobotResult& robot : result.robots)
      EXPECT_LT(robot.travel_time_ratio, 1.5) << "trial " << trial;
  }
}

// Methods that plan for robots which move every way: what they plan is followed as such a robot can.
TEST_P(EveryDriveSlow, DrivesWhatOtherMethodsPlan) {
  int home = 0;
  for (const char* method : {"spf_empc", "es2", "orca"}) {
    SCOPED_TRACE(method);
    for (int trial = 10000; trial < 10002; ++trial) {
      const TrialResult result = drive_t2(GetParam(), method, trial);
      double farthest = 0.0;
      for (const RobotResult& robot : result.robots) {
        EXPECT_EQ(robot.stood[static_cast<std::size_t>(StopCause::stuck)], 0.0);
        farthest = std::max(farthest, robot.path_length);
        home += robot.arrived ? 1 : 0;
      }
      EXPECT_GT(farthest, 2.0);
    }
  }
  EXPECT_GE(home, 5);  // of 30: a contact ends the trial for all, and the baselines seldom come through
}

/// F7 for robots of three kinds, each with its own parameters.
TEST(MixedFleetSlow, CrossesF7) {
  FamilySetup setup = family_setup(Family::f7);
  setup.fleet = {robot_with(DriveType::omni), robot_with(DriveType::differential),
                 robot_with(DriveType::car)};
  setup.fleet[0].radius = 0.2;
  setup.fleet[1].radius = 0.5;
  std::vector<AgentParameters> agents;
  for (const RobotParameters& kind : setup.fleet) agents.push_back(defaults_for(kind));
  const Scenario scenario = make_scenario(setup, kDefaultSeed, 10000);
  const TrialResult result = Simulation{scenario, agents}.run();
  EXPECT_EQ(result.outcome, TrialOutcome::success);
  EXPECT_GT(result.peer_clearance, 0.0);
  for (const RobotResult& robot : result.robots) EXPECT_LT(robot.travel_time_ratio, 1.5);
}

TEST(MixedFleet, NeedsParametersForEveryKind) {
  FamilySetup setup = family_setup(Family::swap);
  setup.fleet.resize(3);
  const Scenario scenario = make_scenario(setup, kDefaultSeed, 0);
  EXPECT_THROW((Simulation{scenario, std::vector<AgentParameters>(2)}), std::invalid_argument);
  EXPECT_NO_THROW((Simulation{scenario, std::vector<AgentParameters>(3)}));
  EXPECT_NO_THROW((Simulation{scenario, AgentParameters{}}));
}

TEST(MixedFleet, DrivesEveryRobotOnItsOwnWheels) {
  FamilySetup setup = family_setup(Family::swap);
  setup.layout.robots = 3;
  setup.fleet = {robot_with(DriveType::mecanum), robot_with(DriveType::differential)};
  setup.fleet[1].radius = 0.4;
  const Scenario scenario = make_scenario(setup, kDefaultSeed, 0);
  const World world{scenario};
  for (const int robot : {0, 1, 2}) {
    const bool mecanum = robot != 1;
    EXPECT_EQ(world.plant(robot).drive().inputs(), mecanum ? 4 : 2) << robot;
    EXPECT_EQ(world.commands()[static_cast<std::size_t>(robot)].size(), mecanum ? 4 : 2) << robot;
    EXPECT_EQ(world.robots()[static_cast<std::size_t>(robot)].radius, mecanum ? 0.3 : 0.4) << robot;
  }
}

/// A robot of these sides before a door in a wall across the room.
Scenario before_door(DriveType drive, double length, double width, double door) {
  Scenario scenario = make_scenario(family_setup(Family::t2), kDefaultSeed, 0);
  scenario.robot = robot_with(drive);
  scenario.robot.length = length;
  scenario.robot.width = width;
  scenario.robot = with_radius_of_footprint(scenario.robot);
  scenario.moving.clear();
  scenario.discs.clear();
  scenario.boxes.clear();
  scenario.border = Box{{-4.0, -4.0}, {4.0, 4.0}};
  scenario.walls = {{{0.0, -4.0}, {0.0, -0.5 * door}}, {{0.0, 0.5 * door}, {0.0, 4.0}}};
  scenario.robots.resize(1);
  scenario.robots[0] = {};
  scenario.robots[0].start = {{-2.0, 1.0}, 1.0};
  scenario.robots[0].goal_world = {2.0, 1.0};
  return scenario;
}

// Doors that the disc around the robot does not fit through, 0.12 m wider than the robot; and long robots
// that move every way turn their narrow side to it.
TEST(FootprintsSlow, PassDoorsByTheirWidth) {
  struct Robot {
    DriveType drive;
    double length, width;
  };
  for (const Robot& robot : {Robot{DriveType::differential, 0.51, 0.43}, Robot{DriveType::omni, 1.0, 0.4},
                             Robot{DriveType::mecanum, 0.9, 0.5}}) {
    const Scenario scenario = before_door(robot.drive, robot.length, robot.width, robot.width + 0.12);
    ASSERT_GT(2.0 * scenario.robot.radius, robot.width + 0.12);
    const TrialResult result = Simulation{scenario, defaults_for(scenario.robot)}.run();
    EXPECT_EQ(result.outcome, TrialOutcome::success) << robot.length << " x " << robot.width;
    EXPECT_GT(result.static_clearance, 0.0);
  }
  // The disc alone does not get through.
  Scenario scenario = before_door(DriveType::differential, 0.51, 0.43, 0.55);
  scenario.robot.length = scenario.robot.width = 0.0;
  scenario.simulation.trial.time_limit = 20.0;
  EXPECT_NE((Simulation{scenario, defaults_for(scenario.robot)}.run().outcome), TrialOutcome::success);
}

}  // namespace
}  // namespace spf::sim
