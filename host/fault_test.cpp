// Each fault and its reaction, of a robot in one process and of one that is split: the table of
// docs/faults.md, without ROS.
#include <gtest/gtest.h>

#include <cstdint>
#include <memory>

#include "host/bench_test.hpp"

namespace spf::host {
namespace {

constexpr double kStale = 0.3;            // [s] TeamParameters::stale_time
constexpr double kReaction = 0.1 + 1e-9;  // [s] within which braking begins, and rounding
constexpr double kStanding = 0.005;       // [m/s], [m] of a controller that settles on its position
constexpr double kTick = Bench::kTick;

/// Brakes in time, at the largest planned acceleration, stands with this reason, and goes on by itself.
void expect_brakes_and_recovers(Bench& bench, bool& working, double earliest, double latest,
                                const std::string& reason) {
  bench.hardest_braking = 0.0;
  working = false;
  const double delay = bench.time_until_braking();
  EXPECT_GE(delay, earliest);
  EXPECT_LE(delay, latest);
  const Eigen::Vector2d begun = bench.pose.position_world;
  bench.run(2.0);
  EXPECT_LT(bench.speed(), kStanding);
  EXPECT_TRUE(bench.reason() == reason || to_string(bench.cause()) == reason)
      << bench.reason() << ", " << to_string(bench.cause());
  // v^2 / 2a = 0.5 m and the ramps of the jerk; the controller may lag behind its reference by a little.
  EXPECT_LT((bench.pose.position_world - begun).norm(), 0.65);
  EXPECT_GT(bench.hardest_braking, 0.8);
  EXPECT_LT(bench.hardest_braking, 1.6);
  const Eigen::Vector2d stood = bench.pose.position_world;
  bench.run(1.0);
  EXPECT_LT((bench.pose.position_world - stood).norm(), kStanding);
  working = true;
  bench.run(2.5);
  EXPECT_GT(bench.speed(), 0.9) << bench.reason() << ", " << to_string(bench.cause());
}

class Faults : public testing::TestWithParam<Arrangement> {};

INSTANTIATE_TEST_SUITE_P(Both, Faults, testing::Values(Arrangement::one_process, Arrangement::split),
                         name_of);

TEST_P(Faults, DrivesToItsGoalWithoutAny) {
  Bench bench{GetParam()};
  bench.planner.set_goal({{4.0, 1.0}, std::nullopt});
  bench.run(9.0);
  EXPECT_LT((bench.pose.position_world - Eigen::Vector2d{4.0, 1.0}).norm(), 0.05);
  EXPECT_EQ(bench.reason(), "arrived");
  EXPECT_EQ(bench.cause(), StopCause::none);
  EXPECT_EQ(bench.planner.counts().inputs_refused, 0u);
}

TEST_P(Faults, StalePose) {
  Bench bench{GetParam()};
  bench.drive();
  expect_brakes_and_recovers(bench, bench.send_poses, kStale - kTick, kStale + kReaction, "stale pose");
}

/// The default method, which counts how often it is asked.
class CountedPlanner final : public Planner {
 public:
  CountedPlanner(const AgentParameters& agent, std::uint32_t* calls)
      : planner_{make_space_time_planner(agent)}, calls_{calls} {}
  void plan(const PlanRequest& request, PlanResult& result) override {
    ++*calls_;
    planner_->plan(request, result);
  }

