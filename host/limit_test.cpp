// Whatever happens to a robot, its commands keep its limits; and one that does not move as it is told says
// so, stops pushing and tries again. In one process and split.
#include <gtest/gtest.h>

#include "host/bench_test.hpp"
#include "spf/math/random_stream.hpp"

namespace spf::host {
namespace {

constexpr double kAtRest = 0.005;  // [m/s]

/// What is allowed, as a share of the limits: 1 % of speed and 10 % of change are left to the controller.
void expect_kept_limits(const Bench& bench) {
  EXPECT_LE(bench.largest.speed, 1.01);
  EXPECT_LE(bench.largest.acceleration, 1.1);
  EXPECT_LE(bench.largest.yaw_rate, 1.01);
  EXPECT_LE(bench.largest.yaw_acceleration, 1.1);
  EXPECT_LE(bench.largest.wheel_speed, 1.0 + 1e-9);
}

/// Robots that are fast, slow, and turn as they go.
AgentParameters robot_kind(int number) {
  AgentParameters agent;
  if (number == 1) agent.robot.max_speed = 0.3;
  if (number == 2) agent.heading_mode = HeadingMode::motion;
  return agent;
}
constexpr int kRobotKinds = 3;

bool gets_going(Bench& bench, double longest) {
  for (const double from = bench.time; bench.time < from + longest;) {
    bench.tick();
    if (bench.speed() > 0.9 * bench.agent.robot.max_speed && bench.cause() == StopCause::none) return true;
  }
  return false;
}

class Limits : public testing::TestWithParam<Arrangement> {};

INSTANTIATE_TEST_SUITE_P(Both, Limits, testing::Values(Arrangement::one_process, Arrangement::split),
                         name_of);

TEST_P(Limits, AreKeptWhereAllIsWell) {
  for (int number = 0; number < kRobotKinds; ++number) {
    Bench bench{GetParam(), {}, 0, robot_kind(number)};
    bench.drive();
    bench.planner.set_goal({{0.0, 4.0}, 2.0});
    bench.run(12.0);
    expect_kept_limits(bench);
    EXPECT_EQ(bench.localiser().motion().failures(), 0);
  }
}

TEST_P(Limits, AreKeptAfterARelocalisation) {
  for (int number = 0; number < kRobotKinds; ++number)
    for (const Eigen::Vector2d& jump : {Eigen::Vector2d{1.0, 0.0}, {-1.0, 0.5}, {0.0, 2.0}, {0.3, 0.3}}) {
      SCOPED_TRACE(testing::Message() << number << ": " << jump.transpose());
      Bench bench{GetParam(), {}, 0, robot_kind(number)};
      bench.drive();
      const double heading = 0.3;
      bench.distort = [&](const Pose2& truth) {
        return Pose2{truth.position_world + jump, truth.heading + heading};
      };
      bench.run(2.0);
      EXPECT_TRUE(gets_going(bench, 10.0)) << bench.reason() << ", " << to_string(bench.cause());
      expect_kept_limits(bench);
    }
}

TEST_P(Limits, NoiseOfThePosesDoesNotShakeTheCommands) {
  for (int number = 0; number < kRobotKinds; ++number) {
    SCOPED_TRACE(number);
    Bench bench{GetParam(), {}, 0, robot_kind(number)};
    bench.drive();
    RandomStream random{1};
    bench.distort = [&](const Pose2& truth) {
      return Pose2{truth.position_world + 0.02 * random.normal2(), truth.heading + 0.01 * random.normal()};
    };
    double changed = 0.0;  // [m/s] in all
    const double period = bench.agent.tracker.control_period;
    const int commands = 100;
    for (int i = 0; i < commands; ++i) {
      const Eigen::Vector2d before = bench.velocity_world;
      bench.run(period);
      changed += (bench.velocity_world - before).norm();
    }
    // On average far less than what the limits would let through.
    EXPECT_LT(changed / commands, 0.5 * bench.agent.robot.max_acceleration * period);
    RecordProperty("mean_change_" + std::to_string(number), std::to_string(changed / commands));
    expect_kept_limits(bench);
    EXPECT_GT(bench.speed(), 0.7 * bench.agent.robot.max_speed) << bench.reason();
    EXPECT_EQ(bench.localiser().motion().failures(), 0);
  }
}

TEST_P(Limits, AHeldRobotSaysSoStopsPushingAndGoesOnWhenItIsLetGo) {
  for (int number = 0; number < kRobotKinds; ++number) {
    SCOPED_TRACE(number);
    Bench bench{GetParam(), {}, 0, robot_kind(number)};
    bench.drive();
    bench.grip = 0.0;
    const double from = bench.time;
    while (bench.time < from + 5.0 && bench.cause() != StopCause::stuck) bench.tick();
    EXPECT_GE(bench.time - from, 0.7);
    EXPECT_LE(bench.time - from, 1.3);
    const double speed = bench.speed();
    bench.run(speed / bench.agent.robot.max_acceleration + 0.1);
    EXPECT_EQ(bench.speed(), 0.0);
    EXPECT_EQ(bench.reason(), "stuck");
    EXPECT_EQ(bench.cause(), StopCause::stuck);
    bench.run(from + 4.0 - bench.time);
    bench.grip = 1.0;
    EXPECT_TRUE(gets_going(bench, 12.0)) << bench.reason() << ", " << to_string(bench.cause());
    expect_kept_limits(bench);
  }
}

// Held for ever: the longer it lasts, the less it pushes.
TEST_P(Limits, ARobotThatStaysStuckPushesLessAndLess) {
  Bench bench{GetParam()};
  bench.drive();
  bench.grip = 0.0;
  const auto time_pushing = [&](double seconds) {
    double pushing = 0.0;
    for (const double from = bench.time; bench.time < from + seconds;) {
      bench.tick();
      if (bench.speed() > kAtRest) pushing += Bench::kTick;
    }
    return pushing;
  };
  const double at_first = time_pushing(10.0);
  time_pushing(20.0);
  const double at_last = time_pushing(40.0) / 4.0;
  EXPECT_LT(at_last, 0.75 * at_first);
  EXPECT_LT(at_last, 0.25 * 10.0);
  EXPECT_GT(at_last, 0.0);  // it goes on trying
  expect_kept_limits(bench);
}

TEST_P(Limits, ARobotThatIsWedgedBacksOffAndReportsNoArrival) {
  Bench bench{GetParam()};
  bench.drive();
  const double wall = bench.pose.position_world.x() + 0.5;  // that no sensor sees
  bool backed_off = false;
  for (int i = 0; i < 30 * 100; ++i) {
    bench.grip = bench.velocity_world.x() > 0.0 && bench.pose.position_world.x() >= wall ? 0.0 : 1.0;
    bench.tick();
    backed_off = backed_off || bench.reason() == "backs off";
    EXPECT_NE(bench.reason(), "arrived");
    if (backed_off && bench.pose.position_world.x() < wall - 0.4) break;
  }
  EXPECT_TRUE(backed_off);
  EXPECT_LT(bench.pose.position_world.x(), wall - 0.4);
  bench.planner.set_goal({{-3.0, 0.0}, std::nullopt});
  EXPECT_TRUE(gets_going(bench, 6.0)) << bench.reason();
  EXPECT_LT(bench.velocity_world.x(), 0.0);
  expect_kept_limits(bench);
}

TEST_P(Limits, APushedRobotGoesOn) {
  for (const Eigen::Vector2d& push : {Eigen::Vector2d{0.0, 0.8}, {0.5, 0.5}, {0.8, 0.0}}) {
    SCOPED_TRACE(testing::Message() << push.transpose());
    Bench bench{GetParam()};
    bench.drive();
    bench.push_world = push;
    bench.run(1.5);
    bench.push_world.setZero();
    EXPECT_TRUE(gets_going(bench, 8.0)) << bench.reason() << ", " << to_string(bench.cause());
    expect_kept_limits(bench);
  }
}

TEST_P(Limits, ARobotThatDriftsSlowlyOrSlipsIsNotStuck) {
  for (const double grip : {1.0, 0.7}) {
    Bench bench{GetParam()};
    bench.drive();
    bench.grip = grip;
    bench.push_world = {-0.05, 0.05};
    for (int i = 0; i < 800; ++i) {
      bench.tick();
      ASSERT_NE(bench.cause(), StopCause::stuck) << grip;
    }
    EXPECT_EQ(bench.localiser().motion().failures(), 0);
    expect_kept_limits(bench);
  }
}

TEST_P(Limits, ARobotOnIceIsStuckAndKeepsItsLimitsWhenItGripsAgain) {
  Bench bench{GetParam()};
  bench.drive();
  bench.grip = 0.1;
  bool stuck = false;
  for (int i = 0; i < 500; ++i) {
    bench.tick();
    stuck = stuck || bench.reason() == "stuck";
  }
  EXPECT_TRUE(stuck);
  bench.grip = 1.0;
  EXPECT_TRUE(gets_going(bench, 12.0)) << bench.reason() << ", " << to_string(bench.cause());
  expect_kept_limits(bench);
}

// It moves as it is told, and is carried back again and again: it gets nowhere in ten seconds.
TEST_P(Limits, ARobotThatGetsNowhereSaysSo) {
  AgentParameters agent;
  agent.robot.max_speed = 0.25;
  Bench bench{GetParam(), {}, 0, agent};
  ASSERT_TRUE(bench.planner.set_goal({{5.0, 0.0}, std::nullopt}));
  bench.run(3.5);
  const Eigen::Vector2d begun = bench.pose.position_world;
  bool stuck = false;
  const double from = bench.time;
  while (bench.time < from + 14.0 && !stuck) {
    bench.tick();
    if (bench.pose.position_world.x() > begun.x() + 0.23) bench.pose.position_world = begun;
    bench.planner.set_goal({{5.0, 0.0}, std::nullopt});  // a client that repeats itself changes nothing
    stuck = bench.reason() == "stuck";
  }
  EXPECT_TRUE(stuck);
  EXPECT_GE(bench.time - from, 9.0);
  EXPECT_EQ(bench.localiser().motion().failures(), 0);
  EXPECT_TRUE(gets_going(bench, 6.0)) << bench.reason() << ", " << to_string(bench.cause());
  expect_kept_limits(bench);
}

TEST_P(Limits, WaitingIsNotBeingStuck) {
  Bench bench{GetParam()};
  bench.planner.set_goal({{3.0, 0.0}, std::nullopt});
  const auto never_stuck = [&](double seconds) {
    for (const double from = bench.time; bench.time < from + seconds;) {
      bench.tick();
      ASSERT_NE(bench.reason(), "stuck");
      ASSERT_NE(bench.cause(), StopCause::stuck);
    }
  };
  never_stuck(25.0);  // it arrives and stays
  EXPECT_EQ(bench.reason(), "arrived");
  bench.set_switches({false, true});
  bench.planner.set_goal({{0.0, 0.0}, std::nullopt});
  never_stuck(15.0);
  bench.set_switches({});
  bench.planner.cancel();
  never_stuck(15.0);
  bench.planner.set_goal({{0.0, 0.0}, std::nullopt});
  never_stuck(8.0);
  EXPECT_EQ(bench.reason(), "arrived");
}

}  // namespace
}  // namespace spf::host
