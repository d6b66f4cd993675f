#include "host/goal_supervisor.hpp"

#include <gtest/gtest.h>

#include "host/bench_test.hpp"

namespace spf::host {

/// So that failed comparisons can be read.
inline void PrintTo(GoalOutcome outcome, std::ostream* stream) {
  *stream << to_string(outcome);
}

namespace {

constexpr double kTimeout = 3.0;  // [s]
constexpr double kStep = 0.1;     // [s]

/// A goal in the open, on a robot that is on its way.
GoalFacts on_the_way() {
  GoalFacts facts;
  facts.map_known = true;
  facts.access = GoalAccess::open;
  facts.distance = 3.0;
  return facts;
}

GoalFacts at_the_goal() {
  GoalFacts facts = on_the_way();
  facts.arrived = true;
  facts.distance = 0.01;
  return facts;
}

GoalFacts cut_off() {
  GoalFacts facts = on_the_way();
  facts.access = GoalAccess::cut_off;
  return facts;
}

class Supervised : public testing::Test {
 protected:
  void SetUp() override { supervisor.begin(kTimeout); }
  /// Seconds until something is decided, with these facts; at most `longest`.
  double time_until_decided(const GoalFacts& facts, double longest = 100.0) {
    const double from = now;
    while (now < from + longest - 1e-9) {
      now += kStep;
      if (supervisor.step(facts, now) != GoalOutcome::pursued) return now - from;
    }
    return std::numeric_limits<double>::infinity();
  }
  void expect_waits_for_its_timeout(const GoalFacts& facts) {
    const double waited = time_until_decided(facts);
    EXPECT_GE(waited, kTimeout);  // from the first sight of it
    EXPECT_LE(waited, kTimeout + 2.0 * kStep + 1e-6);
  }
  double now = 50.0;
  GoalSupervisor supervisor{AgentParameters{}, HostParameters{}};
};

TEST_F(Supervised, NothingIsDecidedBeforeThereIsAGoal) {
  GoalSupervisor idle{AgentParameters{}, HostParameters{}};
  EXPECT_EQ(idle.step(at_the_goal(), 1.0), GoalOutcome::none);
  EXPECT_EQ(idle.step(cut_off(), 100.0), GoalOutcome::none);
}

TEST_F(Supervised, AGoalIsReachedOnceTheRobotStandsThereAndPointsThere) {
  EXPECT_TRUE(std::isinf(time_until_decided(on_the_way())));
  GoalFacts near = at_the_goal();
  near.arrived = false;  // it drives past
  EXPECT_EQ(supervisor.step(near, now), GoalOutcome::pursued);
  GoalFacts behind = at_the_goal();
  behind.distance = 0.06;  // its plan has ended, it has not
  EXPECT_EQ(supervisor.step(behind, now), GoalOutcome::pursued);
  behind.position_sigma = 0.01;
  GoalFacts turning = at_the_goal();
  turning.heading_error = 0.11;
  EXPECT_EQ(supervisor.step(turning, now), GoalOutcome::pursued);
  EXPECT_EQ(supervisor.step(behind, now), GoalOutcome::reached);
  EXPECT_EQ(supervisor.step(cut_off(), now + 100.0), GoalOutcome::reached);  // it stays so
}

TEST_F(Supervised, TolerancesChangeAtRunTime) {
  AgentParameters agent;
  HostParameters host;
  agent.team.goal_tolerance = 0.5;
  host.goal_heading_tolerance = 1.0;
  GoalFacts facts = at_the_goal();
  facts.distance = 0.4;
  facts.heading_error = 0.9;
  EXPECT_EQ(supervisor.step(facts, now), GoalOutcome::pursued);
  supervisor.reconfigure(agent, host);
  EXPECT_EQ(supervisor.step(facts, now), GoalOutcome::reached);
}

TEST_F(Supervised, ThatTheMapDoesNotHoldTheGoalIsSaidAtOnceButNotBeforeThereIsAMap) {
  GoalFacts beyond;
  beyond.on_map = false;
  EXPECT_TRUE(std::isinf(time_until_decided(beyond)));
  beyond.map_known = true;
  EXPECT_EQ(supervisor.step(beyond, now), GoalOutcome::off_map);
  supervisor.begin(kTimeout);
  GoalFacts inside = on_the_way();
  inside.clearance = RobotParameters{}.radius - 0.01;
  EXPECT_EQ(supervisor.step(inside, now), GoalOutcome::in_wall);
  EXPECT_TRUE(given_up(supervisor.outcome()));
}

TEST_F(Supervised, NoPathIsSaidAfterItHasBeenSoForItsTimeout) {
  expect_waits_for_its_timeout(cut_off());
  EXPECT_EQ(supervisor.outcome(), GoalOutcome::no_path);
}

TEST_F(Supervised, TimeoutStartsAnewWhereAPathOpensOrTheRobotIsHeldUp) {
  for (int i = 0; i < 5; ++i) {
    EXPECT_TRUE(std::isinf(time_until_decided(cut_off(), kTimeout - kStep)));
    GoalFacts between = on_the_way();
    if (i % 2 == 1) between.access.reset();  // paused, without a pose, ...
    EXPECT_EQ(supervisor.step(between, now), GoalOutcome::pursued);
  }
}

TEST_F(Supervised, TimeoutSurvivesAClockThatGoesBack) {
  EXPECT_TRUE(std::isinf(time_until_decided(cut_off(), 2.0)));
  now -= 40.0;
  expect_waits_for_its_timeout(cut_off());
}

TEST_F(Supervised, ARobotDrivesAsNearToABlockedGoalAsItCanBeforeItsTimeoutRuns) {
  GoalFacts facts = on_the_way();
  facts.access = GoalAccess::blocked;
  EXPECT_TRUE(std::isinf(time_until_decided(facts)));
  facts.stands_short = true;
  expect_waits_for_its_timeout(facts);
  EXPECT_EQ(supervisor.outcome(), GoalOutcome::in_wall);
}

TEST_F(Supervised, AGoalThatNobodyWaitsForIsNotGivenUpForWantOfAWay) {
  supervisor.begin(GoalSupervisor::kForEver);
  EXPECT_TRUE(std::isinf(time_until_decided(cut_off(), 1000.0)));
  EXPECT_EQ(supervisor.step(at_the_goal(), now), GoalOutcome::reached);
}

TEST_F(Supervised, AGoalThatIsTakenAwaySaysSoUnlessItWasDecidedBefore) {
  supervisor.end(GoalOutcome::preempted);
  EXPECT_EQ(supervisor.step(at_the_goal(), now), GoalOutcome::preempted);
  supervisor.begin(kTimeout);
  supervisor.end(GoalOutcome::cancelled);
  EXPECT_EQ(supervisor.outcome(), GoalOutcome::cancelled);
  supervisor.begin(kTimeout);
  EXPECT_EQ(supervisor.step(at_the_goal(), now), GoalOutcome::reached);
  supervisor.end(GoalOutcome::cancelled);
  EXPECT_EQ(supervisor.outcome(), GoalOutcome::reached);
}

// ---- with a robot -----------------------------------------------------------------------------------------

class GoalsOnTheBench : public testing::TestWithParam<Arrangement> {
 protected:
  GoalsOnTheBench() : bench{GetParam()} {}