 private:
  std::unique_ptr<Planner> planner_;
  std::uint32_t* calls_;
};

// While poses are missing the planner is not asked, and what it said last is not counted again.
TEST_P(Faults, PlansThatWereNotMadeAreNotCounted) {
  std::uint32_t calls = 0;
  AgentParameters agent;
  agent.make_planner = [&](const AgentParameters& parameters) {
    return std::make_unique<CountedPlanner>(parameters, &calls);
  };
  Bench bench{GetParam(), {}, 0, agent};
  bench.drive();
  EXPECT_GT(calls, 10u);
  EXPECT_EQ(bench.planner.counts().plans, calls);
  bench.send_poses = false;
  bench.run(kStale + kReaction);
  ASSERT_EQ(bench.reason(), "stale pose");
  const std::uint32_t before_gap = calls;
  const PlanOutcome last = bench.planner.agent()->last_plan().outcome;
  bench.run(2.0);
  EXPECT_LT(bench.speed(), kStanding);
  EXPECT_EQ(calls, before_gap);
  EXPECT_EQ(bench.planner.counts().plans, calls);
  EXPECT_EQ(bench.planner.agent()->stop_cause(), StopCause::stale_pose);
  EXPECT_EQ(bench.planner.agent()->last_plan().outcome, last);
  bench.send_poses = true;
  bench.run(2.5);
  EXPECT_GT(calls, before_gap + 10u);
  EXPECT_EQ(bench.planner.counts().plans, calls);
  EXPECT_EQ(bench.planner.agent()->stop_cause(), StopCause::none);
}

// Odometry goes on, but what places it in the map has died.
TEST_P(Faults, StaleLocalisation) {
  Bench bench{GetParam()};
  bool alive = true;
  double last = 0.0;
  const auto localise = [&] {
    if (alive) last = bench.now;
    bench.localised = last;
  };
  localise();
  bench.each_tenth = localise;
  bench.drive();
  // The last word may be up to 0.1 s old when it ends.
  expect_brakes_and_recovers(bench, alive, kStale - 0.1 - 2.0 * kTick, kStale + kReaction,
                             "stale localisation");
}

TEST_P(Faults, StaleScan) {
  Bench bench{GetParam()};
  bench.drive();
  // The last scan may be up to 0.1 s old when they end.
  expect_brakes_and_recovers(bench, bench.send_scans, kStale - 0.1 - kTick, kStale + kReaction, "no scan");
}

// A scanner or a network that is slow: what is seen lies where it was seen from, not where the robot is now.
TEST_P(Faults, ScansThatComeLateAreSeenFromWhereTheyWereMade) {
  for (const double delay : {0.0, 0.05, 0.15}) {
    Bench bench{GetParam()};
    bench.scan_delay = delay;
    bench.pillars = {{{3.0, 2.0}, 0.4}, {{6.0, -2.0}, 0.4}, {{9.0, 2.0}, 0.4}};
    ASSERT_TRUE(bench.planner.set_goal({{12.0, 0.0}, std::nullopt}));
    bench.run(9.0);
    ASSERT_GT(bench.pose.position_world.x(), 5.0) << bench.reason();
    const std::vector<Eigen::Vector2d> seen = bench.planner.map()->occupied_points();
    EXPECT_GT(seen.size(), 15u);
    for (const Eigen::Vector2d& point : seen) {
      double off = 1e9;
      for (const Pillar& pillar : bench.pillars)
        off = std::min(off, std::abs((point - pillar.center).norm() - pillar.radius));
      EXPECT_LT(off, 0.03) << delay << ": " << point.transpose();
    }
  }
}

TEST_P(Faults, StaleReportsOfObstacles) {
  Bench bench{GetParam()};
  bench.drive();
  expect_brakes_and_recovers(bench, bench.send_detections, kStale - 0.1 - kTick, kStale + kReaction,
                             "no report of obstacles");
}

TEST(SplitFaults, SilentPlanner) {
  Bench bench;
  bench.drive();
  expect_brakes_and_recovers(bench, bench.planner_alive, bench.host.plan_silence - 0.1 - kTick,
                             bench.host.plan_silence + kReaction, "stale plan");
}

TEST_P(Faults, WhatIsNotReliedOnMayBeMissing) {
  HostParameters parameters;
  parameters.relies_on_scan = false;
  parameters.relies_on_obstacles = false;
  Bench bench{GetParam(), parameters};
  bench.send_scans = bench.send_detections = false;
  bench.drive();
}

TEST_P(Faults, SinglePosesThatAreNotNumbersOrFarAwayAreIgnored) {
  Bench bench{GetParam()};
  bench.drive();
  long tick = 0;
  bench.distort = [&](const Pose2& truth) {
    Pose2 told = truth;
    if (++tick % 2 == 0) told.position_world.x() = tick % 4 == 0 ? NAN : 1e3;
    return told;
  };
  const Eigen::Vector2d from = bench.pose.position_world;
  bench.run(2.0);
  EXPECT_GT(bench.speed(), 0.9);
  EXPECT_NEAR((bench.pose.position_world - from).norm(), 2.0, 0.1);
  EXPECT_EQ(bench.cause(), StopCause::none);
}

TEST_P(Faults, PosesThatAreAllNotNumbersAreNone) {
  Bench bench{GetParam()};
  bench.drive();
  bench.distort = [](const Pose2&) { return Pose2{{NAN, 0.0}, 0.0}; };
  const double delay = bench.time_until_braking();
  EXPECT_GE(delay, kStale - kTick);
  EXPECT_LE(delay, kStale + kReaction);
}

TEST_P(Faults, AJumpIsAFaultUntilItPersistsThenARelocalisation) {
  Bench bench{GetParam()};
  bench.drive();
  const Eigen::Vector2d jump{0.0, 3.0};
  bench.distort = [&](const Pose2& truth) { return Pose2{truth.position_world + jump, truth.heading}; };
  const double delay = bench.time_until_braking();
  EXPECT_GE(delay, kStale - kTick);
  EXPECT_LE(delay, kStale + kReaction);
  bench.run(0.3);  // believed after half a second
  const double before = bench.pose.position_world.y();
  bench.run(6.0);
  EXPECT_EQ(bench.planner.counts().restarts, 2u);
  EXPECT_GT(bench.speed(), 0.9) << bench.reason() << ", " << to_string(bench.cause());
  // The path to the goal leads down now; it is driven, not jumped.
  EXPECT_LT(bench.pose.position_world.y(), before - 0.5);
}

// Under whatever cause it brakes: it is not pulled to where it was thought to be.
TEST_P(Faults, ARelocalisationUnderWayBrakesOnTheSpot) {
  for (const bool emergency : {false, true}) {
    for (const double delay : {0.0, 0.2, 0.4}) {
      Bench bench{GetParam()};
      bench.drive();
      if (emergency) bench.set_switches({true, false});
      bench.run(delay);
      bench.distort = [](const Pose2& truth) {
        return Pose2{truth.position_world + Eigen::Vector2d{0.5, 2.0}, truth.heading};
      };
      const Eigen::Vector2d from = bench.pose.position_world;
      for (int i = 0; i < 180; ++i) {
        bench.tick();
        ASSERT_LE(bench.speed(), 1.1) << emergency << ", " << delay << ", " << i;
      }
      EXPECT_LE(std::abs(bench.pose.position_world.y() - from.y()), 0.15) << emergency << ", " << delay;
      if (emergency) {
        EXPECT_LT(bench.speed(), kStanding) << delay;
      }
    }
  }
}

TEST_P(Faults, AJumpThatPassesLeavesNoTrace) {
  Bench bench{GetParam()};
  bench.drive();
  bench.distort = [](const Pose2& truth) {
    return Pose2{truth.position_world + Eigen::Vector2d{3.0, 0.0}, 0.0};
  };
  bench.run(0.2);
  bench.distort = nullptr;
  bench.run(1.0);
  EXPECT_GT(bench.speed(), 0.9);
  EXPECT_EQ(bench.planner.counts().restarts, 1u);
}

TEST_P(Faults, EmergencyStopBrakesAndHoldsUntilReleased) {
  Bench bench{GetParam()};
  bench.drive();
  bench.hardest_braking = 0.0;
  bench.set_switches({true, false});
  EXPECT_LE(bench.time_until_braking(), kReaction);
  bench.run(3.0);
  EXPECT_EQ(bench.speed(), 0.0);
  EXPECT_EQ(bench.cause(), StopCause::emergency_stop);
  EXPECT_EQ(bench.reason(), "emergency stop");
  EXPECT_GT(bench.hardest_braking, 0.8);
  bench.set_switches({});
  bench.run(2.0);
  EXPECT_GT(bench.speed(), 0.9);
}

TEST_P(Faults, PauseCancelAndANewGoal) {
  Bench bench{GetParam()};
  bench.drive();
  bench.set_switches({false, true});
  bench.run(2.0);
  EXPECT_LT(bench.speed(), kStanding);
  EXPECT_EQ(bench.reason(), "paused");
  bench.set_switches({});
  bench.run(2.0);
  EXPECT_GT(bench.speed(), 0.9);
  bench.planner.cancel();
  bench.run(2.0);
  EXPECT_LT(bench.speed(), 0.01);
  EXPECT_EQ(bench.reason(), "no goal");
  EXPECT_FALSE(bench.planner.set_goal({{NAN, 0.0}, std::nullopt}));
  EXPECT_FALSE(bench.planner.set_goal({{1e9, 0.0}, std::nullopt}));
  EXPECT_TRUE(bench.planner.set_goal({{-5.0, 0.0}, std::nullopt}));
  bench.run(3.0);
  EXPECT_LT(bench.velocity_world.x(), -0.9);
}

TEST_P(Faults, ClockJumpsBothWays) {
  for (const double offset : {30.0, -30.0, -95.0}) {
    SCOPED_TRACE(offset);
    Bench bench{GetParam()};
    bench.drive();
    bench.clock_offset = offset;
    const Eigen::Vector2d at = bench.pose.position_world;
    EXPECT_LE(bench.time_until_braking(), kReaction);
    bench.run(0.5);
    EXPECT_LT((bench.pose.position_world - at).norm(), 1.0);
    bench.run(4.5);
    EXPECT_GT(bench.speed(), 0.9) << bench.reason() << ", " << to_string(bench.cause());
    for (const std::uint32_t jumps : bench.clock_jumps()) EXPECT_EQ(jumps, 1u);
  }
}

TEST(SplitFaults, ARestartedPlannerWaitsForTheRobotToStandAndGoesOn) {
  Bench bench;
  bench.drive();
  bench.restart_planner();
  ASSERT_TRUE(bench.planner.set_goal({{15.0, 0.0}, std::nullopt}));  // latched by whoever sets it
  const double delay = bench.time_until_braking();
  EXPECT_LE(delay, bench.host.plan_silence + kReaction);
  double hardest = 0.0;
  for (int i = 0; i < 500; ++i) {
    const double before = bench.speed();
    bench.tick();
    hardest = std::max(hardest, std::abs(bench.speed() - before));
  }
  EXPECT_GT(bench.speed(), 0.9) << bench.reason() << ", " << to_string(bench.cause());
  EXPECT_LT(hardest, 0.1);  // no jump: 2 m/s^2 over a control period
}

// Until its first pose and plan it commands standstill, and then speeds up no faster than planned.
TEST(SplitFaults, ARestartedTrackerTakesOver) {
  Bench bench;
  bench.drive();
  bench.restart_tracker();
  bench.run(0.1);
  for (int i = 0; i < 240; ++i) {
    const double before = bench.speed();
    bench.tick();
    EXPECT_LE(bench.speed() - before, 1.1 * 0.05);
  }
  EXPECT_GT(bench.speed(), 0.9);
  EXPECT_EQ(bench.cause(), StopCause::none);
}

}  // namespace
}  // namespace spf::host
