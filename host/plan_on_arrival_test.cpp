// A robot plans when something has been observed, within bounds, and goes on planning where nothing is.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "host/bench_test.hpp"
#include "spf/team/plan_schedule.hpp"

namespace spf::host {
namespace {

constexpr double kMillisecond = 0.001;  // [s]
const double kUsualPeriod = TeamParameters{}.plan_period;

HostParameters relying_on_nothing() {
  HostParameters host;
  host.relies_on_scan = host.relies_on_obstacles = false;
  return host;
}

SensedWorld no_obstacles(double time) {
  SensedWorld sensed;
  sensed.observation.time = time;
  sensed.has_detections = true;
  return sensed;
}

SensedWorld free_scan(double time) {
  SensedWorld sensed;
  sensed.observation.time = time;
  sensed.observation.scan = RangeScan{};
  sensed.observation.scan->angle_increment = 0.1;
  sensed.observation.scan->ranges.assign(60, std::numeric_limits<double>::infinity());
  return sensed;
}

/// A robot on its way, moved as it plans: its planner steps every millisecond and keeps the times of its
/// plans.
class PlanOnArrival : public testing::Test {
 protected:
  explicit PlanOnArrival(const HostParameters& host = relying_on_nothing())
      : robot{0, AgentParameters{}, host, Motion::as_planned} {
    robot.start(open_map(), Pose2{}, now);
    EXPECT_TRUE(robot.planner().set_goal({{15.0, 0.0}, std::nullopt}));
    run(1.0);
  }
  void tick() {
    now += kMillisecond;
    const PlannerOutput& output = robot.plan(now);
    if (output.planned) plans.push_back(now);
    if (output.planned) observed = output.observed;
  }
  void run(double seconds) {
    for (const double end = now + seconds - 1e-9; now < end;) tick();
  }
  /// Until the next plan [s].
  double time_to_plan() {
    const double from = now;
    const std::size_t before = plans.size();
    while (plans.size() == before && now < from + 1.0) tick();
    return now - from;
  }

