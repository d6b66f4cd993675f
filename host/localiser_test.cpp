// Poses in, estimate out; what was applied to the wheels, not what was commanded, carries it on.
#include "host/localiser.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "spf/robot/drive.hpp"
#include "spf/testing/allocation_guard.hpp"

namespace spf::host {
namespace {

constexpr double kPoseTick = 0.01;  // [s]

PoseMeasurement pose_at(double time, double x) {
  return {time, {{x, 0.0}, 0.0}};
}

/// Rim speeds of a robot that drives along x [m/s].
Eigen::Vector3d forward(double speed) {
  return Drive{RobotParameters{}}.input_from_world({speed, 0.0, 0.0}, 0.0);
}

class LocaliserTest : public ::testing::Test {
 protected:
  /// Drives along x with this speed from 0 s on, and tells that another was applied.
  void drive(double seconds, double speed, double applied) {
    for (int i = 0; i <= std::lround(seconds / kPoseTick); ++i) {
      now = kPoseTick * i;
      ASSERT_TRUE(believed(localiser.add_pose(pose_at(now, speed * now), now)));
      if (i % 5 == 0) localiser.applied(now, forward(applied));
    }
  }
  [[nodiscard]] double x(double time) const { return localiser.estimate(time).pose_world.position_world.x(); }

