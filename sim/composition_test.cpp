// One robot, composed once: what a robot of a trial was given makes it command the same, bit for bit, in one
// process and split into two that exchange nothing but its plan and what was applied to its wheels.
#include <gtest/gtest.h>

#include <functional>

#include "host/split_host.hpp"
#include "sim/families.hpp"
#include "sim/input_log.hpp"
#include "sim/simulation.hpp"

namespace spf::sim {
namespace {

/// Sensed maps, peers, an obstacle, and poses that are not quite right.
Scenario sensed_swap() {
  Scenario scenario = make_scenario(family_setup(Family::f7), kDefaultSeed, 10000);
  scenario.simulation.pose_noise.position_sigma = 0.02;
  scenario.simulation.pose_noise.heading_sigma = 0.01;
  scenario.simulation.trial.after_contact = AfterContact::go_on;
  scenario.simulation.trial.time_limit = 16.0;
  return scenario;
}

constexpr int kRobot = 3;
using Commands = std::vector<Eigen::Vector3d>;
/// What a base makes of a command.
using Base = std::function<Eigen::Vector3d(const Eigen::Vector3d&)>;

Eigen::Vector3d obeys(const Eigen::Vector3d& command) {
  return command;
}
Eigen::Vector3d slower(const Eigen::Vector3d& command) {
  return 0.7 * command;
}

class CompositionTest : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    InputLog log{kRobot};
    SimulationOptions options;
    options.listener = &log;
    (void)Simulation{sensed_swap(), AgentParameters{}, options}.run();
    ticks_ = log.ticks();
  }
  static void TearDownTestSuite() { ticks_.clear(); }

  [[nodiscard]] static Commands simulated() {
    Commands commands;
    for (const LoggedTick& tick : ticks_)
      if (tick.action.controlled) commands.push_back(tick.action.wheel_speeds);
    return commands;
  }

  [[nodiscard]] Commands in_one_process(const Base& base) const {
    host::RobotHost robot{kRobot, agent, host};
    robot.planner().set_goal({task.goal_world, task.goal_heading});
    robot.start(map, task.start, 0.0);
    Commands commands;
    for (const LoggedTick& tick : ticks_) {
      robot.add_pose(tick.input.pose, tick.time);
      for (const HeardMessage& message : tick.input.messages) robot.add_message(message, tick.time);
      for (const host::SensedWorld& seen : tick.input.seen) robot.add_observation(seen, tick.time);
      const host::RobotOutput output = robot.step(tick.time);
      if (!output.controlled) continue;
      commands.push_back(output.wheel_speeds);
      robot.applied(tick.time, base(output.wheel_speeds));
    }
    return commands;
  }

  /// `tell` is what the planner's process hears of a command.
  [[nodiscard]] Commands split(const Base& base, const Base& tell) const {
    host::PlannerProcess planner{kRobot, agent, host};
    host::TrackerProcess tracker{kRobot, agent, host};
    planner.planner().set_goal({task.goal_world, task.goal_heading});
    planner.planner().start(map, task.start, 0.0);
    Commands commands;
    for (const LoggedTick& tick : ticks_) {
      planner.add_pose(tick.input.pose, tick.time);
      tracker.add_pose(tick.input.pose, tick.time);
      for (const HeardMessage& message : tick.input.messages) planner.add_message(message, tick.time);
      for (const host::SensedWorld& seen : tick.input.seen) {
        if (seen.observation.scan)
          tracker.add_scan(seen.observation.time, *seen.observation.scan, Pose2{}, tick.time);
        planner.add_observation(seen, tick.time);
      }
      const host::PlannerOutput& output = planner.step(tick.time);
      if (output.planned) tracker.add_plan(output.plan, tick.time);
      if (!tick.action.controlled) continue;  // its timer
      const Eigen::Vector3d command = tracker.step(tick.time).wheel_speeds;
      commands.push_back(command);
      tracker.applied(tick.time, base(command));
      planner.add_command(tick.time, tell(command), tick.time, tracker.tracker().command().guard.action);
    }
    return commands;
  }

  const Scenario scenario = sensed_swap();
  const AgentParameters agent = agent_parameters_for(scenario, AgentParameters{});
  host::HostParameters host = host_parameters_for(scenario, agent);
  const OccupancyMap map = robot_map(scenario);
  const RobotTask task = scenario.robots[kRobot];

 private:
  static std::vector<LoggedTick> ticks_;
};

std::vector<LoggedTick> CompositionTest::ticks_;

TEST_F(CompositionTest, TheTrialWasWorthPlaying) {
  const Commands commands = simulated();
  ASSERT_EQ(commands.size(), 320U);  // 16 s at 20 Hz
  double fastest = 0.0;
  for (const Eigen::Vector3d& command : commands) fastest = std::max(fastest, command.norm());
  EXPECT_GT(fastest, 0.5);
}

TEST_F(CompositionTest, PlayedAgainTheRobotCommandsWhatItDidInTheSimulator) {
  EXPECT_EQ(in_one_process(obeys), simulated());
}

TEST_F(CompositionTest, SplitIntoProcessesItCommandsTheSame) {
  EXPECT_EQ(split(obeys, obeys), simulated());
}

TEST_F(CompositionTest, WithItsGuardsUpItCommandsTheSameEitherWay) {
  host.trusts_peers = false;
  host.relies_on_scan = true;
  const Commands one = in_one_process(obeys);
  EXPECT_EQ(split(obeys, obeys), one);
}

TEST_F(CompositionTest, UnderItsGuardItCommandsTheSameEitherWay) {
  host.guard.enabled = true;
  host.guard.margin = 0.5;  // so that it has something to do
  const Commands one = in_one_process(obeys);
  EXPECT_NE(one, simulated());
  EXPECT_EQ(split(obeys, obeys), one);
}

TEST_F(CompositionTest, WhatCountsIsTheAppliedCommandNotTheOneThatWasGiven) {
  const Commands one = in_one_process(slower);
  EXPECT_NE(one, simulated());
  EXPECT_EQ(split(slower, slower), one);
  EXPECT_NE(split(slower, obeys), one);
}

}  // namespace
}  // namespace spf::sim