  double now = 100.0;  // [s]
  RobotHost robot;
  std::vector<double> plans;  // [s] when they were made
  double observed = 0.0;      // [s] by the last of them
};

TEST_F(PlanOnArrival, ObservationsArePlannedWithAtOnce) {
  for (const bool scans : {false, true})
    for (const double after : {0.03, 0.05, 0.08}) {
      time_to_plan();
      run(after);
      const double made = now - 2.0 * kMillisecond;
      ASSERT_EQ(robot.add_observation(scans ? free_scan(made) : no_obstacles(made), now),
                ObservationVerdict::accepted);
      EXPECT_TRUE(robot.planner().plan_due(now));
      EXPECT_NEAR(time_to_plan(), kMillisecond, 1e-9);
      EXPECT_EQ(observed, made);
    }
}

TEST_F(PlanOnArrival, ARobotThatObservesNothingKeepsItsPeriod) {
  const std::size_t before = plans.size();
  run(10.0);
  EXPECT_NEAR(static_cast<double>(plans.size() - before), 10.0 / kUsualPeriod, 1.0);
}

TEST_F(PlanOnArrival, AScannerOfAnyRateIsPlannedWithScanByScanAndNoMoreOften) {
  for (const double period : {0.1, 0.067, 0.04, 0.025}) {
    SCOPED_TRACE(period);
    run(1.0);
    const std::size_t before = plans.size();
    int scans = 0;
    for (double next = now, end = now + 5.0; now < end;) {
      if (now >= next) {
        next += period;
        ++scans;
        robot.add_observation(free_scan(now), now);
        const double made = now;
        tick();
        EXPECT_EQ(observed, made);
      } else {
        tick();
      }
    }
    EXPECT_LE(plans.size() - before, static_cast<std::size_t>(scans) + 1U);
  }
}

TEST_F(PlanOnArrival, ABurstOfObservationsBringsNoMorePlansThanTheLeastIntervalAllows) {
  const std::size_t before = plans.size();
  const double begin = now;
  while (now < begin + 5.0) {
    robot.add_observation(no_obstacles(now), now);
    tick();
  }
  EXPECT_NEAR(static_cast<double>(plans.size() - before), 5.0 / HostParameters{}.least_plan_interval, 3.0);
}

TEST_F(PlanOnArrival, WhatIsRefusedBringsNoPlan) {
  time_to_plan();
  run(0.03);
  SensedWorld senseless = no_obstacles(now);
  senseless.observation.detections.resize(1);
  senseless.observation.detections[0].radius = -1.0;
  EXPECT_EQ(robot.add_observation(senseless, now), ObservationVerdict::malformed);
  EXPECT_EQ(robot.add_observation(no_obstacles(now - 1.0), now), ObservationVerdict::late);
  EXPECT_FALSE(robot.planner().plan_due(now));
  EXPECT_GT(time_to_plan(), 0.05);
}

TEST_F(PlanOnArrival, ManyPeersBringNoPlanEach) {
  const std::size_t before = plans.size();
  for (std::uint32_t round = 1; round <= 50; ++round) {
    for (int peer = 1; peer <= 20; ++peer) {
      TrajectoryMessage message;
      message.robot_id = peer;
      message.sequence = round;
      message.sent_time = now;
      message.expiry_time = now + 1.5;
      message.radius = 0.3;
      message.trajectory = Trajectory::standing({10.0, 0.5 * peer}, now, 1.0, HeadingProfile{0.0});
      EXPECT_EQ(robot.add_message(message, now), MessageVerdict::accepted);
      tick();
    }
  }
  EXPECT_NEAR(static_cast<double>(plans.size() - before), 1.0 / kUsualPeriod, 1.0);
}

TEST_F(PlanOnArrival, ObservationsThatEndLeaveNoGapLongerThanStated) {
  robot.add_observation(no_obstacles(now), now);
  time_to_plan();
  EXPECT_NEAR(time_to_plan(), kUsualPeriod + PlanSchedule::kLongestDelay, 2.0 * kMillisecond);
  EXPECT_NEAR(time_to_plan(), kUsualPeriod, 2.0 * kMillisecond);
}

class PlanByPeriod : public PlanOnArrival {
 protected:
  static HostParameters by_period_alone() {
    HostParameters host = relying_on_nothing();
    host.least_plan_interval = TeamParameters{}.plan_period;
    return host;
  }
  PlanByPeriod() : PlanOnArrival{by_period_alone()} {}
};

TEST_F(PlanByPeriod, WhereTheLeastIntervalIsThePeriodNothingBringsAPlanForward) {
  time_to_plan();
  run(0.03);
  robot.add_observation(no_obstacles(now), now);
  EXPECT_FALSE(robot.planner().plan_due(now));
  EXPECT_NEAR(time_to_plan(), kUsualPeriod - 0.03, 2.0 * kMillisecond);
}

/// A scan that lies nowhere tells nothing.
TEST(PlanOnArrivalByWheels, AScanWithoutAPoseBringsNoPlan) {
  RobotHost robot{0, AgentParameters{}, relying_on_nothing()};
  robot.start(open_map(), Pose2{}, 100.0);
  robot.plan(100.0);
  ASSERT_FALSE(robot.planner().plan_due(100.05));
  ASSERT_EQ(robot.add_observation(free_scan(100.05), 100.05), ObservationVerdict::accepted);
  EXPECT_FALSE(robot.planner().plan_due(100.05));
  robot.add_pose({100.05, Pose2{}}, 100.05);
  ASSERT_EQ(robot.add_observation(free_scan(100.051), 100.051), ObservationVerdict::accepted);
  EXPECT_TRUE(robot.planner().plan_due(100.051));
}

class ArrivalOnTheBench : public testing::TestWithParam<Arrangement> {};

INSTANTIATE_TEST_SUITE_P(Both, ArrivalOnTheBench,
                         testing::Values(Arrangement::one_process, Arrangement::split), name_of);

/// Scans come 0.03 s after the reports of obstacles: the controller is given a plan with each.
TEST_P(ArrivalOnTheBench, TheControllerFollowsAPlanWithTheNewestObservation) {
  Bench bench{GetParam()};
  bench.scan_delay = 0.03;
  bench.drive();
  int arrivals = 0;
  for (int tick = 0; tick < 200; ++tick) {
    bench.tick();
    for (const double after : {0.0, bench.scan_delay}) {
      if (std::abs(std::remainder(bench.time - 100.0 - after, 0.1)) > 1e-6) continue;
      EXPECT_LT(bench.tracker.plan_age(bench.now), 1e-6) << bench.time;
      ++arrivals;
    }
  }
  EXPECT_EQ(arrivals, 40);
}

}  // namespace
}  // namespace spf::host