  void send(const Goal& goal, double timeout = kTimeout) {
    ASSERT_TRUE(bench.planner.set_goal(goal));
    supervisor.begin(timeout);
  }
  /// Runs until something is decided.
  GoalOutcome outcome_within(double seconds) {
    for (const double end = bench.time + seconds; bench.time < end;) {
      bench.tick();
      const Localiser& localiser = bench.split ? bench.planning.localiser() : bench.robot.localiser();
      const GoalOutcome outcome =
          supervisor.step(goal_facts(bench.planner, &localiser, bench.now), bench.now);
      if (outcome != GoalOutcome::pursued) return outcome;
    }
    return supervisor.outcome();
  }
  [[nodiscard]] double distance_to(const Eigen::Vector2d& position) const {
    return (bench.pose.position_world - position).norm();
  }
  /// Open ground, but for a closed room around (6, 0), of walls 0.5 m thick.
  [[nodiscard]] static OccupancyMap map_with_closed_room() {
    OccupancyMap map = open_map();
    map.add_box({4.0, -2.0}, {8.0, -1.5});
    map.add_box({4.0, 1.5}, {8.0, 2.0});
    map.add_box({4.0, -2.0}, {4.5, 2.0});
    map.add_box({7.5, -2.0}, {8.0, 2.0});
    return map;
  }

