// What happens to robots while a trial runs: goals one after the other, orders, and robots that come and go.
#include "sim/fleet_life.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "sim/families.hpp"
#include "sim/geometry.hpp"
#include "sim/recording.hpp"
#include "sim/simulation.hpp"
#include "sim/task_between.hpp"

namespace spf::sim {
namespace {

using Eigen::Vector2d;

/// One robot a lane of 3 m, each of 8 m to the right.
Scenario lanes(int robots) {
  Scenario scenario;
  scenario.border = Box{{-10.0, -3.0}, {10.0, 3.0 * robots}};
  for (int i = 0; i < robots; ++i) scenario.robots.push_back(task_between({-4.0, 3.0 * i}, {4.0, 3.0 * i}));
  return scenario;
}

FleetEvent event(double time, int robot, FleetAct act) {
  FleetEvent event;
  event.time = time;
  event.order.robot = robot;
  event.order.act = act;
  return event;
}

FleetEvent goal_event(double time, int robot, const Vector2d& position) {
  FleetEvent told = event(time, robot, FleetAct::goal);
  told.order.goal.position_world = position;
  return told;
}

TrialResult run(const Scenario& scenario) {
  SimulationOptions options;
  options.record = true;
  return Simulation{scenario, AgentParameters{}, options}.run();
}

const RecordedRobot& at(const TrialResult& result, double time, std::size_t robot) {
  const auto frame = static_cast<std::size_t>(std::lround(time / result.recording->frame_interval));
  return result.recording->frames.at(frame).robots.at(robot);
}

TEST(FleetLife, GoesToItsGoalsOneAfterTheOther) {
  Scenario scenario = lanes(2);
  scenario.robots[0].next_goals = {{{-4.0, 1.0}, std::nullopt}, {{4.0, -1.0}, std::nullopt}};
  scenario.simulation.trial.goal_pause = 2.0;
  const TrialResult result = run(scenario);
  EXPECT_EQ(result.outcome, TrialOutcome::success);
  EXPECT_EQ(result.robots[0].life.goals_reached, 3);
  EXPECT_EQ(result.robots[1].life.goals_reached, 1);
  // The pauses at goals do not count as time under way.
  EXPECT_NEAR(result.robots[0].life.last_arrival, result.robots[0].travel_time + 4.0, 0.05);
  EXPECT_LT(result.robots[0].travel_time_ratio, 1.1);
  EXPECT_NEAR(result.robots[0].path_length_ratio, 1.0, 0.05);
  ASSERT_EQ(result.recording->goals.size(), 2U);
  EXPECT_EQ(result.recording->goals[1].goal->position_world, Vector2d(4.0, -1.0));
}

TEST(FleetLife, BeginsItsListAnewWhereThatRepeats) {
  Scenario scenario = lanes(1);
  scenario.robots[0].next_goals = {{{-4.0, 1.0}, std::nullopt}};
  scenario.simulation.trial.goals = GoalSupply::repeated;
  scenario.simulation.trial.time_limit = 40.0;
  const TrialResult result = run(scenario);
  EXPECT_EQ(result.outcome, TrialOutcome::success);
  EXPECT_EQ(result.sim_seconds, 40.0);
  EXPECT_GE(result.robots[0].life.goals_reached, 4);  // 8 m at 1 m/s are 9 s
}

TEST(FleetLife, StandsWhileItIsPausedOrStopped) {
  Scenario scenario = lanes(2);
  scenario.events = {event(2.0, 0, FleetAct::pause), event(6.0, 0, FleetAct::resume),
                     event(2.0, 1, FleetAct::stop), event(6.0, 1, FleetAct::release)};
  const TrialResult result = run(scenario);
  EXPECT_EQ(result.outcome, TrialOutcome::success);
  for (std::size_t robot : {0U, 1U}) {
    EXPECT_GT(at(result, 2.0, robot).velocity_world.norm(), 0.9);
    EXPECT_LT(at(result, 3.8, robot).velocity_world.norm(), 0.01);
    EXPECT_LT(
        (at(result, 5.9, robot).pose.position_world - at(result, 3.8, robot).pose.position_world).norm(),
        0.01);
    EXPECT_GT(at(result, 8.0, robot).velocity_world.norm(), 0.9);
    EXPECT_LT(result.robots[robot].life.longest_stand, 0.5);  // it was told to
  }
  EXPECT_EQ(at(result, 4.0, 0).status.reason, StopCause::paused);
  EXPECT_EQ(at(result, 4.0, 1).status.reason, StopCause::emergency_stop);
}

TEST(FleetLife, GoesToAnotherGoalOrToNone) {
  Scenario scenario = lanes(2);
  scenario.events = {goal_event(3.0, 0, {-4.0, 1.0}), event(3.0, 1, FleetAct::cancel)};
  const TrialResult result = run(scenario);
  EXPECT_EQ(result.outcome, TrialOutcome::success);  // nothing more was asked of robot 1
  EXPECT_TRUE(result.robots[0].arrived);
  EXPECT_LT((result.recording->frames.back().robots[0].pose.position_world - Vector2d(-4.0, 1.0)).norm(),
            0.2);
  EXPECT_FALSE(result.robots[1].arrived);
  EXPECT_TRUE(result.robots[1].excused);
  EXPECT_LT(result.recording->frames.back().robots[1].velocity_world.norm(), 0.01);
  EXPECT_LT(result.recording->frames.back().robots[1].pose.position_world.x(), 1.0);
}

TEST(FleetLife, WaitsForAGoalThatIsToComeAfterAllHaveArrived) {
  Scenario scenario = lanes(1);
  scenario.events = {goal_event(20.0, 0, {-4.0, 1.0})};
  const TrialResult result = run(scenario);
  EXPECT_EQ(result.robots[0].life.goals_reached, 2);
  EXPECT_GT(result.sim_seconds, 28.0);
  EXPECT_LT(result.robots[0].travel_time, 20.0);
}

/// Robot 1 crosses the way of robot 0, breaks down on it, and is repaired.
TEST(FleetLife, GoesAroundWhoHasBrokenDown) {
  Scenario scenario = lanes(1);
  scenario.border = square(Vector2d::Zero(), 20.0);
  scenario.robots.push_back(task_between({1.0, -3.0}, {1.0, 4.0}));
  scenario.events = {event(3.6, 1, FleetAct::break_down), event(20.0, 1, FleetAct::repair)};
  const TrialResult result = run(scenario);
  EXPECT_EQ(result.outcome, TrialOutcome::success);
  EXPECT_TRUE(at(result, 10.0, 1).broken);
  EXPECT_LT(std::abs(at(result, 10.0, 1).pose.position_world.y()), 1.5);  // in the way
  EXPECT_LT(at(result, 10.0, 1).velocity_world.norm(), 1e-3);
  EXPECT_TRUE(result.robots[0].arrived);
  EXPECT_LT(result.robots[0].life.last_arrival, 20.0);
  EXPECT_TRUE(result.robots[1].arrived);
  EXPECT_GT(result.robots[1].life.last_arrival, 20.0);
}

TEST(FleetLife, JoinsOnceNobodyIsInTheWayAndLeaves) {
  Scenario scenario = lanes(1);
  RobotTask same = scenario.robots[0];
  same.goal_world.y() += 2.0;
  scenario.robots.push_back(same);
  scenario.events = {event(0.0, 1, FleetAct::join), event(6.0, 1, FleetAct::leave),
                     event(9.0, 1, FleetAct::join)};
  EXPECT_TRUE(problems_of(scenario).empty());
  const TrialResult result = run(scenario);
  EXPECT_EQ(result.outcome, TrialOutcome::success);
  EXPECT_TRUE(at(result, 0.2, 1).gone);  // robot 0 is there
  EXPECT_FALSE(at(result, 5.0, 1).gone);
  EXPECT_TRUE(at(result, 7.0, 1).gone);
  EXPECT_FALSE(at(result, 9.5, 1).gone);
  EXPECT_NEAR(result.robots[1].life.present_time, result.sim_seconds - 3.0, 2.0);
  EXPECT_TRUE(result.robots[1].arrived);
}

TEST(FleetLife, LetsOneJoinAfterTheOther) {
  Scenario scenario = lanes(1);
  for (double aside : {2.0, -2.0}) {
    RobotTask same = scenario.robots[0];
    same.goal_world.y() += aside;
    scenario.robots.push_back(same);
  }
  for (int robot : {0, 1, 2}) scenario.events.push_back(event(1.0, robot, FleetAct::join));
  const TrialResult result = run(scenario);
  EXPECT_EQ(result.outcome, TrialOutcome::success);
  EXPECT_TRUE(at(result, 1.2, 1).gone);
  for (const RobotResult& robot : result.robots) EXPECT_EQ(robot.life.goals_reached, 1);
}

TEST(FleetLife, DoesWhatAConditionAsksFor) {
  Scenario scenario = lanes(2);
  FleetEvent after = event(1.5, 1, FleetAct::leave);
  after.after_robot = 0;
  scenario.robots[1].goal_world.x() = 9.0;
  scenario.events = {after};
  const TrialResult result = run(scenario);
  const double due = result.robots[0].life.last_arrival + 1.5;
  EXPECT_FALSE(at(result, std::floor(10.0 * due) / 10.0 - 0.1, 1).gone);
  EXPECT_TRUE(result.robots[1].excused);
  EXPECT_NEAR(result.sim_seconds, due, 0.1);
}

TEST(FleetLife, TellsPeersOfAnotherPriority) {
  struct Watch : TrialListener {
    void thought(double time, int robot, const RobotInput& input, const RobotAction& /*action*/) override {
      if (robot == 1)
        for (const HeardMessage& message : input.messages)
          (time < 3.0 ? before : after).push_back(message->priority);
    }
    std::vector<int> before, after;
  } watch;
  Scenario scenario = lanes(2);
  FleetEvent told = event(2.5, 0, FleetAct::priority);
  told.order.priority = 7;
  scenario.events = {told};
  SimulationOptions options;
  options.listener = &watch;
  const TrialResult result = Simulation{scenario, AgentParameters{}, options}.run();
  EXPECT_EQ(result.outcome, TrialOutcome::success);
  ASSERT_FALSE(watch.before.empty() || watch.after.empty());
  EXPECT_EQ(watch.before.front(), 0);
  EXPECT_EQ(watch.after.back(), 7);
}

// Walls cut the field in two; each robot's goals are in its own half, apart from walls and from each other.
TEST(FleetLife, DrawsGoalsThatCanBeReached) {
  Scenario scenario = lanes(2);
  scenario.border = square(Vector2d::Zero(), 20.0);
  scenario.boxes = {Box{{-10.0, 1.0}, {10.0, 1.2}}, Box{{-8.0, -8.0}, {-3.0, -3.0}}};
  scenario.simulation.trial.goals = GoalSupply::drawn;
  GoalSource source{scenario};
  const StaticShapes shapes{scenario};
  std::vector<std::optional<host::Goal>> taken{host::Goal{}, host::Goal{}};
  Vector2d low = Vector2d::Constant(100.0), high = -low;
  for (int k = 0; k < 300; ++k)
    for (std::size_t robot : {0U, 1U}) {
      const host::Goal goal = *source.next(robot, scenario.robots[robot].start.position_world, taken);
      EXPECT_GT(shapes.clearance(goal.position_world, 0.3), 0.05);
      EXPECT_EQ(goal.position_world.y() > 1.1, robot == 1);
      EXPECT_GT((goal.position_world - taken[1 - robot]->position_world).norm(), 1.6);
      taken[robot] = goal;
      low = low.cwiseMin(goal.position_world);
      high = high.cwiseMax(goal.position_world);
    }
  EXPECT_LT(low.maxCoeff(), -9.0);
  EXPECT_GT(high.minCoeff(), 9.0);
}

TEST(FleetLife, RepeatsBitForBitWithOrWithoutAnAudience) {
  FamilySetup setup = family_setup(Family::field);
  setup.layout.robots = 8;
  Scenario scenario = make_scenario(setup, kDefaultSeed, 10000);
  scenario.simulation.trial.goals = GoalSupply::drawn;
  scenario.simulation.trial.time_limit = 40.0;
  scenario.events = {event(4.0, 0, FleetAct::break_down), event(12.0, 0, FleetAct::repair),
                     event(6.0, 1, FleetAct::leave), event(15.0, 1, FleetAct::join)};
  const TrialResult recorded = run(scenario);
  const TrialResult alone = Simulation{scenario, AgentParameters{}}.run();
  EXPECT_EQ(recorded.digest, alone.digest);
  EXPECT_EQ(recorded.outcome, TrialOutcome::success);
  int goals = 0;
  for (const RobotResult& robot : recorded.robots) goals += robot.life.goals_reached;
  EXPECT_GT(goals, static_cast<int>(scenario.robots.size()));
  scenario.seed += 1;
  EXPECT_NE(Simulation(scenario, AgentParameters{}).run().digest, alone.digest);
}

TEST(FleetLife, ReportsARobotThatNeverGetsOnAsOverTime) {
  Scenario scenario = lanes(1);
  scenario.boxes = {Box{{0.0, -3.0}, {0.5, 3.0}}};  // from border to border
  scenario.simulation.trial.goals = GoalSupply::repeated;
  scenario.simulation.trial.time_limit = 200.0;
  const TrialResult result = run(scenario);
  EXPECT_EQ(result.outcome, TrialOutcome::timeout);
  EXPECT_GT(result.robots[0].life.longest_stand, 60.0);
}

TEST(FleetLife, NamesEventsThatCannotBe) {
  Scenario scenario = lanes(1);
  scenario.boxes = {Box{{0.0, 1.5}, {1.0, 2.5}}};
  FleetEvent stranger = event(1.0, 0, FleetAct::pause);
  stranger.after_robot = 4;
  scenario.events = {event(-1.0, 0, FleetAct::pause), event(1.0, 3, FleetAct::pause), stranger,
                     goal_event(1.0, 0, {0.5, 2.0}), goal_event(1.0, 0, Vector2d::Constant(std::nan("")))};
  scenario.robots[0].next_goals = {{{20.0, 0.0}, std::nullopt}};
  std::vector<std::string> where;
  for (const ScenarioProblem& problem : problems_of(scenario)) where.push_back(problem.where);
  const std::vector<std::string> expected{"robots[0].next_goals[0]", "events[0].at",   "events[1].robot",
                                          "events[2].after.robot",   "events[3].goal", "events[4].goal"};
  EXPECT_EQ(where, expected);
}

}  // namespace
}  // namespace spf::sim