  AgentParameters agent;
  HostParameters host;
  Localiser localiser{agent, host};
  double now = 0.0;
};

TEST_F(LocaliserTest, KnowsNothingBeforeTheFirstPose) {
  EXPECT_FALSE(localiser.has_pose());
  EXPECT_TRUE(std::isinf(localiser.pose_age(1.0)));
  EXPECT_TRUE(std::isinf(localiser.command_age(1.0)));
  EXPECT_FALSE(localiser.estimate(1.0).valid);
  EXPECT_FALSE(localiser.belief().valid);
}

TEST_F(LocaliserTest, IsCarriedByWhatWasApplied) {
  drive(2.0, 0.8, 0.8);
  EXPECT_NEAR(x(now + 0.2), 0.8 * (now + 0.2), 0.01);
  EXPECT_NEAR(localiser.belief().disturbance_world.x(), 0.0, 0.02);
  EXPECT_NEAR(localiser.command_age(now + 0.2), 0.2, 1e-9);
  // The base stopped by itself and said so: the next moments are a standstill, but for the motors' lag.
  localiser.applied(now, Eigen::Vector3d::Zero());
  EXPECT_LT(x(now + 0.4), 0.8 * now + 0.8 * agent.robot.motor_lag + 0.01);
}

TEST_F(LocaliserTest, KnowsWhereItWas) {
  EXPECT_FALSE(localiser.pose(0.0));
  drive(2.0, 0.8, 0.8);
  localiser.advance_to(now + 0.05);  // a control tick between two poses
  for (const double before : {0.0, 0.003, 0.1, 0.27, 0.3}) {
    ASSERT_TRUE(localiser.pose(now - before));
    EXPECT_NEAR(localiser.pose(now - before)->position_world.x(), 0.8 * (now - before), 0.005) << before;
  }
  EXPECT_NEAR(localiser.pose(now + 0.1)->position_world.x(), 0.8 * (now + 0.1), 0.01);
  for (int i = 0; i < 1000; ++i) {  // poses at 10 kHz do not shorten its memory
    now += 1e-4;
    ASSERT_TRUE(believed(localiser.add_pose(pose_at(now, 0.8 * now), now)));
  }
  EXPECT_NEAR(localiser.pose(now - 0.3)->position_world.x(), 0.8 * (now - 0.3), 0.02);
}

TEST(PoseHistory, TurnsTheShortWayRound) {
  PoseHistory history{0.3};
  EXPECT_FALSE(history.at(1.0));
  history.add(1.0, {{0.0, 0.0}, 3.0});
  history.add(2.0, {{1.0, 0.0}, -3.0});
  history.add(1.5, {{9.0, 9.0}, 0.0});  // late
  ASSERT_TRUE(history.at(1.5));
  EXPECT_NEAR(history.at(1.5)->position_world.x(), 0.5, 1e-12);
  EXPECT_NEAR(std::abs(history.at(1.5)->heading), 3.14159265, 1e-6);
  EXPECT_NEAR(history.at(0.0)->heading, 3.0, 1e-12);
  EXPECT_FALSE(history.at(2.1));
}

TEST_F(LocaliserTest, TakesWhatWasNotAppliedForADisturbance) {
  drive(6.0, 0.4, 0.8);  // told that 0.8 m/s was commanded, of which a limit left the half
  EXPECT_NEAR(localiser.belief().disturbance_world.x(), -0.4, 0.1);
}

TEST_F(LocaliserTest, TakesWheelsForStandingOfWhichNothingIsHeard) {
  drive(2.0, 0.8, 0.8);
  localiser.advance_to(now + host.command_silence + 0.3);
  EXPECT_TRUE(localiser.state().command.isZero());
  // As far as it was still driven, plus the lag of the motors; the disturbance is next to none.
  EXPECT_LT(x(now + 1.0), 0.8 * (now + host.command_silence + agent.robot.motor_lag) + 0.05);
  localiser.applied(now + 1.0, forward(0.5));
  EXPECT_EQ(localiser.state().command, forward(0.5));
}

TEST_F(LocaliserTest, RefusesPosesByNameAndCountsThem) {
  drive(0.5, 0.0, 0.0);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(localiser.add_pose(pose_at(now + kPoseTick, nan), now + kPoseTick), PoseVerdict::malformed);
  EXPECT_EQ(localiser.add_pose(pose_at(now + 1e6, 0.0), now + kPoseTick), PoseVerdict::future);
  EXPECT_EQ(localiser.add_pose(pose_at(now, 0.0), now + kPoseTick), PoseVerdict::late);
  EXPECT_EQ(localiser.add_pose(pose_at(now + kPoseTick, 5.0), now + kPoseTick), PoseVerdict::jump);
  EXPECT_EQ(localiser.poses_refused(), 4u);
  EXPECT_NEAR(x(now), 0.0, 1e-9);
  // Poses from the future do not hide that they fall silent.
  EXPECT_NEAR(localiser.pose_age(now + 0.4), 0.4, 1e-9);
}

TEST_F(LocaliserTest, BeginsAnewWhereAJumpPersistsAndStillKnowsItsCommand) {
  drive(1.0, 0.0, 0.0);
  localiser.applied(now, forward(0.3));
  PoseVerdict verdict = PoseVerdict::jump;
  int ticks = 0;
  for (; verdict == PoseVerdict::jump && ticks < 100; ++ticks) {
    now += kPoseTick;
    localiser.applied(now, forward(0.3));
    verdict = localiser.add_pose(pose_at(now, 7.0), now);
  }
  EXPECT_EQ(verdict, PoseVerdict::relocalised);
  EXPECT_NEAR(ticks * kPoseTick, host.jump_persistence, 2.0 * kPoseTick);
  EXPECT_NEAR(x(now), 7.0, 1e-9);
  EXPECT_EQ(localiser.state().command, forward(0.3));
}

TEST_F(LocaliserTest, KeepsItsPoseAndCommandWhenTheClockGoesBack) {
  drive(1.0, 0.8, 0.8);
  const double back = now - 50.0;
  localiser.meet_clock_jump(back);
  EXPECT_FALSE(localiser.has_pose());
  EXPECT_NEAR(x(back), 0.8, 0.01);
  EXPECT_EQ(localiser.state().command, forward(0.8));
  EXPECT_EQ(localiser.add_pose(pose_at(back + 0.01, 0.81), back + 0.01), PoseVerdict::accepted);
}

// The process was suspended, say: the base was told nothing meanwhile, and has stopped.
TEST_F(LocaliserTest, KeepsItsPoseButNoCommandWhenTheClockLeapsAhead) {
  drive(1.0, 0.8, 0.8);
  localiser.meet_clock_jump(500.0);
  EXPECT_NEAR(x(500.0), 0.8, 0.01);
  EXPECT_TRUE(localiser.state().command.isZero());
  EXPECT_EQ(localiser.add_pose(pose_at(500.01, 0.81), 500.01), PoseVerdict::accepted);
}

TEST_F(LocaliserTest, IgnoresCommandsThatComeLate) {
  localiser.applied(1.0, forward(0.5));
  localiser.applied(0.9, forward(0.1));
  EXPECT_EQ(localiser.state().command, forward(0.5));
  localiser.applied(1.0, forward(0.2));  // at the same time: what was really applied
  EXPECT_EQ(localiser.state().command, forward(0.2));
}

TEST_F(LocaliserTest, AllocatesNothing) {
  const DriveInput command = forward(0.5);
  const AllocationGuard guard;
  for (int i = 0; i < 100; ++i) {
    now += kPoseTick;
    localiser.add_pose(pose_at(now, 0.5 * now), now);
    localiser.applied(now, command);
  }
  EXPECT_EQ(guard.allocations(), 0);
}

}  // namespace
}  // namespace spf::host
