// The guard as part of a robot: what it does to commands, what planner and people are told, and how the robot
// goes on.
#include <gtest/gtest.h>

#include "host/bench_test.hpp"

namespace spf::host {
namespace {

class GuardedRobot : public testing::TestWithParam<Arrangement> {};

INSTANTIATE_TEST_SUITE_P(Both, GuardedRobot, testing::Values(Arrangement::one_process, Arrangement::split),
                         name_of);

TEST_P(GuardedRobot, StopsForWhatAppearsAndFindsTheWayOn) {
  for (const double ahead : {0.75, 0.9, 1.2}) {
    SCOPED_TRACE(ahead);
    Bench bench{GetParam()};
    bench.drive();
    bench.pillars = {{bench.pose.position_world + Eigen::Vector2d{0.3 + ahead + 0.4, 0.05}, 0.4}};
    bench.run(1.5);
    EXPECT_GT(bench.clearance, 0.0);
    bench.run(12.0);
    EXPECT_GT(bench.clearance, 0.0);
    EXPECT_GT(bench.pose.position_world.x(), bench.pillars[0].center.x() + 0.7)
        << bench.reason() << ", " << to_string(bench.cause());
  }
}

// What the planner cannot know: its sensors do not show it.
TEST(GuardedSplitRobot, IsHeldBeforeWhatItsPlannerDoesNotSee) {
  HostParameters parameters;
  parameters.relies_on_scan = false;
  Bench bench{Arrangement::split, parameters};
  bench.planner_sees_scans = false;
  bench.pillars = {{{6.0, 0.1}, 0.3}};
  ASSERT_TRUE(bench.planner.set_goal({{12.0, 0.0}, std::nullopt}));
  bench.run(12.0);
  EXPECT_GT(bench.clearance, 0.0);
  EXPECT_LT(bench.clearance, 0.12);
  EXPECT_EQ(bench.cause(), StopCause::in_the_way);
  EXPECT_EQ(bench.reason(), "obstacle in the way");
  EXPECT_EQ(bench.planner.status().state, PeerState::stopped);
  EXPECT_EQ(bench.speed(), 0.0);
  ASSERT_NE(bench.tracker.guard(), nullptr);
  EXPECT_EQ(bench.tracker.guard()->counts().stops, 1u);
  EXPECT_EQ(bench.tracker.command().guard.action, GuardAction::stops);
  // Its plan waits for it where it stands.
  EXPECT_LT((bench.planner.agent()->committed().position(bench.now) - bench.pose.position_world).norm(), 0.1);
  // Another goal leads away from it.
  const Eigen::Vector2d stood = bench.pose.position_world;
  ASSERT_TRUE(bench.planner.set_goal({{stood.x() - 2.0, 0.0}, std::nullopt}));
  bench.run(1.5);
  EXPECT_LT(bench.pose.position_world.x(), stood.x() - 0.5);
  // And when it is gone the robot goes on by itself.
  ASSERT_TRUE(bench.planner.set_goal({{12.0, 0.0}, std::nullopt}));
  bench.run(6.0);
  EXPECT_EQ(bench.reason(), "obstacle in the way");
  bench.pillars.clear();
  bench.run(3.0);
  EXPECT_GT(bench.speed(), 0.9) << bench.reason();
}

TEST_P(GuardedRobot, BrakesByTheGuardHoweverItBrakes) {
  Bench bench{GetParam()};
  bench.drive();
  // A braking under way leads 0.5 m on; the pillar stands in it.
  bench.set_switches({true, false});
  bench.pillars = {{bench.pose.position_world + Eigen::Vector2d{0.3 + 0.3 + 0.62, 0.0}, 0.3}};
  bench.run(2.0);
  EXPECT_GT(bench.clearance, 0.0);
  EXPECT_EQ(bench.cause(), StopCause::emergency_stop);
}

TEST_P(GuardedRobot, DrivesOnlyWhereItsScannerSees) {
  HostParameters parameters;
  Bench bench{GetParam(), parameters};
  bench.drive();
  bench.send_scans = false;
  bench.run(2.0);
  EXPECT_EQ(bench.cause(), StopCause::no_scan);
  EXPECT_LT(bench.speed(), 0.005);
}

TEST_P(GuardedRobot, CanBeSwitchedOff) {
  HostParameters parameters;
  parameters.guard.enabled = false;
  Bench bench{GetParam(), parameters};
  bench.drive();
  EXPECT_EQ(bench.tracker.guard(), nullptr);
  EXPECT_EQ(bench.tracker.command().guard.action, GuardAction::none);
}

}  // namespace
}  // namespace spf::host