  Bench bench;
  GoalSupervisor supervisor{AgentParameters{}, HostParameters{}};
};

INSTANTIATE_TEST_SUITE_P(Both, GoalsOnTheBench, testing::Values(Arrangement::one_process, Arrangement::split),
                         name_of);

TEST_P(GoalsOnTheBench, IsReachedWithItsHeading) {
  for (const double heading : {2.5, -1.0}) {
    const Eigen::Vector2d position{heading, 1.0};
    send({position, heading});
    EXPECT_EQ(outcome_within(15.0), GoalOutcome::reached);
    EXPECT_LT(distance_to(position), 0.05);
    EXPECT_NEAR(bench.pose.heading, heading, 0.1);
    EXPECT_LT(bench.speed(), 0.02);
  }
  send({{-1.0, 1.0}, 2.0});  // on the spot
  EXPECT_EQ(outcome_within(6.0), GoalOutcome::reached);
  EXPECT_NEAR(bench.pose.heading, 2.0, 0.1);
}

TEST_P(GoalsOnTheBench, IsNotReachedByAPlanThatTheRobotDoesNotFollow) {
  send({{3.0, 0.0}, std::nullopt});
  bench.distort = [](const Pose2& truth) {  // as if it were held up before its goal
    return Pose2{{std::min(truth.position_world.x(), 2.8), truth.position_world.y()}, truth.heading};
  };
  EXPECT_EQ(outcome_within(12.0), GoalOutcome::pursued);
}

TEST_P(GoalsOnTheBench, IsGivenUpAtOnceWhereTheMapForbidsIt) {
  bench.planner.set_map(map_with_closed_room());
  send({{4.2, 0.0}, std::nullopt});
  EXPECT_EQ(outcome_within(0.1), GoalOutcome::in_wall);
  send({{50.0, 0.0}, std::nullopt});
  EXPECT_EQ(outcome_within(0.1), GoalOutcome::off_map);
}

TEST_P(GoalsOnTheBench, IsGivenUpWhenNoPathHasLedThereForItsTimeout) {
  bench.run(1.0);  // the robot has started
  bench.planner.set_map(map_with_closed_room());
  bench.run(3.0);  // and has again
  send({{6.0, 0.0}, std::nullopt});
  const double sent = bench.time;
  EXPECT_EQ(outcome_within(20.0), GoalOutcome::no_path);
  EXPECT_GE(bench.time - sent, kTimeout);
  EXPECT_LE(bench.time - sent, kTimeout + 0.2);
  bench.planner.cancel();
  bench.run(2.0);
  EXPECT_LT(bench.speed(), 0.005);
  EXPECT_EQ(bench.reason(), "no goal");
}

TEST_P(GoalsOnTheBench, IsPursuedOnAfterAPause) {
  bench.drive();
  send({{8.0, 2.0}, std::nullopt});
  bench.run(0.5);
  bench.hardest_braking = 0.0;
  bench.set_switches({false, true});
  bench.run(2.0);
  EXPECT_LT(bench.speed(), 0.005);
  EXPECT_LT(bench.hardest_braking, 1.6);
  const Eigen::Vector2d stood = bench.pose.position_world;
  EXPECT_EQ(outcome_within(30.0), GoalOutcome::pursued);  // however long
  EXPECT_LT(distance_to(stood), 0.005);
  bench.set_switches({false, false});
  EXPECT_EQ(outcome_within(15.0), GoalOutcome::reached);
  EXPECT_LT(distance_to({8.0, 2.0}), 0.05);
}

TEST_P(GoalsOnTheBench, ALimitOfSpeedBelowThePresentOneBrakesWithinTheLimitsAndIsKept) {
  bench.drive();
  const double changed = bench.time;
  bench.planner.reconfigure(slowed_to(AgentParameters{}, 0.3));
  while (bench.speed() > 0.33 && bench.time < changed + 3.0) {
    bench.tick();
    EXPECT_LE(bench.planner.agent()->committed().max_acceleration(), 1.1);
  }
  EXPECT_GE(bench.time - changed, 0.67 / 1.1);
  EXPECT_LE(bench.time - changed, 0.67 / 1.0 + 0.4);  // a tenth until it plans, and ramps
  bench.run(1.0);  // its wheels obey at once, which the controller does not reckon with
  double highest = 0.0;
  for (const double end = bench.time + 4.0; bench.time < end;) {
    bench.tick();
    highest = std::max(highest, bench.speed());
  }
  EXPECT_LE(highest, 0.3 * 1.05);
  EXPECT_GT(bench.speed(), 0.25);
  bench.planner.reconfigure(AgentParameters{});
  bench.run(3.0);
  EXPECT_GT(bench.speed(), 0.9);
}

TEST_P(GoalsOnTheBench, ParametersThatContradictOthersAreRefused) {
  AgentParameters changed;
  changed.team.plan_period = 2.0 * bench.host.plan_silence;
  changed.robot.max_speed = 0.3;
  EXPECT_THROW(bench.planner.reconfigure(changed), std::invalid_argument);
  EXPECT_EQ(bench.planner.parameters().robot.max_speed, AgentParameters{}.robot.max_speed);
}

TEST_P(GoalsOnTheBench, ANewStartKeepsToTheLimitOfSpeed) {
  bench.planner.reconfigure(slowed_to(AgentParameters{}, 0.3));
  send({{8.0, 0.0}, std::nullopt});
  double highest = 0.0;
  for (const double end = bench.time + 8.0; bench.time < end;) {
    bench.tick();
    highest = std::max(highest, bench.speed());
  }
  EXPECT_GT(highest, 0.25);
  EXPECT_LE(highest, 0.3 * 1.05);
}

}  // namespace
}  // namespace spf::host
