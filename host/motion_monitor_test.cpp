#include "host/motion_monitor.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "spf/math/random_stream.hpp"
#include "spf/testing/allocation_guard.hpp"

namespace spf::host {
namespace {

/// A robot that is told to drive along x, or to turn, and of whose motion a share comes true.
struct Journey {
  explicit Journey(double tick_of_poses = 0.01) : tick{tick_of_poses} {}

  MotionMonitor monitor{RobotParameters{}};
  RandomStream random{3};
  double tick;          // [s]
  double time = -50.0;  // of a clock that began before its zero
  Pose2 pose;
  double noise = 0.0;  // [m]

  /// Seconds until it is found stuck, at most `longest`.
  double run(const Eigen::Vector3d& told, double share, double longest) {
    for (const double from = time; time < from + longest;) {
      step(told, share);
      if (monitor.stuck(time)) return time - from;
    }
    return std::numeric_limits<double>::infinity();
  }
  double run(double speed, double share, double longest) {
    return run(Eigen::Vector3d{speed, 0.0, 0.0}, share, longest);
  }
  void step(const Eigen::Vector3d& told, double share) {
    time += tick;
    pose.position_world += tick * share * told.head<2>();
    pose.heading += tick * share * told.z();
    Pose2 measured = pose;
    measured.position_world += noise * random.normal2();
    monitor.note(time, measured, told);
  }
  /// Seconds until it may try again.
  double wait() {
    const double from = time;
    while (monitor.stuck(time)) step(Eigen::Vector3d::Zero(), 0.0);
    return time - from;
  }
};

TEST(MotionMonitor, FindsARobotThatDoesNotMoveWithinASecondAndALittle) {
  for (const double tick : {0.005, 0.01, 0.05, 0.1})
    for (const double share : {0.0, 0.1, -0.5})
      for (const double speed : {0.12, 0.5, 2.0}) {
        Journey drive{tick};
        EXPECT_TRUE(std::isinf(drive.run(speed, 1.0, 5.0)));
        const double found = drive.run(speed, share, 5.0);
        EXPECT_GE(found, 0.5);
        EXPECT_LE(found, 1.3) << tick << ", " << share << ", " << speed;
        EXPECT_EQ(drive.monitor.failures(), 1);
        EXPECT_GT(drive.monitor.displacement_in_vain().x(), 0.0);
      }
}

TEST(MotionMonitor, FindsOneThatIsKeptFromTurning) {
  Journey drive;
  const Eigen::Vector3d turn{0.0, 0.0, 1.0};
  EXPECT_TRUE(std::isinf(drive.run(turn, 1.0, 20.0)));  // three times around
  EXPECT_LE(drive.run(turn, 0.0, 5.0), 1.3);
  EXPECT_EQ(drive.monitor.displacement_in_vain(), (Eigen::Vector2d{0.0, 0.0}));
}

TEST(MotionMonitor, TakesNoRobotForStuckThatMovesStandsOrIsNotWellSeen) {
  EXPECT_TRUE(std::isinf(Journey{}.run(0.5, 1.0, 20.0)));
  EXPECT_TRUE(std::isinf(Journey{}.run(0.5, 0.5, 20.0)));  // slips, and gets on
  EXPECT_TRUE(std::isinf(Journey{}.run(0.0, 1.0, 20.0)));
  EXPECT_TRUE(std::isinf(Journey{}.run(0.05, 0.0, 20.0)));  // settles on its goal
  EXPECT_TRUE(std::isinf(Journey{0.2}.run(0.5, 1.0, 20.0)));
  for (const double noise : {0.01, 0.02, 0.05, 0.1, 0.3})
    for (const double speed : {0.1, 0.3, 1.0})
      for (const double tick : {0.01, 0.05}) {
        Journey drive{tick};
        drive.noise = noise;
        EXPECT_TRUE(std::isinf(drive.run(speed, 1.0, 300.0))) << noise << ", " << speed << ", " << tick;
      }
}

TEST(MotionMonitor, FindsAHeldRobotBehindNoiseOfAFewCentimetres) {
  Journey drive;
  drive.noise = 0.02;
  drive.run(0.5, 1.0, 5.0);
  EXPECT_LE(drive.run(0.5, 0.0, 5.0), 1.4);
}

// The poses jump by as much as it drives in the window, against its way or along it.
TEST(MotionMonitor, TakesAJumpOfThePosesForNeitherStandingNorDriving) {
  Journey driven;
  for (int i = 0; i < 20; ++i) {
    driven.pose.position_world.x() -= 0.4;
    EXPECT_TRUE(std::isinf(driven.run(0.4, 1.0, 1.5))) << i;
  }
  Journey held;
  EXPECT_TRUE(std::isinf(held.run(0.4, 0.0, 0.8)));
  held.pose.position_world.x() += 0.4;
  EXPECT_LE(held.run(0.4, 0.0, 5.0), 1.3);
}

TEST(MotionMonitor, WaitsLongerAfterEveryAttemptAndNotAfterASuccess) {
  Journey drive;
  const double braking = 0.5 / RobotParameters{}.max_acceleration;
  double wait = Attempts::kFirstWait;
  for (int attempt = 1; attempt < 7; ++attempt) {
    ASSERT_LE(drive.run(0.5, 0.0, 5.0), 1.3) << attempt;
    EXPECT_EQ(drive.monitor.failures(), attempt);
    EXPECT_NEAR(drive.wait(), wait + braking, 0.02) << attempt;
    wait = std::min(2.0 * wait, Attempts::kLongestWait);
  }
  EXPECT_TRUE(std::isinf(drive.run(-0.5, 1.0, 2.0)));  // aside, not yet away
  EXPECT_EQ(drive.monitor.failures(), 6);
  EXPECT_TRUE(std::isinf(drive.run(0.5, 1.0, 6.0)));
  EXPECT_EQ(drive.monitor.failures(), 0);
  drive.run(0.5, 0.0, 5.0);
  EXPECT_NEAR(drive.wait(), Attempts::kFirstWait + braking, 0.02);
}

TEST(MotionMonitor, ForgetsAcrossGapsAndResets) {
  Journey drive;
  EXPECT_TRUE(std::isinf(drive.run(0.5, 0.0, 0.8)));
  drive.time += 5.0;
  EXPECT_TRUE(std::isinf(drive.run(0.5, 0.0, 0.8)));
  drive.monitor.reset();
  EXPECT_TRUE(std::isinf(drive.run(0.5, 0.0, 0.8)));
  EXPECT_FALSE(std::isinf(drive.run(0.5, 0.0, 0.8)));
  drive.monitor.reset();
  EXPECT_FALSE(drive.monitor.stuck(drive.time));
  EXPECT_EQ(drive.monitor.failures(), 0);
}

TEST(MotionMonitor, SurvivesAnyTimesAndAllocatesNothing) {
  Journey drive;
  drive.run(0.5, 1.0, 2.0);
  const AllocationGuard guard;
  for (const double time : {1e300, -1e300, std::numeric_limits<double>::quiet_NaN(), 1e13, 1e13 + 1.0})
    drive.monitor.note(time, Pose2{}, Eigen::Vector3d::Zero());
  EXPECT_FALSE(drive.monitor.stuck(1e13 + 2.0));
  EXPECT_EQ(guard.allocations(), 0u);
}

}  // namespace
}  // namespace spf::host
